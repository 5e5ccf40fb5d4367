//! Lamps in camera space, how much of a lamp's light arrives at a point, and the default lights for scenes without any.

use trigon_math::{DAffine3, DVec3, Vec3};
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, Simd};

use super::Lights;
use crate::lanes::{V3, difference, dot, inverse_root, lesser_of, positive, saturated, scaled, splat};
use crate::light::{Light, LightKind};

/// The largest light that arrives. It keeps products with reflectances, and sums over thousands of lamps,
/// finite: infinity times zero would be NaN, and show as black in the brightest light.
pub(crate) const BRIGHTEST: f32 = (1_u64 << 60) as f32;

/// A light with a direction, in camera space: differences of large world
/// coordinates never appear.
#[derive(Clone, Debug)]
pub(crate) struct Lamp {
    pub(crate) source: LampSource,
    /// The linear RGB of a white surface in this light; for a point or spot light, at one metre.
    pub(crate) radiance: Vec3,
    /// See [`Light::radius`]; 0 casts sharp shadows.
    pub(crate) radius: f32,
    /// Its node.
    pub(crate) node: Option<u32>,
}

/// The direction from which light comes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum LampSource {
    /// Parallel; the unit vector points towards the light.
    Directional(Vec3),
    /// From a point, perhaps within a cone.
    Point {
        position: Vec3,
        /// One over the range in metres, squared; 0 for none.
        inverse_range_squared: f32,
        cone: Option<Cone>,
    },
}

/// The cone of a spot light; see [`Light::cone`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cone {
    /// The unit vector from a lit point to the lamp.
    backwards: Vec3,
    scale: f32,
    offset: f32,
}

/// Light as it arrives at eight points.
pub(crate) struct Arriving<S: Simd> {
    /// Unit vectors towards the lamp; zero where there is no direction.
    pub(crate) towards: V3<S>,
    /// The fraction of the lamp's radiance that arrives; 1 at one metre.
    pub(crate) share: F32<S>,
}

impl Lamp {
    /// A light of the scene; `None` for ambient light, which is no lamp.
    pub(crate) fn new(light: &Light, node: u32, to_camera: &DAffine3) -> Option<Self> {
        let backwards = to_camera.transform_vector3(DVec3::Z).normalize_or_zero().as_vec3();
        let position = to_camera.translation.as_vec3();
        let inverse_range = if light.range > 0.0 { 1.0 / light.range } else { 0.0 };
        let inverse_range_squared = inverse_range * inverse_range;
        let source = match light.kind {
            LightKind::Ambient => return None,
            LightKind::Directional => LampSource::Directional(backwards),
            LightKind::Point => LampSource::Point { position, inverse_range_squared, cone: None },
            LightKind::Spot { .. } => {
                let (scale, offset) = light.cone();
                let cone = Some(Cone { backwards, scale, offset });
                LampSource::Point { position, inverse_range_squared, cone }
            }
        };
        Some(Self { source, radiance: light.radiance(), radius: light.extent(), node: Some(node) })
    }

    /// Parallel light of the studio.
    pub(crate) fn studio(towards: Vec3, radiance: f32) -> Self {
        let source = LampSource::Directional(towards.normalize());
        Self { source, radiance: Vec3::splat(radiance), radius: 0.0, node: None }
    }

    /// Whether the light depends on a surface's position, and not only on its normal.
    pub(crate) fn needs_position(&self) -> bool {
        matches!(self.source, LampSource::Point { .. })
    }

    /// Whether its light is grey.
    pub(crate) fn is_grey(&self) -> bool {
        self.radiance.x == self.radiance.y && self.radiance.y == self.radiance.z
    }

    /// The light that arrives at points in camera space, by the formulas of [`Light::falloff`] and
    /// [`Light::cone`].
    #[inline(always)]
    pub(crate) fn arriving<S: Simd>(&self, simd: S, position: V3<S>) -> Arriving<S> {
        match &self.source {
            LampSource::Directional(towards) => {
                Arriving { towards: splat(simd, *towards), share: F32::splat(simd, 1.0) }
            }
            LampSource::Point { position: lamp, inverse_range_squared, cone } => {
                let offset = difference(splat(simd, *lamp), position);
                let squared = dot(offset, offset);
                let inverse = inverse_root(squared);
                let towards = scaled(offset, inverse);
                let relative = squared * *inverse_range_squared;
                let falloff = positive(1.0 - relative * relative) * (inverse * inverse);
                let falloff = lesser_of(falloff, BRIGHTEST);
                let share = match cone {
                    None => falloff,
                    Some(cone) => falloff * cone.share(simd, towards),
                };
                Arriving { towards, share }
            }
        }
    }
}

