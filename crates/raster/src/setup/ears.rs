//! Cuts the polygon that is left after clipping and snapping into triangles.
//!
//! Snapping can make a convex polygon concave or fold a corner flat. A fixed fan would then cover samples twice or leave
//! some out. Ears that are chosen by exact orientation do not, unless the polygon crosses itself (see [`cut_ears`]).

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
/// polygon's own winding. Triangles without area are left out.
///
/// If the polygon does not cross itself, the triangles together cover it once. Snapping can make a
/// convex polygon cross itself where it is about a step wide or less: (0, 0), (109, 3.95), (110, 4),
/// (10, 3), for example. Then triangles may overlap or leave parts out.
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

/// A vertex that can be cut off: flat, which takes folded sides away first, or turning
/// inwards with no other vertex in its triangle. If rounding has folded the ring so that
/// there is none, any vertex that turns the right way.
fn find_ear(points: &[ScreenVertex], ring: &[usize], sign: i64) -> Option<usize> {
    let turn_at = |tip: usize| turn(points, corners_at(ring, tip)) * sign;
    let free = |&tip: &usize| {
        let corners = corners_at(ring, tip);
        turn_at(tip) > 0 && !ring.iter().any(|&other| strictly_inside(points, corners, other, sign))
    };
    let mut tips = 0..ring.len();
    let flat = tips.clone().find(|&tip| turn_at(tip) == 0);
    flat.or_else(|| tips.clone().find(free)).or_else(|| tips.find(|&tip| turn_at(tip) > 0))
}

