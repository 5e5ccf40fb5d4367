//! Cuts the polygon that clipping and snapping left into triangles.
//!
//! Snapping can dent a convex polygon or fold a corner flat. A fixed fan would
//! then cover samples twice or leave some out; ears chosen by exact orientation
//! do not.

use crate::clip::MOST_VERTICES;
use crate::vertex::ScreenVertex;
use trigon_math::orientation_fixed;

/// Twice the signed area of a closed polygon, exactly.
pub(crate) fn doubled_area(points: &[ScreenVertex]) -> i64 {
    (2..points.len()).map(|i| doubled(points, [0, i - 1, i])).sum()
}

fn doubled(points: &[ScreenVertex], [a, b, c]: [usize; 3]) -> i64 {
    orientation_fixed(points[a].point(), points[b].point(), points[c].point())
}

/// Calls `ear` with the indices of each triangle of the polygon, in the
/// polygon's own winding; together they cover it once. Triangles without area
/// are left out.
pub(crate) fn cut_ears(points: &[ScreenVertex], mut ear: impl FnMut([usize; 3])) {
    let sign = doubled_area(points).signum();
    if sign == 0 {
        return;
    }
    let mut indices: [usize; MOST_VERTICES] = std::array::from_fn(|index| index);
    let mut ring = &mut indices[..points.len()];
    while ring.len() >= 3 {
        let Some(tip) = find_ear(points, ring, sign) else {
            return;
        };
        let corners = corners_at(ring, tip);
        if turn(points, corners) * sign > 0 {
            ear(corners);
        }
        ring.copy_within(tip + 1.., tip);
        let rest = ring.len() - 1;
        ring = &mut ring[..rest];
    }
}

fn corners_at(ring: &[usize], tip: usize) -> [usize; 3] {
    let count = ring.len();
    [ring[(tip + count - 1) % count], ring[tip], ring[(tip + 1) % count]]
}

fn turn(points: &[ScreenVertex], corners: [usize; 3]) -> i64 {
    doubled(points, corners).signum()
}

/// A vertex that can be cut off: flat, or turning inwards with no other vertex
/// in its triangle. If rounding has folded the ring so that there is none, any
/// vertex that turns the right way.
fn find_ear(points: &[ScreenVertex], ring: &[usize], sign: i64) -> Option<usize> {
    let turn_at = |tip: usize| turn(points, corners_at(ring, tip)) * sign;
    let free = |&tip: &usize| match turn_at(tip) {
        0 => true,
        1 => {
            let corners = corners_at(ring, tip);
            !ring.iter().any(|&other| strictly_inside(points, corners, other, sign))
        }
        _ => false,
    };
    (0..ring.len()).find(free).or_else(|| (0..ring.len()).find(|&tip| turn_at(tip) > 0))
}

/// Whether a point lies in the triangle, or on the edge that cutting it off
/// would make, and is none of its corners.
fn strictly_inside(points: &[ScreenVertex], [a, b, c]: [usize; 3], other: usize, sign: i64) -> bool {
    if [a, b, c].iter().any(|&corner| points[corner].raw() == points[other].raw()) {
        return false;
    }
    turn(points, [a, b, other]) * sign > 0
        && turn(points, [b, c, other]) * sign > 0
        && turn(points, [c, a, other]) * sign >= 0
}

#[cfg(test)]
mod tests {
    use super::*;
    use trigon_math::{Fixed, FixedPoint};

    fn polygon(points: &[(i32, i32)]) -> Vec<ScreenVertex> {
        let point = |&(x, y): &(i32, i32)| FixedPoint::new(Fixed::from_raw(x), Fixed::from_raw(y));
        points.iter().map(|p| ScreenVertex::new(point(p), 0.5, 1.0)).collect()
    }

    fn check(points: &[(i32, i32)], ears: usize) {
        for reversed in [false, true] {
            let mut points = polygon(points);
            if reversed {
                points.reverse();
            }
            let (mut area, mut count) = (0, 0);
            cut_ears(&points, |corners| {
                area += doubled(&points, corners);
                count += 1;
            });
            assert_eq!(area, doubled_area(&points), "the ears add up to the polygon");
            assert_eq!(count, ears, "number of ears");
        }
    }

    #[test]
    fn convex_dented_and_flat_polygons() {
        check(&[(0, 0), (9, 0), (9, 9), (0, 9)], 2);
        check(&[(0, 0), (9, 0), (3, 3), (0, 9)], 2);
        check(&[(0, 0), (5, 0), (9, 0), (9, 9), (9, 9), (0, 9)], 3);
        check(&[(0, 0), (9, 0), (20, 0)], 0);
        check(&[(0, 0), (4, 0)], 0);
    }
}
