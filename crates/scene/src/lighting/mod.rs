//! The lights of an image, gathered once per frame, and the shading of surfaces by them.

mod brdf;
mod lamp;

pub(crate) use brdf::{Brdf, ImageLanes, LitPoints, Microfacets, Reflected};
pub(crate) use lamp::{Arriving, BRIGHTEST, Lamp, LampSource};

use std::collections::BTreeMap;

use trigon_math::{DAffine3, Vec3};

use crate::light::{LightKind, LightReading, sound_radius};
use crate::placement::Eye;
use crate::scene::Scene;
use crate::settings::{Lighting, RenderSettings};
use crate::work::{Work, note};

/// The ambient light that is added if a scene has lamps but no ambient light. The lamps decide how bright the
/// scene is; this only makes shapes visible that they do not reach.
pub(crate) const ADDED_AMBIENT: Vec3 = Vec3::splat(0.1);

/// All lights of an image.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lights {
    /// Ambient light, linear RGB.
    pub(crate) ambient: Vec3,
    /// The number of ambient lights in the scene that shine.
    pub(crate) own_ambient: usize,
    pub(crate) lamps: Vec<Lamp>,
    /// The lamps that were left out of the list because nothing that is drawn gets light from them.
    pub(crate) idle: IdleLamps,
}

/// How many lamps light nothing that is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct IdleLamps {
    /// Those without any light.
    pub(crate) dark: usize,
    /// Those whose range or cone ends before any surface.
    pub(crate) out_of_reach: usize,
}

impl Lights {
    /// Collects the lights that the settings and the scene require. `transforms` are those of the visible nodes that have
    /// lights, by their indices.
    pub(crate) fn gather(
        scene: &Scene,
        transforms: &BTreeMap<u32, DAffine3>,
        eye: &Eye,
        settings: &RenderSettings,
    ) -> Self {
        let lighting = settings.lighting();
        let lights = Self::of_scene(scene, transforms, eye, lighting);
        match lighting {
            Lighting::Studio => Self::studio(),
            // An environment is light, too.
            Lighting::Automatic if settings.effects.environment.is_some() => lights,
            Lighting::Automatic if lights.is_dark() => Self::studio(),
            // glTF and other formats have no ambient light. Without any, sides that no lamp reaches would be
            // black.
            Lighting::Automatic if lights.ambient == Vec3::ZERO => {
                Self { ambient: ADDED_AMBIENT, own_ambient: 0, ..lights }
            }
            Lighting::Automatic | Lighting::Scene => lights,
        }
        .scaled(settings.light_factor())
        .extended(settings.effects.soft_shadows.radius)
    }

    fn of_scene(scene: &Scene, transforms: &BTreeMap<u32, DAffine3>, eye: &Eye, lighting: Lighting) -> Self {
        let mut lights = Self::default();
        if lighting != Lighting::Studio {
            for (&index, world) in transforms {
                let node = scene.nodes().id_at(index as usize).and_then(|id| scene.node(id));
                let Some(light) = node.and_then(|node| node.light.as_deref()) else { continue };
                if light.kind == LightKind::Ambient {
                    let radiance = light.radiance();
                    lights.ambient += radiance;
                    lights.own_ambient += usize::from(radiance != Vec3::ZERO);
                }
                lights.lamps.extend(Lamp::new(light, index, &eye.to_camera(world)));
            }
        }
        lights
    }

    /// Dims or brightens the scene's own lights as a light meter says. Ambient light that was added stays.
    pub(crate) fn exposed(self, reading: &LightReading) -> Self {
        note(Work::LightMeter);
        let ambient = self.ambient;
        let exposed = self.scaled(reading.factor());
        if exposed.own_ambient > 0 { exposed } else { Self { ambient, ..exposed } }
    }

    fn is_dark(&self) -> bool {
        self.ambient == Vec3::ZERO && self.lamps.is_empty()
    }

