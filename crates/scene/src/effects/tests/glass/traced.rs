//! Rays through spheres, by Snell and Schlick in f64.

use trigon_math::{DVec2, DVec3, elementary};

/// Where the checker behind the balls is.
pub(super) const WALL: f64 = -2.0;
/// The sides of its squares.
pub(super) const SQUARE: f64 = 0.5;

/// The light that a parallel ray from +Z at a place brings through concentric spheres around the origin,
/// given as radius and index of refraction from the outside in; none near edges of squares.
pub(super) fn traced(place: DVec2, spheres: &[(f64, f64)]) -> Option<f64> {
    let (mut origin, mut along, mut left) = (place.extend(5.0), DVec3::NEG_Z, 1.0);
    // The number of spheres around the ray.
    let mut depth = 0;
    let ior = |depth: usize| if depth == 0 { 1.0 } else { spheres[depth - 1].1 };
    for _ in 0..32 {
        let meets = |sphere: usize| {
            let (half, radius) = (origin.dot(along), spheres[sphere].0);
            let root = half * half - origin.length_squared() + radius * radius;
            let [near, far] = [-half - root.max(0.0).sqrt(), -half + root.max(0.0).sqrt()];
            let inwards = sphere >= depth;
            (root > 0.0 && (if inwards { near } else { far }) > 1e-9)
                .then_some((if inwards { near } else { far }, inwards))
        };
        let next = [depth.checked_sub(1), Some(depth).filter(|&inner| inner < spheres.len())];
        let next = next.into_iter().flatten().filter_map(meets).min_by(|a, b| a.0.total_cmp(&b.0));
        let Some((distance, inwards)) = next else { break };
        origin += along * distance;
        let normal = if inwards { origin.normalize() } else { -origin.normalize() };
        let [before, after] = [ior(depth), ior(if inwards { depth + 1 } else { depth - 1 })];
        let (cosine, ratio) = (-along.dot(normal), before / after);
        let square = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
        if square < 0.0 {
            along += normal * (2.0 * cosine);
            continue;
        }
        let f0 = elementary::pow((before - after) / (before + after), 2.0);
        let grazing = 1.0 - if before <= after { cosine } else { square.sqrt() };
        left *= 1.0 - (f0 + (1.0 - f0) * elementary::pow(grazing, 5.0));
        along = along * ratio + normal * (ratio * cosine - square.sqrt());
        depth = if inwards { depth + 1 } else { depth - 1 };
    }
    let at = (origin + along * ((WALL - origin.z) / along.z)).truncate() / SQUARE;
    let is_near = |value: f64| (value - value.round()).abs() < 0.15 || value.abs() > 7.5;
    if along.z > -0.1 || is_near(at.x) || is_near(at.y) {
        return None;
    }
    let is_white = (at.x.floor() + at.y.floor()).rem_euclid(2.0) == 0.0;
    Some(if is_white { 0.9 * left } else { 0.0 })
}
