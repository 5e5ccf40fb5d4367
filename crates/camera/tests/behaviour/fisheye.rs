//! Fisheye lenses against the formula that OpenCV's documentation publishes for `cv2.fisheye`.

#![expect(clippy::disallowed_methods, reason = "the platform's functions are the oracle here")]

use proptest::prelude::*;
use trigon_camera::{FisheyeCamera, FisheyeLens, PixelCenters, Viewport};
use trigon_math::{DQuat, DVec2, DVec3};

const IMAGE: Viewport = Viewport { width: 640, height: 480 };
const FOCAL: DVec2 = DVec2::new(190.0, 185.0);
const CENTER: DVec2 = DVec2::new(317.25, 243.5);

fn lens(distortion: [f64; 4]) -> FisheyeLens {
    FisheyeLens::new(FOCAL, CENTER, IMAGE, PixelCenters::AtIntegers, distortion).expect("valid")
}

/// OpenCV's documentation, "Fisheye camera model": X right, Y down, Z forward; the centre of the first pixel is (0, 0).
/// It takes the angle from a = x/z, b = y/z, and so only points ahead.
fn published([x, y, z]: [f64; 3], [k1, k2, k3, k4]: [f64; 4]) -> [f64; 2] {
    let (a, b) = (x / z, y / z);
    let r = (a * a + b * b).sqrt();
    let theta = r.atan();
    let theta_d =
        theta * (1.0 + k1 * theta.powi(2) + k2 * theta.powi(4) + k3 * theta.powi(6) + k4 * theta.powi(8));
    [theta_d / r * a * FOCAL.x + CENTER.x, theta_d / r * b * FOCAL.y + CENTER.y]
}

/// Coefficients of real lenses are of this size.
fn distortion() -> impl Strategy<Value = [f64; 4]> {
    [-0.05..0.05, -0.02..0.02, -0.005..0.005, -0.001..0.001]
}

proptest! {
    #[test]
    fn points_are_drawn_where_opencv_draws_them(
        [x, y] in [-3.0..3.0, -3.0..3.0], z in 0.05..4.0_f64, distortion in distortion(),
    ) {
        let lens = lens(distortion);
        let point = DVec3::new(x, -y, -z);
        if let Some(pixel) = lens.project(point) {
            // Ours has the centre of the first pixel at 0.5.
            let expected = published([x, y, z], distortion).map(|v| v + 0.5);
            prop_assert!((pixel - DVec2::from_array(expected)).length() < 1e-9, "{pixel}, not {expected:?}");
        } else {
            prop_assert!(DVec2::new(x, y).length().atan2(z) > lens.greatest_angle(), "the lens ends before");
        }
    }

    #[test]
    fn rays_meet_the_points_that_are_drawn_there(
        angle in 1e-6..3.1_f64, side in 0.0..std::f64::consts::TAU, distance in 1e-3..1e3, distortion in distortion(),
    ) {
        let lens = lens(distortion);
        let direction = DVec3::new(angle.sin() * side.cos(), angle.sin() * side.sin(), -angle.cos());
        prop_assume!(angle < lens.greatest_angle() - 1e-3);
        let pixel = lens.project(direction * distance).expect("within the lens");
        let ray = lens.ray(pixel).expect("within the image of the lens");
        // 1000 units in the last place: near the fold the inverse multiplies the error of d.
        prop_assert!((ray - direction).length() < 2e-13, "{ray}, not {direction}");
        prop_assert!((ray.length() - 1.0).abs() < 1e-15);
    }

    /// Central differences err by the square of their step, and by roundings divided by it.
    #[test]
    fn derivatives_are_what_small_steps_change(
        x in -200.0..200.0, y in -200.0..200.0, distortion in distortion(),
    ) {
        let lens = lens(distortion);
        let (pixel, step) = (CENTER + DVec2::new(x, y), 1e-4);
        let Some(ray) = lens.ray_with_steps(pixel) else { return Ok(()) };
        for (axis, expected) in [DVec2::X, DVec2::Y].into_iter().zip(ray.steps) {
            let [after, before] = [1.0, -1.0].map(|way| lens.ray(pixel + axis * step * way));
            let (Some(after), Some(before)) = (after, before) else { return Ok(()) };
            let found = (after - before) / (2.0 * step);
            prop_assert!((found - expected).length() < 1e-7 * (1.0 + expected.length()), "{found}, not {expected}");
        }
    }
}

