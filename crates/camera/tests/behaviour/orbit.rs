//! The orbit controller: no drift, no flip, no surprises.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use proptest::prelude::*;
use trigon_camera::{AxisView, Camera, Orbit, OrbitStyle, Projection, Projector, Viewport};
use trigon_math::{Bounds3, DVec2, DVec3};

const BOX: Bounds3 = Bounds3 { min: DVec3::splat(-1.0), max: DVec3::splat(1.0) };

fn difference(a: &Camera, b: &Camera) -> f64 {
    let q = (a.orientation.dot(b.orientation).abs() - 1.0).abs();
    a.position.distance(b.position).max(q)
}

#[test]
fn a_million_steps_round_return_to_the_start() {
    for style in [OrbitStyle::Turntable, OrbitStyle::Trackball] {
        let mut orbit = Orbit::new(DVec3::new(0.2, 1.0, -0.1));
        orbit.orbit(0.3, 0.4);
        orbit.set_style(style);
        let start = orbit.camera(&BOX);
        for _ in 0..1_000_000 {
            orbit.orbit(TAU / 1e6, 0.0);
        }
        let end = orbit.camera(&BOX);
        let length = (end.orientation.length() - 1.0).abs();
        assert!(length < 1e-12, "{style:?}: the quaternion's length is off by {length}");
        // Fixed-point angles lose nothing; the trackball rounds at every step.
        let tolerance = if style == OrbitStyle::Turntable { 1e-12 } else { 1e-9 };
        let miss = difference(&start, &end);
        assert!(miss < tolerance, "{style:?}: missed the start by {miss}");
    }
}

#[test]
fn undoing_a_drag_restores_the_bits() {
    let mut orbit = Orbit::new(DVec3::Y);
    orbit.orbit(0.1, 0.2);
    let start = orbit;
    let steps: Vec<_> = (0..100_000).map(|i| (f64::from(i % 97) * 1e-3, f64::from(i % 13) * 1e-6)).collect();
    steps.iter().for_each(|&(x, y)| orbit.orbit(x, y));
    steps.iter().rev().for_each(|&(x, y)| orbit.orbit(-x, -y));
    assert_eq!(orbit, start, "the same drag backwards ends where it began");
}

#[test]
fn dragging_over_the_pole_stops_there_and_never_flips() {
    let mut orbit = Orbit::new(DVec3::Y);
    let mut last = orbit.camera(&BOX);
    for _ in 0..400 {
        orbit.orbit(0.001, 0.01);
        let camera = orbit.camera(&BOX);
        assert!(camera.up().dot(last.up()) > 0.99, "up jumped from {} to {}", last.up(), camera.up());
        assert!(camera.up().y > -1e-12, "the camera is upside down: {}", camera.up());
        last = camera;
    }
    assert!(last.forward().distance(DVec3::NEG_Y) < 1e-12, "looks straight down");
    orbit.orbit(FRAC_PI_2, 0.0);
    let turned = orbit.camera(&BOX);
    let angle = last.up().dot(turned.up()).abs();
    assert!(angle < 1e-9, "at the pole the up axis still turns the view, by a quarter: {angle}");
}

#[test]
fn named_views_show_their_side_for_any_up() {
    // Up, right, front.
    let frames = [
        (DVec3::Y, DVec3::X, DVec3::Z),
        (DVec3::Z, DVec3::X, DVec3::NEG_Y),
        (DVec3::NEG_Y, DVec3::X, DVec3::NEG_Z),
        (DVec3::X, DVec3::Y, DVec3::NEG_Z),
        (DVec3::NEG_Z, DVec3::X, DVec3::Y),
    ];
    for (up, right, front) in frames {
        let mut orbit = Orbit::new(up * 3.0);
        for (view, eye, above) in [
            (AxisView::Front, front, up),
            (AxisView::Back, -front, up),
            (AxisView::Right, right, up),
            (AxisView::Left, -right, up),
            (AxisView::Top, up, -front),
            (AxisView::Bottom, -up, front),
        ] {
            orbit.roll(1.0);
            orbit.set_view(view);
            let camera = orbit.camera(&BOX);
            assert!(
                camera.position.normalize().distance(eye) < 1e-12,
                "{view:?}, up {up}: {}",
                camera.position
            );
            assert!(camera.up().distance(above) < 1e-12, "{view:?}, up {up}: above is {}", camera.up());
        }
        orbit.set_view(AxisView::Isometric);
        let eye = orbit.camera(&BOX).position.normalize();
        let same = [up, right, front].map(|axis| eye.dot(axis));
        assert!(same.iter().all(|c| (c - same[0]).abs() < 1e-12), "isometric sees all alike: {same:?}");
    }
}

