//! Hard cases 9, 17, 18 and 19: `w` about zero, behind the eye, and huge.

use trigon_math::{Vec4, clip_triangle};

use super::check;
use super::input::Planes;

/// The guard band of a viewport of 1024 pixels, no far plane.
const GUARD: Planes =
    Planes { minimal_w: 1e-6, near: true, far: false, horizontal: Some(64.0), vertical: Some(64.0) };

const ABOUT_ZERO: [f32; 9] = [1e-4, 1e-10, 1e-38, 1e-45, 0.0, -0.0, -1e-45, -1e-38, -1e-4];

#[test]
fn w_about_zero_is_finite_and_continuous() {
    let clipped = |w: f32| {
        let apex = Vec4::new(1.0, 2.0, 0.0, w);
        let base = [Vec4::new(-1.0, -1.0, 0.5, 1.0), Vec4::new(1.0, -1.0, 0.5, 1.0)];
        let polygon = check::clip([base[0], base[1], apex], &GUARD);
        polygon.vertices().iter().map(|v| v.position).collect::<Vec<_>>()
    };
    let at_zero = clipped(0.0);
    assert_eq!(at_zero.len(), 4, "the apex is cut off");
    // By y = 64 w: at the share s of the way from (∓1, -1, 1/2, 1) to (1, 2, 0, 0), where -1 + 3 s = 64 - 64 s.
    let share = 65.0 / 67.0;
    for side in [-1.0, 1.0] {
        let exact = [side + (1.0 - side) * share, -1.0 + 3.0 * share, 0.5 - 0.5 * share, 1.0 - share];
        let is_there = |v: &Vec4| (0..4).all(|axis| (f64::from(v[axis]) - exact[axis]).abs() < 1e-7);
        assert!(at_zero.iter().any(is_there), "{exact:?} is none of {at_zero:?}");
    }
    for w in ABOUT_ZERO {
        let here = clipped(w);
        assert_eq!(here.len(), at_zero.len(), "w = {w:e}");
        for (vertex, expected) in here.iter().zip(&at_zero) {
            // The plane y = 64 w cuts both sides at the share 65 / (67 - 64 w) of their way to the
            // apex, which changes by 65 · 64 / 66.9² < 0.93 for each 1 of w; the way is 3 long
            // on its longest axis. Numbers below 2 round to f32 by 2⁻²⁴, here and there.
            let moved = (*vertex - *expected).abs().max_element();
            let bound = 3.0 * 0.93 * w.abs() + f32::EPSILON;
            assert!(moved <= bound, "w = {w:e} moves a vertex by {moved}");
        }
    }
}

#[test]
fn every_corner_may_have_w_about_zero() {
    for a in ABOUT_ZERO {
        for b in ABOUT_ZERO {
            for c in ABOUT_ZERO {
                let triangle = [
                    Vec4::new(-1.0, 0.5, 1e-6, a),
                    Vec4::new(1.0, 0.5, -1e-6, b),
                    Vec4::new(0.0, -1.0, 0.0, c),
                ];
                check::clip(triangle, &GUARD);
                check::clip(triangle, &Planes { minimal_w: f32::MIN_POSITIVE, ..GUARD });
            }
        }
    }
}

/// The ground under the camera reaches from behind the eye to far ahead: what is
/// left is below the horizon, which is at y = 0, and reaches the horizon's edge.
#[test]
fn ground_behind_the_eye_stays_below_the_horizon() {
    // An infinite reversed-Z perspective with near plane 0.1: clip z = 0.1,
    // clip w is the distance ahead, the ground is one below the eye.
    let ground = |x: f32, ahead: f32| Vec4::new(x, -1.0, 0.1, ahead);
    let (a, b) = (ground(-50.0, -100.0), ground(50.0, -100.0));
    let (c, d) = (ground(50.0, 100.0), ground(-50.0, 100.0));
    for triangle in [[a, b, c], [a, c, d]] {
        let polygon = check::clip(triangle, &GUARD);
        assert!(!polygon.is_empty(), "the ground is seen");
        let heights = polygon.vertices().iter().map(|v| v.position.y / v.position.w);
        let highest = heights.clone().fold(f32::NEG_INFINITY, f32::max);
        assert_eq!(highest, -0.01, "its far edge is 100 ahead");
        // Nearer than 0.1 ahead nothing is drawn: there y / w = -10.
        let lowest = heights.fold(f32::INFINITY, f32::min);
        assert_eq!(lowest, -10.0, "its near edge is at the near plane");
    }
}

/// Dividing by a negative `w` would bring these into the view.
#[test]
fn what_is_behind_the_eye_is_not_drawn() {
    for z in [0.5, -0.5, 0.0, -2.0] {
        let triangle = [(0.5, 0.5), (-0.5, 0.5), (0.0, -0.5)].map(|(x, y)| Vec4::new(x, y, z, -1.0));
        assert!(check::clip(triangle, &GUARD).is_empty(), "z = {z}");
        let planes = Planes { near: false, ..GUARD };
        assert!(check::clip(triangle, &planes).is_empty(), "z = {z}, no near plane");
    }
}

/// Edges of 2²³ pixels and more through a small window: the view's corners come
/// out exactly, and all of them.
#[test]
fn huge_triangles_cover_the_guard_band() {
    for size in [1e4, 1e8, 1e15, 1e30, f32::MAX / 4.0] {
        let triangle = [(-size, -size), (3.0 * size, -size), (-size, 3.0 * size)]
            .map(|(x, y)| Vec4::new(x, y, 0.5, 1.0));
        let polygon = clip_triangle(triangle, &GUARD.volume());
        let corners: Vec<_> = polygon.vertices().iter().map(|v| v.position).collect();
        for (x, y) in [(-64.0, -64.0), (64.0, -64.0), (64.0, 64.0), (-64.0, 64.0)] {
            let corner = Vec4::new(x, y, 0.5, 1.0);
            assert!(corners.contains(&corner), "size {size:e} misses {corner}: {corners:?}");
        }
    }
}
