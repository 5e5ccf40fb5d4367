//! Nodes that are hidden as a whole, against images of each node alone.

use proptest::prelude::*;
use trigon_camera::{Camera, Projection};
use trigon_math::glam::DQuat;
use trigon_math::{DVec3, Vec3, Vec4};
use trigon_mesh::primitives;

use crate::{
    AlphaMode, Background, EffectSettings, Exposure, Frame, Light, Lighting, Material, Node, NodeId, Outputs,
    RenderSettings, Renderer, Scene, Shading, Transform,
};

/// From the origin along −Z; the near plane cuts what is nearer than half a metre.
fn camera() -> Camera {
    let projection = Projection::perspective(1.0, 0.5, None).expect("in range");
    Camera::look_at(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y).with_projection(projection)
}

/// Draws a scene; and how many triangles that took.
fn drawn(scene: &Scene, samples_per_axis: u32) -> (Frame, u64) {
    // A light meter would count what is visible.
    let effects = EffectSettings { exposure: Exposure::Stops(0.0), ..EffectSettings::default() };
    let settings = RenderSettings {
        effects,
        samples_per_axis,
        background: Background::Color(Vec3::ZERO),
        lighting: Lighting::Scene,
        outputs: Outputs { depth: true, ids: true, ..Outputs::default() },
        ..RenderSettings::new(72, 50)
    };
    let mut renderer = Renderer::new(settings);
    let frame = renderer.render(scene, &camera()).expect("drawn");
    let triangles = renderer.stats().primitives;
    (frame, triangles)
}

/// Nodes in many layers, some of them walls, some around the camera or behind it.
fn scenes() -> impl Strategy<Value = (Scene, Vec<NodeId>)> {
    let size = prop_oneof![3 => 0.1_f64..5.0, 1 => Just(0.0), 1 => Just(40.0)];
    let place = prop_oneof![1 => -3.0_f64..1.0, 4 => -40.0_f64..-3.0];
    let node = (0..3_usize, 0..2_usize, size, (-4.0_f64..4.0, -3.0_f64..3.0, place), -3.0_f64..3.0);
    prop::collection::vec(node, 30..50).prop_map(|nodes| {
        let mut scene = Scene::new();
        let meshes = [primitives::cube(1.0), primitives::icosphere(0.5, 1), primitives::plane(1.0, 1.0)]
            .map(|mesh| scene.add_mesh("mesh", mesh));
        let materials = [AlphaMode::Opaque, AlphaMode::Mask { cutoff: 0.5 }].map(|alpha_mode| {
            let base_color = Vec4::new(0.8, 0.6, 0.4, 1.0);
            scene.add_material(Material {
                base_color,
                alpha_mode,
                shading: Shading::Lambert,
                ..Material::default()
            })
        });
        scene.add(Node::from_light(Light::point(30.0)));
        let add = |(mesh, material, size, place, turn): (usize, usize, f64, (f64, f64, f64), f64)| {
            let mut node = Node::from_mesh(meshes[mesh], materials[material]);
            let turn = DQuat::from_rotation_x(1.5) * DQuat::from_rotation_z(turn);
            node.transform =
                Transform::from_scale_rotation_translation(DVec3::splat(size), turn, DVec3::from(place));
            scene.add(node)
        };
        let nodes = nodes.into_iter().map(add).collect();
        (scene, nodes)
    })
}

/// What a pixel shows.
fn pixel(frame: &Frame, index: usize) -> ([u8; 4], f32, u32, u32) {
    let ids = |ids: &Option<Vec<u32>>| ids.as_ref().expect("requested")[index];
    let depth = frame.depth.as_ref().expect("requested")[index];
    let color = frame.color.as_chunks().0[index];
    (color, depth, ids(&frame.object_ids), ids(&frame.face_ids))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, ..ProptestConfig::default() })]

    #[test]
    fn each_pixel_shows_the_nearest_of_what_single_nodes_show((scene, nodes) in scenes()) {
        let (whole, _) = drawn(&scene, 1);
        let alone = |&shown: &NodeId| {
            let mut alone = scene.clone();
            for &node in &nodes {
                alone.node_mut(node).expect("added").visible = node == shown;
            }
            drawn(&alone, 1).0
        };
        let alone: Vec<Frame> = nodes.iter().map(alone).collect();
        for index in 0..whole.color.len() / 4 {
            let pixels = || alone.iter().map(|frame| pixel(frame, index));
            let nearest = pixels().map(|(_, depth, ..)| depth).fold(f32::INFINITY, f32::min);
            // Distances round to equal ones more often than depths.
            let nearest: Vec<_> = pixels().filter(|(_, depth, ..)| *depth == nearest).collect();
            let shown = pixel(&whole, index);
            prop_assert!(nearest.contains(&shown), "pixel {index}: {shown:?}, alone {nearest:?}");
        }
    }
}

#[test]
fn what_a_wall_hides_is_not_drawn() {
    let mut scene = Scene::new();
    let [wall, body] =
        [primitives::cube(1.0), primitives::icosphere(1.0, 2)].map(|mesh| scene.add_mesh("mesh", mesh));
    let material = scene.add_material(Material { shading: Shading::Lambert, ..Material::default() });
    scene.add(Node::from_light(Light::point(30.0)));
    let at = |mesh, size: f64, place: DVec3| Node {
        transform: Transform::from_scale_rotation_translation(DVec3::splat(size), DQuat::IDENTITY, place),
        ..Node::from_mesh(mesh, material)
    };
    let wall = scene.add(at(wall, 10.0, DVec3::new(0.0, 0.0, -9.0)));
    for index in 0..24 {
        scene.add(at(body, 10.0, DVec3::new(0.0, 0.0, -30.0 - f64::from(index))));
    }
    for samples_per_axis in [1, 2] {
        assert_eq!(drawn(&scene, samples_per_axis).1, 12, "the wall");
    }
    scene.node_mut(wall).expect("added").transform.translate(DVec3::X * 3.0);
    assert!(drawn(&scene, 1).1 > 320, "some bodies are seen beside it");
}
