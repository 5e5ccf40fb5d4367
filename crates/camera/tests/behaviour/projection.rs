//! What each projection means, checked against its textbook formula.

use trigon_camera::{Camera, CameraAxes, CameraError, PixelCenters, Projection, Projector, Viewport};
use trigon_math::{DAffine3, DMat3, DQuat, DVec2, DVec3};

const IMAGE: Viewport = Viewport { width: 640, height: 480 };

fn projector(projection: Projection) -> Projector {
    Projector::new(&Camera::default().with_projection(projection), IMAGE)
}

fn assert_near(actual: DVec2, expected: DVec2, why: &str) {
    assert!(actual.distance(expected) < 1e-9, "{why}: {actual} instead of {expected}");
}

#[test]
fn corners_of_a_frustum_are_corners_of_the_image() {
    let frustum = Projection::frustum_from_corners(DVec3::new(0.5, -2.0, 1.0), DVec3::new(3.0, -1.0, 10.0))
        .expect("an ordinary off-centre frustum");
    let projector = projector(frustum);
    let at =
        |x: f64, y: f64, z: f64| projector.to_screen_and_depth(DVec3::new(x, y, -z)).expect("before the eye");
    let (screen, depth) = at(0.5, -2.0, 1.0);
    assert_near(screen, DVec2::new(0.0, 480.0), "(l, b, n) is the lower left corner");
    assert!((depth - 1.0).abs() < 1e-12, "near is depth 1, not {depth}");
    let (screen, depth) = at(30.0, -10.0, 10.0);
    assert_near(screen, DVec2::new(640.0, 0.0), "(r, t) seen at f is the upper right corner");
    assert!(depth.abs() < 1e-12, "far is depth 0, not {depth}");
}

#[test]
fn one_point_perspective_divides_by_one_plus_z_over_f() {
    let (focal_length, height) = (4.0, 3.0);
    let one_point = Projection::one_point(focal_length, height, 0.1, None).expect("positive numbers");
    let projector = projector(one_point);
    let pixels_per_unit = 480.0 / height;
    for (x, y, z) in [(1.0, 0.5, 0.0), (1.0, 0.5, 4.0), (-2.0, 1.0, -3.0), (0.3, -0.7, 100.0)] {
        // The image plane is at distance F before the eye; z counts from it.
        let screen = projector.to_screen(DVec3::new(x, y, -(focal_length + z))).expect("before the eye");
        let r = 1.0 / focal_length;
        let flat = DVec2::new(x / (1.0 + r * z), -y / (1.0 + r * z));
        assert_near(screen, DVec2::new(320.0, 240.0) + flat * pixels_per_unit, "x / (1 + rz)");
    }
    // The switch to orthographic keeps what lies on the image plane.
    let parallel = one_point.to_orthographic(focal_length).expect("a positive distance");
    let Projection::Orthographic { height: shown, .. } = parallel else { panic!("not orthographic") };
    assert!((shown - height).abs() < 1e-12, "{shown} units are visible instead of {height}");
}

#[test]
fn pinhole_follows_computer_vision() {
    // An OpenCV pose: turned about x, y down, z forward.
    let (sin, cos) = (0.6, 0.8);
    let rotation = DMat3::from_cols(DVec3::X, DVec3::new(0.0, cos, sin), DVec3::new(0.0, -sin, cos));
    let pose = DAffine3 { matrix3: rotation, translation: DVec3::new(0.1, -0.2, 3.0) };
    let (focal, center) = (DVec2::new(500.0, 510.0), DVec2::new(310.0, 250.0));
    for (pixel_centers, offset) in [(PixelCenters::AtHalves, 0.0), (PixelCenters::AtIntegers, 0.5)] {
        let k = Projection::pinhole(focal, center, IMAGE, pixel_centers, 0.1).expect("a sound K");
        let camera = Camera::from_extrinsics(&pose, CameraAxes::OpenCv, k).expect("a rotation");
        let back = camera.extrinsics(CameraAxes::OpenCv);
        assert!(back.abs_diff_eq(pose, 1e-14), "and back: {back}");
        let point = DVec3::new(0.4, 0.3, -0.5);
        let p = pose.transform_point3(point);
        let uv = focal * DVec2::new(p.x / p.z, p.y / p.z) + center;
        let screen = Projector::new(&camera, IMAGE).to_screen(point).expect("before the eye");
        assert_near(screen, uv + DVec2::splat(offset), "u = fx X / Z + cx");
        let double = Viewport { width: 1280, height: 960 };
        let scaled = Projector::new(&camera, double).to_screen(point).expect("before the eye");
        assert_near(scaled, (uv + DVec2::splat(offset)) * 2.0, "a larger image shows the same view");
    }
}

