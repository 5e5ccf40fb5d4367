//! What a renderer keeps from frame to frame.

use trigon_math::Vec4;
use trigon_raster::{Pass, Rasterizer, Stats, Target, TargetError};

use crate::effect::Effect;
use crate::effect_settings::Shadows;
use crate::effects::{
    AmbientRays, Casters, Counts, FogModel, LampRays, LightingEnvironment, RayCache, VisibleBackdrop,
    draw_outline, encode, lay_on_background, map_tones,
};
use crate::frame::{Frame, resize};
use crate::lighting::Lamp;
use crate::outputs::{Needed, VisibleIds};
use crate::plan::{Cause, Decision, EffectPlan};
use crate::prepare::PreparedScene;
use crate::settings::RenderSettings;
use crate::shadow_maps::{CastingScene, MappedLamp, ShadowCache};

/// What a renderer keeps from frame to frame. It never changes a byte.
#[derive(Default)]
pub(super) struct EffectCaches {
    shadows: ShadowCache,
    rays: RayCache,
    /// The image before tone mapping.
    linear: Vec<Vec4>,
    /// What shows through its faces, likewise.
    beneath: Vec<Vec4>,
    /// The visible triangle of each pixel, as far as outputs and outlines need it.
    pub(super) ids: VisibleIds,
}

/// Where a pass is drawn.
pub(super) struct Destination<'a> {
    /// Of the right size and samples; stores nothing yet.
    pub(super) target: Target<'a>,
    pub(super) frame: &'a mut Frame,
    /// The required parts of depth and ids.
    pub(super) needed: Needed,
}

impl EffectCaches {
    /// The lighting environment, as far as the plan requires it.
    pub(super) fn lighting(
        &mut self,
        prepared: &PreparedScene<'_>,
        plan: &EffectPlan,
        rasterizer: &mut Rasterizer,
    ) -> Result<LightingEnvironment, TargetError> {
        let effects = &prepared.settings.effects;
        let on = |effect| plan.is_on(effect);
        let lights = prepared.lights.clone();
        let mut lighting = LightingEnvironment {
            lights: match plan.decision(Effect::LightMeter) {
                Decision::On(Cause::Metered(reading)) => lights.exposed(reading),
                _ => lights,
            },
            surroundings: prepared.surroundings().filter(|_| on(Effect::Environment)),
            metal_studio: on(Effect::MetalStudio).then(|| prepared.metal_studio()),
            world_to_sky: prepared.world_to_sky().as_mat3(),
            fog: effects.fog.as_ref().filter(|_| on(Effect::Fog)).and_then(FogModel::new),
            shadow_rays: on(Effect::ShadowRays),
            lamp_rays: (on(Effect::ShadowRays) && on(Effect::SoftShadows))
                .then(|| LampRays::new(effects.soft_shadows)),
            ambient_rays: effects
                .ambient_occlusion
                .filter(|_| on(Effect::AmbientOcclusion))
                .map(AmbientRays::new),
            ..LightingEnvironment::default()
        };
        let sight = on(Effect::Reflection) || on(Effect::Refraction);
        if sight {
            lighting.bounces = effects.sight.bounces();
            lighting.traces_mirrors = on(Effect::Reflection) || effects.sight.start_at_mirrors();
            lighting.backdrop =
                VisibleBackdrop::new(prepared.settings, prepared.eye.projection(), prepared.lens.as_ref());
        }
        let rays = sight || lighting.shadow_rays || lighting.ambient_rays.is_some();
        if !rays && !on(Effect::ShadowMaps) {
            return Ok(lighting);
        }
        let casters = Casters::gather(prepared.scene, &prepared.shapes);
        if let (true, Shadows::Maps { resolution }) = (on(Effect::ShadowMaps), effects.shadows) {
            let mapped = |lamp: &Lamp| MappedLamp { pose: prepared.pose(lamp), radius: lamp.radius };
            let lamps: Vec<MappedLamp> = prepared.lights.lamps.iter().map(mapped).collect();
            let casting = CastingScene {
                scene: prepared.scene,
                casters: &casters,
                camera_to_world: &prepared.camera_to_world,
            };
            let resolution = resolution.clamp(16, 8192);
            lighting.shadow_maps = Some(self.shadows.maps(&lamps, &casting, resolution, rasterizer)?);
        }
        if rays {
            lighting.rays =
                Some(self.rays.scene(&casters, sight.then_some(prepared.scene), &prepared.camera_to_world));
        }
        Ok(lighting)
    }

