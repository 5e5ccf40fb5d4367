//! Cameras: a point that is projected comes back from its pixel, within what
//! the rounding of each step allows, for every kind of projection; and there
//! is an answer where the input is degenerate.

use proptest::prelude::*;
use trigon_camera::{Camera, PixelCenters, Projection, Projector, Viewport, orientation_looking};
use trigon_math::{DMat3, DVec2, DVec3, elementary};

use crate::effort::cases;

const IMAGE: Viewport = Viewport { width: 1920, height: 1080 };

/// Rounding unit of f64.
const UNIT: f64 = f64::EPSILON / 2.0;

fn any_projection() -> impl Strategy<Value = Projection> {
    let near = -4i32..2;
    let far = prop::option::of(1.5f64..1e6);
    (0u8..4, near, far, prop::array::uniform4(0.1f64..1.0)).prop_map(|(kind, near, far, n)| {
        let near = elementary::pow(10.0, f64::from(near));
        let far = far.map(|ratio| near * ratio);
        let made = match kind {
            0 => Projection::perspective(3.0 * n[0], near, far),
            1 => Projection::orthographic(10.0 * n[0], -near, far.unwrap_or(1e3)),
            2 => {
                let (left, bottom) = (n[0] - 0.5, n[1] - 0.5);
                Projection::frustum(
                    left * near,
                    (left + n[2]) * near,
                    bottom * near,
                    (bottom + n[3]) * near,
                    near,
                    far,
                )
            }
            _ => {
                let (focal, center) = (DVec2::new(n[0], n[1]) * 2000.0, DVec2::new(n[2], n[3]) * 1080.0);
                Projection::pinhole(focal, center, IMAGE, PixelCenters::AtIntegers, near)
                    .and_then(|k| k.with_planes(near, far))
            }
        };
        made.expect("the ranges above are valid")
    })
}

fn any_point(size: f64) -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-size..size).prop_map(DVec3::from)
}

/// Scales and shifts of x and y, read off the matrix.
fn scale_and_shift(projection: &Projection) -> (DVec2, DVec2) {
    let matrix = projection.matrix(IMAGE.aspect());
    (DVec2::new(matrix.x_axis.x, matrix.y_axis.y), matrix.z_axis.truncate().truncate().abs())
}

/// The pixel and the depth of a point in the camera's space, by the definitions of the projections' fields.
fn by_definition(projection: &Projection, seen: DVec3) -> (DVec2, f64) {
    let (size, ahead) = (DVec2::new(1920.0, 1080.0), -seen.z);
    // From -1 to 1 over the window, y up.
    let in_window = |x: f64, y: f64| DVec2::new(1.0 + x, 1.0 - y) / 2.0 * size;
    let reversed = |near: f64, far: Option<f64>| match far {
        Some(far) => near * (far - ahead) / (ahead * (far - near)),
        None => near / ahead,
    };
    match *projection {
        Projection::Perspective { vertical_fov, near, far, .. } => {
            #[expect(
                clippy::disallowed_methods,
                reason = "of the oracle's own; its last bit is far below the bound"
            )]
            let half = (vertical_fov / 2.0).tan() * ahead;
            (in_window(seen.x / half * size.y / size.x, seen.y / half), reversed(near, far))
        }
        Projection::Orthographic { height, near, far, .. } => {
            let half = height / 2.0;
            (in_window(seen.x / half * size.y / size.x, seen.y / half), (far - ahead) / (far - near))
        }
        Projection::Frustum { left, right, bottom, top, near, far, .. } => {
            let at =
                |value: f64, low: f64, high: f64| 2.0 * (value * near / ahead - low) / (high - low) - 1.0;
            (in_window(at(seen.x, left, right), at(seen.y, bottom, top)), reversed(near, far))
        }
        Projection::Pinhole { focal, center, near, far, .. } => {
            (center + focal * DVec2::new(seen.x, -seen.y) / ahead, reversed(near, far))
        }
    }
}

