//! A model, the camera that orbits it, and its images.

use std::f64::consts::PI;
use std::sync::Arc;

use serde::Serialize;
use trigon_camera::{AxisView, Camera, DEFAULT_MARGIN, Orbit, Projection};
use trigon_io::{Limits, LoadOptions, Pixels, encode_png, load_from_files};
use trigon_math::{Bounds3, DVec3, elementary};
use trigon_scene::{
    Background, Display, Frame, OVERVIEW_DIRECTION, RenderSettings, Renderer, Scene, Style, css_color,
    quality::Quality,
};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::facts::Facts;
use crate::files::Files;
use crate::refusal::Refusal;

/// A model that was loaded.
#[wasm_bindgen]
pub struct Model {
    scene: Scene,
    facts: Facts,
    bounds: Bounds3,
    orbit: Orbit,
    renderer: Renderer,
    frame: Arc<Frame>,
    /// Of images that are no drafts.
    quality: Quality,
}

/// The size of images until the page sets another one, as that of the viewer.
const SIZE: [u32; 2] = [1000, 600];

/// What a file may use: a module has no more than 4 GiB of memory.
fn limits() -> Limits {
    Limits { file_bytes: 1 << 30, total_bytes: 1 << 30, total_pixels: 1 << 27, ..Limits::default() }
}

#[wasm_bindgen]
impl Model {
    /// Loads the file of a path, and what it refers to.
    ///
    /// # Errors
    /// A JSON text, as [`Refusal`] has it.
    pub fn load(files: Files, path: &str) -> Result<Self, String> {
        let options = LoadOptions { limits: limits(), ..LoadOptions::default() };
        let loaded =
            load_from_files(path, files.by_path, &options).map_err(|error| Refusal::of_file(&error))?;
        let facts = Facts::new(&loaded);
        let scene = loaded.scene;
        let settings = RenderSettings::new(SIZE[0], SIZE[1]);
        let mut model = Self {
            bounds: scene.tight_bounds(),
            orbit: Orbit::new(scene.up.direction()),
            scene,
            facts,
            quality: Quality::of(&settings),
            renderer: Renderer::new(settings),
            frame: Arc::default(),
        };
        model.reset();
        Ok(model)
    }

    /// Counts, sizes and warnings, as JSON.
    #[must_use]
    pub fn facts(&self) -> String {
        json(&self.facts)
    }

    /// Looks from the upper right in front again, so that the model fills the image.
    pub fn reset(&mut self) {
        self.orbit = Orbit::new(self.scene.up.direction());
        self.orbit.look_along(self.scene.up.frame() * OVERVIEW_DIRECTION);
        self.fit();
    }

    /// Moves the camera so that the model fills the image, seen from the same side.
    pub fn fit(&mut self) {
        let points: Vec<DVec3> = self.scene.visible_points().collect();
        self.orbit.fit_points(&points, self.renderer.settings().aspect(), DEFAULT_MARGIN);
    }

    /// Sets the size of the images in pixels.
    pub fn resize(&mut self, width: u32, height: u32) {
        let settings = self.renderer.settings_mut();
        (settings.width, settings.height) = (width, height);
    }

    /// Sets how many samples there are along each side of a pixel, 1 to 4, in images that are no drafts.
    #[wasm_bindgen(js_name = setSamples)]
    pub fn set_samples(&mut self, per_axis: u32) {
        self.quality.samples_per_axis = per_axis;
    }

    /// Sets how many samples take the place of each of these where faces end: 1, 2, 4, 8 or 16.
    #[wasm_bindgen(js_name = setEdgeSamples)]
    pub fn set_edge_samples(&mut self, samples: u32) {
        self.quality.samples = samples;
    }

    /// Sets how many surfaces a ray through glass may meet, 1 to 16.
    #[wasm_bindgen(js_name = setGlassBounces)]
    pub fn set_glass_bounces(&mut self, bounces: u32) {
        self.quality.glass_bounces = bounces;
    }

    /// The pointer was dragged with the model in its hand, by parts of the image's height.
    pub fn drag(&mut self, right: f64, down: f64) {
        self.orbit.orbit(-right * PI, -down * PI);
    }

    /// The pointer moved the model, by parts of the image's height.
    pub fn pan(&mut self, right: f64, down: f64) {
        let height = self.orbit.height_at_target();
        self.orbit.pan(-right * height, down * height);
    }

    /// Magnifies by e to a power.
    pub fn zoom(&mut self, power: f64) {
        self.orbit.zoom(elementary::exp(power));
    }

    /// Rolls the camera, in radians.
    pub fn roll(&mut self, angle: f64) {
        self.orbit.roll(angle);
    }

    /// Turns the camera about the model, in radians.
    pub fn orbit(&mut self, right: f64, up: f64) {
        self.orbit.orbit(right, up);
    }

    /// Looks from `front`, `back`, `right`, `left`, `top`, `bottom` or `isometric`; ignores other names.
    #[wasm_bindgen(js_name = lookFrom)]
    pub fn look_from(&mut self, side: &str) {
        let found = AxisView::ALL.into_iter().find(|view| format!("{view:?}").eq_ignore_ascii_case(side));
        if let Some(view) = found {
            self.orbit.set_view(view);
            self.fit();
        }
    }

    /// Switches between perspective and parallel lines of sight.
    #[wasm_bindgen(js_name = toggleOrthographic)]
    pub fn toggle_orthographic(&mut self) {
        self.orbit.toggle_orthographic();
    }

