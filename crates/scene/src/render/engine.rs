//! The drawing engine: threads, memory and caches that last from frame to frame, and the order of
//! the steps of a frame.
//!
//! Depths become greys here, too, for [`Display::Depth`](crate::Display::Depth).

use std::sync::Arc;

use trigon_camera::Camera;
use trigon_math::UVec2;
use trigon_raster::{
    Background, Cancel, ExecuteSettings, Pass, PixelExplanation, Rasterizer, Rect, Stats, Target, TargetError,
};

use super::RenderError;
use super::bounds::record_all;
use super::compose::Composer;
use super::effect_caches::{Destination, EffectCaches};
use super::fisheye::EyeTriangleCache;
use super::last_frame::{LastFrame, Redraw, redraw};
use super::record::Record;
use super::shared_frames::{ReusableFrame, SharedFrames};
use super::wire::VertexLists;
use crate::display::Display;
use crate::effect::Effect;
use crate::effects::{Counts, EffectCounts, LightingEnvironment};
use crate::frame::Frame;
use crate::outputs;
use crate::outputs::Needed;
use crate::placement::DepthToDistance;
use crate::plan::EffectPlan;
use crate::prepare::{Backdrop, MeshDetail, PreparedScene};
use crate::scene::Scene;
use crate::settings::{RenderSettings, Style};

/// Draws frames one after the other. What it keeps between them never changes a byte.
#[derive(Default)]
pub(super) struct Engine {
    pub(super) rasterizer: Option<Rasterizer>,
    pub(super) caches: EffectCaches,
    pub(super) last: LastFrame,
    pub(super) eye_triangles: EyeTriangleCache,
    frames: SharedFrames,
    pub(super) vertex_lists: VertexLists,
    pub(super) plan: Option<EffectPlan>,
    pub(super) counts: Counts,
    pub(super) stats: Stats,
    /// Whether stages measure their time.
    pub(super) is_timed: bool,
}

/// A frame of fewer samples is begun on the calling thread: waking another one could take as long as the frame.
const WORTH_SHARING: u64 = 1 << 15;

/// What is to be drawn.
#[derive(Clone, Copy)]
pub(super) struct Request<'r> {
    pub(super) scene: &'r Scene,
    pub(super) camera: &'r Camera,
    pub(super) settings: &'r RenderSettings,
    pub(super) cancel: Option<&'r Cancel>,
    pub(super) detail: MeshDetail,
}

impl Engine {
    /// Explains a pixel of the image that [`draw`](Self::draw) would make; `None` outside of it.
    pub(super) fn explain(
        &mut self,
        scene: &Scene,
        camera: &Camera,
        settings: &RenderSettings,
        [x, y]: [u32; 2],
    ) -> Result<Option<PixelExplanation>, RenderError> {
        let target = blank(settings)?;
        let mut rasterizer = self.rasterizer(settings)?;
        rasterizer.set_cancel(None);
        let prepared = PreparedScene::new(scene, camera, settings);
        let plan = EffectPlan::of_prepared(&prepared);
        let lighting = self.lighting(&prepared, &plan, &mut rasterizer)?;
        let explained =
            record(&prepared, &lighting, &self.vertex_lists, settings, &mut Counts::default(), |pass, _| {
                rasterizer.explain_pixel(pass, &target, x, y)
            });
        // The next image does not follow from what the rasterizer holds now.
        self.last = LastFrame::default();
        self.rasterizer = Some(rasterizer);
        Ok(explained)
    }

    /// Draws into an existing frame; after an error its contents are unspecified.
    pub(super) fn draw(&mut self, request: Request<'_>, frame: &mut Frame) -> Result<(), RenderError> {
        let mut free = ReusableFrame::of(std::mem::take(frame));
        let drawn = self.draw_free(request, &mut free);
        if let (Ok(()), Some(rasterizer)) = (drawn, &self.rasterizer) {
            self.frames.keep(&free, request.settings, rasterizer);
        }
        *frame = free.frame;
        drawn
    }