/// How far a point may come back from where it started, in units of rounding.
///
/// - World to camera and back: a few roundings of the distance from the eye,
///   and one of the world coordinates themselves.
/// - x and y go through the screen, whose coordinates are rounded relative to
///   `1 + |ndc|`; a unit of device coordinates is `distance / scale` in the world.
/// - Depth: `near/d` is rounded relative to itself plus the constant that makes
///   it 0 at the far plane, which is `d / far` of it; a parallel projection
///   rounds relative to the planes. An error along the line of sight moves the
///   point by that times the slope of its ray.
fn round_trip_bound(camera: &Camera, point: DVec3) -> f64 {
    /// Roundings along the longest chain of operations there and back.
    const STEPS: f64 = 40.0;
    let (scale, shift) = scale_and_shift(&camera.projection);
    let seen = camera.to_camera(point);
    let (eye_distance, sight) = (seen.length(), seen.z.abs());
    let parallel = camera.projection.is_orthographic();
    let reach = if parallel { 1.0 } else { sight };
    let ndc = scale * seen.truncate().abs() / reach + shift;
    let across = (ndc + DVec2::ONE) * reach / scale;
    let far = camera.projection.far().unwrap_or(f64::INFINITY);
    let along = if parallel { far.abs() + sight } else { eye_distance * (1.0 + sight / far) };
    let world = point.length() + camera.position.length();
    STEPS * UNIT * (world + eye_distance + across.element_sum() + along)
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn a_projected_point_comes_back(
        projection in any_projection(),
        position in any_point(100.0),
        target in any_point(100.0),
        offset in prop::sample::select(vec![0.0, 1e7]),
        ahead in 0.001f64..0.999,
        across in prop::array::uniform2(-1.0f64..1.0),
    ) {
        let offset = DVec3::new(offset, -offset, offset);
        let camera = Camera::look_at(position + offset, target + offset, DVec3::Y).with_projection(projection);
        let projector = Projector::new(&camera, IMAGE);
        // A point of the visible space, between the planes.
        let (near, far) = (projection.near(), projection.far().unwrap_or(projection.near() * 1e4));
        let screen = (DVec2::from(across) * 0.5 + DVec2::splat(0.5)) * IMAGE.size();
        let point = projector.at_distance(screen, near + (far - near) * ahead).expect("the image has pixels");

        let (screen, depth) = projector.to_screen_and_depth(point).expect("before the eye");
        let back = projector.unproject(screen, depth).expect("before infinity");
        let (miss, bound) = (back.distance(point), round_trip_bound(&camera, point));
        prop_assert!(miss <= bound, "came back {miss} away, {bound} is allowed");

        let seen = camera.orientation.conjugate() * (point - camera.position);
        let (exact, exact_depth) = by_definition(&projection, seen);
        let reach = if projection.is_orthographic() { 1.0 } else { -seen.z };
        let pixels = bound / reach * scale_and_shift(&projection).0.max_element() * 1920.0 + 1e-9;
        prop_assert!((screen - exact).length() <= pixels, "at {screen}, not {exact}; {pixels} is allowed");
        // What moves it along the line of sight by the bound changes its depth by so much: of a parallel projection
        // everywhere the same, also behind the eye.
        let share = if projection.is_orthographic() {
            bound / (far - near) + 1e-14
        } else {
            bound / -seen.z * projection.far().map_or(1.0, |far| 1.0 + -seen.z / far) + 1e-14
        };
        prop_assert!((depth - exact_depth).abs() <= share * 2.0, "depth {depth}, not {exact_depth}");
        prop_assert_eq!(projector.to_screen(point), Some(screen));
        prop_assert_eq!(projector.to_depth(point), Some(depth));
        let ray = projector.ray(screen).expect("the image has pixels");
        let along = (point - ray.origin).dot(ray.direction);
        prop_assert!(ray.at(along).distance(point) <= bound, "the pixel's ray misses the point");
    }

    #[test]
    fn the_matrix_and_the_projector_agree(
        projection in any_projection(),
        position in any_point(10.0),
        target in any_point(10.0),
        point in any_point(10.0),
    ) {
        let camera = Camera::look_at(position, target, DVec3::Y).with_projection(projection);
        let clip = camera.view_projection(IMAGE.aspect()) * point.extend(1.0);
        let distance = -camera.to_camera(point).z;
        prop_assume!(distance.abs() > 1e-3);
        let projected = Projector::new(&camera, IMAGE).to_screen_and_depth(point);
        if clip.w <= 0.0 {
            prop_assert_eq!(projected, None, "behind the eye");
            return Ok(());
        }
        let (screen, depth) = projected.expect("before the eye");
        let ndc = clip.truncate() / clip.w;
        let expected = DVec2::new((ndc.x + 1.0) * 960.0, (1.0 - ndc.y) * 540.0);
        // Two orders of the same operations; w itself is rounded relative to
        // the coordinates, which are up to 20.
        let amplified = 20.0 / if projection.is_orthographic() { 1.0 } else { distance };
        let tolerance = 64.0 * UNIT * amplified * (1.0 + expected.length() + 1920.0 * scale_and_shift(&projection).0.length());
        prop_assert!(screen.distance(expected) <= tolerance, "{screen} and {expected}, {tolerance} allowed");
        let depth_tolerance = 64.0 * UNIT * amplified * (1.0 + depth.abs() + projection.matrix(1.0).w_axis.z.abs());
        prop_assert!((depth - ndc.z).abs() <= depth_tolerance, "depths {depth} and {}", ndc.z);
    }

    #[test]
    fn depth_is_one_at_near_and_zero_at_far(projection in any_projection()) {
        let projector = Projector::new(&Camera::default().with_projection(projection), IMAGE);
        // Terms of up to far / (far - near), 3 with the ratios above; less than eight roundings.
        let bound = 3.0 * 8.0 * UNIT;
        let near = projector.to_depth(DVec3::NEG_Z * projection.near()).expect("before the eye");
        prop_assert!((near - 1.0).abs() <= bound, "near has depth {near}");
        match projection.far() {
            Some(far) => {
                let depth = projector.to_depth(DVec3::NEG_Z * far).expect("before the eye");
                prop_assert!(depth.abs() <= bound, "far has depth {depth}");
            }
            None => prop_assert_eq!(projector.unproject(DVec2::ZERO, 0.0), None, "0 is infinity"),
        }
    }

    #[test]
    fn every_direction_gives_a_rotation(direction in any_point(1.0), up in any_point(1.0), scale in -200i32..200) {
        let turned = orientation_looking(direction * elementary::pow(10.0, f64::from(scale)), up);
        let axes = DMat3::from_quat(turned);
        // The length of the quaternion is off by 4 roundings, which counts six times; then 24
        // for entries and their products.
        prop_assert!((axes.determinant() - 1.0).abs() <= 48.0 * UNIT, "not a rotation: {axes}");
        let forward = turned * DVec3::NEG_Z;
        // What is across both is a difference of products, the less precise the shorter it is:
        // by 4 roundings over that it is not square to either. 32 more for the way through
        // a quaternion.
        let sine = direction.normalize().cross(up.normalize()).length();
        let bound = (32.0 + 4.0 / sine) * UNIT;
        prop_assert!(forward.distance(direction.normalize()) <= bound, "looks along {forward}");
        prop_assert!((turned * DVec3::Y).dot(up) >= -bound, "up is down");
    }
}

