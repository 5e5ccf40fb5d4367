//! The rectangle of least area around points.
//!
//! One of its sides lies on a side of the convex hull (H. Freeman and R. Shapira, *Determining the Minimum-Area
//! Encasing Rectangle for an Arbitrary Closed Curve*, 1975). The hull is found as by A. Andrew, *Another Efficient
//! Algorithm for Convex Hulls in Two Dimensions*, 1979.

use trigon_math::{DVec2, Orientation, orientation};

use super::factor::{conjugate, times};

/// Turns points so that the rectangle of least area around them is upright and at least as high as wide, with its
/// lower left corner at the origin. Returns its size.
pub(super) fn turn_upright(points: &mut [DVec2]) -> DVec2 {
    let hull = convex_hull(points);
    let mut best = (f64::INFINITY, DVec2::X);
    for (i, &from) in hull.iter().enumerate() {
        let side = (hull[(i + 1) % hull.len()] - from).normalize_or_zero();
        if side == DVec2::ZERO {
            continue;
        }
        let size = size_along(&hull, side);
        if size.x * size.y < best.0 {
            best = (size.x * size.y, side);
        }
    }
    let size = size_along(&hull, best.1);
    // A quarter turn makes the longer side upright.
    let turn = if size.x > size.y { times(conjugate(best.1), DVec2::Y) } else { conjugate(best.1) };
    points.iter_mut().for_each(|point| *point = times(turn, *point));
    to_origin(points)
}

/// Moves points so that the lower left corner of their bounding rectangle is at the origin. Returns its size.
pub(super) fn to_origin(points: &mut [DVec2]) -> DVec2 {
    let (low, high) = extent(points.iter().copied());
    points.iter_mut().for_each(|point| *point -= low);
    high - low
}

fn extent(points: impl Iterator<Item = DVec2>) -> (DVec2, DVec2) {
    let everything = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    points.fold(everything, |(low, high), point| (low.min(point), high.max(point)))
}

/// The size of the rectangle with a side along this unit vector.
fn size_along(hull: &[DVec2], side: DVec2) -> DVec2 {
    let (low, high) = extent(hull.iter().map(|&point| times(conjugate(side), point)));
    high - low
}

/// The corners of the convex hull, counter-clockwise, decided without rounding; those of the points that lie on it
/// if it has no area.
fn convex_hull(points: &[DVec2]) -> Vec<DVec2> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    sorted.dedup();
    if sorted.len() < 3 {
        return sorted;
    }
    let mut hull: Vec<DVec2> = Vec::new();
    let mut half = |ordered: &mut dyn Iterator<Item = DVec2>| {
        let first = hull.len();
        for point in ordered {
            while let [.., a, b] = hull[first..]
                && orientation(a, b, point) != Orientation::CounterClockwise
            {
                hull.pop();
            }
            hull.push(point);
        }
        // It begins the other half.
        hull.pop();
    };
    half(&mut sorted.iter().copied());
    half(&mut sorted.iter().rev().copied());
    hull
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// No rectangle at any of a thousand angles is smaller, the points stay congruent, and all lie within.
        #[test]
        fn no_other_rectangle_is_smaller(
            points in prop::collection::vec((-1.0f64..1.0, -1.0f64..1.0), 2..30),
        ) {
            let points: Vec<DVec2> = points.into_iter().map(|(x, y)| DVec2::new(x, y)).collect();
            let mut turned = points.clone();
            let size = turn_upright(&mut turned);
            prop_assert!(size.x <= size.y * (1.0 + 1e-12) + 1e-12, "{}", size);
            for step in 0..1000 {
                let (sin, cos) = trigon_math::elementary::sin_cos(f64::from(step) * 0.0015708);
                let other = size_along(&points, DVec2::new(cos, sin));
                prop_assert!(size.x * size.y <= other.x * other.y + 1e-12, "{} for {}", size, other);
            }
            for (i, a) in points.iter().enumerate() {
                let before = a.distance(points[0]);
                prop_assert!((turned[i].distance(turned[0]) - before).abs() < 1e-12);
                prop_assert!(turned[i].cmpge(DVec2::splat(-1e-12)).all() && turned[i].cmple(size + 1e-12).all());
            }
        }
    }
}