    /// Draws a frame that is shared with the caller.
    pub(super) fn draw_shared(&mut self, request: Request<'_>) -> Result<Arc<Frame>, RenderError> {
        let mut free = self.frames.take();
        match self.draw_free(request, &mut free) {
            Ok(()) => Ok(self.frames.share(free)),
            Err(error) => {
                self.frames.give_back(free.frame);
                Err(error)
            }
        }
    }

    /// The parts in which the last frame that is shared may differ from an earlier one; `None` if that is not known.
    pub(super) fn redrawn_between(&self, before: &Frame, last: &Frame) -> Option<Vec<Rect>> {
        self.frames.redrawn_between(before, last)
    }

    fn draw_free(&mut self, request: Request<'_>, free: &mut ReusableFrame) -> Result<(), RenderError> {
        let Request { settings, cancel, .. } = request;
        if settings.display == Display::Depth && settings.outputs.color {
            return self.draw_depth(request, free);
        }
        // Checks the size before memory is allocated for it.
        let sample = blank(settings)?.visibility_sample();
        free.frame.allocate(settings)?;
        let mut rasterizer = self.rasterizer(settings)?;
        rasterizer.set_cancel(cancel.cloned());
        let threads = rasterizer.threads();
        let draw = || self.draw_on(rasterizer, request, sample, free);
        if samples_of(settings) < WORTH_SHARING { draw() } else { threads.install(draw) }
    }

    /// Draws a frame for which there is memory.
    fn draw_on(
        &mut self,
        mut rasterizer: Rasterizer,
        request: Request<'_>,
        sample: [f64; 2],
        free: &mut ReusableFrame,
    ) -> Result<(), RenderError> {
        let Request { scene, camera, settings, cancel, detail } = request;
        let prepared = PreparedScene::with_detail(detail, scene, camera, settings);
        let plan = EffectPlan::of_prepared(&prepared);
        let mut counts = Counts::default();
        let apart = needs_id_pass(settings, &plan);
        if let Some(cancel) = cancel {
            // Shadow maps are added when it is known which of them are missing.
            let colors = u32::from(settings.outputs.of_light());
            let beneath = u32::from(settings.xray_opacity().is_some()) * colors;
            cancel.begin_drawing(colors + beneath + u32::from(apart));
        }
        self.stats = Stats::default();
        self.vertex_lists.begin();
        if settings.outputs.of_light() {
            let drawn = self.draw_colors(&prepared, &plan, free, &mut rasterizer, &mut counts);
            // It may have been cancelled, too: its shadow maps may be incomplete.
            drawn.inspect_err(|_| self.caches.forget_unfinished())?;
        }
        let ReusableFrame { frame, redrawn, .. } = free;
        if apart {
            self.draw_ids(&prepared, frame, &mut rasterizer)?;
        }
        if settings.outputs.of_triangles() {
            outputs::fill(frame, &prepared, sample, &self.caches.ids, &rasterizer);
        }
        if cancel.is_some_and(Cancel::is_cancelled) {
            self.caches.forget_unfinished();
            self.rasterizer = Some(rasterizer);
            return Err(RenderError::Cancelled);
        }
        self.last.set_whole(redrawn.is_some());
        if redrawn.is_none() {
            self.caches.ids.hand_over(frame);
            measure_depth(frame, camera, settings, &rasterizer);
        }
        counts.of(Effect::Poses).bytes = prepared.shapes.posed_bytes() as u64;
        (self.counts, self.plan) = (counts, Some(plan));
        self.rasterizer = Some(rasterizer);
        Ok(())
    }

    /// Draws depths as colours.
    fn draw_depth(&mut self, request: Request<'_>, free: &mut ReusableFrame) -> Result<(), RenderError> {
        let settings = request.settings;
        let mut uncolored = settings.clone();
        (uncolored.outputs.color, uncolored.outputs.depth) = (false, true);
        self.draw_free(Request { settings: &uncolored, ..request }, free)?;
        paint_depth(&mut free.frame);
        free.frame.depth.take_if(|_| !settings.outputs.depth);
        Ok(())
    }

