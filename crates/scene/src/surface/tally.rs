//! Counts the varyings and texture look-ups of a draw, for the effects that need them.

use super::{Coverage, Illumination, Look, Model};
use crate::effect::Effect;
use crate::effects::{Counts, LightingEnvironment, Optics};
use crate::material::MaterialTexture;

impl Look<'_> {
    /// Adds the varyings of each vertex and the look-ups of each pixel.
    pub(crate) fn count(&self, lighting: &LightingEnvironment, masked: bool, counts: &mut Counts) {
        let Self { params, layout, .. } = self;
        let some = |there: bool, count: u64| if there { count } else { 0 };
        let light = if !lighting.lights.lamps.is_empty() {
            Effect::Lamps
        } else if lighting.surroundings.is_some() {
            Effect::Environment
        } else if lighting.has_ambient() {
            Effect::AmbientLight
        } else if matches!(params.optics, Some(Optics::Glass(_))) {
            Effect::Refraction
        } else {
            Effect::Reflection
        };
        let specular = !matches!(params.model, Model::Lambert);
        let position = match () {
            () if lighting.fog.is_some() => Effect::Fog,
            () if specular && self.illumination != Illumination::None => Effect::Highlights,
            () if lighting.shadow_maps.is_some() => Effect::ShadowMaps,
            () if lighting.shadow_rays => Effect::ShadowRays,
            () if lighting.ambient_rays.is_some() => Effect::AmbientOcclusion,
            () => light,
        };
        let of_light = layout.light.map_or(0, |slots| slots.len() as u64) + some(layout.normal.is_some(), 3);
        counts.of(light).attributes += of_light;
        counts.of(position).attributes += some(layout.position.is_some(), 3);
        counts.of(Effect::NormalMaps).attributes += some(layout.tangent.is_some(), 4);
        counts.of(Effect::VertexColors).attributes += some(layout.color.is_some(), 4);
        counts.of(Effect::Textures).attributes += 2 * layout.coordinates.len() as u64;
        for slot in params.maps.slots() {
            counts.of(slot.row().effect).look_ups += 1;
        }
        let has_holes = masked && params.maps.get(MaterialTexture::BaseColor).is_some();
        counts.of(Effect::Masks).look_ups += some(has_holes, 1);
        counts.of(Effect::Transparency).passes += some(params.coverage == Coverage::Translucent, 1);
    }
}