#[test]
fn every_view_is_the_opposite_of_its_opposite() {
    for view in AxisView::ALL {
        assert_eq!(view.opposite().opposite(), view, "{view:?}");
    }
}

#[test]
fn directions_of_the_hand() {
    let mut orbit = Orbit::new(DVec3::Y);
    orbit.orbit(0.5, 0.0);
    assert!(orbit.camera(&BOX).position.x > 0.0, "right takes the eye to the right");
    orbit.orbit(0.0, 0.5);
    assert!(orbit.camera(&BOX).position.y > 0.0, "up takes it up");
    let mut orbit = Orbit::new(DVec3::Y);
    orbit.roll(FRAC_PI_2);
    assert!(orbit.camera(&BOX).up().distance(DVec3::NEG_X) < 1e-12, "roll is counter-clockwise");
    let mut orbit = Orbit::new(DVec3::Y);
    orbit.pan(2.0, 1.0);
    assert_eq!(orbit.target(), DVec3::new(2.0, 1.0, 0.0), "pan moves the target in the image's plane");
    orbit.zoom(2.0);
    assert_eq!(orbit.distance(), 2.5, "twice as large from half the distance");
}

#[test]
fn zooming_about_a_point_keeps_it_in_place() {
    let viewport = Viewport { width: 200, height: 100 };
    let point = DVec3::new(0.4, 0.3, -0.2);
    for parallel in [false, true] {
        let mut orbit = Orbit::new(DVec3::Y);
        orbit.set_view(AxisView::Isometric);
        if parallel {
            orbit.toggle_orthographic();
        }
        let before = Projector::new(&orbit.camera(&BOX), viewport).to_screen(point).expect("visible");
        orbit.zoom_about(point, 1.7);
        let after = Projector::new(&orbit.camera(&BOX), viewport).to_screen(point).expect("visible");
        assert!(before.distance(after) < 1e-9, "the point moved from {before} to {after}");
    }
}

#[test]
fn switching_to_orthographic_keeps_the_size_at_the_target() {
    let viewport = Viewport { width: 200, height: 100 };
    let mut orbit = Orbit::new(DVec3::Y);
    let at = |orbit: &Orbit| {
        Projector::new(&orbit.camera(&BOX), viewport).to_screen(DVec3::new(0.5, 0.5, 0.0)).expect("visible")
    };
    let before = at(&orbit);
    orbit.toggle_orthographic();
    assert!(orbit.camera(&BOX).projection.is_orthographic(), "lines of sight are parallel now");
    assert!(at(&orbit).distance(before) < 1e-9, "moved to {}", at(&orbit));
    orbit.zoom(2.0);
    let middle = DVec2::new(100.0, 50.0);
    let expected = middle + (before - middle) * 2.0;
    assert!(at(&orbit).distance(expected) < 1e-9, "zoom works there too: {}", at(&orbit));
}

