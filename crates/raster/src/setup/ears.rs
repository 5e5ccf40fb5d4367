//! Cuts the polygon that clipping and snapping left into triangles.
//!
//! Snapping can dent a convex polygon or fold a corner flat. A fixed fan would
//! then cover samples twice or leave some out; ears chosen by exact orientation
//! do not.

use trigon_math::{FixedPoint, orientation_fixed};

/// Twice the signed area of a closed polygon, exactly.
pub(crate) fn doubled_area(points: &[FixedPoint]) -> i64 {
    let Some((&first, rest)) = points.split_first() else {
        return 0;
    };
    rest.windows(2).map(|edge| orientation_fixed(first, edge[0], edge[1])).sum()
}

/// Calls `ear` with the indices of each triangle of the polygon, in the
/// polygon's own winding; together they cover it once. Triangles without area
/// are left out.
pub(crate) fn cut_ears(points: &[FixedPoint], mut ear: impl FnMut([usize; 3])) {
    let sign = doubled_area(points).signum();
    if sign == 0 {
        return;
    }
    let mut ring: Vec<usize> = (0..points.len()).collect();
    while ring.len() >= 3 {
        let Some(tip) = find_ear(points, &ring, sign) else {
            return;
        };
        let corners = corners_at(&ring, tip);
        if turn(points, corners) * sign > 0 {
            ear(corners);
        }
        ring.remove(tip);
    }
}

fn corners_at(ring: &[usize], tip: usize) -> [usize; 3] {
    let count = ring.len();
    [ring[(tip + count - 1) % count], ring[tip], ring[(tip + 1) % count]]
}

fn turn(points: &[FixedPoint], [a, b, c]: [usize; 3]) -> i64 {
    orientation_fixed(points[a], points[b], points[c]).signum()
}

/// A vertex that can be cut off: flat, or turning inwards with no other vertex
/// in its triangle. If rounding has folded the ring so that there is none, any
/// vertex that turns the right way.
fn find_ear(points: &[FixedPoint], ring: &[usize], sign: i64) -> Option<usize> {
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
fn strictly_inside(points: &[FixedPoint], [a, b, c]: [usize; 3], other: usize, sign: i64) -> bool {
    if [points[a], points[b], points[c]].contains(&points[other]) {
        return false;
    }
    turn(points, [a, b, other]) * sign > 0
        && turn(points, [b, c, other]) * sign > 0
        && turn(points, [c, a, other]) * sign >= 0
}

#[cfg(test)]
mod tests {
    use super::*;
    use trigon_math::Fixed;

    fn polygon(points: &[(i32, i32)]) -> Vec<FixedPoint> {
        let point = |&(x, y): &(i32, i32)| FixedPoint::new(Fixed::from_raw(x), Fixed::from_raw(y));
        points.iter().map(point).collect()
    }

    fn check(points: &[(i32, i32)], ears: usize) {
        for reversed in [false, true] {
            let mut points = polygon(points);
            if reversed {
                points.reverse();
            }
            let (mut area, mut count) = (0, 0);
            cut_ears(&points, |[a, b, c]| {
                area += orientation_fixed(points[a], points[b], points[c]);
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
