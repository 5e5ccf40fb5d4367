//! Points to pixels and back, held to what the geometry of a window at a distance says.

use proptest::prelude::*;
use trigon_camera::{Camera, PixelCenters, Projection, Projector, Viewport};
use trigon_math::{DVec2, DVec3};

const IMAGE: Viewport = Viewport { width: 640, height: 320 };

/// A projection, and where it shows what is to the right and above the line of sight at a distance.
struct Shown {
    projection: Projection,
    pixel: fn(DVec2, f64) -> DVec2,
    far: Option<f64>,
}

const NEAR: f64 = 0.25;

/// Pixels of a window whose sides are at these distances from its middle; all windows are twice as wide as high.
fn pixel(at: DVec2, left: f64, top: f64, height: f64) -> DVec2 {
    DVec2::new(at.x - left, top - at.y) / height * f64::from(IMAGE.height)
}

fn shown() -> [Shown; 6] {
    let quarter = |far| Projection::perspective(std::f64::consts::FRAC_PI_2, NEAR, far).expect("valid");
    // 45° up and down, and the window is as high as twice the distance.
    let in_quarter = |at: DVec2, distance: f64| pixel(at, -2.0 * distance, distance, 2.0 * distance);
    let oblique = |far| Projection::frustum(-0.5, 1.5, -0.75, 0.25, NEAR, far).expect("valid");
    let in_oblique = |at: DVec2, distance: f64| pixel(at / distance * NEAR, -0.5, 0.25, 1.0);
    let (focal, center) = (DVec2::new(400.0, 300.0), DVec2::new(320.0, 200.0));
    let pinhole = Projection::pinhole(focal, center, IMAGE, PixelCenters::AtHalves, NEAR).expect("valid");
    [
        Shown { projection: quarter(None), pixel: in_quarter, far: None },
        Shown { projection: quarter(Some(50.0)), pixel: in_quarter, far: Some(50.0) },
        Shown { projection: oblique(None), pixel: in_oblique, far: None },
        Shown { projection: oblique(Some(20.0)), pixel: in_oblique, far: Some(20.0) },
        Shown {
            projection: pinhole,
            pixel: |at, distance| {
                DVec2::new(320.0 + 400.0 * at.x / distance, 200.0 - 300.0 * at.y / distance)
            },
            far: None,
        },
        Shown {
            projection: Projection::orthographic(6.0, NEAR, 50.0).expect("valid"),
            pixel: |at, _| pixel(at, -6.0, 3.0, 6.0),
            far: Some(50.0),
        },
    ]
}

fn near(a: DVec3, b: DVec3) -> bool {
    a.distance(b) < 1e-9
}

/// A point in the world, and where it is across and along the line of sight.
struct At {
    point: DVec3,
    across: DVec2,
    distance: f64,
}

fn check(camera: &Camera, shown: &Shown, at: &At) {
    let At { point, across, distance } = *at;
    let what = format!("{:?}, {across} at {distance}", shown.projection);
    assert!(near(camera.to_camera(point), across.extend(-distance)), "{what}: to the camera");
    assert!(near(camera.to_world(across.extend(-distance)), point), "{what}: to the world");
    assert!(near(camera.view().transform_point3(point), across.extend(-distance)), "{what}: the view");
    let depth = match (shown.projection.is_orthographic(), shown.far) {
        (true, Some(far)) => (far - distance) / (far - NEAR),
        (false, Some(far)) => NEAR / distance * ((far - distance) / (far - NEAR)),
        (_, None) => NEAR / distance,
    };
    let expected = (shown.pixel)(across, distance);
    let projector = Projector::new(camera, IMAGE);
    assert_eq!((projector.viewport(), *projector.camera()), (IMAGE, *camera), "{what}");
    let screen = projector.to_screen(point).expect("before the eye");
    let found = projector.to_depth(point).expect("before the eye");
    assert!(screen.distance(expected) < 1e-7, "{what}: at {screen}, not {expected}");
    assert!((found - depth).abs() < 1e-9, "{what}: depth {found}, not {depth}");
    assert_eq!(projector.to_screen_and_depth(point), Some((screen, found)), "{what}: both at once");
    let clip = camera.view_projection(IMAGE.aspect()) * point.extend(1.0);
    let drawn = IMAGE.to_screen(clip.truncate().truncate() / clip.w);
    assert!(drawn.distance(expected) < 1e-7 && (clip.z / clip.w - depth).abs() < 1e-9, "{what}: {clip}");
    let again = projector.unproject(screen, found).expect("at a finite distance");
    assert!(again.distance(point) < 1e-6, "{what}: {again} instead of {point}");
    let again = projector.at_distance(screen, distance).expect("the image has an area");
    assert!(near(again, point), "{what}: {again} instead of {point}");
    check_ray(camera, &projector, at);
}

