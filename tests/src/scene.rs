//! The scene as a container, and what an image promises about it.

use std::collections::BTreeSet;

use proptest::prelude::*;
use trigon_camera::{Camera, Projection};
use trigon_math::{DAffine3, DQuat, DVec3, Vec3};
use trigon_mesh::primitives::{self, TorusKnot};
use trigon_scene::{
    Background, Frame, Material, Node, NodeId, Outputs, RenderSettings, Scene, SceneError, Style, Transform,
    render,
};

use crate::hard_cases::flight::check_ids;
use crate::hard_cases::flight_oracle::{Oracle, own_map};
use crate::hard_cases::flight_scenes::in_triangles;

fn settings() -> RenderSettings {
    let outputs = Outputs { depth: true, ids: true, ..Outputs::default() };
    RenderSettings { outputs, samples_per_axis: 1, ..RenderSettings::new(80, 60) }
}

fn draw(scene: &Scene, camera: &Camera) -> Frame {
    render(scene, camera, &settings()).expect("in range")
}

/// The same, after each pixel was compared with what a ray in f64 hits first; and not all is background.
fn draw_as_rays_meet(scene: &Scene, camera: &Camera) -> Frame {
    let outputs = Outputs { triangle_ids: true, ..settings().outputs };
    let frame = render(scene, camera, &RenderSettings { outputs, ..settings() }).expect("in range");
    let decided = check_ids(&frame, &Oracle::new(scene, camera, [80, 60]), "by rays");
    assert!(decided > 0.5, "the oracle decides {decided} of the pixels");
    frame
}

/// A world is a container: add, iterate, change and remove while it is drawn.
#[test]
fn a3_objects_come_and_go_between_frames() {
    let mut scene = Scene::new();
    let cube = scene.add_object("cube", primitives::cube(1.0), Material::default());
    let camera = scene.overview(4.0 / 3.0);
    let alone = draw(&scene, &camera);
    let ball = scene.add_object("ball", primitives::icosphere(0.4, 2), Material::default());
    scene.node_mut(ball).expect("just added").transform.translate(DVec3::new(0.6, 0.6, 0.6));
    let both = draw(&scene, &camera);
    assert!(
        both.object_ids.as_ref().expect("asked for").contains(&(ball.index() as u32)),
        "the ball is seen"
    );
    let names: Vec<_> = scene.nodes().iter().map(|(_, node)| node.name.as_str()).collect();
    assert_eq!(names, ["cube", "ball"], "iteration in the order of the indices");
    assert_eq!(scene.remove(ball), 1, "one node goes");
    assert_eq!(draw(&scene, &camera), alone, "and leaves no trace");
    assert!(scene.node(cube).is_some(), "the other one stays");
}

#[test]
fn a_node_cannot_hang_on_its_own_child() {
    let mut scene = Scene::new();
    let parent = scene.add(Node::default());
    let child = scene.add_child(parent, Node::default()).expect("the parent is there");
    let refused = scene.set_parent(parent, Some(child));
    assert_eq!(refused, Err(SceneError::Cycle { child: parent, parent: child }), "a cycle");
    assert_eq!(scene.remove(parent), 2, "the subtree goes as one");
}

#[test]
fn a_chain_of_100_000_nodes_is_placed_without_recursion() {
    let mut scene = Scene::new();
    let mut last = scene.add(Node::default().at(DVec3::X));
    let first = last;
    for _ in 1..100_000 {
        last = scene.add_child(last, Node::default().at(DVec3::X)).expect("the parent is there");
    }
    assert_eq!(scene.world_transform(last).translation, DVec3::X * 1e5, "each adds a metre");
    assert_eq!(
        scene.visible_transforms()[last.index()],
        Some(scene.world_transform(last)),
        "both ways agree"
    );
    scene.node_mut(first).expect("there").visible = false;
    assert_eq!(scene.visible_transforms()[last.index()], None, "hidden with its ancestor");
    assert_eq!(scene.remove(first), 100_000, "removed as a whole");
}

/// A model ten million metres away looks exactly as one at the origin.
#[test]
fn large_world_coordinates_change_nothing() {
    let image = |offset: DVec3| {
        let mut scene = Scene::new();
        let knot = scene.add_object(
            "knot",
            in_triangles(&primitives::torus_knot(&TorusKnot::default())),
            Material::default(),
        );
        scene.node_mut(knot).expect("there").transform.set_translation(offset);
        let at = DVec3::new(1.5, 1.0, 2.0);
        let camera = Camera::look_at(offset + at, offset, DVec3::Y);
        draw_as_rays_meet(&scene, &camera)
    };
    let here = image(DVec3::ZERO);
    assert_eq!(here, image(DVec3::new(1e7, -3e7, 2e7)), "exactly representable offsets cancel exactly");
}

/// A pixel's ids and depth belong together: the camera ray through the pixel
/// meets that node's box at about that depth.
#[test]
fn depth_is_metres_along_the_view_axis() {
    let mut scene = Scene::new();
    scene.add_object("wall", primitives::cube(2.0), Material::default());
    for projection in [
        Projection::perspective(1.0, 0.1, Some(50.0)).expect("valid"),
        Projection::perspective(1.0, 0.1, None).expect("valid"),
        Projection::orthographic(3.0, 0.1, 50.0).expect("valid"),
    ] {
        let camera = Camera::look_at(DVec3::Z * 5.0, DVec3::ZERO, DVec3::Y).with_projection(projection);
        let frame = draw(&scene, &camera);
        let depth = frame.depth.as_ref().expect("asked for");
        let (middle, corner) = (depth[30 * 80 + 40], depth[0]);
        // The wall stands 4 m away; depth and the inverse each round once. At near
        // 0.1 m a unit of depth is worth 160 m (perspective) or 49.9 m (orthographic).
        assert!((middle - 4.0).abs() <= 160.0 * 0.1 * f32::EPSILON, "{projection:?}: {middle}");
        assert_eq!(corner, f32::INFINITY, "nothing there");
    }
}

