//! How the window's images are drawn: the steps at rest, drafts, and what an image depends on.

use trigon_camera::{Orbit, Viewport};
use trigon_scene::quality::Preset;
use trigon_scene::{Node, RaySampling, RenderSettings, Shadows, SightRays};

use super::Stage;
use crate::drawer::DrawnBy;
use crate::panes::Area;
use crate::refinement::{self, Comparison, Refinement, Wanted};
use crate::shared_scene::Revision;
use crate::shown;

/// Of so many rays at each pixel, a preview casts a quarter or less: 64 that pixels share are one at each.
const LONG_RAYS: u32 = 4;

impl Stage {
    /// How the window's images at rest are drawn, step by step.
    pub(crate) fn ladder(&self) -> Vec<RenderSettings> {
        let steps = refinement::ladder(&self.settings, self.drawer.is_some());
        steps.into_iter().map(|settings| self.fitted(settings, 1.0)).collect()
    }

    /// The steps to do at rest: those of the ladder, followed by the comparison.
    pub(crate) fn wanted_steps(&self) -> Vec<usize> {
        let length = refinement::ladder(&self.settings, self.drawer.is_some()).len();
        refinement::wanted(length, self.shown_refinement(), self.comparison)
    }

    /// The image of an application's drawer is not replaced by a better one.
    fn shown_refinement(&self) -> Refinement {
        if self.drawer.is_some() { Refinement::Settings } else { self.refinement }
    }

    /// Which image to show at rest.
    pub(crate) fn wanted_image(&self) -> Wanted {
        match (self.comparison, self.shown_refinement()) {
            (Comparison::Shown, _) => Wanted::Difference,
            (_, Refinement::Reference) => Wanted::Best,
            (_, Refinement::Settings) => Wanted::Settings,
        }
    }

    /// How drafts are drawn: with no more rays than the draft preset has, and reduced by a factor
    /// in each direction.
    pub(crate) fn draft_settings(&self, shrink: f64) -> RenderSettings {
        let mut settings = RenderSettings { samples_per_axis: 1, samples: 1, ..self.settings.clone() };
        let (effects, most) = (&mut settings.effects, Preset::Draft.quality());
        if effects.shadows == Shadows::Rays {
            effects.shadows = most.shadows;
        }
        if let Some(occlusion) = &mut effects.ambient_occlusion {
            occlusion.rays = occlusion.rays.min(most.occlusion_rays);
            occlusion.sampling = most.occlusion_sampling;
        }
        if let SightRays::Glass { bounces } = &mut effects.sight {
            *bounces = (*bounces).min(most.glass_bounces);
        }
        self.fitted(settings, shrink)
    }

    /// How the image at rest is drawn first if its rays take long: with rays that pixels share, as in the better presets of
    /// those that have them. `None` if no rays start at every sample, or if few do.
    pub(crate) fn preview_settings(&self) -> Option<RenderSettings> {
        let mut settings = self.settings.clone();
        let shaded = settings.samples_per_axis.saturating_pow(2);
        let takes_long =
            |rays: u32, sampling| sampling == RaySampling::Full && rays.saturating_mul(shaded) >= LONG_RAYS;
        let (effects, mut is_changed) = (&mut settings.effects, false);
        if let Some(occlusion) = &mut effects.ambient_occlusion
            && takes_long(occlusion.rays, occlusion.sampling)
        {
            let shared = Preset::Standard.quality();
            (occlusion.rays, occlusion.sampling) = (shared.occlusion_rays, shared.occlusion_sampling);
            is_changed = true;
        }
        let soft = &mut effects.soft_shadows;
        if effects.shadows == Shadows::Rays && takes_long(soft.rays, soft.sampling) && self.has_wide_lamps() {
            let shared = Preset::High.quality();
            (soft.rays, soft.sampling) = (shared.shadow_rays, shared.shadow_sampling);
            is_changed = true;
        }
        (is_changed && self.drawer.is_none()).then(|| self.fitted(settings, 1.0))
    }

    /// Whether the rays to a lamp are more than one.
    fn has_wide_lamps(&self) -> bool {
        let is_wide = |node: &Node| node.light.as_ref().is_some_and(|light| light.radius > 0.0);
        self.settings.effects.soft_shadows.radius > 0.0
            || self.scene.nodes().iter().any(|(_, node)| is_wide(node))
    }

    /// What draws the window's image again: [`Stage::settings`] for the window's size, with line widths in
    /// physical pixels.
    #[must_use]
    pub fn image_settings(&self) -> RenderSettings {
        RenderSettings { outputs: self.settings.outputs, ..self.fitted(self.settings.clone(), 1.0) }
    }

    /// For the window's size, reduced by a factor in each direction.
    fn fitted(&self, mut settings: RenderSettings, shrink: f64) -> RenderSettings {
        settings.outputs = shown::OUTPUTS;
        let larger = (self.scale / shrink) as f32;
        settings.line_width *= larger;
        settings.point_size = settings.point_size.map(|size| size * larger);
        if let Some(points) = &mut settings.vertices {
            points.size *= larger;
            points.marked_size *= larger;
        }
        let smaller = |size: u32| ((f64::from(size) / shrink) as u32).clamp(1, trigon_scene::MAX_SIZE);
        let Viewport { width, height } = self.image_area().size;
        (settings.width, settings.height) = (smaller(width), smaller(height));
        settings
    }

    /// Everything that the window's image depends on.
    pub(crate) fn subject(&self) -> Subject {
        let Self { orbit, viewport, scale, four_views, .. } = *self;
        let area = self.visible_area();
        let (settings, drawer) = (self.settings.clone(), DrawnBy(self.drawer.clone()));
        let scene = self.scene.revision();
        Subject { scene, orbit, area, four_views, settings, drawer, viewport, scale }
    }
}

/// Everything that the window's image depends on: as long as this is unchanged, so is the image.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Subject {
    scene: Revision,
    orbit: Orbit,
    area: Area,
    four_views: bool,
    settings: RenderSettings,
    drawer: DrawnBy,
    viewport: Viewport,
    scale: f64,
}
