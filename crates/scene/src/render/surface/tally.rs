//! What a draw hands on and looks up, counted for the effects that ask for it.

use super::{Coverage, Dressed, Illumination, Model};
use crate::effects::{Counts, Effect, Scenery};

impl Dressed<'_> {
    /// Adds what each vertex hands on and what each pixel looks up.
    pub(crate) fn count(&self, scenery: &Scenery, masked: bool, counts: &mut Counts) {
        let Self { look, layout, .. } = self;
        let some = |there: bool, count: u64| if there { count } else { 0 };
        let light = if !scenery.lights.lamps.is_empty() {
            Effect::Lamps
        } else if scenery.surroundings.is_some() {
            Effect::Environment
        } else {
            Effect::AmbientLight
        };
        let (maps, specular) = match &look.model {
            Model::Lambert => (0, false),
            Model::BlinnPhong { map, .. } => (some(map.is_some(), 1), true),
            Model::Microfacets(model) => {
                let maps = [&model.map, &model.specular_map, &model.specular_color_map];
                (maps.iter().filter(|map| map.is_some()).count() as u64, true)
            }
        };
        let position = match () {
            () if scenery.mist.is_some() => Effect::Fog,
            () if specular && self.illumination != Illumination::None => Effect::Highlights,
            () if scenery.shadow_maps.is_some() => Effect::ShadowMaps,
            () if scenery.shadow_rays => Effect::ShadowRays,
            () if scenery.ambient_rays.is_some() => Effect::AmbientOcclusion,
            () => light,
        };
        let of_light = layout.light.map_or(0, |slots| slots.len() as u64) + some(layout.normal.is_some(), 3);
        counts.of(light).attributes += of_light;
        counts.of(position).attributes += some(layout.position.is_some(), 3);
        counts.of(Effect::NormalMaps).attributes += some(layout.tangent.is_some(), 4);
        counts.of(Effect::VertexColors).attributes += some(layout.color.is_some(), 4);
        counts.of(Effect::Textures).attributes += 2 * layout.coordinates.len() as u64;
        counts.of(Effect::Textures).look_ups += maps + some(look.base_map.is_some(), 1);
        counts.of(Effect::Masks).look_ups += some(masked && look.base_map.is_some(), 1);
        counts.of(Effect::Emission).look_ups += some(look.emissive_map.is_some(), 1);
        counts.of(Effect::NormalMaps).look_ups += some(look.normal_map.is_some(), 1);
        counts.of(Effect::OcclusionMaps).look_ups += some(look.occlusion_map.is_some(), 1);
        counts.of(Effect::Refraction).look_ups += some(look.transmission_map.is_some(), 1);
        counts.of(Effect::Transparency).passes += some(look.coverage == Coverage::Translucent, 1);
    }
}