#[test]
fn hidden_nodes_and_those_below_them_are_not_drawn() {
    let mut scene = Scene::new();
    let (cube, material) =
        (scene.add_mesh("cube", primitives::cube(1.0)), scene.add_material(Material::default()));
    let node = |x: f64| Node::from_mesh(cube, material).at(DVec3::X * x);
    let parent = scene.add(node(0.0));
    let child = scene.add_child(parent, node(2.0)).expect("the parent is there");
    let grandchild = scene.add_child(child, node(2.0)).expect("the child is there");
    let beside = scene.add(node(-2.0));
    let camera = scene.overview(4.0 / 3.0);
    let drawn = |scene: &Scene| -> BTreeSet<u32> {
        let ids = draw(scene, &camera).object_ids.expect("asked for");
        ids.into_iter().filter(|&id| id != u32::MAX).collect()
    };
    let indices = |nodes: &[NodeId]| nodes.iter().map(|node| node.index() as u32).collect::<BTreeSet<_>>();
    assert_eq!(drawn(&scene), indices(&[parent, child, grandchild, beside]), "all four");
    for (hidden, left) in [
        (parent, &[beside][..]),
        (child, &[parent, beside]),
        (grandchild, &[parent, child, beside]),
        (beside, &[parent, child, grandchild]),
    ] {
        scene.node_mut(hidden).expect("there").visible = false;
        assert_eq!(drawn(&scene), indices(left), "without {hidden:?}");
        scene.node_mut(hidden).expect("there").visible = true;
    }
}

#[test]
fn a_transparent_background_has_no_alpha() {
    let mut scene = Scene::new();
    scene.add_object("cube", primitives::cube(1.0), Material::default());
    let settings = RenderSettings { background: Background::Transparent, ..settings() };
    let frame = render(&scene, &scene.overview(4.0 / 3.0), &settings).expect("in range");
    assert_eq!((frame.pixel(0, 0)[3], frame.pixel(40, 30)[3]), (0, 255), "outside and inside");
}

fn any_transform() -> impl Strategy<Value = Transform> {
    let part = -3.0..3.0_f64;
    let vector = (part.clone(), part.clone(), part).prop_map(|(x, y, z)| DVec3::new(x, y, z));
    (vector.clone(), vector.clone(), -7.0..7.0_f64).prop_map(|(translation, axis, angle)| {
        let mut transform =
            Transform::from_scale_rotation_translation(DVec3::ONE, DQuat::IDENTITY, translation);
        transform.rotate(axis, angle);
        transform
    })
}

proptest! {
    #![proptest_config(crate::effort::cases(24))]

    /// Moving everything, the camera included, by a rigid motion that is exact
    /// in binary moves nothing in the image.
    #[test]
    fn only_the_placement_relative_to_the_camera_counts(x in -1000_i32..1000, y in -1000_i32..1000) {
        let image = |offset: DVec3| {
            let mut scene = Scene::new();
            let cube = in_triangles(&primitives::cube(1.0));
            let cube = scene.add_object("cube", cube, Material::from_color(Vec3::X));
            scene.node_mut(cube).expect("there").transform.set_translation(offset);
            draw_as_rays_meet(&scene, &Camera::look_at(offset + DVec3::new(2.0, 1.0, 3.0), offset, DVec3::Y))
        };
        prop_assert_eq!(image(DVec3::ZERO), image(DVec3::new(f64::from(x), f64::from(y), 0.5)));
    }

    /// A child under a chain of parents lands where the product of their maps
    /// says, whichever way it is asked for.
    #[test]
    fn world_transforms_are_products(chain in prop::collection::vec(any_transform(), 1..6)) {
        let mut scene = Scene::new();
        let mut last: Option<NodeId> = None;
        for transform in &chain {
            let node = Node::default().with_transform(*transform);
            last = Some(match last {
                Some(parent) => scene.add_child(parent, node).expect("the parent is there"),
                None => scene.add(node),
            });
        }
        let last = last.expect("at least one node");
        let product = chain.iter().fold(DAffine3::IDENTITY, |outer, inner| outer * own_map(inner));
        let world = scene.world_transform(last);
        let visible = scene.visible_transforms()[last.index()].expect("visible");
        // At most six rotations and sums of terms below 20: 1e-13 is 500 units in
        // the last place of such a sum.
        for found in [world, visible] {
            prop_assert!(found.abs_diff_eq(product, 1e-13), "{:?} and {:?}", found, product);
        }
    }

    /// Every style draws the object in the same place: faces that only hide
    /// cover what lit faces cover.
    #[test]
    fn styles_agree_on_where_the_object_is(turn in any_transform()) {
        let mut scene = Scene::new();
        let solid = scene.add_object("solid", primitives::octahedron(1.0), Material::default());
        scene.node_mut(solid).expect("there").transform = turn;
        let camera = scene.overview(4.0 / 3.0);
        let covered = |style| {
            let settings = RenderSettings { style, ..settings() };
            let ids = render(&scene, &camera, &settings).expect("in range").object_ids.expect("asked for");
            ids.iter().map(|&id| id != u32::MAX).collect::<Vec<_>>()
        };
        let [surface, hidden, wires] = [Style::Surface, Style::HiddenLine, Style::Wireframe].map(covered);
        prop_assert!(surface == hidden, "edges beside the faces show in colours alone");
        prop_assert!(wires.contains(&true), "edges are seen");
    }
}
