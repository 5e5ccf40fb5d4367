//! Automatic near and far planes: nothing in front of the eye is cut, whatever is far behind it, and depth is as
//! precise as with planes made to measure.
//!
//! Images are drawn through the planes that the engine sets. What must be seen is decided in f64 without any plane.

use proptest::prelude::*;
use trigon_camera::{Camera, Orbit, Projection};
use trigon_math::{Bounds3, DQuat, DVec3, Vec3, elementary};
use trigon_mesh::{Mesh, MeshBuilder, primitives};
use trigon_scene::{Frame, Material, Scene, Transform, render};

use super::flight::{check_ids, check_numbers, settings};
use super::flight_oracle::Oracle;
use crate::effort::cases;

const SIZE: [u32; 2] = [48, 36];

/// From the lower to the upper edge of the image, in radians.
const ANGLE: f64 = 0.8;

/// A number from one power of ten to another.
fn magnitude(powers: std::ops::Range<f64>) -> impl Strategy<Value = f64> {
    powers.prop_map(|power| elementary::pow(10.0, power))
}

/// Which of the engine's cameras sets the planes.
#[derive(Clone, Copy, Debug)]
enum Planes {
    /// The viewer's, from a box around everything.
    Fitted,
    /// The window's, from boxes of meshes.
    Orbit,
}

fn planes() -> impl Strategy<Value = Planes> {
    prop_oneof![Just(Planes::Fitted), Just(Planes::Orbit)]
}

impl Planes {
    fn of(self, camera: &Camera, scene: &Scene) -> Camera {
        match self {
            Self::Fitted => camera.with_clip_planes(&scene.tight_bounds()),
            Self::Orbit => {
                let orbit = Orbit::from_camera(camera, 2.0, camera.up());
                Camera { projection: orbit.camera(&scene.bounds()).projection, ..*camera }
            }
        }
    }
}

fn draw(scene: &Scene, camera: &Camera) -> Frame {
    let frame = render(scene, camera, &settings(SIZE)).expect("in range");
    check_numbers(&frame);
    frame
}

fn perspective(near: f64) -> Projection {
    Projection::perspective(ANGLE, near, None).expect("in range")
}

fn add(scene: &mut Scene, name: &str, mesh: Mesh, transform: Transform) {
    let node = scene.add_object(name, mesh, Material::default());
    scene.node_mut(node).expect("just added").transform = transform;
}

fn ball(scene: &mut Scene, name: &str, center: DVec3, radius: f64) {
    let transform = Transform::from_scale_rotation_translation(DVec3::splat(radius), DQuat::IDENTITY, center);
    add(scene, name, primitives::icosphere(1.0, 2), transform);
}

/// Two triangles at height 0, as far on each side.
fn ground(reach: f64) -> Mesh {
    let mut builder = MeshBuilder::new();
    let reach = reach as f32;
    let corners = [[-reach, -reach], [-reach, reach], [reach, reach], [reach, -reach]]
        .map(|[x, z]| builder.push_vertex(Vec3::new(x, 0.0, z)));
    let [a, b, c, d] = corners;
    builder.push_face(&[a, b, c]).expect("a face");
    builder.push_face(&[a, c, d]).expect("a face");
    builder.build()
}

/// The direction of the ray through a pixel's middle in the world: `up`, `right` and the line of sight are the
/// camera's own numbers.
fn ray(camera: &Camera, [x, y]: [u32; 2]) -> DVec3 {
    #[expect(
        clippy::disallowed_methods,
        reason = "of the oracle's own; its last bit is far below the bounds"
    )]
    let half = (ANGLE / 2.0).tan();
    let [width, height] = SIZE.map(f64::from);
    let across = ((f64::from(x) + 0.5) / width * 2.0 - 1.0) * half * width / height;
    let up = (1.0 - (f64::from(y) + 0.5) / height * 2.0) * half;
    camera.orientation * DVec3::new(across, up, -1.0)
}