fn check_ray(camera: &Camera, projector: &Projector, at: &At) {
    let is_parallel = camera.projection.is_orthographic();
    let what = format!("{:?}", camera.projection);
    let screen = projector.to_screen(at.point).expect("before the eye");
    let ray = projector.ray(screen).expect("the image has an area");
    let way = at.point - ray.origin;
    assert!((ray.direction.length() - 1.0).abs() < 1e-12, "{what}: of unit length");
    assert!(near(way, ray.direction * way.length()), "{what}: the point is ahead on the ray");
    let from_eye = ray.origin - camera.position;
    let begins =
        if is_parallel { from_eye.dot(camera.forward()).abs() < 1e-9 } else { from_eye == DVec3::ZERO };
    assert!(begins, "{what}: the ray begins at the eye or in its plane, not at {}", ray.origin);
    let behind = camera.position - camera.forward() * at.distance;
    let seen = [projector.to_screen(behind).is_some(), projector.to_depth(behind).is_some()];
    assert_eq!(seen, [is_parallel; 2], "{what}: behind the eye");
    assert_eq!(projector.to_screen_and_depth(behind).is_some(), is_parallel, "{what}: behind the eye");
}

proptest! {
    #[test]
    fn points_are_where_the_window_shows_them(
        position in prop::array::uniform3(-10.0f64..10.0),
        direction in prop::array::uniform3(-1.0f64..1.0),
        above in prop::array::uniform3(-1.0f64..1.0),
        off in prop::array::uniform2(-5.0f64..5.0),
        distance in 0.1f64..20.0,
    ) {
        let (position, direction, above) = (DVec3::from(position), DVec3::from(direction), DVec3::from(above));
        let across = direction.cross(above);
        prop_assume!(across.length() > 0.01);
        let axes = [across.normalize(), across.cross(direction).normalize(), direction.normalize()];
        let camera = Camera::look_at(position, position + direction, above);
        let found = [camera.right(), camera.up(), camera.forward()];
        prop_assert!(found.iter().zip(axes).all(|(found, axis)| near(*found, axis)), "{found:?}, not {axes:?}");
        let point = position + axes[0] * off[0] + axes[1] * off[1] + axes[2] * distance;
        let at = At { point, across: off.into(), distance };
        for shown in shown() {
            check(&camera.with_projection(shown.projection), &shown, &at);
        }
    }
}

#[test]
fn nothing_is_at_infinity_or_in_an_image_without_area() {
    let camera = Camera::look_at(DVec3::Z, DVec3::ZERO, DVec3::Y);
    for shown in shown() {
        let camera = camera.with_projection(shown.projection);
        let projector = Projector::new(&camera, IMAGE);
        let middle = DVec2::new(320.0, 160.0);
        // 0 is the depth of the far plane, or of infinity.
        let farthest = projector.unproject(middle, 0.0).map(|point| (1.0 - point.z).round());
        assert_eq!(farthest, shown.far, "{:?}", shown.projection);
        let nearest = projector.unproject(middle, 1.0).expect("the near plane");
        assert!((1.0 - nearest.z - NEAR).abs() < 1e-12, "{:?}: {nearest}", shown.projection);
        let nothing = Projector::new(&camera, Viewport { width: 0, height: 3 });
        assert!(nothing.at_distance(middle, 1.0).is_none() && nothing.unproject(middle, 0.5).is_none());
        assert!(nothing.ray(middle).is_none(), "no ray through a pixel that is not there");
    }
}

/// Up to a sine of 10⁻⁸, the upward direction does not define the roll.
#[test]
fn almost_parallel_to_up_is_as_parallel() {
    for (off, keeps_right) in [(0.0, true), (0.5e-8, true), (1e-8, true), (1.1e-8, false), (1e-3, false)] {
        // From above, to the left of the line straight down.
        let camera = Camera::look_at(DVec3::ZERO, DVec3::new(-off, -1.0, 0.0), DVec3::Y);
        let expected = if keeps_right { DVec3::X } else { DVec3::NEG_Z };
        assert!(camera.right().distance(expected) < 1e-7, "{off}: {}", camera.right());
    }
}