    /// Forgets what a cancelled frame left incomplete.
    pub(super) fn forget_unfinished(&mut self) {
        if self.shadows.drawn() > 0 {
            self.shadows = ShadowCache::default();
        }
    }

    /// Adds the cost of the lighting, and of what was laid over the image.
    pub(super) fn count(
        &self,
        prepared: &PreparedScene<'_>,
        lighting: &LightingEnvironment,
        plan: &EffectPlan,
        counts: &mut Counts,
    ) {
        if plan.is_on(Effect::ToneMapping) {
            let pixels = prepared.settings.width as usize * prepared.settings.height as usize;
            counts.of(Effect::ToneMapping).passes = 1;
            counts.of(Effect::ToneMapping).bytes = (pixels * size_of::<Vec4>()) as u64;
        }
        if plan.is_on(Effect::Outline) {
            counts.of(Effect::Outline).passes = 1;
            counts.of(Effect::Outline).bytes = size_of_val(self.ids.objects.as_slice()) as u64;
        }
        if let Decision::On(Cause::Metered(reading)) = plan.decision(Effect::LightMeter) {
            counts.of(Effect::LightMeter).bytes = size_of_val(reading) as u64;
        }
        if let Some(maps) = &lighting.shadow_maps {
            counts.of(Effect::ShadowMaps).bytes = maps.byte_count() as u64;
            counts.of(Effect::ShadowMaps).passes = self.shadows.drawn() as u64;
            counts.of(Effect::SoftShadows).bytes = maps.extent_byte_count() as u64;
        }
        if let Some(surroundings) = &lighting.surroundings {
            counts.of(Effect::Environment).bytes = surroundings.environment.byte_count() as u64;
        }
        if let Some(studio) = &lighting.metal_studio {
            counts.of(Effect::MetalStudio).bytes = studio.byte_count() as u64;
        }
        if let Some(buffer) = &lighting.occlusion_buffer {
            counts.of(Effect::AmbientOcclusion).passes = 1;
            counts.of(Effect::AmbientOcclusion).bytes = buffer.byte_count() as u64;
        }
        for buffer in lighting.lamp_buffers.iter().flatten() {
            counts.of(Effect::SoftShadows).passes += 1;
            counts.of(Effect::SoftShadows).bytes += buffer.byte_count() as u64;
        }
        if let Some(rays) = &lighting.rays {
            let [to_lamps, around, sight, to_soft_lamps] = rays.cast();
            // Mirrors and glass share their rays.
            for (effect, cast) in [
                (Effect::ShadowRays, to_lamps),
                (Effect::AmbientOcclusion, around),
                (Effect::SoftShadows, to_soft_lamps),
                (Effect::Reflection, sight),
                (Effect::Refraction, sight),
            ] {
                if plan.is_on(effect) {
                    counts.of(effect).bytes += rays.byte_count() as u64;
                    counts.of(effect).rays = cast;
                }
            }
        }
    }

    /// Draws the colour pass, and what is laid over the image afterwards. The results of the pass other than
    /// colours go to `ids` and the frame's depth, as far as they are needed.
    pub(super) fn draw(
        &mut self,
        pass: &Pass<'_>,
        settings: &RenderSettings,
        plan: &EffectPlan,
        Destination { target, frame, needed }: Destination<'_>,
        rasterizer: &mut Rasterizer,
    ) -> Result<Stats, TargetError> {
        let Frame { color, radiance, depth, .. } = frame;
        let (colors, pixels) = (color.as_chunks_mut().0, settings.width as usize * settings.height as usize);
        let needed = needed.with_objects(plan.is_on(Effect::Outline));
        let full = TargetError::Memory { width: settings.width, height: settings.height };
        self.ids.allocate(pixels, needed).ok_or(full)?;
        // The target borrows the lists.
        let mut ids = std::mem::take(&mut self.ids);
        let target = ids.with(target, depth.as_mut())?;
        let images = ColorImages { colors, radiance: radiance.as_mut() };
        let is_mapped = plan.is_on(Effect::ToneMapping);
        let stats = if is_mapped || settings.xray_opacity().is_some() {
            self.draw_mapped(pass, settings, target, images, rasterizer)?
        } else {
            draw_directly(pass, target, images, rasterizer)?
        };
        if let (true, Some(outline)) = (plan.is_on(Effect::Outline), &settings.effects.outline) {
            draw_outline(outline, &ids.objects, settings.width as usize, color.as_chunks_mut().0);
        }
        self.ids = ids;
        Ok(stats)
    }