/// Four kinds of matrices for one camera, each with its way back.
#[test]
fn poses_of_either_convention_are_one_camera() {
    let orientation = DQuat::from_xyzw(0.1, -0.5, 0.3, 0.8).normalize();
    let camera = Camera { position: DVec3::new(3.0, -2.0, 1e6), orientation, ..Camera::default() };
    for axes in [CameraAxes::OpenGl, CameraAxes::OpenCv] {
        let [pose, extrinsics] = [camera.pose(axes), camera.extrinsics(axes)];
        // 1e6 m leave 2⁻³³ m in f64.
        assert!((pose * extrinsics).abs_diff_eq(DAffine3::IDENTITY, 1e-9), "one is the inverse of the other");
        let ahead = if axes == CameraAxes::OpenGl { DVec3::NEG_Z } else { DVec3::Z };
        assert!(
            pose.transform_vector3(ahead).abs_diff_eq(camera.forward(), 1e-15),
            "{axes:?} looks along {ahead}"
        );
        for again in [
            Camera::from_pose(&pose, axes, camera.projection),
            Camera::from_extrinsics(&extrinsics, axes, camera.projection),
        ] {
            let again = again.expect("a rotation");
            assert!(again.position.abs_diff_eq(camera.position, 1e-9), "{axes:?}: at {}", again.position);
            let turn = again.orientation.dot(orientation).abs();
            assert!((turn - 1.0).abs() < 1e-15, "{axes:?}: turned by {turn}");
        }
    }
}

#[test]
fn rounded_rotations_are_made_exact_and_others_refused() {
    let exact = DMat3::from_quat(DQuat::from_xyzw(0.1, -0.5, 0.3, 0.8).normalize());
    let pose = |matrix3: DMat3| {
        let pose = DAffine3 { matrix3, translation: DVec3::ONE };
        Camera::from_pose(&pose, CameraAxes::OpenGl, Projection::default())
    };
    let digits = DMat3::from_cols_array(&exact.to_cols_array().map(|v| (v * 1e4).round() / 1e4));
    let rounded = pose(digits).expect("four digits are enough");
    let error = DMat3::from_quat(rounded.orientation) - exact;
    let error = error.to_cols_array().into_iter().map(f64::abs).fold(0.0, f64::max);
    assert!(error < 1e-4, "within the last digit, not {error}");
    for (matrix, word) in [
        (exact * 2.0, "lengths"),
        (DMat3::from_cols(exact.x_axis, exact.x_axis, exact.z_axis), "square"),
        (DMat3::from_cols(-exact.x_axis, exact.y_axis, exact.z_axis), "mirror"),
        (DMat3::from_cols(DVec3::NAN, exact.y_axis, exact.z_axis), "finite"),
    ] {
        let error = pose(matrix).expect_err("refused").to_string();
        assert!(error.contains(word), "{word}: {error}");
    }
}

#[test]
fn every_perspective_has_a_k_that_places_points_where_the_image_shows_them() {
    let offset = DVec2::new(300.0, 200.0);
    let perspectives = [
        Projection::perspective(1.0, 0.1, Some(50.0)).expect("valid"),
        Projection::frustum(-0.1, 0.3, -0.05, 0.2, 0.1, None).expect("valid"),
        Projection::pinhole(DVec2::new(400.0, 420.0), offset, IMAGE, PixelCenters::AtHalves, 0.1)
            .expect("valid"),
    ];
    for projection in perspectives {
        for (centers, shift) in [(PixelCenters::AtHalves, 0.0), (PixelCenters::AtIntegers, 0.5)] {
            let k = projection.intrinsics(IMAGE, centers).expect("a perspective");
            for point in [DVec3::new(0.3, 0.2, -4.0), DVec3::new(-0.1, 0.4, -1.5)] {
                let by_k = k.focal * DVec2::new(point.x, -point.y) / -point.z + k.center + shift;
                assert_near(
                    projector(projection).to_screen(point).expect("in front"),
                    by_k,
                    "u = fx X / Z + cx",
                );
            }
        }
    }
    let parallel = Projection::orthographic(4.0, 0.1, 50.0).expect("valid");
    assert_eq!(parallel.intrinsics(IMAGE, PixelCenters::AtHalves), None, "it has no focal length");
}

#[test]
fn vertical_field_of_view_reaches_the_upper_edge() {
    let quarter = Projection::perspective(std::f64::consts::FRAC_PI_2, 0.1, None).expect("90 degrees");
    let screen = projector(quarter).to_screen(DVec3::new(0.0, 7.0, -7.0)).expect("before the eye");
    assert_near(screen, DVec2::new(320.0, 0.0), "45 degrees up");
}