proptest! {
    #![proptest_config(cases(40))]

    /// A ball right ahead and a moon far away, also as far as the stars: with a near plane at 10⁻⁵ of the farthest
    /// distance not one pixel of a ball of 1 m at 2 m was left before a moon at 400 km.
    #[test]
    fn a_ball_before_a_moon_is_seen_as_rays_meet_it(
        distance in magnitude(-3.0..3.0),
        farther in magnitude(1.0..18.0),
        place in prop_oneof![Just(0.0), Just(1e6)],
        planes in planes(),
    ) {
        let eye = DVec3::new(place, -place, 0.5 * place);
        let mut scene = Scene::new();
        ball(&mut scene, "ball", eye + DVec3::NEG_Z * distance, 0.25 * distance);
        let moon = distance * farther;
        ball(&mut scene, "moon", eye + DVec3::new(0.3, 0.1, -1.0) * moon, 0.05 * moon);
        let camera = Camera::look_at(eye, eye + DVec3::NEG_Z * distance, DVec3::Y).with_projection(perspective(1.0));
        let frame = draw(&scene, &planes.of(&camera, &scene));
        let uncut = camera.with_projection(perspective(1e-100));
        let decided = check_ids(&frame, &Oracle::new(&scene, &uncut, SIZE), "a ball before a moon");
        let seen = frame.object_ids.as_ref().expect("asked for").iter().filter(|&&id| id == 0).count();
        prop_assert!(decided > 0.5 && seen > 200, "{} decided, the ball has {} pixels", decided, seen);
    }

    /// From a height of 1 mm to 100 m over a ground of two triangles that reaches up to 300,000 times as far: all below
    /// the horizon is ground, from the lower edge of the image on, at the depth where rays meet it. Their corners are
    /// rounded to f32 when the camera turns, which tilts the ground: by four roundings of its reach, beside the height.
    #[test]
    fn a_ground_begins_right_under_the_eye(
        height in magnitude(-3.0..2.0),
        reach in magnitude(1.0..5.5),
        pitch in -1.4_f64..0.3,
        turn in 0.0_f64..std::f64::consts::TAU,
        planes in planes(),
    ) {
        let reach = f64::from((height * reach) as f32);
        let tilt = 4.0 * f64::from(f32::EPSILON) * reach / height;
        let mut scene = Scene::new();
        add(&mut scene, "ground", ground(reach), Transform::IDENTITY);
        let (sine, cosine) = elementary::sin_cos(turn);
        let (rise, run) = elementary::sin_cos(pitch);
        let eye = DVec3::Y * height;
        let sight = DVec3::new(run * sine, rise, run * cosine);
        let camera = Camera::look_at(eye, eye + sight, DVec3::Y).with_projection(perspective(1.0));
        let frame = draw(&scene, &planes.of(&camera, &scene));
        let (ids, depths) = (frame.object_ids.expect("asked for"), frame.depth.expect("asked for"));
        for (index, (&id, &depth)) in ids.iter().zip(&depths).enumerate() {
            let at = [index as u32 % SIZE[0], index as u32 / SIZE[0]];
            let ray = ray(&camera, at);
            // The ground's edge and the horizon are a pixel wide; what is within a percent of a border is left out.
            let far = height / -ray.y;
            let met = eye + ray * far;
            let out = met.x.abs().max(met.z.abs()) / reach;
            if far > 0.0 && out < 0.99 && -ray.y > 0.05 {
                prop_assert_eq!(id, 0, "a hole at {:?}, {} m away", at, far);
                // Snapped by 1/512 pixel, of which a row is 1/45 of a unit at least; and f32's rounding.
                let slope = 1.0 / (512.0 * 20.0) / -ray.y;
                let error = (f64::from(depth) / far - 1.0).abs();
                prop_assert!(error < 2.0 * slope + 1e-5 + tilt, "{} instead of {}", depth, far);
            } else if far < 0.0 && ray.y > 0.05 {
                prop_assert_eq!(id, u32::MAX, "ground in the sky at {:?}", at);
            }
        }
    }

    /// Walls of any size about the eye, which lies in the planes of their corners, looks along their edges and has a
    /// moon in view: no pixel shows the background, or the moon behind the wall.
    #[test]
    fn a_room_before_a_moon_has_no_hole(
        size in magnitude(-6.0..3.0),
        eye in prop::array::uniform3(prop::sample::select(vec![-0.25, 0.0, 0.25, 0.499])),
        sight in prop_oneof![
            prop::array::uniform3(-1.0..1.0_f64).prop_map(DVec3::from_array),
            prop::sample::select(vec![DVec3::NEG_Z, DVec3::X, DVec3::NEG_Y, DVec3::new(1.0, 0.0, 1.0)]),
        ],
        farther in magnitude(1.0..12.0),
        planes in planes(),
    ) {
        let mut scene = Scene::new();
        // A grid of vertices on each wall, so that some lie exactly beside the eye.
        let walls = Transform::from_scale_rotation_translation(DVec3::splat(size), DQuat::IDENTITY, DVec3::ZERO);
        add(&mut scene, "room", room(4), walls);
        ball(&mut scene, "moon", sight.normalize_or(DVec3::X) * size * farther, 0.1 * size * farther);
        let eye = DVec3::from_array(eye) * size;
        let camera = Camera::look_at(eye, eye + sight, DVec3::Y).with_projection(perspective(1.0));
        let frame = draw(&scene, &planes.of(&camera, &scene));
        let others = frame.object_ids.expect("asked for").iter().filter(|&&id| id != 0).count();
        prop_assert_eq!(others, 0, "so many pixels show no wall");
    }
}

