//! Edges and faces that pass the plane through the eye, with a near plane right before it: where it cuts them
//! they are 10²⁵ pixels away.

use trigon_camera::{Camera, Projection};
use trigon_math::{DVec2, DVec3};
use trigon_mesh::primitives;

use super::super::region::center;
use crate::{Frame, Material, NodeId, Outputs, Picker, Reach, Region, RenderSettings, Scene, render};

const SIZE: [u32; 2] = [320, 240];

/// Half of what the image is high at a metre.
const HALF: f64 = 1.4;

/// Where a point in front of a camera at the origin that looks along −z is drawn.
fn drawn(point: DVec3) -> DVec2 {
    let size = DVec2::new(SIZE[0].into(), SIZE[1].into());
    let scale = size.y / 2.0 / HALF / -point.z;
    DVec2::new(size.x / 2.0 + point.x * scale, size.y / 2.0 - point.y * scale)
}

/// A room of 4 m about the eye: the four edges that run past it are found wherever they are in view, and the wall ahead
/// and the others in the pixels that they cover.
#[test]
fn edges_and_walls_that_run_past_the_eye_are_picked_where_they_are_seen() {
    let mut scene = Scene::new();
    let room = scene.add_object("room", primitives::cube(4.0), Material::default());
    let angle = 2.0 * trigon_math::elementary::atan2(HALF, 1.0);
    let projection = Projection::perspective(angle, 1.0, None).expect("in range");
    for eye in [DVec3::ZERO, DVec3::new(0.7, -0.4, 1.0), DVec3::new(0.0, 1.5, 0.5)] {
        let camera = Camera::look_at(eye, eye + DVec3::NEG_Z, DVec3::Y).with_projection(projection);
        let camera = camera.with_clip_planes(&scene.bounds());
        assert!(camera.projection.near() < 1e-20, "right before the eye: {}", camera.projection.near());
        let outputs = Outputs { ids: true, depth: true, ..Outputs::NONE };
        let settings =
            RenderSettings { outputs, samples_per_axis: 1, ..RenderSettings::new(SIZE[0], SIZE[1]) };
        let frame = render(&scene, &camera, &settings).expect("drawn");
        let picker = Picker::new(&scene, &camera, &frame);
        let found = edges_found(&picker, &scene, eye);
        assert!(found >= 4, "{found} points of edges are in view from {eye}");
        check_faces(&picker, &frame, room);
    }
}

/// Picks points of the edges along z; how many of them are in view.
fn edges_found(picker: &Picker<'_>, scene: &Scene, eye: DVec3) -> usize {
    let mesh = scene.meshes().iter().next().expect("the room").1.mesh();
    let mut found = 0;
    let corners = [(-2.0, -2.0), (-2.0, 2.0), (2.0, -2.0), (2.0, 2.0)];
    for ((x, y), z) in corners.into_iter().flat_map(|corner| [-1.9, -1.5, -1.2].map(|z| (corner, z))) {
        let at = drawn(DVec3::new(x, y, z) - eye);
        if z > eye.z - 0.1 || at.cmplt(DVec2::ONE).any() || at.x > 319.0 || at.y > 239.0 {
            continue;
        }
        let edge = picker.nearest(at, 3.0, Reach::Visible).edge;
        let (_, edge) = edge.unwrap_or_else(|| panic!("none at {at} from {eye}"));
        let ends = mesh.edges()[edge as usize].map(|end| mesh.positions()[end as usize].as_dvec3());
        assert!(ends.iter().all(|end| end.x == x && end.y == y), "{ends:?} at {x}, {y}, {z}");
        found += 1;
    }
    found
}

/// Some pixels: the face of the pixel's id; through all, too, but for a centre on an edge, which both faces cover.
fn check_faces(picker: &Picker<'_>, frame: &Frame, room: NodeId) {
    let ids = frame.face_ids.as_ref().expect("asked for");
    for (index, &face) in ids.iter().enumerate().step_by(1999) {
        let at = center(index as u32 % SIZE[0], index as u32 / SIZE[0]);
        assert_ne!(face, u32::MAX, "a wall at {at}");
        for (reach, most) in [(Reach::Visible, 1), (Reach::Through, 2)] {
            let faces = picker.faces(&Region::Point(at), reach);
            assert!(faces.contains(room, face) && faces.len() <= most, "{faces:?} at {at}, {reach:?}");
        }
    }
}