    /// Draws a pass of which only depth and ids are kept.
    pub(super) fn draw_ids(
        &mut self,
        pass: &Pass<'_>,
        settings: &RenderSettings,
        Destination { target, frame, needed }: Destination<'_>,
        rasterizer: &mut Rasterizer,
    ) -> Result<Stats, TargetError> {
        let RenderSettings { width, height, .. } = *settings;
        let pixels = width as usize * height as usize;
        self.ids.allocate(pixels, needed).ok_or(TargetError::Memory { width, height })?;
        Ok(rasterizer.draw(pass, &mut self.ids.with(target, frame.depth.as_mut())?))
    }

    /// Draws what shows through the faces of the next image.
    pub(super) fn draw_beneath(
        &mut self,
        pass: &Pass<'_>,
        settings: &RenderSettings,
        blank: Target<'_>,
        rasterizer: &mut Rasterizer,
    ) -> Result<Stats, TargetError> {
        let RenderSettings { width, height, .. } = *settings;
        let pixels = width as usize * height as usize;
        resize(&mut self.beneath, pixels, Vec4::ZERO).ok_or(TargetError::Memory { width, height })?;
        Ok(rasterizer.draw(pass, &mut blank.with_linear(&mut self.beneath)?))
    }

    /// Draws the colours of a frame whose pixels are not rasterized: `paint` gives linear light. Outlines are laid over
    /// them by the ids of the pixels, which must be there already.
    pub(super) fn draw_rays(
        &mut self,
        settings: &RenderSettings,
        plan: &EffectPlan,
        frame: &mut Frame,
        rasterizer: &Rasterizer,
        paint: impl FnOnce(&mut [Vec4]),
    ) -> Result<(), TargetError> {
        let RenderSettings { width, height, .. } = *settings;
        let Frame { color, radiance, .. } = frame;
        let (is_requested, linear) = (radiance.is_some(), radiance.as_mut().unwrap_or(&mut self.linear));
        let pixels = width as usize * height as usize;
        resize(linear, pixels, Vec4::ZERO).ok_or(TargetError::Memory { width, height })?;
        paint(linear);
        let colors = color.as_chunks_mut().0;
        if plan.is_on(Effect::ToneMapping) {
            map_tones(linear, settings, colors, rasterizer);
            if is_requested {
                lay_on_background(linear, settings);
            }
        } else {
            encode(linear, colors);
        }
        if let (true, Some(outline)) = (plan.is_on(Effect::Outline), &settings.effects.outline) {
            draw_outline(outline, &self.ids.objects, width as usize, colors);
        }
        Ok(())
    }

    /// Draws linear light, adds what shows through faces, and maps the tones into the image.
    fn draw_mapped(
        &mut self,
        pass: &Pass<'_>,
        settings: &RenderSettings,
        target: Target<'_>,
        ColorImages { colors, radiance }: ColorImages<'_>,
        rasterizer: &mut Rasterizer,
    ) -> Result<Stats, TargetError> {
        let RenderSettings { width, height, .. } = *settings;
        let (is_requested, linear) = (radiance.is_some(), radiance.unwrap_or(&mut self.linear));
        let pixels = width as usize * height as usize;
        resize(linear, pixels, Vec4::ZERO).ok_or(TargetError::Memory { width, height })?;
        let stats = rasterizer.draw(pass, &mut target.with_linear(linear)?);
        if let Some(share) = settings.xray_opacity() {
            for (light, beneath) in linear.iter_mut().zip(&self.beneath) {
                *light = *light * (1.0 - share) + *beneath * share;
            }
        }
        map_tones(linear, settings, colors, rasterizer);
        if is_requested {
            lay_on_background(linear, settings);
        }
        Ok(stats)
    }
}

/// The images that a pass of colours leaves, as far as they are requested.
struct ColorImages<'a> {
    /// Bytes, or none.
    colors: &'a mut [[u8; 4]],
    /// Linear light.
    radiance: Option<&'a mut Vec<Vec4>>,
}

/// Draws what is not changed afterwards.
fn draw_directly<'a>(
    pass: &Pass<'_>,
    mut target: Target<'a>,
    ColorImages { colors, radiance }: ColorImages<'a>,
    rasterizer: &mut Rasterizer,
) -> Result<Stats, TargetError> {
    if let Some(radiance) = radiance {
        target = target.with_linear(radiance)?;
    }
    if !colors.is_empty() {
        target = target.with_srgb8(colors)?;
    }
    Ok(rasterizer.draw(pass, &mut target))
}