/// A closed cube of size 1 whose sides are cut into squares.
fn room(parts: u32) -> Mesh {
    let mut builder = MeshBuilder::new();
    let at = |index: u32| index as f32 / parts as f32 - 0.5;
    for (axis, side) in (0..3).flat_map(|axis| [-0.5, 0.5].map(|side| (axis, side))) {
        for (i, j) in (0..parts).flat_map(|i| (0..parts).map(move |j| (i, j))) {
            let corner = |i: u32, j: u32| {
                let mut corner = [0.0; 3];
                (corner[axis], corner[(axis + 1) % 3], corner[(axis + 2) % 3]) = (side, at(i), at(j));
                Vec3::from_array(corner)
            };
            let corners = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            let corners = corners.map(|corner| builder.push_vertex(corner));
            builder.push_face(&corners).expect("a face");
        }
    }
    builder.build()
}

/// The files of the kind as people met them: the ball covers as much before the moon as without it.
#[test]
fn a_ball_of_one_metre_before_a_moon_at_400_km_is_as_large_as_without_it() {
    let pixels = |has_moon: bool| {
        let mut scene = Scene::new();
        ball(&mut scene, "ball", DVec3::NEG_Z * 2.0, 0.5);
        if has_moon {
            ball(&mut scene, "moon", DVec3::new(1e5, 0.0, -4e5), 1e4);
        }
        let camera = Camera::look_at(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y).with_projection(perspective(1.0));
        let frame = draw(&scene, &camera.with_clip_planes(&scene.bounds()));
        frame.object_ids.expect("asked for").iter().filter(|&&id| id == 0).count()
    };
    // A circle of half of 0.5/√3.75 of the image's height over tan 0.4, that is 11 pixels.
    let (alone, before_moon) = (pixels(false), pixels(true));
    assert!((300..450).contains(&alone), "{alone} pixels");
    assert_eq!(before_moon, alone, "the moon takes none");
}

/// A level camera 1.7 m above a ground of ±10⁶ and ±10⁷ m, of which 13 and 128 m before the eye were cut: the lower half
/// of the image is ground.
#[test]
fn a_ground_of_ten_thousand_kilometres_begins_before_the_eye() {
    for reach in [1e6, 1e7] {
        let mut scene = Scene::new();
        add(&mut scene, "ground", ground(reach), Transform::IDENTITY);
        let eye = DVec3::Y * 1.7;
        let camera = Camera::look_at(eye, eye + DVec3::NEG_Z, DVec3::Y).with_projection(perspective(1.0));
        let frame = draw(&scene, &camera.with_clip_planes(&scene.bounds()));
        let (ids, depths) = (frame.object_ids.expect("asked for"), frame.depth.expect("asked for"));
        let [width, height] = SIZE.map(|size| size as usize);
        assert!(ids[width * height / 2..].iter().all(|&id| id == 0), "a hole in the ground of {reach} m");
        assert!(ids[..width * height / 2].iter().all(|&id| id == u32::MAX), "ground above the horizon");
        // The middle of the lowest row: at 35/36 of 0.4228 per metre.
        let lowest = f64::from(depths[width * height - width / 2]);
        assert!((lowest - 1.7 / (35.0 / 36.0 * 0.422_793)).abs() < 0.01, "it begins at {lowest} m");
    }
}

/// What is given stays: planes that cut are drawn as they are.
#[test]
fn planes_that_are_given_stay() {
    let mut scene = Scene::new();
    ball(&mut scene, "ball", DVec3::NEG_Z * 2.0, 0.5);
    let camera = Camera::look_at(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y).with_projection(perspective(4.0));
    let seen = |near: f64| {
        let ids = draw(&scene, &camera.with_projection(perspective(near))).object_ids.expect("asked for");
        ids.iter().filter(|&&id| id == 0).count()
    };
    assert_eq!(seen(4.0), 0, "a near plane of 4 m hides a ball at 2 m");
    // A circle of half of 0.5/√3.75 of the image's height over tan 0.4, that is 11 pixels. The plane through the
    // ball's middle leaves its back, a circle of half of 0.5/2 of that: 10.6 pixels.
    let (whole, back) = (seen(1.0), seen(2.0));
    assert!((330..430).contains(&whole) && (300..whole).contains(&back), "{whole} and {back} pixels");
    let bounds = Bounds3 { min: DVec3::splat(-9.0), max: DVec3::splat(9.0) };
    let wide = camera.with_clip_planes(&bounds);
    assert_eq!(wide.with_projection(camera.projection), camera, "only the planes change");
}
