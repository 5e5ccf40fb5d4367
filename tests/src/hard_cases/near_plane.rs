//! At the eye: corners on the near plane, about w = 0 and behind it, planes through
//! the eye, and walls a millionth away.

use super::against_rays::check;
use crate::coverage_support::{Values, count};
use crate::effort::cases;
use proptest::prelude::*;
use trigon_camera::Projection;
use trigon_math::{DVec3, DVec4, Vec4, elementary};
use trigon_study::oracle::ray::Tolerance;

/// Corners are snapped by at most 1/512 pixel on either axis. Those that are cut have
/// been rounded to f32 before, coordinate and w, each by 2^-24 of at most 32768
/// pixels, which is 1/512, too; and cut from coordinates of up to 1e3/1e-4 times w,
/// with 2^-44 of that (see `clipping::vertices`). Together, over both axes, less than
/// 1/120. Depths of at most 1 are rounded twice, and what `primitive/depth.rs` adds is less.
const TOLERANCE: Tolerance = Tolerance { outline: 1.0 / 120.0, depth: 1.0 / (1 << 22) as f64 };

/// Distances about the near plane, about zero, and on either side.
pub(super) fn distance(near: f32) -> impl Strategy<Value = f32> {
    let tiny = (-45..-1_i32, any::<bool>()).prop_map(|(exponent, behind)| {
        let size = elementary::pow(10.0, f64::from(exponent)) as f32;
        if behind { -size } else { size }
    });
    prop_oneof![
        2 => prop::sample::select(vec![near, near.next_up(), near.next_down()]),
        1 => prop::sample::select(vec![0.0, -0.0, f32::MIN_POSITIVE, -f32::MIN_POSITIVE]),
        2 => tiny,
        2 => -4.0_f32..0.0,
        4 => near * 1.5..near * 1.5 + 8.0,
    ]
}

/// A corner in an infinite perspective, about as far to the side as ahead, or
/// further by far.
fn corner(near: f32) -> impl Strategy<Value = Vec4> {
    let side = || prop_oneof![3 => -4.0_f32..4.0, 1 => -1e3_f32..1e3];
    (side(), side(), distance(near)).prop_map(move |(x, y, w)| Vec4::new(x, y, near, w))
}

fn triangle() -> impl Strategy<Value = [Vec4; 3]> {
    let near = prop::sample::select(vec![0.25_f32, 0.01, 1e-4]);
    near.prop_flat_map(|near| [corner(near), corner(near), corner(near)])
}

proptest! {
    #![proptest_config(cases(200))]

    /// Hard cases 17 and 18.
    #[test]
    fn corners_about_the_eye_draw_what_rays_meet(corners in triangle()) {
        check(corners, TOLERANCE);
    }

    /// Hard case 19: dividing by a negative w would bring these into the view.
    #[test]
    fn what_lies_behind_the_eye_is_not_drawn(
        places in [[-1.0_f32..1.0, -1.0..1.0], [-1.0..1.0, -1.0..1.0], [-1.0..1.0, -1.0..1.0]],
        w in [1e-30_f32..4.0, 1e-30..4.0, 1e-30..4.0],
        z in prop_oneof![Just(0.1_f32), Just(-0.1), Just(0.0), Just(-9.0)],
    ) {
        let corners = [0, 1, 2].map(|i| Vec4::new(places[i][0] * w[i], places[i][1] * w[i], z, -w[i]));
        let counts = count(&Values::ones(corners), &[[0, 1, 2]]);
        prop_assert!(counts.iter().all(|&count| count == 0), "nothing is behind the eye");
        // What lies before the eye in the same pixels is drawn: else this would hold of an engine that draws nothing.
        let before = [0, 1, 2].map(|i| {
            let ahead = w[i].max(0.01);
            Vec4::new(places[i][0] * ahead, places[i][1] * ahead, 0.5 * ahead, ahead)
        });
        check(before, TOLERANCE);
    }

    /// Edge on, nothing is seen but, by the rounding of its corners, what lies on the
    /// line that the plane is seen as. The corners are sums of two vectors with small
    /// whole factors, so that the plane goes exactly through the eye.
    #[test]
    fn a_plane_through_the_eye_is_no_more_than_its_line(
        [u, v] in [[-50..50_i16, -50..50, -50..50], [-50..50, -50..50, -50..50]],
        factors in [[-9..9_i16, -9..9], [-9..9, -9..9], [-9..9, -9..9]],
    ) {
        let at = |[s, t]: [i16; 2], axis: usize| f32::from(s * u[axis] + t * v[axis]);
        let corners = factors.map(|pair| Vec4::new(at(pair, 0), at(pair, 1), 0.25, at(pair, 2)));
        check(corners, TOLERANCE);
    }

    /// A wall 1e-6 before the eye, far larger than what is seen, at a slant of up to 74
    /// degrees: every pixel once, and as deep as it lies. In f32 its corners could not
    /// be told from the eye's plane if they were much further away than 0.1.
    #[test]
    fn a_wall_a_millionth_away_fills_the_image(
        angle in 0.01_f64..1.3,
        turn in 0.0_f64..7.0,
        size in 1e-4_f64..0.1,
        fov in 0.1_f64..0.3,
    ) {
        let projection = Projection::perspective(fov, 1e-7, None).expect("in range").matrix(1.0);
        let [(sine, cosine), (lean, upright)] = [turn, angle].map(elementary::sin_cos);
        let right = DVec3::new(cosine, sine, 0.0);
        let up = DVec3::new(-sine * upright, cosine * upright, lean);
        let corner = |x: f64, y: f64| -> DVec4 {
            projection * (DVec3::Z * -1e-6 + (right * x + up * y) * size).extend(1.0)
        };
        let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)].map(|v| v.as_vec4());
        let counts = count(&Values::ones(corners), &[[0, 1, 2], [0, 2, 3]]);
        prop_assert!(counts.iter().all(|&count| count == 1), "each pixel once");
        check([corners[0], corners[1], corners[2]], TOLERANCE);
        check([corners[0], corners[2], corners[3]], TOLERANCE);
    }
}
