//! What pixels show, and where it is.

#![expect(clippy::disallowed_methods, reason = "the platform's functions are the oracle here")]

use std::f64::consts::PI;

use proptest::prelude::*;
use trigon_camera::{Camera, PixelCenters, Projection, Viewport};
use trigon_math::{DQuat, DVec2, DVec3};
use trigon_scene::{Material, Outputs, Scene, render, render_fisheye, showcase};

use super::oracle::{direction, hits};
use super::{camera, lens, mesh, settings};

const SIDE: u32 = 24;

fn all_but_color() -> Outputs {
    Outputs {
        depth: true,
        ids: true,
        triangle_ids: true,
        barycentrics: true,
        positions: true,
        geometric_normals: true,
        ..Outputs::NONE
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Pixels near an edge, or where two triangles cross, may show either; 2⁻²² of the scene's size is less than the
    /// margin of 10⁻⁴ even in the smallest triangle.
    #[test]
    fn pixels_show_the_nearest_triangle_of_their_rays(
        corners in prop::collection::vec([-2.0..2.0_f32, -2.0..2.0_f32, -2.0..2.0_f32], 30),
        turn in [-1.0..1.0, -1.0..1.0, -1.0..1.0, 0.1..1.0],
        focal in 4.0..30.0,
        distortion in [-0.03..0.03, -0.01..0.01, -0.002..0.002, -0.0005..0.0005],
    ) {
        let faces: Vec<Vec<u32>> = (0..10).map(|face| (3 * face..3 * face + 3).collect()).collect();
        let faces: Vec<&[u32]> = faces.iter().map(Vec::as_slice).collect();
        let mut scene = Scene::new();
        let material = Material { double_sided: true, ..Material::default() };
        scene.add_object("triangles", mesh(&corners, &faces), material);
        let camera = camera(DVec3::new(0.1, 0.2, 0.3), DQuat::from_array(turn).normalize(), lens(SIDE, focal, distortion));
        let frame = render_fisheye(&scene, &camera, &settings(SIDE, all_but_color())).expect("drawn");
        let triangles: Vec<[DVec3; 3]> = corners
            .chunks(3)
            .map(|three| [0, 1, 2].map(|corner| DVec3::from_array(three[corner].map(f64::from))))
            .collect();
        let (ids, depths) = (frame.face_ids.expect("ids"), frame.depth.expect("depth"));
        let (weights, positions) = (frame.barycentrics.expect("weights"), frame.positions.expect("positions"));
        for at in 0..(SIDE * SIDE) as usize {
            let pixel = [at as u32 % SIDE, at as u32 / SIDE];
            let Some(towards) = direction(&camera, SIDE, focal, pixel) else {
                prop_assert_eq!((ids[at], depths[at]), (u32::MAX, f32::INFINITY), "beyond the lens");
                continue;
            };
            let hits = hits(camera.position, towards, &triangles);
            let Some(first) = hits.first() else {
                prop_assert_eq!((ids[at], depths[at]), (u32::MAX, f32::INFINITY), "nothing is there");
                continue;
            };
            let is_ambiguous = hits.iter().any(|hit| hit.margin.abs() < 1e-4)
                || hits.get(1).is_some_and(|next| next.distance < first.distance * (1.0 + 1e-4));
            if is_ambiguous {
                continue;
            }
            prop_assert_eq!(ids[at], first.triangle as u32, "pixel {:?}: {:?}", pixel, hits);
            // Rounded to f32 once; the rest is f64, in which grazing hits lose some digits.
            let error = (f64::from(depths[at]) / first.distance - 1.0).abs();
            prop_assert!(error < 1e-6, "pixel {pixel:?}: depth {} of {first:?}", depths[at]);
            let point = camera.position + towards * first.distance;
            prop_assert!((positions[at].as_dvec3() - point).length() < 1e-6 * (1.0 + first.distance), "{pixel:?}");
            let [a, b, c] = triangles[first.triangle];
            let w = weights[at].as_dvec3();
            prop_assert!((a * w.x + b * w.y + c * w.z - point).length() < 3e-6, "{pixel:?}: weights {w}");
        }
    }
}

/// A lens of one degree draws tangents nearly in proportion to angles: the difference, θ³/3, is 10⁻³ pixel at the rim.
/// The rasterizer rounds vertices to 1/256 pixel. So ids differ only where an edge passes by within 1/200 pixel, and are
/// those of a neighbour then.
#[test]
fn a_narrow_fisheye_shows_what_a_pinhole_shows() {
    const WIDE: u32 = 96;
    let scene = showcase();
    let (_, seen) = scene.cameras()[0];
    // Half an image is half a degree.
    let focal = f64::from(WIDE) / 2.0 / 0.5_f64.to_radians();
    let (image, center) = (Viewport { width: WIDE, height: WIDE }, DVec2::splat(f64::from(WIDE) / 2.0));
    let pinhole = Projection::pinhole(DVec2::splat(focal), center, image, PixelCenters::AtHalves, 0.01);
    let pinhole = pinhole.expect("valid");
    let settings = settings(WIDE, Outputs { ids: true, ..Outputs::default() });
    let (mut differing, mut objects) = (0, std::collections::BTreeSet::new());
    // Where objects stand on the floor.
    let stands = scene.nodes().iter().filter(|(_, node)| node.mesh.is_some());
    let stands: Vec<DVec3> = stands.map(|(id, _)| scene.world_transform(id).translation).skip(1).collect();
    for place in stands.into_iter().take(4) {
        let flat = Camera::look_at(seen.position, place, DVec3::Y).with_projection(pinhole);
        let round = camera(flat.position, flat.orientation, lens(WIDE, focal, [0.0; 4]));
        let expected = render(&scene, &flat, &settings).expect("drawn");
        let found = render_fisheye(&scene, &round, &settings).expect("drawn");
        let ids = |frame: &trigon_scene::Frame, x: u32, y: u32| {
            let at = (y * WIDE + x) as usize;
            [frame.object_ids.as_ref().expect("ids")[at], frame.face_ids.as_ref().expect("ids")[at]]
        };
        for (x, y) in (1..WIDE - 1).flat_map(|y| (1..WIDE - 1).map(move |x| (x, y))) {
            let id = ids(&found, x, y);
            objects.insert(id[0]);
            let around = (y - 1..=y + 1).flat_map(|y| (x - 1..=x + 1).map(move |x| (x, y)));
            let is_near = around.into_iter().any(|(x, y)| ids(&expected, x, y) == id);
            assert!(is_near, "({x}, {y}) shows {id:?}, which the pinhole does not show near there");
            differing += usize::from(ids(&expected, x, y) != id);
            // The same pipelines shade both.
            if ids(&expected, x, y) == id {
                let [a, b] = [&expected, &found].map(|frame| frame.pixel(x, y));
                let error = a.iter().zip(b).map(|(a, b)| a.abs_diff(b)).max();
                assert!(error <= Some(3), "({x}, {y}): {a:?} and {b:?}");
            }
        }
    }
    assert!(differing <= 30, "{differing} of 35344 pixels differ");
    assert!(objects.len() >= 3, "several objects are visible: {objects:?}");
}

/// The inside of a cube from −1 to 1: faces 0 to 5 are at −X, +X, −Y, +Y, −Z and +Z.
fn cube_room() -> Scene {
    let positions: Vec<[f32; 3]> =
        (0..8).map(|corner| [0, 1, 2].map(|axis| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 })).collect();
    let faces: [&[u32]; 6] =
        [&[0, 2, 6, 4], &[1, 3, 7, 5], &[0, 1, 5, 4], &[2, 3, 7, 6], &[0, 1, 3, 2], &[4, 5, 7, 6]];
    let mut scene = Scene::new();
    let material = Material { double_sided: true, ..Material::default() };
    scene.add_object("room", mesh(&positions, &faces), material);
    scene
}