    /// Draws the colours, and the visible triangles unless they have a pass of their own. A frame from which the
    /// next one can follow is finished then.
    fn draw_colors(
        &mut self,
        prepared: &PreparedScene<'_>,
        plan: &EffectPlan,
        free: &mut ReusableFrame,
        rasterizer: &mut Rasterizer,
        counts: &mut Counts,
    ) -> Result<(), RenderError> {
        let lighting = self.lighting(prepared, plan, rasterizer)?;
        let settings = prepared.settings;
        if settings.xray_opacity().is_some() {
            let wires = RenderSettings { style: Style::Wireframe, ..settings.clone() };
            let target = blank(settings)?;
            self.stats += record(
                prepared,
                &lighting,
                &self.vertex_lists,
                &wires,
                &mut Counts::default(),
                |pass, _| self.caches.draw_beneath(pass, settings, target, rasterizer),
            )?;
        }
        let apart = needs_id_pass(settings, plan);
        let needed = if apart { Needed::default() } else { Needed::of(&settings.outputs) };
        // If depth has a pass of its own, it is not written twice.
        let depth = if apart { free.frame.depth.take() } else { None };
        let target = blank(settings)?;
        let stats = record(prepared, &lighting, &self.vertex_lists, settings, counts, |pass, draws| {
            let kind = if apart { Redraw::Independent } else { self.last.plan_redraw(prepared, plan, draws) };
            if matches!(kind, Redraw::Independent) {
                let into = Destination { target, frame: &mut free.frame, needed };
                self.caches.draw(pass, settings, plan, into, rasterizer)
            } else {
                let changes = kind.changes(&self.frames, free, rasterizer);
                redraw(pass, prepared, target, free, changes.as_deref(), rasterizer)
            }
        })?;
        self.stats += stats;
        if apart {
            free.frame.depth = depth;
        }
        self.caches.count(prepared, &lighting, plan, counts);
        Ok(())
    }

    /// Draws only ids and depth.
    fn draw_ids(
        &mut self,
        prepared: &PreparedScene<'_>,
        frame: &mut Frame,
        rasterizer: &mut Rasterizer,
    ) -> Result<(), RenderError> {
        let (dark, settings) = (LightingEnvironment::default(), prepared.settings);
        let composer = Composer::of_shapes(prepared, &dark, &self.vertex_lists);
        // Effects do not matter for it.
        let draws = composer.draws(&mut Counts::default());
        let mut pass = Pass::new();
        record_all(&draws, &mut pass);
        let into = Destination { target: blank(settings)?, frame, needed: Needed::of(&settings.outputs) };
        self.stats += self.caches.draw_ids(&pass, settings, into, rasterizer)?;
        Ok(())
    }

    pub(super) fn plan(&self) -> Option<&EffectPlan> {
        self.plan.as_ref()
    }

    pub(super) fn effect_counts(&self, effect: Effect) -> EffectCounts {
        self.counts.get(effect)
    }

    pub(super) fn stats(&self) -> &Stats {
        &self.stats
    }

    #[cfg(test)]
    pub(super) fn id_capacities(&self) -> [usize; 3] {
        let ids = &self.caches.ids;
        [ids.objects.capacity(), ids.faces.capacity(), ids.triangles.capacity()]
    }

    /// The last frame's rasterizer if its settings fit, or a new one.
    pub(super) fn rasterizer(&mut self, settings: &RenderSettings) -> Result<Rasterizer, RenderError> {
        let RenderSettings { threads, simd, .. } = *settings;
        let how = ExecuteSettings { threads, simd, timed: self.is_timed, ..Default::default() };
        let rasterizer = self.rasterizer.take().filter(|rasterizer| *rasterizer.settings() == how);
        Ok(match rasterizer {
            Some(rasterizer) => rasterizer,
            None => Rasterizer::new(how)?,
        })
    }
}

