//! Light blurred over all directions: diffuse irradiance by the first nine spherical harmonics; and reflections at several
//! roughnesses, weighted by the GGX distribution around each direction, as if seen head-on.

use rayon::prelude::*;
use trigon_math::Vec3;
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, Simd};

use super::Octahedral;
use super::octahedral::direction;
use crate::lanes::{V3, positive};

/// Sides of the maps in texels, from a quarter of the greatest roughness on: blurred light needs
/// few.
const SIDES: [usize; 4] = [64, 32, 16, 16];

/// Sides of their source maps: texels no wider than the blur.
const SOURCES: [usize; 4] = [128, 64, 32, 32];

/// The sharp map and its successive halves, down to the smallest useful one.
pub(super) fn halved(sharp: Octahedral) -> Vec<Octahedral> {
    let mut maps = vec![sharp];
    while let Some(last) = maps.last().filter(|last| last.size() > SOURCES[3]) {
        let halved = last.halved();
        maps.push(halved);
    }
    maps
}

/// What rough surfaces mirror; empty if the light is the same from all directions.
pub(super) fn blurred(halved: &[Octahedral]) -> Vec<Octahedral> {
    if halved[0].size() < SIDES[0] {
        return Vec::new();
    }
    let levels = SIDES.into_iter().zip(SOURCES).zip(1_u8..);
    levels
        .map(|((side, source), level)| {
            let source = halved.iter().find(|map| map.size() <= source).unwrap_or(&halved[0]);
            blur(source, side, f32::from(level) / SIDES.len() as f32)
        })
        .collect()
}

fn blur(source: &Octahedral, size: usize, roughness: f32) -> Octahedral {
    let lights: Vec<(Vec3, f32, Vec3)> = source.iter().collect();
    let alpha = roughness * roughness;
    let square = alpha * alpha;
    let shown = |towards: Vec3| {
        let (mut sum, mut weights) = (Vec3::ZERO, 0.0_f32);
        for &(direction, area, light) in &lights {
            let cosine = towards.dot(direction);
            if cosine <= 0.0 {
                continue;
            }
            // Of the half vector between view and light: N·H² = (1 + N·L) / 2.
            let width = (cosine + 1.0) * 0.5 * (square - 1.0) + 1.0;
            let weight = cosine * area / (width * width);
            sum += light * weight;
            weights += weight;
        }
        if weights > 0.0 { sum / weights } else { Vec3::ZERO }
    };
    // Each texel by itself, so that threads do not matter.
    let texels: Vec<Vec3> =
        (0..size * size).into_par_iter().map(|i| shown(direction(size, i % size, i / size))).collect();
    Octahedral::from_texels(size, &texels)
}

/// Nine coefficients for each of red, green and blue, constants multiplied in: of
/// 1, y, z, x, xy, yz, 3z² − 1, xz and x² − y².
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Harmonics([Vec3; 9]);

/// The squares of the constants of the real harmonics times what a cosine leaves
/// of each band, over π: 1, 2/3, 1/4.
const FACTORS: [f32; 9] = [
    0.079_577_47,
    0.238_732_42 * 2.0 / 3.0,
    0.238_732_42 * 2.0 / 3.0,
    0.238_732_42 * 2.0 / 3.0,
    1.193_662 / 4.0,
    1.193_662 / 4.0,
    0.099_471_84 / 4.0,
    1.193_662 / 4.0,
    0.298_415_5 / 4.0,
];

impl Harmonics {
    pub(super) fn of(map: &Octahedral) -> Self {
        let mut sums = [Vec3::ZERO; 9];
        let mut whole = 0.0;
        for (direction, area, light) in map.iter() {
            whole += area;
            for (sum, basis) in sums.iter_mut().zip(basis(direction)) {
                *sum += light * (basis * area);
            }
        }
        for (sum, factor) in sums.iter_mut().zip(FACTORS) {
            // The texels' areas are not quite exact; their sum is known.
            *sum *= factor * (4.0 * std::f32::consts::PI / whole);
        }
        Self(sums)
    }

    /// For a unit normal.
    pub(super) fn at(&self, normal: Vec3) -> Vec3 {
        let sum: Vec3 = self.0.iter().zip(basis(normal)).map(|(&light, basis)| light * basis).sum();
        Vec3::select(sum.cmpgt(Vec3::ZERO), sum, Vec3::ZERO)
    }

    /// For eight unit normals.
    #[inline(always)]
    pub(super) fn at_lanes<S: Simd>(&self, simd: S, [x, y, z]: V3<S>) -> V3<S> {
        let one = F32::splat(simd, 1.0);
        let basis = [one, y, z, x, x * y, y * z, z * z * 3.0 - 1.0, x * z, x * x - y * y];
        let mut sum = [F32::splat(simd, 0.0); 3];
        for (light, basis) in self.0.iter().zip(basis) {
            for (channel, sum) in sum.iter_mut().enumerate() {
                *sum += basis * light[channel];
            }
        }
        [positive(sum[0]), positive(sum[1]), positive(sum[2])]
    }
}

fn basis(Vec3 { x, y, z }: Vec3) -> [f32; 9] {
    [1.0, y, z, x, x * y, y * z, 3.0 * z * z - 1.0, x * z, x * x - y * y]
}
