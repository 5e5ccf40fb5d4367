//! One mesh at many nodes.

use proptest::prelude::*;
use trigon_camera::{Camera, Projection};
use trigon_math::{DQuat, DVec3};
use trigon_mesh::primitives;
use trigon_scene::{Frame, Material, Node, Scene, Transform, render};

use super::flight::{check_ids, check_numbers, settings};
use super::flight_oracle::Oracle;
use super::flight_scenes::in_triangles;
use crate::effort::cases;

const SIZE: [u32; 2] = [48, 36];

/// Anywhere about the origin, turned in any way, from a hundredth to twice as large, mirrored or not.
fn placement() -> impl Strategy<Value = Transform> {
    let vector = |range: std::ops::Range<f64>| prop::array::uniform3(range).prop_map(DVec3::from_array);
    let turn = prop::array::uniform4(-1.0..1.0_f64)
        .prop_filter("has a length", |q| q.iter().map(|v| v * v).sum::<f64>() > 0.01)
        .prop_map(|q| DQuat::from_array(q).normalize());
    let sizes = (vector(0.2..1.0), -2.0..0.3_f64, 0..8_u8).prop_map(|(sides, power, mirrors)| {
        let size = trigon_math::elementary::pow(10.0, power);
        DVec3::from_array([0, 1, 2].map(|axis| if mirrors >> axis & 1 == 0 { size } else { -size })) * sides
    });
    (sizes, turn, vector(-2.0..2.0))
        .prop_map(|(size, turn, place)| Transform::from_scale_rotation_translation(size, turn, place))
}

/// A ball at each place, of one mesh or of a mesh for each.
fn scene(places: &[Transform], offset: DVec3, is_shared: bool) -> Scene {
    let mut scene = Scene::new();
    let ball = in_triangles(&primitives::icosphere(1.0, 1));
    let material = scene.add_material(Material { double_sided: false, ..Material::default() });
    let shared = scene.add_mesh("ball", ball.clone());
    for place in places {
        let mesh = if is_shared { shared } else { scene.add_mesh("ball", ball.clone()) };
        let mut node = Node::from_mesh(mesh, material).with_transform(*place);
        node.transform.set_translation(place.translation() + offset);
        scene.add(node);
    }
    scene
}

proptest! {
    #![proptest_config(cases(24))]

    /// Up to sixty instances, here and up to 10⁷ m away: the bytes of as many meshes of their own, each pixel with the
    /// number of the node that a ray meets first.
    #[test]
    fn instances_are_drawn_like_meshes_of_their_own_each_at_its_place(
        places in prop::collection::vec(placement(), 1..60),
        offset in prop_oneof![
            Just(DVec3::ZERO),
            prop::array::uniform3(-1e7..1e7_f64).prop_map(DVec3::from_array),
        ],
        away in prop::array::uniform3(-1.0..1.0_f64).prop_map(DVec3::from_array),
    ) {
        let eye = offset + away.normalize_or(DVec3::X) * 6.0;
        let projection = Projection::perspective(0.9, 0.01, None).expect("in range");
        let camera = Camera::look_at(eye, offset, DVec3::Y).with_projection(projection);
        let [instances, meshes] = [true, false].map(|is_shared| {
            let scene = scene(&places, offset, is_shared);
            (render(&scene, &camera, &settings(SIZE)).expect("in range"), scene)
        });
        let (frame, scene): (Frame, Scene) = instances;
        prop_assert!(frame == meshes.0, "the images differ");
        check_numbers(&frame);
        let decided = check_ids(&frame, &Oracle::new(&scene, &camera, SIZE), "instances");
        prop_assert!(decided > 0.5, "{} decided", decided);
    }
}

/// A hundred instances beside each other: as many numbers, in their order.
#[test]
fn a_hundred_instances_have_a_hundred_numbers() {
    let place = |i: u32| {
        let at = DVec3::new(f64::from(i % 10) - 4.5, 4.5 - f64::from(i / 10), 0.0);
        Transform::from_scale_rotation_translation(DVec3::splat(0.4), DQuat::IDENTITY, at)
    };
    let scene = scene(&(0..100).map(place).collect::<Vec<_>>(), DVec3::ZERO, true);
    let projection = Projection::orthographic(10.0, 0.1, 20.0).expect("in range");
    let camera = Camera::look_at(DVec3::Z * 10.0, DVec3::ZERO, DVec3::Y).with_projection(projection);
    let frame = render(&scene, &camera, &settings([50, 50])).expect("in range");
    let ids = frame.object_ids.expect("asked for");
    let middles = (0..100_usize).map(|i| ids[(i / 10 * 5 + 2) * 50 + i % 10 * 5 + 2]);
    assert!(middles.eq(0..100), "the middle of each shows its number");
}
