//! From a scene to a picture: gather lights, compose a pipeline for each mesh
//! and material, record one pass, execute it, and hand the outputs over.
//!
//! A picture is a pure function of scene, camera and settings.

mod columns;
mod compose;
mod geometry;
pub(crate) mod lanes;
pub(crate) mod lighting;
pub(crate) mod placement;
mod record;
mod shapes;
mod stage;
pub(crate) mod surface;
mod wire;

pub(crate) use geometry::Geometry;
pub(crate) use shapes::{Shape, Shapes};

use thiserror::Error;
use trigon_camera::Camera;
use trigon_raster::simd::SimdLevelError;
use trigon_raster::{ExecuteSettings, Pass, Rasterizer, Stats, Target, TargetError};

use crate::effects::{Counts, Effect, EffectCounts, EffectPlan};
use crate::frame::Frame;
use crate::scene::Scene;
use crate::settings::RenderSettings;
use stage::Kept;
pub(crate) use stage::Stage;

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
    kept: Kept,
    plan: Option<EffectPlan>,
    counts: Counts,
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
        let mut rasterizer = self.rasterizer(settings)?;
        let stage = Stage::new(scene, camera, settings);
        let plan = EffectPlan::of_stage(&stage);
        let mut counts = Counts::default();
        let scenery = self.kept.scenery(&stage, &plan, &mut rasterizer)?;
        let composer = compose::Composer::new(scene, camera, settings, (&stage.shapes, &scenery, &stage.eye));
        let draws = composer.draws(&mut counts);
        let mut pass = Pass::new();
        for draw in &draws {
            draw.record(&mut pass);
        }
        self.stats =
            self.kept.draw(pass, (settings, &plan), (blank, frame), (&mut rasterizer, &mut counts))?;
        measure_depth(frame, camera, settings);
        self.kept.count(&scenery, (&stage, &plan), &mut counts);
        (self.counts, self.plan) = (counts, Some(plan));
        self.rasterizer = Some(rasterizer);
        Ok(())
    }

    /// The plan of the last picture; `None` before the first.
    pub fn plan(&self) -> Option<&EffectPlan> {
        self.plan.as_ref()
    }

    /// What an effect took in the last picture.
    pub fn effect_counts(&self, effect: Effect) -> EffectCounts {
        self.counts.get(effect)
    }

    /// What the last picture took, in counts.
    pub fn stats(&self) -> &Stats {
        &self.stats
    }

    /// The last picture's rasterizer when its settings fit, or a new one.
    fn rasterizer(&mut self, settings: &RenderSettings) -> Result<Rasterizer, RenderError> {
        let how = ExecuteSettings { threads: settings.threads, simd: settings.simd, ..Default::default() };
        let kept = self.rasterizer.take().filter(|rasterizer| *rasterizer.settings() == how);
        Ok(match kept {
            Some(rasterizer) => rasterizer,
            None => Rasterizer::new(how)?,
        })
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

/// A target that also draws what a frame holds beside its colours.
fn with_outputs<'a>(mut target: Target<'a>, beside: Beside<'a>) -> Result<Target<'a>, TargetError> {
    let (depth, objects, faces) = beside;
    if let Some(depth) = depth {
        target = target.with_depth(depth)?;
    }
    if let Some(objects) = objects {
        target = target.with_objects(objects)?;
    }
    if let Some(faces) = faces {
        target = target.with_faces(faces)?;
    }
    Ok(target)
}

/// Depths, nodes and faces of a frame.
type Beside<'a> = (&'a mut Option<Vec<f32>>, &'a mut Option<Vec<u32>>, &'a mut Option<Vec<u32>>);

/// From stored depths to metres.
fn measure_depth(frame: &mut Frame, camera: &Camera, settings: &RenderSettings) {
    let distance = placement::DepthToDistance::new(&camera.projection, settings.aspect());
    for depth in frame.depth.iter_mut().flatten() {
        *depth = distance.at(*depth);
    }
}
