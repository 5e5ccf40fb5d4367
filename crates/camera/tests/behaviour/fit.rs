//! Fitting: the whole model is in the image, with the margin asked for.

use proptest::prelude::*;
use trigon_camera::{Camera, PixelCenters, Projection, Projector, Viewport};
use trigon_math::{Bounds3, DVec2, DVec3, elementary};

const IMAGE: Viewport = Viewport { width: 300, height: 200 };

fn corners(bounds: &Bounds3) -> impl Iterator<Item = DVec3> {
    let (a, b) = (bounds.min, bounds.max);
    (0..8)
        .map(move |i| DVec3::select(trigon_math::glam::BVec3::new(i & 1 == 0, i & 2 == 0, i & 4 == 0), a, b))
}

/// Fits, and asserts that every corner is inside the margin and between the
/// planes. Returns the greatest distance from the middle, 1 at the margin.
fn check(projection: Projection, bounds: &Bounds3, direction: DVec3, margin: f64) -> f64 {
    let camera = Camera::default().with_projection(projection);
    let camera = camera.fit(bounds, direction, DVec3::Y, IMAGE.aspect(), margin);
    let projector = Projector::new(&camera, IMAGE);
    // The eye is rounded to the grid of f64 where it stands.
    let grid = camera.position.length() * f64::EPSILON / (bounds.max - bounds.min).length();
    let mut reach: f64 = 0.0;
    for corner in corners(bounds) {
        let (screen, depth) = projector.to_screen_and_depth(corner).expect("before the eye");
        let ndc = IMAGE.to_ndc(screen).abs() / (1.0 - margin);
        assert!(
            ndc.max_element() < 1.0 + 1e-9 + 4.0 * grid,
            "corner {corner} is at {ndc}, beyond the margin"
        );
        assert!((0.0..=1.0).contains(&depth), "corner {corner} has depth {depth}");
        reach = reach.max(ndc.max_element());
    }
    reach
}

fn projections() -> [Projection; 5] {
    let k = Projection::pinhole(
        DVec2::new(250.0, 260.0),
        DVec2::new(170.0, 80.0),
        IMAGE,
        PixelCenters::AtHalves,
        0.1,
    );
    [
        Projection::default(),
        Projection::perspective(2.0, 0.1, Some(100.0)).expect("valid"),
        Projection::orthographic(1.0, 0.1, 100.0).expect("valid"),
        Projection::frustum(-0.02, 0.1, -0.05, 0.03, 0.1, None).expect("valid"),
        k.expect("valid"),
    ]
}

proptest! {
    #[test]
    fn the_whole_box_is_in_the_image(
        which in 0usize..5,
        size in prop::array::uniform3(0.01f64..1.0),
        exponent in -6i32..=20,
        offset in prop::array::uniform3(-1.0f64..1.0),
        direction in prop::array::uniform3(-1.0f64..1.0),
        margin in 0.0f64..0.5,
    ) {
        let scale = elementary::pow(10.0, f64::from(exponent));
        let center = DVec3::from(offset) * scale * 10.0;
        let half = DVec3::from(size) * scale;
        let bounds = Bounds3 { min: center - half, max: center + half };
        let reach = check(projections()[which], &bounds, DVec3::from(direction), margin);
        // Only the clearance of very wide views may leave more room than asked for.
        prop_assert!(reach > 0.999 || which == 1, "the box reaches only {reach} of the margin");
    }
}

proptest! {
    /// A model's own points fill the image, where its box would leave room.
    #[test]
    fn points_fill_the_image_up_to_the_margin(
        which in 0usize..5,
        points in prop::collection::vec(prop::array::uniform3(-1.0f64..1.0), 2..40),
        direction in prop::array::uniform3(-1.0f64..1.0),
        margin in 0.0f64..0.5,
    ) {
        let points: Vec<DVec3> = points.into_iter().map(DVec3::from).collect();
        let camera = Camera::default().with_projection(projections()[which]);
        let aspect = IMAGE.aspect();
        let camera = camera.fit_points(&points, DVec3::from(direction), DVec3::Y, aspect, margin);
        let projector = Projector::new(&camera, IMAGE);
        let mut reach: f64 = 0.0;
        for &point in &points {
            let screen = projector.to_screen(point).expect("before the eye");
            reach = reach.max((IMAGE.to_ndc(screen).abs() / (1.0 - margin)).max_element());
        }
        prop_assert!(reach < 1.0 + 1e-9, "a point is at {} of the margin", reach);
        // Points nearly in line with the eye may leave it close enough to be held
        // off by its clearance.
        let bounds = Bounds3::from_points(points.iter().copied());
        let middle = bounds.min.midpoint(bounds.max);
        let off = |point: &DVec3| (*point - middle).reject_from(camera.forward()).length();
        let off = points.iter().map(off).fold(0.0, f64::max);
        prop_assert!(reach > 0.999 || which == 1 || off < 0.5, "the points reach only {}", reach);
    }
}

