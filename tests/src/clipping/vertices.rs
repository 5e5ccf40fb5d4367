//! Every vertex that comes out: inside, convex weights, where its weights say.

use num_traits::{Signed, Zero};
use proptest::prelude::*;
use trigon_math::elementary::exp2;
use trigon_math::{ClipVertex, Vec4};

use super::{check, input};
use crate::effort::cases;
use trigon_study::oracle::area::rational;

/// The documented bound: `2⁻²²·m` for rounding position and weights to `f32`
/// (2⁻²⁴ of the position, three times 2⁻²⁵ of a corner) and `2⁻⁴⁴·(m + b·w)` for
/// the cuts in `f64`. One cut makes at most 16 roundings of 2⁻⁵³, relative to a
/// coordinate and the band times `w`; there are up to seven cuts.
pub(super) fn positions_follow_weights<const N: usize>(
    corners: [Vec4; N],
    planes: &input::Planes,
    vertices: &[ClipVertex<N>],
) {
    let band = f64::from(planes.horizontal.unwrap_or(1.0).max(planes.vertical.unwrap_or(1.0)));
    let largest = |axis: usize| {
        corners.iter().fold(0.0_f64, |largest, corner| largest.max(f64::from(corner[axis].abs())))
    };
    for vertex in vertices {
        for axis in 0..4 {
            let weighted = corners
                .iter()
                .zip(vertex.weights)
                .fold(num_rational::BigRational::zero(), |sum, (corner, weight)| {
                    sum + rational(corner[axis]) * rational(weight)
                });
            let bound = exp2(-22.0) * largest(axis)
                + exp2(-44.0) * (largest(axis) + band * largest(3))
                // Positions and weights below the normal range of f32.
                + exp2(-149.0) * (1.0 + largest(axis));
            let error = (rational(vertex.position[axis]) - weighted).abs();
            assert!(
                error <= rational(bound),
                "axis {axis} of {vertex:?} is not where its weights say; {corners:?}"
            );
        }
    }
}

/// Corners on the near plane, some `nudged` by it to one side, before the eye, in its
/// plane (where one nudge is far less than other corners are rounded by) and behind it;
/// some so near to the eye's plane that a cut between them and the others rounds by more
/// than they are off.
fn triangles_at_the_near_plane(nudged: fn(f32) -> f32) -> impl Strategy<Value = [Vec4; 3]> {
    let corner = move || {
        let tiny = (-4.0..4.0_f32, 1..120_u8).prop_map(|(w, e)| w * exp2(-f64::from(e)) as f32);
        let w = prop_oneof![3 => -4.0..4.0_f32, 1 => Just(0.0), 2 => tiny];
        (-4.0..4.0_f32, -4.0..4.0_f32, w, any::<bool>())
            .prop_map(move |(x, y, w, off)| Vec4::new(x, y, if off { nudged(w) } else { w }, w))
    };
    [corner(), corner(), corner()]
}

proptest! {
    #![proptest_config(cases(20_000))]

    #[test]
    fn vertices_are_inside_and_convex(triangle in input::triangle(), planes in input::planes()) {
        check::clip(triangle, &planes);
    }
}

proptest! {
    #![proptest_config(cases(1_000))]

    #[test]
    fn vertices_are_where_their_weights_say(triangle in input::triangle(), planes in input::planes()) {
        let polygon = check::clip(triangle, &planes);
        positions_follow_weights(triangle, &planes, polygon.vertices());
    }

    /// Hard case 23: what is equal at all corners is equal at all vertices.
    #[test]
    fn constant_coordinates_stay_constant(triangle in input::ordinary_triangle(), y in -0.5..0.5_f32) {
        let planes = input::Planes { vertical: None, ..input::Planes::VIEW };
        let flat = triangle.map(|corner| corner.with_y(y));
        for vertex in check::clip(flat, &planes).vertices() {
            prop_assert_eq!(vertex.position.y.to_bits(), y.to_bits());
        }
    }

    /// A plane that no corner is outside of must not be made to cut by the
    /// rounding of earlier cuts: neighbours which it does cut would disagree. No
    /// far plane here, as restoring the near side moves `z` by that rounding.
    #[test]
    fn a_plane_with_all_corners_inside_cuts_nothing(
        triangle in triangles_at_the_near_plane(f32::next_down), planes in input::planes(),
    ) {
        let [with, without] = [true, false].map(|near| {
            let polygon = check::clip(triangle, &input::Planes { near, far: false, ..planes });
            polygon.vertices().iter().map(|vertex| vertex.weights).collect::<Vec<_>>()
        });
        prop_assert_eq!(with, without);
    }

    /// Nor may rounding leave anything but the border where no corner is inside.
    #[test]
    fn a_plane_with_no_corner_inside_leaves_at_most_its_border(
        triangle in triangles_at_the_near_plane(f32::next_up), planes in input::planes(),
    ) {
        let polygon = check::clip(triangle, &input::Planes { near: true, far: false, ..planes });
        for vertex in polygon.vertices() {
            prop_assert_eq!(vertex.position.z, vertex.position.w);
        }
    }

    /// And it makes no vertex of its own there: what has no side of the border is kept or left
    /// out as it is.
    #[test]
    fn a_plane_with_no_corner_inside_makes_no_vertex(
        triangle in triangles_at_the_near_plane(f32::next_up), planes in input::planes(),
    ) {
        let [with, without] = [true, false].map(|near| {
            let planes = input::Planes { near, far: false, horizontal: None, vertical: None, ..planes };
            let polygon = check::clip(triangle, &planes);
            polygon.vertices().iter().map(|vertex| vertex.weights).collect::<Vec<_>>()
        });
        prop_assert!(with.iter().all(|weights| without.contains(weights)), "{:?} of {:?}", with, without);
    }

    /// Hard case 20.
    #[test]
    fn what_is_not_finite_is_dropped(
        triangle in input::triangle(), planes in input::planes(), corner in 0..3_usize, axis in 0..4_usize,
        bad in prop::sample::select(&[f32::NAN, f32::INFINITY, f32::NEG_INFINITY][..]),
    ) {
        let mut triangle = triangle;
        triangle[corner][axis] = bad;
        prop_assert!(trigon_math::clip_triangle(triangle, &planes.volume()).is_empty());
    }
}
