//! From a scene to a picture: gather lights, compose a pipeline for each mesh
//! and material, record one pass, execute it, and hand the outputs over.
//!
//! A picture is a pure function of scene, camera and settings.

mod columns;
mod compose;
mod geometry;
mod lanes;
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
use trigon_raster::{ExecuteSettings, Pass, Rasterizer, Stats, Target, TargetError};

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

/// Draws pictures one after the other and keeps its threads and memory between
/// them.
#[derive(Default)]
pub struct Renderer {
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
        let mut frame = Frame::default();
        self.render_into(scene, camera, settings, &mut frame)?;
        Ok(frame)
    }

    /// As [`render`](Self::render), into a frame whose memory is used again. What
    /// it held does not matter; after an error it holds nothing of use.
    ///
    /// # Errors
    /// When the size or the number of samples is out of range.
    pub fn render_into(
        &mut self,
        scene: &Scene,
        camera: &Camera,
        settings: &RenderSettings,
        frame: &mut Frame,
    ) -> Result<(), RenderError> {
        let blank = blank(settings)?;
        frame.make_room(settings)?;
        let rasterizer = self.rasterizer(settings)?;
        let composer = compose::Composer::new(scene, camera, settings);
        let draws = composer.draws();
        let (background, height) = (settings.background, settings.height);
        let behind = |pixel: UVec2| background.row(pixel.y, height);
        let mut pass = Pass::new();
        pass.background(match background {
            Background::Gradient { .. } => trigon_raster::Background::PerPixel(&behind),
            Background::Color(_) | Background::Transparent => {
                trigon_raster::Background::Color(background.row(0, height))
            }
        });
        for draw in &draws {
            draw.record(&mut pass);
        }
        self.stats = rasterizer.draw(&pass, &mut onto(blank, frame)?);
        measure_depth(frame, camera, settings);
        Ok(())
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
}

/// Draws one picture. To draw many, keep a [`Renderer`].
///
/// # Errors
/// When the size or the number of samples is out of range.
pub fn render(scene: &Scene, camera: &Camera, settings: &RenderSettings) -> Result<Frame, RenderError> {
    Renderer::new().render(scene, camera, settings)
}

/// A target of the right size and samples that keeps nothing.
fn blank<'a>(settings: &RenderSettings) -> Result<Target<'a>, TargetError> {
    let target = Target::new(settings.width, settings.height, &[])?;
    target.with_samples_per_axis(settings.samples_per_axis)?.with_samples(settings.samples)
}

/// A target that draws into a frame.
fn onto<'a>(blank: Target<'a>, frame: &'a mut Frame) -> Result<Target<'a>, TargetError> {
    let mut target = blank.with_srgb8(frame.color.as_chunks_mut().0)?;
    if let Some(depth) = &mut frame.depth {
        target = target.with_depth(depth)?;
    }
    if let Some(objects) = &mut frame.object_ids {
        target = target.with_objects(objects)?;
    }
    if let Some(faces) = &mut frame.face_ids {
        target = target.with_faces(faces)?;
    }
    Ok(target)
}

/// From stored depths to metres.
fn measure_depth(frame: &mut Frame, camera: &Camera, settings: &RenderSettings) {
    let distance = placement::DepthToDistance::new(&camera.projection, settings.aspect());
    for depth in frame.depth.iter_mut().flatten() {
        *depth = distance.at(*depth);
    }
}
