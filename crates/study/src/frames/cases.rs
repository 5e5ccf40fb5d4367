//! The scenes, and a flight past each. The reference image has more samples than any quality has, at
//! positions that none of them uses.

use trigon_io::LoadOptions;
use trigon_math::color::srgb8_to_linear;
use trigon_math::{DQuat, DVec3, Vec3};
use trigon_mesh::primitives::TorusKnot;
use trigon_mesh::{Mesh, primitives};
use trigon_scene::camera::Camera;
use trigon_scene::quality::Preset;
use trigon_scene::{
    Frame, Light, Material, Node, RenderError, RenderSettings, Scene, Shadows, Texture, TextureFormat,
    Transform, showcase,
};

use super::Repeated;

/// A scene and its camera path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FrameCase {
    /// The built-in scene: some objects, many lights, fine wood.
    Showcase,
    /// Knots on a chequered floor, with shadows.
    Shadows,
    /// 36 balls of 5,120 triangles, most of which are smaller than a pixel.
    Dense,
    /// The teapot of Martin Newell, 1975, with shadows.
    Teapot,
    /// A chair that was modelled with trigon's editor (`docs/models/chair.json`), with shadows.
    Chair,
    /// A mug that was modelled likewise, with shadows.
    Mug,
}

impl FrameCase {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Showcase, Self::Shadows, Self::Dense, Self::Teapot, Self::Chair, Self::Mug];

    /// The name in tables and plots.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Showcase => "the built-in scene",
            Self::Shadows => "knots and their shadows",
            Self::Dense => "184,320 triangles",
            Self::Teapot => "a teapot",
            Self::Chair => "a chair",
            Self::Mug => "a mug",
        }
    }

    /// Whether it has shadows.
    #[must_use]
    pub fn has_shadows(self) -> bool {
        !matches!(self, Self::Showcase | Self::Dense)
    }

    /// What is drawn.
    #[must_use]
    pub fn scene(self) -> Scene {
        match self {
            Self::Showcase => showcase(),
            Self::Shadows => knots(),
            Self::Dense => balls(),
            Self::Teapot => standing(&primitives::teapot(12), Vec3::new(0.75, 0.72, 0.68)),
            Self::Chair => standing(&read(include_str!("../../models/chair.obj")), Vec3::new(0.5, 0.3, 0.16)),
            Self::Mug => standing(&read(include_str!("../../models/mug.obj")), Vec3::new(0.25, 0.45, 0.65)),
        }
    }

    /// An image of it, at no particular quality.
    #[must_use]
    pub fn settings(self, [width, height]: [u32; 2]) -> RenderSettings {
        let mut settings = RenderSettings::new(width, height);
        if self.has_shadows() {
            settings.effects.shadows = Shadows::Maps { resolution: 1024 };
        }
        settings
    }

    /// The camera at a fraction of the flight, from 0 to 1: three eighths of a circle around the scene,
    /// rising, and a third nearer in the middle than at either end. No constant of the cost and error models
    /// was fitted to such a flight.
    #[must_use]
    pub fn camera(self, scene: &Scene, aspect: f64, part: f64) -> Camera {
        let start = scene.cameras().first().map_or_else(|| scene.overview(aspect), |(_, camera)| *camera);
        let turn = DQuat::from_axis_angle(DVec3::Y, -std::f64::consts::TAU * 0.375 * part)
            * DQuat::from_axis_angle(start.orientation * DVec3::X, -0.3 * part);
        let nearer = 1.0 - 4.0 / 3.0 * part * (1.0 - part);
        let position = turn * start.position * nearer;
        Camera { position, orientation: (turn * start.orientation).normalize(), ..start }
    }
}

/// A model on a chequered floor four times as wide, in the sun; one unit high.
fn standing(mesh: &Mesh, color: Vec3) -> Scene {
    let bounds = mesh.bounds();
    let scale = 1.0 / (bounds.max.y - bounds.min.y);
    let foot = DVec3::Y * bounds.min.y;
    let mut scene = Scene::new();
    let pattern = scene.add_texture("pattern", chequered());
    scene.add_object("floor", primitives::plane(4.0, 4.0), Material::from_texture(pattern));
    let (mesh, material) =
        (scene.add_mesh("model", mesh.clone()), scene.add_material(Material::from_color(color)));
    let spot =
        Transform::from_scale_rotation_translation(DVec3::splat(scale), DQuat::IDENTITY, -foot * scale);
    scene.add(Node::from_mesh(mesh, material).with_transform(spot));
    add_sun(&mut scene);
    scene
}

/// The mesh of a file of this crate.
fn read(text: &str) -> Mesh {
    let loaded = trigon_io::load_from_slice("model.obj", text.as_bytes(), &LoadOptions::default());
    let scene = loaded.expect("the model is part of this crate").scene;
    let mut meshes = scene.meshes().iter().map(|(_, asset)| asset.mesh().clone());
    meshes.next().expect("it has a mesh")
}