#[test]
fn an_equidistant_lens_draws_angles_in_proportion() {
    let lens = lens([0.0; 4]);
    for degrees in [10.0_f64, 45.0, 90.0, 120.0, 179.0] {
        let angle = degrees.to_radians();
        let pixel = lens.project(DVec3::new(angle.sin(), 0.0, -angle.cos())).expect("it sees all around");
        let expected = CENTER + 0.5 + DVec2::X * FOCAL.x * angle;
        assert!((pixel - expected).length() < 1e-10, "{degrees}°: {pixel}, not {expected}");
    }
    assert_eq!(lens.project(DVec3::NEG_Z), Some(CENTER + 0.5), "ahead");
    assert_eq!(lens.project(DVec3::Z), None, "exactly behind has no side");
    assert_eq!(lens.project(DVec3::ZERO), None, "the eye");
    assert_eq!(lens.ray(CENTER + 0.5), Some(DVec3::NEG_Z), "the centre");
    let far = lens.project(DVec3::new(1e300, 0.0, -1e300)).expect("45°");
    assert!((far.x - (CENTER.x + 0.5 + FOCAL.x * std::f64::consts::FRAC_PI_4)).abs() < 1e-10, "{far}");
}

#[test]
fn a_lens_shows_nothing_beyond_its_field_of_view() {
    let lens = lens([0.0; 4]).with_fov(200_f64.to_radians()).expect("valid");
    let at = |degrees: f64| lens.ray(CENTER + 0.5 + DVec2::X * FOCAL.x * degrees.to_radians());
    assert!(at(99.9).is_some() && at(100.1).is_none(), "half of 200° to each side");
    for fov in [0.0, -1.0, 6.3, f64::NAN] {
        assert!(lens.with_fov(fov).is_err(), "{fov}");
    }
}

#[test]
fn invalid_lenses_are_errors() {
    let new = |focal, center, image, distortion| {
        FisheyeLens::new(focal, center, image, PixelCenters::AtHalves, distortion)
    };
    assert!(new(DVec2::new(0.0, 1.0), CENTER, IMAGE, [0.0; 4]).is_err(), "no focal length");
    assert!(new(FOCAL, DVec2::NAN, IMAGE, [0.0; 4]).is_err(), "nowhere");
    assert!(new(FOCAL, CENTER, Viewport { width: 0, height: 5 }, [0.0; 4]).is_err(), "no image");
    assert!(new(FOCAL, CENTER, IMAGE, [0.0, f64::INFINITY, 0.0, 0.0]).is_err(), "no polynomial");
}

proptest! {
    /// Any bits: nothing panics, and no ray or pixel is NaN.
    #[test]
    fn lenses_of_any_numbers_are_safe(
        distortion in [any::<f64>(), any::<f64>(), any::<f64>(), any::<f64>()],
        focal in [any::<f64>(), any::<f64>()], pixel in [any::<f64>(), any::<f64>()],
        point in [any::<f64>(), any::<f64>(), any::<f64>()],
    ) {
        let [focal, pixel] = [focal, pixel].map(DVec2::from_array);
        let Ok(lens) = FisheyeLens::new(focal, CENTER, IMAGE, PixelCenters::AtHalves, distortion) else { return Ok(()) };
        prop_assert!((0.0..=std::f64::consts::PI).contains(&lens.greatest_angle()));
        prop_assert!(lens.ray(pixel).is_none_or(|ray| !ray.is_nan()));
        prop_assert!(lens.project(DVec3::from_array(point)).is_none_or(|pixel| !pixel.is_nan()));
    }
}

#[test]
fn an_image_of_another_size_shows_the_same_view() {
    let orientation = DQuat::from_rotation_y(0.7);
    let camera =
        FisheyeCamera { position: DVec3::new(1.0, 2.0, 3.0), orientation, lens: lens([0.01, 0.0, 0.0, 0.0]) };
    let point = DVec3::new(-1.0, 2.5, 1.0);
    let pixel = camera.project(point, IMAGE).expect("ahead");
    let small = Viewport { width: 320, height: 240 };
    let half = camera.project(point, small).expect("ahead");
    assert!((half - pixel * 0.5).length() < 1e-10, "{half}, not half of {pixel}");
    let ray = camera.ray(half, small).expect("within");
    assert!((ray.at(point.distance(camera.position)) - point).length() < 1e-12, "through the point");
}
