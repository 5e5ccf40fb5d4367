//! Fog, eight lanes at a time.

use crate::work::{Work, note};
use trigon_math::Vec3;
use trigon_raster::simd::{Simd, prelude::*};

use crate::effect_settings::Fog;
use crate::lanes::{V3, dot, exp2, mix, splat};

/// Precomputed fog.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FogModel {
    color: Vec3,
    /// Halvings per metre.
    halvings: f32,
}

impl FogModel {
    /// `None` for fog that hides nothing.
    pub(crate) fn new(fog: &Fog) -> Option<Self> {
        let halvings = fog.density * std::f32::consts::LOG2_E;
        (halvings > 0.0 && halvings.is_finite()).then_some(Self { color: fog.color, halvings })
    }

    /// Colours seen through the fog at positions in camera space.
    #[inline(always)]
    pub(crate) fn over<S: Simd>(&self, simd: S, position: V3<S>, color: V3<S>) -> V3<S> {
        note(Work::Fog);
        let distance = dot(position, position).sqrt();
        let transmitted = exp2(distance * -self.halvings);
        let fog_color = splat(simd, self.color);
        [
            mix(fog_color[0], color[0], transmitted),
            mix(fog_color[1], color[1], transmitted),
            mix(fog_color[2], color[2], transmitted),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fearless_simd::Fallback;
    use trigon_math::elementary;

    #[test]
    fn a_surface_fades_exponentially_with_its_distance() {
        let simd = Fallback::new();
        let fog = Fog { color: Vec3::new(1.0, 0.5, 0.0), density: 0.3 };
        let model = FogModel::new(&fog).expect("there is some");
        for distance in [0.0_f32, 1.0, 5.0, 40.0] {
            let at = splat(simd, Vec3::new(0.0, 0.6, -0.8) * distance);
            let foggy = model.over(simd, at, splat(simd, Vec3::Z)).map(|channel| f64::from(channel[0]));
            let transmitted = elementary::exp(-0.3 * f64::from(distance));
            let expected = [1.0 - transmitted, 0.5 - 0.5 * transmitted, transmitted];
            let worst = foggy.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-6, "{foggy:?} at {distance}, not {expected:?}");
        }
    }

    #[test]
    fn fog_without_density_is_none() {
        for density in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            assert!(FogModel::new(&Fog { color: Vec3::ONE, density }).is_none(), "{density} hides nothing");
        }
    }
}