    /// Multiplies the intensity of every light; a factor that is not positive turns them off.
    pub(crate) fn scaled(mut self, factor: f32) -> Self {
        self.ambient *= factor;
        self.lamps.iter_mut().for_each(|lamp| lamp.radiance *= factor);
        self
    }

    /// With a radius for lamps that have none.
    fn extended(mut self, radius: f32) -> Self {
        let radius = sound_radius(radius);
        self.lamps.iter_mut().filter(|lamp| lamp.radius == 0.0).for_each(|lamp| lamp.radius = radius);
        self
    }

    /// Whether the light depends on a surface's position, and not only on its normal.
    pub(crate) fn need_position(&self) -> bool {
        self.lamps.iter().any(Lamp::needs_position)
    }

    /// Whether all light is grey.
    pub(crate) fn are_grey(&self) -> bool {
        let Vec3 { x, y, z } = self.ambient;
        x == y && y == z && self.lamps.iter().all(Lamp::is_grey)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::baseline::{Baseline, baseline};
    use crate::effects::LightingEnvironment;
    use crate::lanes::{V3, splat};
    use crate::light::Light;
    use trigon_math::DVec3;
    use trigon_raster::simd::{F32, LANES, prelude::*};

    /// The value of a white Lambertian surface two metres away, lit and seen head-on.
    fn shown(lights: &Lights) -> Vec3 {
        shown_at(lights, [2.0; LANES])[0]
    }

    /// The same of surfaces at eight distances.
    fn shown_at(lights: &Lights, distances: [f32; LANES]) -> [Vec3; LANES] {
        let simd = baseline();
        let normal: V3<Baseline> = splat(simd, Vec3::Z);
        let mut position = splat(simd, Vec3::ZERO);
        position[2] = F32::simd_from(simd, distances.map(|distance| -distance));
        let points = LitPoints::elsewhere(simd, position, normal, normal);
        let lighting = LightingEnvironment { lights: lights.clone(), ..LightingEnvironment::default() };
        let [red, green, blue] = lighting.reflected(simd, &points, &Brdf::Lambert).diffuse;
        std::array::from_fn(|lane| Vec3::new(red[lane], green[lane], blue[lane]))
    }

    fn lamp(light: Light, to_camera: DAffine3) -> Lights {
        Lights { lamps: Lamp::new(&light, 0, &to_camera).into_iter().collect(), ..Lights::default() }
    }

    #[test]
    fn a_white_surface_head_on_shows_the_intensity() {
        let shown_by = |light| shown(&lamp(light, DAffine3::IDENTITY));
        assert_eq!(shown_by(Light::directional(0.5)), Vec3::splat(0.5), "directional");
        assert_eq!(shown_by(Light::point(1.0)), Vec3::splat(0.25), "a quarter at two metres");
    }

    #[test]
    fn intensity_is_a_factor_for_every_light() {
        let shown = |factor| shown(&Lights::studio().scaled(factor));
        assert_eq!(shown(2.0), shown(1.0) * 2.0, "twice as bright");
        let broken = RenderSettings { light_intensity: f32::NAN, ..RenderSettings::new(1, 1) };
        assert_eq!(broken.light_factor(), 0.0, "no number, no light");
    }

    #[test]
    fn a_light_on_the_surface_gives_no_nan() {
        let there = DAffine3::from_translation(DVec3::new(0.0, 0.0, -2.0));
        let found = shown_at(&lamp(Light::point(1.0), there), [3.0, 3.0, 2.0, 3.0, 3.0, 3.0, 3.0, 3.0]);
        let mut expected = [Vec3::ONE; LANES];
        expected[2] = Vec3::ZERO;
        assert_eq!(found, expected, "no direction, no light; a metre before the lamp there is all of it");
    }

    #[test]
    fn light_from_behind_does_not_reach_the_surface() {
        let turned = DAffine3::from_quat(trigon_math::DQuat::from_xyzw(0.0, 1.0, 0.0, 0.0));
        assert_eq!(shown(&lamp(Light::directional(1.0), turned)), Vec3::ZERO, "from behind");
    }
}
