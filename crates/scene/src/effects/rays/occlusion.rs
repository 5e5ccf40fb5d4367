//! Ambient occlusion: the fraction of cosine-weighted rays that leave the surroundings of a point
//! (H. Landis, "Production-Ready Global Illumination", 2002).
//!
//! Every pixel uses the same directions, a spiral over the disc below the hemisphere (which gives the cosine
//! weights), rotated about the normal by one of 16 angles. The pixel's position in a square of four by four
//! selects the angle: neighbours differ, and the image is reproducible.

use crate::work::{Work, note};
use std::sync::atomic::Ordering;

use trigon_math::{Hemispheres, Rays, Vec2, Vec3, elementary};
use trigon_raster::simd::{F32, LANES, Mask, Simd, prelude::*};

use super::{RayScene, columns, rows};
use crate::effect_settings::AmbientOcclusion;
use crate::lanes::{V3, scaled, sum, turned};
use crate::lighting::LitPoints;

/// The maximum number of rays per pixel.
const MOST: u32 = 256;

/// Sines and cosines of the turns.
const TURNS: usize = 16;

/// The rays of each pixel.
#[derive(Clone, Debug)]
pub(crate) struct AmbientRays {
    /// Unit vectors around +Z.
    directions: Vec<Vec3>,
    turns: [Vec2; TURNS],
    distance: f32,
}

impl AmbientRays {
    pub(crate) fn new(settings: AmbientOcclusion) -> Self {
        /// The golden angle, in radians.
        const STEP: f32 = 2.399_963_2;
        let count = settings.rays.clamp(1, MOST);
        let direction = |i: u32| {
            let square = (i as f32 + 0.5) / count as f32;
            let (radius, angle) = (square.sqrt(), i as f32 * STEP);
            let flat = Vec2::new(elementary::cos_f32(angle), elementary::sin_f32(angle)) * radius;
            flat.extend((1.0 - square).sqrt())
        };
        let turn = |i: usize| {
            // Bit-reversed: neighbours differ most.
            let angle = ((i as u8).reverse_bits() >> 4) as f32 / TURNS as f32 * std::f32::consts::TAU;
            Vec2::new(elementary::cos_f32(angle), elementary::sin_f32(angle))
        };
        Self {
            directions: (0..count).map(direction).collect(),
            turns: std::array::from_fn(turn),
            distance: settings.distance,
        }
    }

    /// The fraction of rays that leave the surroundings of eight points at these pixel positions.
    pub(crate) fn open<S: Simd>(
        &self,
        simd: S,
        scene: &RayScene,
        points: &LitPoints<S>,
        pixels: [F32<S>; 2],
        active: u64,
    ) -> F32<S> {
        simd.vectorize(
            #[inline(always)]
            || {
                let normal = turned(&scene.turn(), points.facing);
                let is_turned = !(normal[0].simd_eq(0.0) & normal[1].simd_eq(0.0) & normal[2].simd_eq(0.0));
                let active = is_turned.to_bitmask() as u32 & active as u32;
                let origin = scene.origins(simd, points);
                let surroundings = Hemispheres { origin, normal, distance: self.distance, active };
                let surroundings = scene.triangles.bvh.surroundings(simd, &surroundings);
                let [zero, one] = [F32::splat(simd, 0.0), F32::splat(simd, 1.0)];
                if active == 0 || surroundings.is_empty() {
                    return one;
                }
                let [right, up] = self.frames(simd, normal, pixels);
                let (start, end) = (zero, F32::splat(simd, self.distance));
                let mut open = zero;
                for along in &self.directions {
                    let flat =
                        sum(scaled(right, F32::splat(simd, along.x)), scaled(up, F32::splat(simd, along.y)));
                    let direction = sum(flat, scaled(normal, F32::splat(simd, along.z)));
                    let rays = Rays { origin, direction, start, end, active };
                    let occluded = scene.triangles.bvh.occluded_rays(simd, &rays, Some(&surroundings));
                    open += Mask::from_bitmask(simd, u64::from(occluded)).select(zero, one);
                }
                note(Work::OcclusionRay);
                let cast = u64::from(active.count_ones()) * self.directions.len() as u64;
                scene.cast[1].fetch_add(cast, Ordering::Relaxed);
                open / self.directions.len() as f32
            },
        )
    }

    /// Two unit vectors along eight surfaces, turned as the positions of the pixels say.
    #[inline(always)]
    fn frames<S: Simd>(&self, simd: S, normal: V3<S>, [x, y]: [F32<S>; 2]) -> [V3<S>; 2] {
        let [nx, ny, nz] = rows(normal);
        let [x, y]: [[f32; LANES]; 2] = [x.into(), y.into()];
        let (mut right, mut up) = ([Vec3::ZERO; LANES], [Vec3::ZERO; LANES]);
        for lane in 0..LANES {
            let turn = self.turns[(y[lane] as usize % 4) * 4 + x[lane] as usize % 4];
            let (tangent, bitangent) = Vec3::new(nx[lane], ny[lane], nz[lane]).any_orthonormal_pair();
            right[lane] = tangent * turn.x + bitangent * turn.y;
            up[lane] = bitangent * turn.x - tangent * turn.y;
        }
        [columns(simd, &right), columns(simd, &up)]
    }
}