#[test]
fn a_room_is_visible_on_all_six_sides() {
    const WIDE: u32 = 221;
    // A pixel for each degree.
    let focal = 180.0 / PI;
    let lens = lens(WIDE, focal, [0.0; 4]).with_fov(220_f64.to_radians()).expect("valid");
    // 0.2 ahead of the wall behind: that one begins at 90° + atan 0.2 = 101.3° from the axis.
    let camera = camera(DVec3::new(0.0, 0.0, 0.8), DQuat::IDENTITY, lens);
    let frame = render_fisheye(&cube_room(), &camera, &settings(WIDE, all_but_color())).expect("drawn");
    let (ids, depth) = (frame.face_ids.expect("ids"), frame.depth.expect("depth"));
    let at = |degrees: i32, [right, down]: [i32; 2]| {
        let middle = WIDE as i32 / 2;
        ((middle + degrees * down) * WIDE as i32 + middle + degrees * right) as usize
    };
    let expect = |degrees: i32, side: [i32; 2], face: u32, distance: f64| {
        let at = at(degrees, side);
        assert_eq!(ids[at], face, "{degrees}° {side:?}");
        assert!((f64::from(depth[at]) - distance).abs() < 1e-6, "{degrees}° {side:?}: {}", depth[at]);
    };
    let [sin, cos] = [f64::sin, f64::cos].map(|of| move |degrees: i32| of(f64::from(degrees).to_radians()));
    expect(0, [0, 0], 4, 1.8);
    // The wall ahead ends at atan(1 / 1.8) = 29.05°.
    for (side, face) in [([-1, 0], 0), ([1, 0], 1), ([0, 1], 2), ([0, -1], 3)] {
        expect(29, side, 4, 1.8 / cos(29));
        expect(30, side, face, 1.0 / sin(30));
        expect(90, side, face, 1.0);
        expect(101, side, face, 1.0 / sin(101));
        expect(102, side, 5, 0.2 / -cos(102));
        expect(110, side, 5, 0.2 / -cos(110));
    }
    // Diagonally 79 pixels across and down are 111.7°.
    let beyond = (WIDE as usize / 2 + 79) * WIDE as usize + WIDE as usize / 2 + 79;
    assert_eq!((ids[beyond], depth[beyond]), (u32::MAX, f32::INFINITY), "beyond the lens");
}

/// Some models have every face twice, once for each side: at each hit one of the two is not drawn.
#[test]
fn of_two_faces_in_one_plane_the_front_is_visible() {
    let corners = [[-1.0, -1.0, -1.0], [1.0, -1.0, -1.0], [1.0, 1.0, -1.0], [-1.0, 1.0, -1.0]];
    let mut scene = Scene::new();
    let one_sided = Material { double_sided: false, ..Material::default() };
    // Face 0 shows its back.
    scene.add_object("both", mesh(&corners, &[&[3, 2, 1, 0], &[0, 1, 2, 3]]), one_sided);
    let camera = camera(DVec3::ZERO, DQuat::IDENTITY, lens(SIDE, 20.0, [0.0; 4]));
    let frame = render_fisheye(&scene, &camera, &settings(SIDE, all_but_color())).expect("drawn");
    let ids = frame.face_ids.expect("ids");
    assert_eq!(ids[(SIDE * SIDE / 2 + SIDE / 2) as usize], 1, "the second face");
    assert!(ids.iter().all(|&id| id == 1 || id == u32::MAX), "the first one nowhere");
}