proptest! {
    #[test]
    fn taking_over_from_a_camera_changes_nothing(
        position in prop::array::uniform3(-10.0f64..10.0),
        target in prop::array::uniform3(-10.0f64..10.0),
        roll in -PI..PI,
        up in prop::sample::select(vec![DVec3::Y, DVec3::Z, DVec3::NEG_X]),
        offset in 0.0f64..0.5,
    ) {
        let frustum = Projection::frustum(-0.1 + offset, 0.1 + offset, -0.1, 0.1, 0.1, None);
        let camera = Camera::look_at(position.into(), target.into(), DVec3::Y).with_projection(frustum.expect("valid"));
        let mut orbit = Orbit::from_camera(&camera, 4.0, up);
        orbit.roll(roll);
        orbit.roll(-roll);
        let miss = difference(&camera, &orbit.camera(&BOX));
        prop_assert!(miss < 1e-9, "moved by {miss}");
        orbit.set_style(OrbitStyle::Trackball);
        orbit.set_style(OrbitStyle::Turntable);
        let miss = difference(&camera, &orbit.camera(&BOX));
        prop_assert!(miss < 1e-9, "another style moved it by {miss}");
    }

    #[test]
    fn any_input_leaves_a_usable_camera(
        steps in prop::collection::vec((0u8..9, any::<f64>(), any::<f64>()), 1..60),
    ) {
        let mut orbit = Orbit::new(DVec3::Y);
        for (what, a, b) in steps {
            match what {
                0 => orbit.orbit(a, b),
                1 => orbit.roll(a),
                2 => orbit.zoom(a),
                3 => orbit.set_distance(a),
                4 => orbit.toggle_orthographic(),
                5 => orbit.set_up(DVec3::new(a, b, 0.0)),
                6 => orbit.set_style(OrbitStyle::Trackball),
                7 => orbit.set_style(OrbitStyle::Turntable),
                _ => orbit.look_along(DVec3::new(a, b, 1.0)),
            }
            let camera = orbit.camera(&BOX);
            prop_assert!((camera.orientation.length() - 1.0).abs() < 1e-12, "{orbit:?}");
            prop_assert!(camera.position.is_finite(), "{orbit:?}");
        }
    }
}

#[test]
fn an_orbit_tells_its_axis_and_the_height_of_its_window() {
    let mut orbit = Orbit::new(DVec3::new(0.0, 0.0, 3.0));
    assert!(orbit.up().distance(DVec3::Z) < 1e-12, "of unit length: {}", orbit.up());
    orbit.set_projection(Projection::perspective(FRAC_PI_2, 0.1, None).expect("valid"));
    orbit.set_distance(3.0);
    assert!((orbit.height_at_target() - 6.0).abs() < 1e-12, "45° up and down");
    // The distance at which the perspective shows as much as the parallel window.
    orbit.set_projection(Projection::orthographic(8.0, 0.1, 10.0).expect("valid"));
    assert!(orbit.is_orthographic() && (orbit.distance() - 4.0).abs() < 1e-12, "{}", orbit.distance());
}

#[test]
fn distances_that_are_not_positive_are_ignored() {
    let mut orbit = Orbit::new(DVec3::Y);
    for distance in [0.0, -0.0, -1.0, f64::NAN] {
        orbit.set_distance(distance);
        assert_eq!(orbit.distance(), 5.0, "{distance}");
    }
}

#[test]
fn fitting_looks_at_the_middle_and_fills_the_image() {
    let bounds = Bounds3 { min: DVec3::new(1.0, 2.0, 3.0), max: DVec3::new(3.0, 6.0, 3.0) };
    let mut orbit = Orbit::new(DVec3::Y);
    orbit.set_projection(Projection::perspective(FRAC_PI_2, 0.1, None).expect("valid"));
    orbit.fit(&bounds, 1.0, 0.0);
    assert_eq!(orbit.target(), DVec3::new(2.0, 4.0, 3.0), "the middle");
    // Half of the height of 4, seen from the front at 45°.
    assert!((orbit.distance() - 2.0).abs() < 1e-12, "{}", orbit.distance());
}

#[test]
fn a_trackball_turns_by_the_angle() {
    let mut orbit = Orbit::new(DVec3::Y);
    orbit.set_style(OrbitStyle::Trackball);
    orbit.orbit(FRAC_PI_2, 0.0);
    let forward = orbit.camera(&BOX).forward();
    assert!(forward.distance(DVec3::NEG_X) < 1e-12, "from the right side: {forward}");
    orbit.orbit(0.0, FRAC_PI_2);
    let forward = orbit.camera(&BOX).forward();
    assert!(forward.distance(DVec3::NEG_Y) < 1e-12, "from above: {forward}");
    orbit.orbit(f64::NAN, f64::INFINITY);
    assert_eq!(orbit.camera(&BOX).forward(), forward, "what is not finite turns nothing");
}
