//! Quads, the most frequent polygon: two triangles without any search.

use trigon_math::{AxisProjection, DVec3, Vec3};

use super::ears::turn;

/// The second diagonal is taken only if its square is smaller by this factor.
/// Squares on a curved surface have diagonals that differ by rounding; without
/// this their triangles would lie this way and that.
const CLEARLY_SHORTER: f64 = 0.9999;

/// How a quad is cut into triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum QuadCut {
    /// From the first corner to the third.
    First,
    /// From the second corner to the last.
    Second,
    /// Only the triangle of this corner and the two beside it is left, of a quad that crosses itself.
    Ear(u8),
}

impl QuadCut {
    /// The triangles, as indices of corners.
    pub(super) const fn triangles(self) -> &'static [[u32; 3]] {
        match self {
            Self::First => &[[0, 1, 2], [0, 2, 3]],
            Self::Second => &[[0, 1, 3], [1, 2, 3]],
            Self::Ear(0) => &[[3, 0, 1]],
            Self::Ear(1) => &[[0, 1, 2]],
            Self::Ear(2) => &[[1, 2, 3]],
            Self::Ear(_) => &[[2, 3, 0]],
        }
    }

    /// The cut of a quad that turns left at some corners and right at the others, and whose second diagonal is clearly
    /// shorter or not. Of one that crosses itself, as many do whose vertex is dragged far, this is what the general way
    /// finds, which cuts off the first ear; what is left turns right. `None` if it turns left nowhere.
    const fn of(left: [bool; 4], is_second_shorter: bool) -> Option<Self> {
        let [at_a, at_b, at_c, at_d] = left;
        match (at_b && at_d, at_a && at_c) {
            (true, true) if is_second_shorter => Some(Self::Second),
            (true, _) => Some(Self::First),
            (false, true) => Some(Self::Second),
            _ if at_a => Some(Self::Ear(0)),
            _ if at_b => Some(Self::Ear(1)),
            _ if at_c => Some(Self::Ear(2)),
            _ if at_d => Some(Self::Ear(3)),
            _ => None,
        }
    }
}

/// Cuts a quad. `None` where three corners of one that may cross itself are in one line, or where rounding makes it
/// doubtful from which side that is seen: then the general way decides.
pub(super) fn split(corners: [Vec3; 4]) -> Option<QuadCut> {
    let [a, b, c, d] = corners.map(|p| p.as_dvec3());
    let view = AxisProjection::against((c - a).cross(d - b));
    let [pa, pb, pc, pd] = [a, b, c, d].map(|p| view.project(p));
    // At a, b, c and d.
    let turns = [turn(pd, pa, pb), turn(pa, pb, pc), turn(pb, pc, pd), turn(pc, pd, pa)];
    let cut = QuadCut::of(turns.map(|turn| turn > 0), is_clearly_shorter(d - b, c - a))?;
    let is_certain = || !turns.contains(&0) && corners.iter().all(|corner| corner.is_finite());
    let is_sure = !matches!(cut, QuadCut::Ear(_)) || is_certain() && AxisProjection::of(&corners) == view;
    is_sure.then_some(cut)
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
            let Some(cut @ QuadCut::Ear(_)) = split(corners) else { return Ok(()) };
            let mut expected = Vec::new();
            Triangulator::default().any(&corners, &mut expected);
            prop_assert_eq!(cut.triangles(), expected);
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
            assert_eq!(cut.triangles().len(), 1, "starting at corner {start}");
        }
    }
}