#[test]
fn tiny_models_far_from_the_origin_are_fitted() {
    let center = DVec3::new(1e7, -1e7, 1e7);
    let bounds = Bounds3 { min: center, max: center + DVec3::splat(1e-3) };
    for projection in projections() {
        check(projection, &bounds, DVec3::new(-1.0, -0.5, -1.0), 0.1);
    }
}

#[test]
fn bounds_without_size_have_a_camera() {
    let point = |p: DVec3| Bounds3 { min: p, max: p };
    let line = Bounds3 { min: DVec3::new(0.0, 0.0, -1.0), max: DVec3::new(0.0, 0.0, 1.0) };
    let nan = Bounds3 { min: DVec3::NAN, max: DVec3::ONE };
    let infinite = Bounds3 { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY };
    let all = [
        point(DVec3::ZERO),
        point(DVec3::splat(1e7)),
        point(DVec3::splat(1e20)),
        line,
        Bounds3::EMPTY,
        nan,
        infinite,
    ];
    for bounds in all {
        for projection in projections() {
            for direction in [DVec3::NEG_Z, DVec3::NEG_Y, DVec3::ZERO, DVec3::NAN] {
                let camera = Camera::default().with_projection(projection);
                let camera = camera.fit(&bounds, direction, DVec3::Y, IMAGE.aspect(), 0.1);
                let middle = if bounds.min.is_finite() && bounds.max.is_finite() && bounds != Bounds3::EMPTY {
                    (bounds.min + bounds.max) * 0.5
                } else {
                    DVec3::ZERO
                };
                assert_ne!(camera.position, middle, "{bounds:?}: the eye is in the model");
                let (screen, depth) = Projector::new(&camera, IMAGE)
                    .to_screen_and_depth(middle)
                    .unwrap_or_else(|| panic!("{bounds:?} is behind the eye of {camera:?}"));
                assert!(screen.distance(DVec2::new(150.0, 100.0)) < 1.0, "{bounds:?} is at {screen}");
                assert!((0.0..=1.0).contains(&depth), "{bounds:?} has depth {depth}");
            }
        }
    }
}

#[test]
fn planes_follow_a_camera_inside_the_bounds() {
    let bounds = Bounds3 { min: DVec3::splat(-1.0), max: DVec3::splat(1.0) };
    let inside = Camera::look_at(DVec3::ZERO, DVec3::X, DVec3::Y).with_clip_planes(&bounds);
    assert!(inside.projection.near() < 1e-20, "near plane at {}", inside.projection.near());
    let away = Camera::look_at(DVec3::X * 5.0, DVec3::X * 6.0, DVec3::Y).with_clip_planes(&bounds);
    assert!(away.projection.near() > 0.0, "a camera that looks away keeps a near plane");
}

