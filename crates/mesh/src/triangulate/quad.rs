//! Quads, the most frequent polygon: two triangles without any search.

use trigon_math::{DVec3, Vec3};

use super::ears::turn;
use super::project::{View, plane};

/// The second diagonal is taken only if its square is smaller by this factor.
/// Squares on a curved surface have diagonals that differ by rounding; without
/// this their triangles would lie this way and that.
const CLEARLY_SHORTER: f64 = 0.9999;

/// Cuts a quad. `None` where three corners are in one line, or where rounding makes it doubtful from which side the
/// quad is seen: then the general way decides.
pub(super) fn split(corners: [Vec3; 4]) -> Option<&'static [[u32; 3]]> {
    let [a, b, c, d] = corners.map(|p| p.as_dvec3());
    let view = View::against((c - a).cross(d - b));
    let [pa, pb, pc, pd] = [a, b, c, d].map(|p| plane(p, view));
    // At a, b, c and d.
    let turns = [turn(pd, pa, pb), turn(pa, pb, pc), turn(pb, pc, pd), turn(pc, pd, pa)];
    let [at_a, at_b, at_c, at_d] = turns.map(|turn| turn > 0);
    match (at_b && at_d, at_a && at_c) {
        (false, false) => ear(corners, view, turns),
        (true, true) if is_clearly_shorter(d - b, c - a) => Some(&SECOND),
        (true, _) => Some(&FIRST),
        (false, true) => Some(&SECOND),
    }
}

const FIRST: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];
const SECOND: [[u32; 3]; 2] = [[0, 1, 3], [1, 2, 3]];

/// The corners' own triangles.
const EARS: [[u32; 3]; 4] = [[3, 0, 1], [0, 1, 2], [1, 2, 3], [2, 3, 0]];

/// What the general way makes of a quad that crosses itself, as many do whose vertex is dragged far: it cuts off the
/// first ear, and what is left turns right.
fn ear(corners: [Vec3; 4], view: View, turns: [i32; 4]) -> Option<&'static [[u32; 3]]> {
    let is_certain = !turns.contains(&0) && corners.iter().all(|corner| corner.is_finite());
    if !is_certain || View::of(&corners) != view {
        return None;
    }
    Some(turns.iter().position(|&turn| turn > 0).map_or(&[], |first| &EARS[first..=first]))
}

fn is_clearly_shorter(one: DVec3, other: DVec3) -> bool {
    one.length_squared() < CLEARLY_SHORTER * other.length_squared()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::Triangulator;
    use super::*;

    /// Many coordinates are equal, so that corners lie in one line or in one place.
    fn corner() -> impl Strategy<Value = Vec3> {
        let coordinate = prop_oneof![
            4 => (-3..=3_i8).prop_map(f32::from),
            2 => -3.0_f32..3.0,
            1 => (-3..=3_i8).prop_map(|value| f32::from(value) * 1e-20),
        ];
        [coordinate.clone(), coordinate.clone(), coordinate].prop_map(Vec3::from_array)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4 * ProptestConfig::default().cases))]

        #[test]
        fn quads_that_cross_themselves_are_cut_as_the_general_way_does(
            corners in [corner(), corner(), corner(), corner()],
            is_flat: bool,
        ) {
            let corners = corners.map(|corner| if is_flat { corner.with_z(0.0) } else { corner });
            let Some(cut) = split(corners).filter(|cut| cut.len() < 2) else { return Ok(()) };
            let mut expected = Vec::new();
            Triangulator::default().any(&corners, &mut expected);
            prop_assert_eq!(cut, expected);
        }
    }

    #[test]
    fn a_bow_tie_keeps_its_first_ear() {
        let corner = |x: f32, y: f32| Vec3::new(x, y, 0.0);
        let tie = [corner(0.0, 0.0), corner(3.0, 1.0), corner(3.0, 0.0), corner(0.0, 2.0)];
        for start in 0..4 {
            let mut corners = tie;
            corners.rotate_left(start);
            let cut = split(corners).expect("no three corners are in one line");
            assert_eq!(cut.len(), 1, "starting at corner {start}");
        }
    }
}
