//! Ambient occlusion: the fraction of cosine-weighted rays that leave the surroundings of a point
//! (H. Landis, "Production-Ready Global Illumination", 2002).
//!
//! Every pixel uses the same directions, a spiral over the disc below the hemisphere (which gives the cosine
//! weights), rotated about the normal by one of 16 angles. The pixel's position in a square of four by four
//! selects the angle: neighbours differ, and the image is reproducible.

use crate::work::{Work, note};
use std::sync::atomic::Ordering;

use trigon_math::{Ray, Vec2, Vec3, elementary};
use trigon_raster::simd::{F32, LANES, Simd, lanes_of, prelude::*};

use super::RayScene;
use crate::effect_settings::AmbientOcclusion;
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
        [x, y]: [F32<S>; 2],
        active: u64,
    ) -> F32<S> {
        let origins = scene.origins(simd, points);
        let [nx, ny, nz] = scene.turned_rows(simd, points.facing);
        let [x, y]: [[f32; LANES]; 2] = [x.into(), y.into()];
        let mut cast = 0;
        let open = lanes_of(|lane| {
            let normal = Vec3::new(nx[lane], ny[lane], nz[lane]);
            if active >> lane & 1 == 0 || normal == Vec3::ZERO {
                return 1.0;
            }
            cast += self.directions.len() as u64;
            let turn = self.turns[(y[lane] as usize % 4) * 4 + x[lane] as usize % 4];
            self.share(scene, origins[lane], normal, turn)
        });
        scene.cast[1].fetch_add(cast, Ordering::Relaxed);
        F32::simd_from(simd, open)
    }

    fn share(&self, scene: &RayScene, origin: Vec3, normal: Vec3, turn: Vec2) -> f32 {
        let (tangent, bitangent) = normal.any_orthonormal_pair();
        let [right, up] = [tangent * turn.x + bitangent * turn.y, bitangent * turn.x - tangent * turn.y];
        let leaves = |direction: &&Vec3| {
            let direction = right * direction.x + up * direction.y + normal * direction.z;
            note(Work::OcclusionRay);
            !scene.triangles.bvh.occluded(&Ray { origin, direction }, 0.0..self.distance)
        };
        self.directions.iter().filter(leaves).count() as f32 / self.directions.len() as f32
    }
}