/// Seen along −z from a height of ten: a cube from 9 to 11, a square, and a cube so far away that its own size is
/// below the rounding of distances.
#[test]
fn planes_keep_a_hundredth_of_the_bounds_away_from_them() {
    let square = Bounds3 { min: DVec3::new(-1.0, -1.0, 0.0), max: DVec3::new(1.0, 1.0, 0.0) };
    let cube = |z: f64| Bounds3 { min: DVec3::new(-1.0, -1.0, z - 1.0), max: DVec3::new(1.0, 1.0, z + 1.0) };
    // A hundredth of the depth and of half of the diagonal, and a milliardth of the distance.
    let of_cube = 0.02 + 0.01 * 3f64.sqrt();
    let cases = [
        (square, 10.0, 10.0, 0.01 * 2f64.sqrt() + 1e-8),
        (cube(0.0), 9.0, 11.0, of_cube + 1.1e-8),
        (cube(10.0 - 1e9), 1e9 - 1.0, 1e9 + 1.0, of_cube + 1.0),
    ];
    let camera = Camera::look_at(DVec3::Z * 10.0, DVec3::ZERO, DVec3::Y);
    let perspective = Projection::perspective(1.0, 0.1, Some(5.0)).expect("valid");
    let parallel = Projection::orthographic(3.0, 0.1, 5.0).expect("valid");
    for (bounds, nearest, farthest, room) in cases {
        for projection in [perspective, parallel] {
            let projection = camera.with_projection(projection).with_clip_planes(&bounds).projection;
            let (near, far) = (projection.near(), projection.far().expect("it stays finite"));
            assert!((near - (nearest - room)).abs() < 1e-6, "{near} instead of {nearest} - {room}");
            assert!((far - (farthest + room)).abs() < 1e-6, "{far} instead of {farthest} + {room}");
        }
    }
    let inside = camera.with_projection(perspective).with_clip_planes(&cube(10.0)).projection;
    assert!((0.0..1e-20).contains(&inside.near()), "right before the eye: {}", inside.near());
    let infinite = Projection::perspective(1.0, 0.1, None).expect("valid");
    assert_eq!(
        camera.with_projection(infinite).with_clip_planes(&square).projection.far(),
        None,
        "it stays infinite"
    );
}

/// A ball of 1 m, 2 m ahead of the eye, and a moon at 400 km: the near plane was 4 m away.
#[test]
fn planes_are_usable_and_cut_nothing_in_front_of_an_eye_within_bounds_of_any_size() {
    for exponent in -20..=40 {
        let reach = elementary::pow(10.0, f64::from(exponent));
        let bounds = Bounds3 { min: DVec3::splat(-reach), max: DVec3::splat(reach) };
        let finite = Projection::perspective(1.0, 0.1, Some(5.0)).expect("valid");
        for projection in [Projection::default(), finite] {
            let camera = Camera::look_at(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y).with_projection(projection);
            let projection = camera.with_clip_planes(&bounds).projection;
            let near = projection.near();
            // What the rasterizer does not draw, or next to nothing beside the bounds.
            assert!(near < 1e-24 || near < 1e-27 * reach, "{near} in bounds of {reach}");
            // In f32 a depth anywhere in the bounds is a normal number, as is clip space's z.
            let depth = near / (2.0 * reach);
            assert!(
                [near, depth].iter().all(|&number| (number as f32).is_normal()) || reach > 1e37,
                "{near}"
            );
            assert_eq!(projection.far().is_some(), camera.projection.far().is_some(), "far stays as it is");
            assert!(
                projection.far().is_none_or(|far| far > reach && far > near),
                "behind all: {projection:?}"
            );
        }
    }
}

#[test]
fn room_for_more_moves_planes_apart_and_never_together() {
    let cube = |z: f64| Bounds3 { min: DVec3::new(-1.0, -1.0, z - 1.0), max: DVec3::new(1.0, 1.0, z + 1.0) };
    let perspective = Projection::perspective(1.0, 0.1, Some(5.0)).expect("valid");
    let parallel = Projection::orthographic(3.0, 0.1, 5.0).expect("valid");
    for projection in [perspective, parallel] {
        let camera = Camera::look_at(DVec3::Z * 10.0, DVec3::ZERO, DVec3::Y).with_projection(projection);
        let fitted = camera.with_clip_planes(&cube(0.0));
        assert_eq!(fitted.with_wider_clip_planes(&cube(0.0)), fitted, "it has room");
        let nearer = fitted.with_wider_clip_planes(&cube(4.0)).projection;
        assert!(nearer.near() < 5.0 && nearer.far() == fitted.projection.far(), "{nearer:?}");
        let farther = fitted.with_wider_clip_planes(&cube(-90.0)).projection;
        let far = farther.far().expect("it stays finite");
        assert!(far > 101.0 && farther.near() == fitted.projection.near(), "{farther:?}");
    }
}
