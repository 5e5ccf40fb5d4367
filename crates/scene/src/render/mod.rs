//! From a scene to a picture: gather lights, compose a pipeline for each mesh
//! and material, record one pass, execute it, and hand the outputs over.
//!
//! A picture is a pure function of scene, camera and settings.

mod compose;
mod geometry;
mod lighting;
mod placement;
mod record;
mod surface;
mod wire;

pub(crate) use geometry::Geometry;

use thiserror::Error;
use trigon_camera::Camera;
use trigon_math::UVec2;
use trigon_raster::simd::SimdLevelError;
use trigon_raster::{ExecuteSettings, Output, Pass, Rasterizer, Stats, Target, TargetError};

use crate::background::Background;
use crate::frame::Frame;
use crate::scene::Scene;
use crate::settings::RenderSettings;

/// Why a picture cannot be drawn.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum RenderError {
    /// The size or the number of samples is out of range.
    #[error(transparent)]
    Target(#[from] TargetError),
    /// The processor lacks the SIMD level asked for.
    #[error(transparent)]
    Simd(#[from] SimdLevelError),
}

/// Draws pictures one after the other and keeps its memory between them.
#[derive(Default)]
pub struct Renderer {
    target: Option<Target<'static>>,
    rasterizer: Option<Rasterizer>,
    stats: Stats,
}

impl Renderer {
    /// A renderer that holds no memory yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Draws what the camera sees of the scene.
    ///
    /// # Errors
    /// When the size or the number of samples is out of range.
    pub fn render(
        &mut self,
        scene: &Scene,
        camera: &Camera,
        settings: &RenderSettings,
    ) -> Result<Frame, RenderError> {
        let mut target = self.target(settings)?;
        let composer = compose::Composer::new(scene, camera, settings);
        let draws = composer.draws();
        let rows = background_rows(&settings.background, settings.height);
        let behind = |pixel: UVec2| rows[pixel.y as usize];
        let mut pass = Pass::new();
        pass.background(trigon_raster::Background::PerPixel(&behind));
        for draw in &draws {
            draw.record(&mut pass);
        }
        self.stats = self.rasterizer(settings)?.draw(&pass, &mut target);
        let frame = frame(&target, camera, settings);
        self.target = Some(target);
        Ok(frame)
    }

    /// What the last picture took, in counts.
    pub fn stats(&self) -> &Stats {
        &self.stats
    }

    /// The last picture's rasterizer when its settings fit, or a new one.
    fn rasterizer(&mut self, settings: &RenderSettings) -> Result<&mut Rasterizer, RenderError> {
        let how = ExecuteSettings { threads: settings.threads, simd: settings.simd, ..Default::default() };
        let kept = self.rasterizer.take().filter(|rasterizer| *rasterizer.settings() == how);
        let rasterizer = match kept {
            Some(rasterizer) => rasterizer,
            None => Rasterizer::new(how)?,
        };
        Ok(self.rasterizer.insert(rasterizer))
    }

    /// The last picture's target when it fits, or a new one.
    fn target(&mut self, settings: &RenderSettings) -> Result<Target<'static>, RenderError> {
        let fits = |target: &Target<'static>| {
            (target.width(), target.height()) == (settings.width, settings.height)
                && target.samples_per_axis() == settings.samples_per_axis
                && target.samples() == settings.samples
                && target.depth().is_some() == settings.outputs.depth
                && target.objects().is_some() == settings.outputs.ids
        };
        if let Some(target) = self.target.take().filter(fits) {
            return Ok(target);
        }
        let mut outputs = vec![Output::Srgb8];
        if settings.outputs.depth {
            outputs.push(Output::Depth);
        }
        if settings.outputs.ids {
            outputs.extend([Output::Object, Output::Face]);
        }
        let target = Target::new(settings.width, settings.height, &outputs)?;
        Ok(target.with_samples_per_axis(settings.samples_per_axis)?.with_samples(settings.samples)?)
    }
}

/// Draws one picture. To draw many, keep a [`Renderer`].
///
/// # Errors
/// When the size or the number of samples is out of range.
pub fn render(scene: &Scene, camera: &Camera, settings: &RenderSettings) -> Result<Frame, RenderError> {
    Renderer::new().render(scene, camera, settings)
}

fn background_rows(background: &Background, height: u32) -> Vec<trigon_math::Vec4> {
    (0..height).map(|y| background.row(y, height)).collect()
}

fn frame(target: &Target<'_>, camera: &Camera, settings: &RenderSettings) -> Frame {
    let color = target.srgb8().expect("colour is always asked for").as_flattened().to_vec();
    let distance = placement::DepthToDistance::new(&camera.projection, settings.aspect());
    let depth = target.depth().map(|depth| depth.iter().map(|&depth| distance.at(depth)).collect());
    let (width, height) = (settings.width, settings.height);
    let (object_ids, face_ids) = (target.objects().map(<[u32]>::to_vec), target.faces().map(<[u32]>::to_vec));
    Frame { width, height, color, depth, object_ids, face_ids }
}
