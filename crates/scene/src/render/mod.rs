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

use crate::effects::{Counts, Effect, EffectCounts, EffectPlan, Scenery};
use crate::frame::Frame;
use crate::outputs::{self, Needed};
use crate::scene::Scene;
use crate::settings::RenderSettings;
use compose::Composer;
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
        frame.make_room(settings)?;
        let sample = blank(settings)?.visibility_sample();
        let mut rasterizer = self.rasterizer(settings)?;
        let stage = Stage::new(scene, camera, settings);
        let plan = EffectPlan::of_stage(&stage);
        let mut counts = Counts::default();
        let apart = settings.outputs.need_own_pass(plan.is_on(Effect::Transparency));
        self.stats = Stats::default();
        if settings.outputs.color {
            self.draw_colors(&stage, camera, (&plan, frame, apart), (&mut rasterizer, &mut counts))?;
        }
        if apart {
            self.draw_seen(&stage, camera, frame, &mut rasterizer)?;
        }
        if settings.outputs.of_triangles() {
            outputs::fill(frame, &stage, camera, sample, &self.kept.seen);
        }
        self.kept.seen.hand_over(frame);
        measure_depth(frame, camera, settings);
        counts.of(Effect::Poses).bytes = stage.shapes.posed_bytes() as u64;
        (self.counts, self.plan) = (counts, Some(plan));
        self.rasterizer = Some(rasterizer);
        Ok(())
    }

    /// Draws colours; and what is seen, too, unless that has a pass of its own.
    fn draw_colors(
        &mut self,
        stage: &Stage<'_>,
        camera: &Camera,
        (plan, frame, apart): (&EffectPlan, &mut Frame, bool),
        (rasterizer, counts): (&mut Rasterizer, &mut Counts),
    ) -> Result<(), RenderError> {
        let scenery = self.kept.scenery(stage, plan, rasterizer)?;
        let (scene, settings) = (stage.scene, stage.settings);
        let composer = Composer::new(scene, camera, settings, (&stage.shapes, &scenery, &stage.eye));
        let draws = composer.draws(counts);
        let mut pass = Pass::new();
        draws.iter().for_each(|draw| draw.record(&mut pass));
        let needed = if apart { Needed::default() } else { Needed::of(&settings.outputs) };
        // Depth that has a pass of its own is not to be written twice.
        let depth = if apart { frame.depth.take() } else { None };
        let target = (blank(settings)?, &mut *frame, needed);
        self.stats = self.kept.draw(pass, (settings, plan), target, (rasterizer, counts))?;
        if apart {
            frame.depth = depth;
        }
        self.kept.count(&scenery, plan, counts);
        Ok(())
    }

    /// Draws nothing but what is seen.
    fn draw_seen(
        &mut self,
        stage: &Stage<'_>,
        camera: &Camera,
        frame: &mut Frame,
        rasterizer: &mut Rasterizer,
    ) -> Result<(), RenderError> {
        let (dark, settings) = (Scenery::default(), stage.settings);
        let composer = Composer::of_shapes(stage.scene, camera, settings, (&stage.shapes, &dark, &stage.eye));
        // Effects have no part in it.
        let draws = composer.draws(&mut Counts::default());
        let mut pass = Pass::new();
        draws.iter().for_each(|draw| draw.record(&mut pass));
        let target = (blank(settings)?, frame, Needed::of(&settings.outputs));
        self.stats += self.kept.draw_seen(&pass, settings, target, rasterizer)?;
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

    /// For tests: how much room is kept for objects, faces and triangles.
    #[cfg(test)]
    pub(crate) fn seen_capacities(&self) -> [usize; 3] {
        let seen = &self.kept.seen;
        [seen.objects.capacity(), seen.faces.capacity(), seen.triangles.capacity()]
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

/// From stored depths to metres.
fn measure_depth(frame: &mut Frame, camera: &Camera, settings: &RenderSettings) {
    let distance = placement::DepthToDistance::new(&camera.projection, settings.aspect());
    for depth in frame.depth.iter_mut().flatten() {
        *depth = distance.at(*depth);
    }
}
