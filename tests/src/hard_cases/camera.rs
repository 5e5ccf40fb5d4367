//! Cameras within what they look at, and angles of view from next to nothing to next
//! to a half-turn.

use std::f64::consts::PI;

use proptest::prelude::*;
use trigon_camera::{Camera, Projection};
use trigon_math::{DQuat, DVec3, elementary};
use trigon_mesh::primitives::{self, TorusKnot};
use trigon_scene::{Material, Scene, Transform, render};

use super::flight::{check_ids, check_numbers, settings};
use super::flight_oracle::Oracle;
use super::flight_scenes::in_triangles;
use crate::effort::cases;

const SIZE: [u32; 2] = [48, 36];

fn vector() -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-1.0..1.0_f64).prop_map(DVec3::from_array)
}

/// Degrees from 0.01 to 179, the ends among them.
fn field_of_view() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.01), Just(179.0), (-2.0..2.25_f64).prop_map(|power| elementary::pow(10.0, power))]
        .prop_map(|degrees| degrees * PI / 180.0)
}

proptest! {
    #![proptest_config(cases(48))]

    /// A closed mesh around the eye leaves no way out: no pixel shows the background,
    /// without any tolerance. `up` may be zero or the line of sight.
    #[test]
    fn from_within_a_closed_mesh_nothing_of_the_background_is_seen(
        eye in vector(), sight in vector(), up in prop_oneof![Just(None), vector().prop_map(Some), Just(Some(DVec3::ZERO))],
        angle in field_of_view(), round in any::<bool>(), automatic in any::<bool>(),
    ) {
        let mut scene = Scene::new();
        let mesh = if round { primitives::uv_sphere(2.0, 24, 12) } else { primitives::cube(2.4) };
        scene.add_object("room", mesh, Material::default());
        // The walls are at least 0.2 away, and the farthest corner's ray runs 190 times as
        // long as it gains depth.
        let projection = Projection::perspective(angle, 1e-4, None).expect("in range");
        let camera = Camera::look_at(eye, eye + sight, up.unwrap_or(sight)).with_projection(projection);
        let camera = if automatic { camera.with_clip_planes(&scene.bounds()) } else { camera };
        let frame = render(&scene, &camera, &settings(SIZE)).expect("in range");
        check_numbers(&frame);
        let hidden = frame.object_ids.expect("asked for").iter().filter(|&&id| id == 0).count();
        prop_assert_eq!(hidden, frame.width as usize * frame.height as usize, "the room has a hole");
    }

    /// What is as large as the image is drawn where rays meet it, at any angle.
    #[test]
    fn any_field_of_view_shows_what_rays_meet(angle in field_of_view(), tilt in prop::array::uniform3(-1.0..1.0_f64)) {
        let shape = TorusKnot { segments: 60, sides: 5, ..TorusKnot::default() };
        let mut scene = Scene::new();
        let knot = scene.add_object("knot", in_triangles(&primitives::torus_knot(&shape)), Material::default());
        let size = elementary::tan(angle / 2.0);
        let depth = if size < 0.2 { size } else { 0.2 };
        // Turned in its plane, and leaning by less than a third of its distance.
        let lean = 0.3 * depth / size;
        let turned = DQuat::from_xyzw(tilt[0] * lean, tilt[1], tilt[2] * lean, 1.0).normalize();
        let upright = DQuat::from_xyzw(elementary::sin(PI / 4.0), 0.0, 0.0, elementary::cos(PI / 4.0));
        scene.node_mut(knot).expect("just added").transform = Transform::from_scale_rotation_translation(
            DVec3::new(size, depth, size), upright * turned, DVec3::NEG_Z,
        );
        let camera = Camera::default().with_projection(Projection::perspective(angle, 1e-3, None).expect("in range"));
        let frame = render(&scene, &camera, &settings(SIZE)).expect("in range");
        check_numbers(&frame);
        let share = check_ids(&frame, &Oracle::new(&scene, &camera, SIZE), "any field of view");
        let seen = frame.object_ids.expect("asked for").iter().filter(|&&id| id == 0).count();
        prop_assert!(share > 0.5 && seen > 50, "{} decided, {} pixels show it", share, seen);
    }
}
