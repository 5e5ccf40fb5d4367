//! The steps of a frame through a fisheye lens.

use trigon_camera::{FisheyeCamera, Projection};
use trigon_raster::{Pass, Rasterizer, Stats, TargetError};

use super::RenderError;
use super::compose::Composer;
use super::engine::{Engine, blank, paint_depth, record};
use super::fisheye::{EyeTriangles, SampleGrid, Tracer};
use super::last_frame::LastFrame;
use crate::display::Display;
use crate::effect::Effect;
use crate::effects::{Counts, LightingEnvironment};
use crate::frame::Frame;
use crate::outputs;
use crate::outputs::Needed;
use crate::plan::{EffectPlan, Omission};
use crate::prepare::PreparedScene;
use crate::scene::Scene;
use crate::settings::RenderSettings;

/// What is to be drawn through a lens.
#[derive(Clone, Copy)]
pub(super) struct FisheyeRequest<'r> {
    pub(super) scene: &'r Scene,
    pub(super) camera: &'r FisheyeCamera,
    pub(super) settings: &'r RenderSettings,
}

impl Engine {
    /// Draws into an existing frame; after an error its contents are unspecified.
    pub(super) fn draw_fisheye(
        &mut self,
        request: FisheyeRequest<'_>,
        frame: &mut Frame,
    ) -> Result<(), RenderError> {
        let mut settings = Omission::without(request.settings);
        let shows_depth = settings.display == Display::Depth && settings.outputs.color;
        if shows_depth {
            (settings.outputs.color, settings.outputs.depth) = (false, true);
        }
        // Checks the size before memory is allocated for it.
        blank(&settings)?;
        frame.allocate(&settings)?;
        let mut rasterizer = self.rasterizer(&settings)?;
        rasterizer.set_cancel(None);
        let threads = rasterizer.threads();
        let sound = FisheyeRequest { settings: &settings, ..request };
        let drawn = threads.install(|| self.draw_rays(&mut rasterizer, sound, frame));
        self.rasterizer = Some(rasterizer);
        drawn?;
        if shows_depth {
            paint_depth(frame);
            frame.depth.take_if(|_| !request.settings.outputs.depth);
        }
        Ok(())
    }

    /// Draws a frame for which there is memory.
    fn draw_rays(
        &mut self,
        rasterizer: &mut Rasterizer,
        FisheyeRequest { scene, camera, settings }: FisheyeRequest<'_>,
        frame: &mut Frame,
    ) -> Result<(), RenderError> {
        let pose = camera.with_projection(Projection::default());
        let prepared = PreparedScene::through(Some(&camera.lens), scene, &pose, settings);
        let plan = EffectPlan::of_prepared(&prepared);
        let mut counts = Counts::default();
        // The next frame does not follow from this one.
        (self.last, self.stats) = (LastFrame::default(), Stats::default());
        self.vertex_lists.begin();
        let triangles = self.eye_triangles.of(&prepared);
        if settings.outputs.beside_color() || plan.is_on(Effect::Outline) {
            self.find_ids(&prepared, &triangles, rasterizer)?;
        }
        if settings.outputs.of_light() {
            let lighting = self.caches.lighting(&prepared, &plan, rasterizer)?;
            let shaded =
                record(&prepared, &lighting, &self.vertex_lists, settings, &mut counts, |pass, draws| {
                    let tracer = Tracer::new(&prepared, pass, draws, &triangles, rasterizer);
                    self.caches.draw_rays(settings, &plan, frame, rasterizer, |pixels| {
                        tracer.paint(pixels, &prepared.backdrop, rasterizer);
                    })?;
                    Ok::<_, TargetError>(tracer.shaded_count())
                })?;
            self.stats.pixels_shaded = shaded;
            self.caches.count(&prepared, &lighting, &plan, &mut counts);
        }
        if settings.outputs.beside_color() {
            let sample = SampleGrid::new(settings).visibility_sample();
            outputs::fill(frame, &prepared, sample, &self.caches.ids, rasterizer);
            self.caches.ids.hand_over(frame);
        }
        counts.of(Effect::Poses).bytes = prepared.shapes.posed_bytes() as u64;
        (self.counts, self.plan) = (counts, Some(plan));
        Ok(())
    }

    /// Finds the triangle that the middle of each pixel shows.
    fn find_ids(
        &mut self,
        prepared: &PreparedScene<'_>,
        triangles: &EyeTriangles,
        rasterizer: &Rasterizer,
    ) -> Result<(), TargetError> {
        let RenderSettings { width, height, .. } = *prepared.settings;
        let pixels = width as usize * height as usize;
        self.caches.ids.allocate(pixels, Needed::ALL).ok_or(TargetError::Memory { width, height })?;
        let dark = LightingEnvironment::default();
        let composer = Composer::of_shapes(prepared, &dark, &self.vertex_lists);
        let draws = composer.draws(&mut Counts::default());
        let mut pass = Pass::new();
        draws.iter().for_each(|draw| draw.record(&mut pass));
        Tracer::new(prepared, &pass, &draws, triangles, rasterizer).find(&mut self.caches.ids, rasterizer);
        Ok(())
    }
}
