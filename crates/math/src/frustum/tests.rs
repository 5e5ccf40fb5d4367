//! Culling against the clip inequalities in exact rationals.

use num_rational::BigRational;
use num_traits::{FromPrimitive, Signed};
use proptest::prelude::*;

use super::*;

/// A right-handed perspective with reversed depth, written out here so that the
/// test knows each entry: 90 degrees, square.
fn perspective(near: f64, far: Option<f64>) -> DMat4 {
    let (scale, offset) = match far {
        Some(far) => (near / (far - near), near * far / (far - near)),
        None => (0.0, near),
    };
    DMat4::from_cols(DVec4::X, DVec4::Y, DVec4::new(0.0, 0.0, scale, -1.0), DVec4::new(0.0, 0.0, offset, 0.0))
}

fn cube(center: DVec3, half: f64) -> Bounds3 {
    Bounds3::from_points([center - half, center + half])
}

#[test]
fn boxes_in_across_and_out_of_every_side() {
    let frustum = Frustum::from_clip_matrix(&perspective(1.0, Some(9.0)));
    let cases = [
        (DVec3::new(0.0, 0.0, -5.0), true, true),
        (DVec3::new(-5.0, 0.0, -5.0), false, true),
        (DVec3::new(5.0, 0.0, -5.0), false, true),
        (DVec3::new(0.0, -5.0, -5.0), false, true),
        (DVec3::new(0.0, 5.0, -5.0), false, true),
        (DVec3::new(0.0, 0.0, -1.0), false, true),
        (DVec3::new(0.0, 0.0, -9.0), false, true),
        (DVec3::new(-7.0, 0.0, -5.0), false, false),
        (DVec3::new(7.0, 0.0, -5.0), false, false),
        (DVec3::new(0.0, -7.0, -5.0), false, false),
        (DVec3::new(0.0, 7.0, -5.0), false, false),
        (DVec3::new(0.0, 0.0, 0.0), false, false),
        (DVec3::new(0.0, 0.0, -10.0), false, false),
        (DVec3::new(0.0, 0.0, 5.0), false, false),
    ];
    for (center, contained, intersecting) in cases {
        let bounds = cube(center, 0.5);
        assert_eq!(frustum.contains(&bounds), contained, "containing {center}");
        assert_eq!(frustum.intersects(&bounds), intersecting, "meeting {center}");
    }
}

#[test]
fn an_infinite_far_plane_cuts_nothing_off() {
    let frustum = Frustum::from_clip_matrix(&perspective(0.1, None));
    assert_eq!(frustum.plane(FrustumSide::Far), None, "no such plane");
    let far_away = cube(DVec3::new(0.0, 0.0, -1e12), 1.0);
    assert!(frustum.contains(&far_away), "still inside");
    assert!(!frustum.intersects(&cube(DVec3::Z * 1e12, 1.0)), "behind the eye");
}

#[test]
fn planes_have_unit_normals_inward() {
    let frustum = Frustum::from_clip_matrix(&perspective(1.0, Some(9.0)));
    let inside = DVec3::new(0.0, 0.0, -4.0);
    for side in FrustumSide::ALL {
        let plane = frustum.plane(side).unwrap();
        assert!((plane.normal().length() - 1.0).abs() < 1e-15, "{side:?} is scaled");
        assert!(plane.signed_distance(inside) > 1.0, "{side:?} points inward");
    }
    let near = frustum.plane(FrustumSide::Near).unwrap();
    assert!((near.signed_distance(inside) - 3.0).abs() < 1e-12, "three behind near");
}

#[test]
fn empty_and_unusable_boxes() {
    let frustum = Frustum::from_clip_matrix(&perspective(1.0, None));
    assert!(!frustum.intersects(&Bounds3::EMPTY), "nothing to see");
    assert!(frustum.contains(&Bounds3::EMPTY), "nothing outside");
    let everything = Bounds3 { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY };
    assert!(frustum.intersects(&everything), "the frustum is part of it");
    assert!(!frustum.contains(&everything), "and not all of it");
}

fn exact(value: f64) -> BigRational {
    BigRational::from_f64(value).unwrap()
}

/// The clip inequalities at a point, in exact arithmetic: the least of them.
fn exact_inside(matrix: &DMat4, point: DVec3) -> bool {
    let row = |index: usize| {
        let row = matrix.row(index);
        exact(row.x) * exact(point.x)
            + exact(row.y) * exact(point.y)
            + exact(row.z) * exact(point.z)
            + exact(row.w)
    };
    let [x, y, z, w] = [0, 1, 2, 3].map(row);
    x.abs() <= w && y.abs() <= w && !z.is_negative() && z <= w
}

fn vector(range: std::ops::Range<f64>) -> impl Strategy<Value = DVec3> {
    [range.clone(), range.clone(), range].prop_map(DVec3::from_array)
}

proptest! {
    /// Boxes of no size on a side (up to rounding) are where a wrong bound
    /// would show: `x = w` at depth `d` is the point `(d, y, -d)`.
    #[test]
    fn answers_are_proofs_in_exact_arithmetic(
        axis in vector(-1.0..1.0), angle in -4.0..4.0_f64, eye in vector(-1e3..1e3),
        depth in 0.5..50.0_f64, y in -1.0..1.0_f64, nudge in -4..=4_i64, size in prop_oneof![Just(0.0), 0.0..3.0_f64],
        far in prop_oneof![Just(None), Just(Some(40.0))],
    ) {
        let Some(axis) = axis.try_normalize() else { return Ok(()) };
        let view = DMat4::from_axis_angle(axis, angle) * DMat4::from_translation(-eye);
        let matrix = perspective(1.0, far) * view;
        let frustum = Frustum::from_clip_matrix(&matrix);
        let on_side = DVec3::new(depth * (1.0 + nudge as f64 * f64::EPSILON), y * depth, -depth);
        let point = view.inverse().transform_point3(on_side);
        let bounds = Bounds3::from_points([point, point - size]);
        let corners = bounds.corners().map(|corner| exact_inside(&matrix, corner));
        if frustum.contains(&bounds) {
            prop_assert!(corners.iter().all(|&inside| inside), "a corner is outside");
        }
        if !frustum.intersects(&bounds) {
            prop_assert!(!corners.iter().any(|&inside| inside), "a corner is inside");
        }
    }

    /// The proofs succeed a little away from the border, so they are of use.
    #[test]
    fn boxes_clear_of_the_border_are_decided(
        depth in 1.0..1e6_f64, x in -0.99..0.99_f64, y in -0.99..0.99_f64,
    ) {
        let frustum = Frustum::from_clip_matrix(&perspective(0.5, None));
        let inside = cube(DVec3::new(x * depth, y * depth, -depth), 1e-3);
        prop_assert!(frustum.contains(&inside));
        let outside = cube(DVec3::new(1.01 * depth, y * depth, -depth), 1e-3);
        prop_assert!(!frustum.intersects(&outside));
    }
}