#[test]
fn nothing_at_or_behind_the_eye_is_on_the_screen() {
    let camera = Camera::look_at(DVec3::ONE, DVec3::ZERO, DVec3::Y);
    let projector = Projector::new(&camera, IMAGE);
    for point in [camera.position, camera.position + DVec3::ONE, camera.position + camera.right(), DVec3::NAN]
    {
        assert_eq!(projector.to_screen(point), None, "{point} is not before the eye");
        assert_eq!(projector.to_depth(point), None, "{point} is not before the eye");
        assert_eq!(projector.to_screen_and_depth(point), None, "{point} is not before the eye");
    }
    assert_eq!(projector.unproject(DVec2::ZERO, -0.1), None, "beyond infinity");
    assert_eq!(projector.unproject(DVec2::ZERO, f64::NAN), None, "no depth at all");
}

#[test]
fn an_image_without_pixels_has_no_rays() {
    for viewport in [Viewport { width: 0, height: 0 }, Viewport { width: 3, height: 0 }] {
        let projector = Projector::new(&Camera::default(), viewport);
        assert_eq!(projector.ray(DVec2::ZERO), None, "{viewport:?}");
        assert_eq!(projector.unproject(DVec2::ZERO, 0.5), None, "{viewport:?}");
    }
}

#[test]
fn looking_at_oneself_or_along_up_has_a_stable_answer() {
    // Through a quaternion and back: less than 16 roundings of entries up to 1.
    let off = |found: DVec3, axis: DVec3| found.distance(axis) > 16.0 * UNIT;
    let at_self = Camera::look_at(DVec3::ONE, DVec3::ONE, DVec3::Y);
    assert_eq!(at_self, Camera { position: DVec3::ONE, ..Camera::default() }, "looks along -Z");
    let down = Camera::look_at(DVec3::Y * 5.0, DVec3::ZERO, DVec3::Y);
    assert!(!off(down.up(), DVec3::NEG_Z), "from above -Z is on top, not {}", down.up());
    assert!(!off(down.right(), DVec3::X), "and +X to the right, not {}", down.right());
    let up = Camera::look_at(DVec3::Y * -5.0, DVec3::ZERO, DVec3::Y);
    assert!(!off(up.up(), DVec3::Z), "from below +Z is on top, not {}", up.up());
    for broken in [DVec3::ZERO, DVec3::NAN, DVec3::INFINITY] {
        let camera = Camera::look_at(DVec3::Z, DVec3::ZERO, broken);
        assert!(!off(camera.up(), DVec3::Y), "up {broken} counts as +Y");
    }
}
