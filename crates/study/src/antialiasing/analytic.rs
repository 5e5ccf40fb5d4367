//! The exact area of each triangle in each pixel (E. Catmull, "A hidden-surface algorithm
//! with anti-aliasing", SIGGRAPH 1978): the pixel's square is cut by the three edges.

use super::Star;
use crate::oracle::{GridPoint, STEPS};
use trigon_classic::Field;
use trigon_math::DVec2;

pub(super) fn draw(star: &Star) -> Field<f64> {
    let mut shares = Field::new([star.side; 2], 0.0);
    for triangle in &star.triangles {
        let [columns, rows] = [0, 1].map(|axis| {
            let [low, high] = crate::fill::range(triangle.map(|corner| corner[axis]));
            (low.div_euclid(STEPS)).max(0)..=(high.div_euclid(STEPS)).min(star.side as i32 - 1)
        });
        for pixel in rows.flat_map(|y| columns.clone().map(move |x| [x, y])) {
            shares[pixel.map(|part| part as usize)] += area(*triangle, pixel);
        }
    }
    shares
}

/// The fraction of a pixel that a triangle covers, from 0 to 1. It is rounded in `f64` a few times at most,
/// because points lie within the pixel.
pub(super) fn area(triangle: [GridPoint; 3], pixel: [i32; 2]) -> f64 {
    let corner = DVec2::new(pixel[0].into(), pixel[1].into());
    let [a, b, c] = triangle.map(|[x, y]| DVec2::new(x.into(), y.into()) / f64::from(STEPS) - corner);
    let [a, b, c] = if (b - a).perp_dot(c - a) < 0.0 { [a, c, b] } else { [a, b, c] };
    let mut polygon = vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
    for [from, to] in [[a, b], [b, c], [c, a]] {
        polygon = inside(&polygon, |point| (to - from).perp_dot(point - from));
    }
    let sides = polygon.iter().zip(polygon.iter().cycle().skip(1));
    sides.map(|(p, q)| p.perp_dot(*q)).sum::<f64>() / 2.0
}

/// Clips a convex polygon to where a linear function is positive.
fn inside(polygon: &[DVec2], value: impl Fn(DVec2) -> f64) -> Vec<DVec2> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (&point, &next) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        let (here, there) = (value(point), value(next));
        if here >= 0.0 {
            kept.push(point);
        }
        if (here >= 0.0) != (there >= 0.0) {
            kept.push(point + (next - point) * (here / (here - there)));
        }
    }
    kept
}