/// Nine knots in rows on a floor with a fine pattern, in the sun.
fn knots() -> Scene {
    let mut scene = Scene::new();
    let pattern = scene.add_texture("pattern", chequered());
    scene.add_object("floor", primitives::plane(8.0, 8.0), Material::from_texture(pattern));
    let shape =
        TorusKnot { major_radius: 0.5, minor_radius: 0.22, tube_radius: 0.12, ..TorusKnot::default() };
    let mesh = scene.add_mesh("knot", primitives::torus_knot(&shape));
    for spot in 0..9 {
        let [column, row] = [spot % 3, spot / 3].map(|step| f64::from(step - 1));
        let color = Vec3::new(0.7 - 0.2 * row as f32, 0.4, 0.5 + 0.2 * column as f32);
        let material = scene.add_material(Material::from_color(color));
        scene.add(Node::from_mesh(mesh, material).at(DVec3::new(2.2 * column, 0.8, 2.2 * row)));
    }
    add_sun(&mut scene);
    scene
}

/// The sun, and some light from everywhere.
fn add_sun(scene: &mut Scene) {
    let down = DQuat::from_axis_angle(DVec3::Y, 0.6) * DQuat::from_axis_angle(DVec3::X, -0.9);
    let sun = Transform::from_scale_rotation_translation(DVec3::ONE, down, DVec3::ZERO);
    scene.add(Node::from_light(Light::directional(0.8)).with_transform(sun));
    scene.add(Node::from_light(Light::ambient(0.25)));
}

/// Fields of 16 texels.
fn chequered() -> Texture {
    const SIDE: u32 = 512;
    let texel = |index: u32| {
        let is_light = (index % SIDE / 16 + index / SIDE / 16).is_multiple_of(2);
        if is_light { [220, 214, 200, 255] } else { [60, 70, 92, 255] }
    };
    let texels = (0..SIDE * SIDE).map(texel).collect();
    Texture::new(SIDE, SIDE, texels, TextureFormat::Srgb).expect("the size is within the limits")
}

/// Balls in a square; lit by the lights that come with the camera.
fn balls() -> Scene {
    let mut scene = Scene::new();
    let mesh = scene.add_mesh("ball", primitives::icosphere(0.45, 4));
    let material = scene.add_material(Material::from_color(Vec3::new(0.75, 0.55, 0.3)));
    for spot in 0..36 {
        let [x, z] = [spot % 6, spot / 6].map(|step| f64::from(step) - 2.5);
        scene.add(Node::from_mesh(mesh, material).at(DVec3::new(x, 0.0, z)));
    }
    scene
}

/// The light of each pixel of a case's image: the mean of the four pixels that `reference` draws
/// in its place at twice the size, 8×8 shaded places with 16 samples each.
///
/// The samples lie at odd sixteenths of a pixel. The samples of grids with 1, 2, 3 and 4 per row lie at
/// halves, quarters, sixths and eighths, which are never odd sixteenths.
pub struct Truth {
    size: [usize; 2],
    light: Vec<[f64; 3]>,
}

impl Truth {
    /// At the start of a case's flight.
    ///
    /// # Errors
    /// A size that cannot be drawn.
    pub fn new(case: FrameCase, size: [u32; 2]) -> Result<Self, RenderError> {
        let mut drawn = Repeated::new(case, size.map(|side| 2 * side), Preset::Reference.quality());
        let frame = drawn.draw(0.0)?;
        let [width, height] = size.map(|side| side as usize);
        let mean = |pixel: usize| {
            let [x, y] = [2 * (pixel % width), 2 * (pixel / width)];
            let parts = [[x, y], [x + 1, y], [x, y + 1], [x + 1, y + 1]]
                .map(|[x, y]| light(frame, y * 2 * width + x));
            [0, 1, 2].map(|channel| parts.iter().map(|part| part[channel]).sum::<f64>() / 4.0)
        };
        Ok(Self { size: [width, height], light: (0..width * height).map(mean).collect() })
    }

    /// The root mean square difference of an image from it, in linear light, over red, green and blue.
    #[must_use]
    pub fn error(&self, frame: &Frame) -> f64 {
        assert_eq!(
            self.size,
            [frame.width as usize, frame.height as usize],
            "images of one size are compared"
        );
        let squares = self.light.iter().enumerate().map(|(pixel, right)| {
            let found = light(frame, pixel);
            (0..3)
                .map(|channel| (found[channel] - right[channel]) * (found[channel] - right[channel]))
                .sum::<f64>()
        });
        (squares.sum::<f64>() / (3 * self.light.len()) as f64).sqrt()
    }
}

/// Red, green and blue of a pixel in linear light.
fn light(frame: &Frame, pixel: usize) -> [f64; 3] {
    [0, 1, 2].map(|channel| srgb8_to_linear(frame.color[4 * pixel + channel]).into())
}