/// Whether a point lies in the triangle, or on the edge that cutting it off
/// would make, and is none of its corners.
fn strictly_inside(points: &[ScreenVertex], [a, b, c]: [usize; 3], other: usize, sign: i64) -> bool {
    turn(points, [a, b, other]) * sign > 0
        && turn(points, [b, c, other]) * sign > 0
        && turn(points, [c, a, other]) * sign >= 0
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use trigon_math::{Fixed, FixedPoint};

    /// In 1/256 pixel.
    fn polygon(points: &[[i32; 2]]) -> Vec<ScreenVertex> {
        let vertex = |&[x, y]: &[i32; 2]| {
            ScreenVertex::new(FixedPoint::new(Fixed::from_raw(x), Fixed::from_raw(y)), 0.5, 1.0)
        };
        points.iter().map(vertex).collect()
    }

    /// Cuts a polygon with coordinates from -8 to 8, holds its ears against it, and tells
    /// how many there are.
    fn check(points: &[[i32; 2]]) -> usize {
        // Points of a polygon and probes lie at whole and at other multiples of half of it:
        // 2048 i + 1, 2048 j + 33. With whole steps dx and dy between two points, at most
        // 16, their line would hold a probe only if 33 dx - dy were a multiple of 2048.
        const STEP: i32 = 4096;
        let points = polygon(&points.iter().map(|point| point.map(|v| v * STEP)).collect::<Vec<_>>());
        let sign = doubled_area(&points).signum();
        let mut ears = Vec::new();
        cut_ears(&points, |ear| ears.push(ear));
        assert!(ears.iter().all(|&ear| turn(&points, ear) == sign), "ears are wound as their polygon");

        let probes = (-17..17).flat_map(|i| (-17..17).map(move |j| [i * STEP / 2 + 1, j * STEP / 2 + 33]));
        for probe in probes {
            let mut points = points.clone();
            points.extend(polygon(&[probe]));
            let probe = points.len() - 1;
            let around = |[a, b, c]: [usize; 3]| {
                let turns =
                    [[a, b, c], [a, b, probe], [b, c, probe], [c, a, probe]].map(|t| turn(&points, t));
                if turns == [turns[0]; 4] { turns[0] * sign } else { 0 }
            };
            let covered: i64 = ears.iter().copied().map(around).sum();
            let winding: i64 = (2..probe).map(|i| around([0, i - 1, i])).sum();
            assert_eq!(covered, winding, "ears around a point that a polygon runs round so often");
        }
        let area: i64 = ears.iter().map(|&ear| doubled(&points, ear)).sum();
        assert_eq!(area, doubled_area(&points), "ears add up to their polygon");
        ears.len()
    }

    fn both_ways(points: &[[i32; 2]]) -> [usize; 2] {
        let reversed: Vec<_> = points.iter().copied().rev().collect();
        [check(points), check(&reversed)]
    }

    #[test]
    fn convex_dented_and_flat_polygons() {
        let ears = |points: &[[i32; 2]], ears| assert_eq!(both_ways(points), [ears; 2], "{points:?}");
        ears(&[[0, 0], [8, 0], [8, 8], [0, 8]], 2);
        ears(&[[0, 0], [8, 0], [3, 3], [0, 8]], 2);
        ears(&[[0, 0], [5, 0], [8, 0], [8, 8], [8, 8], [0, 8]], 2);
        ears(&[[-8, 0], [4, 6], [-2, 3], [4, 6], [2, -5]], 1);
        ears(&[[-8, 0], [0, 0], [8, 0]], 0);
        ears(&[[0, 0], [4, 0]], 0);
    }

    /// An ear next to the end of a fold once covered what lies beside it, too.
    #[test]
    fn a_folded_side_covers_nothing() {
        assert_eq!(check(&[[-1, 0], [5, 5], [3, 1], [4, 3], [3, 1], [0, -6]]), 2, "of a quadrilateral");
    }

    /// No ear is free of others here.
    #[test]
    fn of_a_polygon_that_crosses_itself_something_is_left() {
        let points = polygon(&[[0, 1], [2, -11], [1, -6], [-1, 10], [-2, 11], [-2, 12]]);
        let mut count = 0;
        cut_ears(&points, |ear| {
            assert_eq!(turn(&points, ear), doubled_area(&points).signum(), "ears are wound as their polygon");
            count += 1;
        });
        assert_eq!(count, 1, "ears");
    }

    /// Polygons that do not cross themselves: all of their corners are seen from the
    /// origin, some are repeated, some sides folded.
    fn star() -> impl Strategy<Value = Vec<[i32; 2]>> {
        let corners = prop::collection::vec([-8..=8, -8..=8], 3..=MOST_VERTICES);
        let folds = prop::collection::vec((any::<prop::sample::Index>(), any::<bool>()), 0..3);
        (corners, folds, any::<prop::sample::Index>()).prop_filter_map(
            "a star",
            |(mut points, folds, first)| {
                let cross = |a: [i32; 2], b: [i32; 2]| a[0] * b[1] - a[1] * b[0];
                points.sort_by(|a, b| {
                    let half = |p: &[i32; 2]| (p[1], p[0]) < (0, 0);
                    half(a).cmp(&half(b)).then(0.cmp(&cross(*a, *b)))
                });
                points.dedup_by(|b, a| cross(*a, *b) == 0 && a[0] * b[0] + a[1] * b[1] > 0);
                let sees = |i: usize| cross(points[i], points[(i + 1) % points.len()]) > 0;
                if !(0..points.len()).all(sees) {
                    return None;
                }
                for (at, folds) in folds {
                    let (at, count) = (at.index(points.len()), points.len());
                    let (a, b) = (points[at], points[(at + 1) % count]);
                    let middle = [a[0] + b[0], a[1] + b[1]];
                    if folds && count + 2 <= MOST_VERTICES && middle.iter().all(|v| v % 2 == 0) {
                        points.splice(at..at, [a, middle.map(|v| v / 2)]);
                    } else if count < MOST_VERTICES {
                        points.insert(at, a);
                    }
                }
                let first = first.index(points.len());
                points.rotate_left(first);
                Some(points)
            },
        )
    }

    proptest! {
        #[test]
        fn ears_cover_a_polygon_once(points in star()) {
            both_ways(&points);
        }
    }
}
