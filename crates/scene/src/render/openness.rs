//! The lighting environment of a frame, with what its surfaces share: how open they are to their surroundings and to lamps
//! with an extent, drawn at half the resolution.

use trigon_math::Vec4;
use trigon_raster::{Background, Pass, Rasterizer, Stats, Target, TargetError};

use super::bounds::record_all;
use super::compose::Composer;
use super::engine::Engine;
use crate::effect_settings::RaySampling;
use crate::effects::{Counts, LightingEnvironment, OpennessBuffer, OpennessOf, SmallImage, SmallView};
use crate::frame::resize;
use crate::placement::DepthToDistance;
use crate::plan::EffectPlan;
use crate::prepare::PreparedScene;
use crate::settings::RenderSettings;

impl Engine {
    /// The lighting environment, with what its surfaces share of ambient occlusion and of soft shadows.
    pub(super) fn lighting(
        &mut self,
        prepared: &PreparedScene<'_>,
        plan: &EffectPlan,
        rasterizer: &mut Rasterizer,
    ) -> Result<LightingEnvironment, TargetError> {
        let mut lighting = self.caches.lighting(prepared, plan, rasterizer)?;
        let is_shared =
            lighting.ambient_rays.as_ref().is_some_and(|rays| rays.sampling == RaySampling::Shared);
        if is_shared {
            let buffer = self.openness(OpennessOf::Surroundings, prepared, &lighting, rasterizer)?;
            lighting.occlusion_buffer = Some(buffer);
        }
        let mut buffers = Vec::new();
        for is_shared in lighting.sharing_lamps() {
            let of = OpennessOf::Lamp(buffers.len());
            let buffer = is_shared.then(|| self.openness(of, prepared, &lighting, rasterizer)).transpose()?;
            buffers.push(buffer);
        }
        lighting.lamp_buffers = buffers;
        Ok(lighting)
    }

    fn openness(
        &mut self,
        of: OpennessOf,
        prepared: &PreparedScene<'_>,
        lighting: &LightingEnvironment,
        rasterizer: &mut Rasterizer,
    ) -> Result<OpennessBuffer, TargetError> {
        let draws = Composer::of_openness(of, prepared, lighting, &self.vertex_lists);
        let (buffer, stats) = draw_openness(of, prepared, &draws, rasterizer)?;
        self.stats += stats;
        Ok(buffer)
    }
}

/// Draws how open surfaces are, at half the resolution.
fn draw_openness(
    of: OpennessOf,
    prepared: &PreparedScene<'_>,
    composer: &Composer<'_>,
    rasterizer: &mut Rasterizer,
) -> Result<(OpennessBuffer, Stats), TargetError> {
    let RenderSettings { width, height, .. } = *prepared.settings;
    let projection = &prepared.camera.projection;
    let view = SmallView::new(projection, prepared.eye.projection(), [width, height]);
    let draws = composer.draws(&mut Counts::default());
    let mut pass = Pass::new();
    pass.background(Background::Color(Vec4::ZERO));
    record_all(&draws, &mut pass);
    let full = TargetError::Memory { width: view.width, height: view.height };
    let pixels = view.width as usize * view.height as usize;
    let (mut found, mut depths) = (Vec::new(), Vec::new());
    resize(&mut found, pixels, Vec4::ZERO).ok_or(full)?;
    resize(&mut depths, pixels, 0.0).ok_or(full)?;
    let target = Target::new(view.width, view.height, &[])?;
    let mut target = target.with_linear(&mut found)?.with_depth(&mut depths)?;
    let stats = rasterizer.draw(&pass, &mut target);
    let distance = DepthToDistance::new(projection, prepared.settings.aspect());
    depths.iter_mut().for_each(|depth| *depth = distance.at(*depth));
    let small = SmallImage { view, found: &found, distances: &depths };
    Ok((OpennessBuffer::new(&small, of, rasterizer), stats))
}