impl Cone {
    #[inline(always)]
    fn share<S: Simd>(&self, simd: S, towards: V3<S>) -> F32<S> {
        let cosine = dot(splat(simd, self.backwards), towards);
        let linear = saturated(cosine * self.scale + self.offset);
        linear * linear
    }
}

impl Lights {
    /// A key light from the upper left, a weaker fill from the right, a rim light from behind, and a little
    /// ambient light. All of them move with the camera, so that no side of a model is ever dark.
    ///
    /// They are as bright as a display can show: a white plate that faces the camera shows at least 235 of
    /// 255, and no white diffuse surface is clipped, at any orientation. The darkest side of a white ball has
    /// a fifth of the light of the brightest.
    pub(crate) fn studio() -> Self {
        let key = Lamp::studio(Vec3::new(-0.5, 0.55, 0.75), 0.72);
        let fill = Lamp::studio(Vec3::new(0.75, -0.1, 0.65), 0.25);
        let rim = Lamp::studio(Vec3::new(0.25, 0.75, -0.6), 0.25);
        Self { ambient: Vec3::splat(0.2), lamps: vec![key, fill, rim], ..Self::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::baseline::baseline;
    use crate::lighting::LampSource;
    use trigon_math::elementary;

    fn share(light: &Light, at: Vec3) -> f32 {
        let simd = baseline();
        let lamp = Lamp::new(light, 0, &DAffine3::IDENTITY).expect("a lamp");
        lamp.arriving(simd, splat(simd, at)).share[0]
    }

    #[test]
    fn light_falls_off_as_the_light_says() {
        let light = Light::point(1.0).with_range(4.0);
        for distance in [0.5_f32, 1.0, 3.0, 3.999, 4.0, 7.0] {
            let (given, expected) = (share(&light, Vec3::X * distance), light.falloff(distance * distance));
            assert!((given - expected).abs() <= 1e-6 * expected.abs() + 1e-9, "{distance}: {given}");
        }
        assert_eq!(share(&light, Vec3::ZERO), 0.0, "no direction, no light");
    }

    /// The formula of KHR_lights_punctual, in f64.
    #[test]
    fn a_spot_fades_as_the_specification_says() {
        let (inner, outer) = (0.2, 0.5);
        let light = Light { kind: LightKind::Spot { inner, outer }, ..Light::spot(1.0) };
        for angle in [0.0_f64, 0.1, 0.25, 0.35, 0.45, 0.6, 2.0] {
            let at = DVec3::new(elementary::sin(angle), 0.0, -elementary::cos(angle)) * 2.0;
            let (near, far) = (elementary::cos(f64::from(inner)), elementary::cos(f64::from(outer)));
            let linear = ((elementary::cos(angle) - far) / (near - far)).clamp(0.0, 1.0);
            let expected = linear * linear / 4.0;
            let given = f64::from(share(&light, at.as_vec3()));
            assert!((given - expected).abs() < 1e-5, "at {angle}: {given}, not {expected}");
        }
    }

    /// Over all normals n, the sum of max(0, n · v) over some vectors v is largest where n
    /// points along the sum of some of them: it is the length of the longest such sum.
    fn brightest(lights: &Lights) -> f32 {
        let lamps: Vec<Vec3> = lights.lamps.iter().map(towards).collect();
        let longest = (0..1_u32 << lamps.len()).map(|subset| {
            let chosen = lamps.iter().zip(0..).filter(|(_, bit)| subset >> bit & 1 == 1);
            chosen.map(|(lamp, _)| *lamp).sum::<Vec3>().length()
        });
        lights.ambient.max_element() + longest.fold(0.0, f32::max)
    }

    /// The length is the lamp's brightness.
    fn towards(lamp: &Lamp) -> Vec3 {
        let LampSource::Directional(towards) = lamp.source else {
            panic!("lamps of the studio are parallel")
        };
        towards * lamp.radiance
    }

    #[test]
    fn white_is_bright_and_never_clipped() {
        let studio = Lights::studio();
        let brightest = brightest(&studio);
        assert!(brightest <= 1.0, "no diffuse surface is clipped: {brightest}");
        let facing = studio.ambient.x + studio.lamps.iter().map(|lamp| towards(lamp).z.max(0.0)).sum::<f32>();
        let shown = trigon_math::color::linear_to_srgb8(facing);
        assert!(shown >= 235, "a plate that faces the camera: {shown}");
        assert!(studio.ambient.x < 0.25 * brightest, "shapes can be told by their shade");
    }
}