#[test]
fn other_planes_leave_the_image_as_it_is() {
    let center = DVec2::new(300.0, 200.0);
    let all = [
        Projection::perspective(1.0, 0.1, Some(50.0)).expect("valid"),
        Projection::orthographic(4.0, 0.1, 50.0).expect("valid"),
        Projection::frustum(-0.1, 0.3, 0.0, 0.2, 0.1, Some(50.0)).expect("valid"),
        Projection::pinhole(DVec2::splat(400.0), center, IMAGE, PixelCenters::AtHalves, 0.1).expect("valid"),
    ];
    let point = DVec3::new(0.3, 0.2, -4.0);
    for projection in all {
        let moved = projection.with_planes(2.0, Some(9.0)).expect("in order");
        let (before, after) = (projector(projection).to_screen(point), projector(moved).to_screen(point));
        assert_near(after.expect("visible"), before.expect("visible"), "planes only change depth");
        assert_eq!((moved.near(), moved.far()), (2.0, Some(9.0)), "the planes are those asked for");
    }
}

#[test]
fn constructors_refuse_and_name_the_number() {
    let nan = f64::NAN;
    let refused: [(Result<Projection, CameraError>, &str); 14] = [
        (Projection::perspective(0.0, 0.1, None), "field of view"),
        (Projection::perspective(std::f64::consts::PI, 0.1, None), "field of view"),
        (Projection::perspective(nan, 0.1, None), "field of view"),
        (Projection::perspective(1.0, 0.0, None), "near"),
        (Projection::perspective(1.0, nan, None), "near"),
        (Projection::perspective(1.0, 0.1, Some(0.1)), "far"),
        (Projection::perspective(1.0, 1.0, Some(f64::INFINITY)), "far"),
        (Projection::orthographic(-1.0, 0.0, 1.0), "height"),
        (Projection::orthographic(1.0, 2.0, 1.0), "far"),
        (Projection::frustum(1.0, 1.0, 0.0, 1.0, 0.1, None), "left"),
        (Projection::frustum(0.0, 1.0, 2.0, 1.0, 0.1, None), "bottom"),
        (Projection::one_point(0.0, 1.0, 0.1, None), "focal length"),
        (Projection::pinhole(DVec2::new(1.0, 0.0), DVec2::ZERO, IMAGE, PixelCenters::AtHalves, 0.1), "fy"),
        (
            Projection::pinhole(
                DVec2::ONE,
                DVec2::ZERO,
                Viewport { width: 0, height: 1 },
                PixelCenters::AtHalves,
                0.1,
            ),
            "width",
        ),
    ];
    for (result, name) in refused {
        let error = result.expect_err(name).to_string();
        assert!(error.contains(name), "{error:?} should name {name}");
    }
}

/// A window of 4 by 2 on the near plane at 0.5 is four times as large at a distance of 2.
#[test]
fn windows_grow_with_distance_and_keep_their_aspect() {
    let frustum = Projection::frustum(-1.0, 3.0, 0.0, 2.0, 0.5, None).expect("valid");
    assert_eq!((frustum.own_aspect(), frustum.height_at(2.0)), (Some(2.0), 8.0));
    // A tall pixel of 640 by 480: one metre at a distance of one is 400 pixels wide and 300 high.
    let focal = DVec2::new(400.0, 300.0);
    let center = DVec2::new(320.0, 240.0);
    let pinhole = Projection::pinhole(focal, center, IMAGE, PixelCenters::AtHalves, 0.1).expect("valid");
    assert_eq!((pinhole.own_aspect(), pinhole.height_at(2.0)), (Some(1.0), 3.2));
    let quarter = Projection::perspective(std::f64::consts::FRAC_PI_2, 0.1, None).expect("valid");
    assert!(
        quarter.own_aspect().is_none() && (quarter.height_at(3.0) - 6.0).abs() < 1e-12,
        "45° up and down"
    );
    let parallel = Projection::orthographic(5.0, 0.0, 1.0).expect("valid");
    assert_eq!((parallel.own_aspect(), parallel.height_at(7.0)), (None, 5.0), "at any distance");
}

#[test]
fn a_parallel_projection_takes_over_planes_or_a_far_one() {
    let quarter = |far| Projection::perspective(std::f64::consts::FRAC_PI_2, 0.5, far).expect("valid");
    let parallel = quarter(None).to_orthographic(2.0).expect("in range");
    assert_eq!((parallel.near(), parallel.far()), (0.5, Some(2.5e6)), "a million times as far");
    let parallel = quarter(Some(9.0)).to_orthographic(2.0).expect("in range");
    assert_eq!((parallel.near(), parallel.far()), (0.5, Some(9.0)), "kept");
}

#[test]
fn a_projector_has_the_camera_it_was_made_for() {
    let camera = Camera::look_at(DVec3::new(1.0, 2.0, 3.0), DVec3::ZERO, DVec3::Z);
    assert_eq!(Projector::new(&camera, IMAGE).camera(), &camera);
}

#[test]
fn an_image_without_area_counts_as_square() {
    for (width, height, aspect) in [(0, 0, 1.0), (0, 5, 1.0), (5, 0, 1.0), (3, 2, 1.5)] {
        assert_eq!(Viewport { width, height }.aspect(), aspect, "{width}×{height}");
    }
}
