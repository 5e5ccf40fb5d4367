//! Reflections at several roughnesses: the light of all directions, weighted by the GGX distribution around
//! each, as if seen head-on.

use rayon::prelude::*;
use trigon_math::Vec3;

use super::Octahedral;
use super::octahedral::direction;

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
