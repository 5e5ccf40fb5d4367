//! What mirrors of several roughnesses show: the light of all directions, weighed
//! by GGX's distribution around each, as if it were seen head-on.

use rayon::prelude::*;
use trigon_math::Vec3;

use super::Octahedral;
use super::octahedral::direction;

/// Sides of the maps in texels, from a mirror to the roughest surface: blurred
/// light needs few.
const SIDES: [usize; 5] = [256, 64, 32, 16, 16];

/// Sides of the maps that they are made from: texels no wider than the blur.
const SOURCES: [usize; 5] = [256, 128, 64, 32, 32];

/// The sharp map and its blurred ones.
pub(super) fn levels(sharp: Octahedral) -> Vec<Octahedral> {
    // The same from everywhere: there is nothing to blur.
    if sharp.size() < SIDES[1] {
        return vec![sharp];
    }
    let mut sources = vec![sharp.clone()];
    while let Some(last) = sources.last().filter(|last| last.size() > SOURCES[4]) {
        let halved = last.halved();
        sources.push(halved);
    }
    let mut levels = vec![sharp];
    for level in 1..SIDES.len() {
        let roughness = level as f32 / (SIDES.len() - 1) as f32;
        let source = sources.iter().find(|source| source.size() <= SOURCES[level]);
        levels.push(blurred(source.unwrap_or(&levels[0]), SIDES[level], roughness));
    }
    levels
}

fn blurred(source: &Octahedral, size: usize, roughness: f32) -> Octahedral {
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
