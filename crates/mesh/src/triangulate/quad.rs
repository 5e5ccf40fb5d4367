//! Quads, the most frequent polygon: two triangles without any search.

use trigon_math::{DVec3, Vec3};

use super::ears::is_left_turn;
use super::project::{longest_axis, plane};

/// The second diagonal is taken only if its square is smaller by this factor.
/// Squares on a curved surface have diagonals that differ by rounding; without
/// this their triangles would lie this way and that.
const CLEARLY_SHORTER: f64 = 0.9999;

/// Cuts a quad whose corners all matter. None if neither diagonal leaves two
/// halves that face the same way; then the general way decides.
pub(super) fn split(corners: [Vec3; 4]) -> Option<[[u32; 3]; 2]> {
    let [a, b, c, d] = corners.map(|p| p.as_dvec3());
    let normal = (c - a).cross(d - b);
    let axis = longest_axis(normal);
    let swap = normal[axis] < 0.0;
    let [pa, pb, pc, pd] = [a, b, c, d].map(|p| plane(p, axis, swap));
    let first = is_left_turn(pa, pb, pc) && is_left_turn(pa, pc, pd);
    let second = is_left_turn(pa, pb, pd) && is_left_turn(pb, pc, pd);
    match (first, second) {
        (false, false) => None,
        (true, true) if is_clearly_shorter(d - b, c - a) => Some(SECOND),
        (true, _) => Some(FIRST),
        (false, true) => Some(SECOND),
    }
}

const FIRST: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];
const SECOND: [[u32; 3]; 2] = [[0, 1, 3], [1, 2, 3]];

fn is_clearly_shorter(one: DVec3, other: DVec3) -> bool {
    one.length_squared() < CLEARLY_SHORTER * other.length_squared()
}