    /// Places the camera at angles in radians, around the model from its front to the right and up from its horizon;
    /// and at a distance, or where the model fills the image.
    #[wasm_bindgen(js_name = setOrbit)]
    pub fn set_orbit(&mut self, azimuth: f64, elevation: f64, distance: Option<f64>) {
        self.orbit.set_angles(azimuth, elevation, 0.0);
        self.fit();
        if let Some(distance) = distance {
            self.orbit.set_distance(distance);
        }
    }

    /// The distance of the camera from what it turns about.
    #[must_use]
    pub fn distance(&self) -> f64 {
        self.orbit.distance()
    }

    /// Sets the angle from the lower to the upper edge of the image, in radians; angles that no lens has are ignored.
    #[wasm_bindgen(js_name = setFieldOfView)]
    pub fn set_field_of_view(&mut self, angle: f64) {
        if let Ok(projection) = Projection::perspective(angle, 1.0, None) {
            self.orbit.set_projection(projection);
        }
    }

    /// Sets what faces show, by a name of [`displays`](crate::displays); ignores other names.
    #[wasm_bindgen(js_name = setDisplay)]
    pub fn set_display(&mut self, name: &str) {
        if let Some(display) = Display::ALL.into_iter().find(|display| display.name() == name) {
            self.renderer.settings_mut().display = display;
        }
    }

    /// Sets how surfaces are drawn: `surface`, `edges`, `wireframe` or `hidden-line`; ignores other names.
    #[wasm_bindgen(js_name = setStyle)]
    pub fn set_style(&mut self, name: &str) {
        let style = match name {
            "surface" => Style::Surface,
            "edges" => Style::SurfaceWithEdges,
            "wireframe" => Style::Wireframe,
            "hidden-line" => Style::HiddenLine,
            _ => return,
        };
        self.renderer.settings_mut().style = style;
    }

    /// Sets a colour of CSS as the background, `transparent`, or the gradient of the viewer for an empty text. Whether
    /// the text is a colour.
    #[wasm_bindgen(js_name = setBackground)]
    pub fn set_background(&mut self, color: &str) -> bool {
        let background = match (color, css_color(color)) {
            ("", _) => Background::default(),
            (_, Ok(color)) if color.w == 0.0 => Background::Transparent,
            (_, Ok(color)) => Background::Color(color.truncate()),
            (_, Err(_)) => return false,
        };
        self.renderer.settings_mut().background = background;
        true
    }

    /// Sets a factor for every light.
    #[wasm_bindgen(js_name = setLight)]
    pub fn set_light(&mut self, factor: f32) {
        self.renderer.settings_mut().light_intensity = factor;
    }

    /// Poses the model as an animation does at a time in seconds. Animations are counted from 0.
    pub fn animate(&mut self, animation: usize, time: f64) {
        if let Some(animation) = self.scene.animations.get(animation) {
            let pose = self.scene.pose(animation, time);
            self.scene.apply_pose(&pose);
            self.bounds = self.scene.tight_bounds();
        }
    }

    /// Draws an image. A draft has one sample for each pixel, and may show coarser meshes.
    ///
    /// # Errors
    /// A JSON text: the size or a setting is out of range.
    pub fn draw(&mut self, is_draft: bool) -> Result<(), String> {
        let camera = self.camera();
        let quality =
            if is_draft { Quality { samples_per_axis: 1, samples: 1, ..self.quality } } else { self.quality };
        quality.apply(self.renderer.settings_mut());
        let drawn = if is_draft {
            self.renderer.render_draft(&self.scene, &camera, None)
        } else {
            self.renderer.render_shared(&self.scene, &camera, None)
        };
        self.frame = drawn.map_err(Refusal::of_image)?;
        Ok(())
    }

    /// Where in the module's memory the last image is: rows of red, green, blue and alpha, from the top.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.frame.color.as_ptr().addr()
    }

    /// The last image as the bytes of a PNG file.
    ///
    /// # Errors
    /// A JSON text: nothing was drawn yet.
    pub fn png(&self) -> Result<Vec<u8>, String> {
        let Frame { width, height, color, .. } = &*self.frame;
        let mut png = Vec::new();
        encode_png(&mut png, *width, *height, Pixels::Rgba8(color)).map_err(Refusal::of_image)?;
        Ok(png)
    }

    /// Why a pixel of an image that is no draft looks as it does, as JSON: the name of what is visible, its face, and the
    /// whole explanation as a text.
    ///
    /// # Errors
    /// A JSON text: the image cannot be drawn, or the pixel lies outside of it.
    pub fn explain(&mut self, x: u32, y: u32) -> Result<String, String> {
        let camera = self.camera();
        self.quality.apply(self.renderer.settings_mut());
        let pixel = self.renderer.explain_pixel(&self.scene, &camera, x, y).map_err(Refusal::of_image)?;
        let pixel = pixel.ok_or_else(|| Refusal::of_image("the pixel lies outside of the image"))?;
        let visible = pixel.reported().visible();
        let node = visible.and_then(|visible| self.scene.nodes().id_at(visible.object as usize));
        let name = node.and_then(|id| self.scene.node(id)).map(|node| node.name.clone());
        let face = visible.map(|visible| visible.face).filter(|&face| face != u32::MAX);
        Ok(json(&Explanation { name, face, text: pixel.to_string() }))
    }

    pub(crate) fn camera(&self) -> Camera {
        self.orbit.camera(&self.bounds)
    }

    pub(crate) fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Of images that are no drafts.
    pub(crate) fn image_settings(&self) -> RenderSettings {
        let mut settings = self.renderer.settings().clone();
        self.quality.apply(&mut settings);
        settings
    }
}

/// Why a pixel looks as it does.
#[derive(Serialize)]
struct Explanation {
    /// Of the node; `None` for the background.
    name: Option<String>,
    face: Option<u32>,
    text: String,
}

pub(crate) fn json(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_else(|error| Refusal::of_image(error))
}