/// Records the colour pass of a scene with these settings, and passes it to a function.
pub(super) fn record<T>(
    prepared: &PreparedScene<'_>,
    lighting: &LightingEnvironment,
    vertex_lists: &VertexLists,
    settings: &RenderSettings,
    counts: &mut Counts,
    draw: impl FnOnce(&Pass<'_>, &[Box<dyn Record + '_>]) -> T,
) -> T {
    let composer = Composer::new(prepared, settings, lighting, vertex_lists);
    let draws = composer.draws(counts);
    let behind = |pixel| prepared.backdrop.at(pixel);
    let behind_row = |y| prepared.backdrop.at(UVec2::new(0, y));
    let mut pass = Pass::new();
    pass.background(match prepared.backdrop {
        Backdrop::Color(color) => Background::Color(color),
        Backdrop::Rows(..) => Background::PerRow(&behind_row),
        Backdrop::Environment(_) => Background::PerPixel(&behind),
    });
    if matches!(settings.style, Style::SurfaceWithEdges | Style::HiddenLine) {
        pass.edges(settings.face_edges());
    }
    if !settings.marks.is_plain() {
        pass.marks(settings.marks.colors());
    }
    record_all(&draws, &mut pass);
    draw(&pass, &draws)
}

/// How many samples a frame has.
fn samples_of(settings: &RenderSettings) -> u64 {
    let [width, height, axis, samples] =
        [settings.width, settings.height, settings.samples_per_axis, settings.samples].map(u64::from);
    width * height * axis * axis * samples
}

/// Whether depth and ids have a pass of their own, besides that of colours.
fn needs_id_pass(settings: &RenderSettings, plan: &EffectPlan) -> bool {
    settings.outputs.need_own_pass(plan.is_on(Effect::Transparency))
}

/// A target of the right size and samples that stores nothing.
pub(super) fn blank<'a>(settings: &RenderSettings) -> Result<Target<'a>, TargetError> {
    let target = Target::new(settings.width, settings.height, &[])?;
    target.with_samples_per_axis(settings.samples_per_axis)?.with_samples(settings.samples)
}

/// From stored depths to metres.
fn measure_depth(frame: &mut Frame, camera: &Camera, settings: &RenderSettings, rasterizer: &Rasterizer) {
    /// Pixels per task.
    const PIECE: usize = 1 << 16;
    let Some(depths) = &mut frame.depth else { return };
    let distance = DepthToDistance::new(&camera.projection, settings.aspect());
    let measure = |depths: &mut [f32]| depths.iter_mut().for_each(|depth| *depth = distance.at(*depth));
    // Waking other threads costs more than a small image takes.
    if depths.len() <= PIECE {
        measure(depths);
    } else {
        rasterizer.share(depths.chunks_mut(PIECE), measure);
    }
}

/// Paints the depths of a frame into its colours.
pub(super) fn paint_depth(frame: &mut Frame) {
    let Some(depths) = &frame.depth else { return };
    frame.color = grey_depths(depths);
}

/// Near is dark; nothing is white. Greys are in proportion to the distance.
fn grey_depths(depths: &[f32]) -> Vec<u8> {
    /// The brightest grey, so that it differs from the background.
    const FAR: f32 = 235.0;
    let finite = || depths.iter().copied().filter(|depth| depth.is_finite());
    let nearest = finite().fold(f32::INFINITY, |least, depth| if depth < least { depth } else { least });
    let farthest = finite().fold(0.0, |most: f32, depth| if depth > most { depth } else { most });
    let range = if farthest > nearest { farthest - nearest } else { 1.0 };
    let grey = |&depth: &f32| {
        let grey = if depth.is_finite() { ((depth - nearest) / range * FAR) as u8 } else { 255 };
        [grey, grey, grey, 255]
    };
    depths.iter().flat_map(grey).collect()
}
