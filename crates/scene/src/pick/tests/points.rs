//! Picks against rays in f64 through every pixel.

use std::collections::BTreeSet;

use trigon_camera::{Camera, Projector, Viewport};
use trigon_math::{DVec2, DVec3, Vec3};
use trigon_mesh::{Deltas, MeshChange, MorphTarget, primitives};

use super::super::region::center;
use super::oracle::{Lens, in_world};
use crate::{
    AlphaMode, CachedPoints, ElementSet, Frame, Material, NodeId, Outputs, Picker, Reach, Region,
    RenderSettings, Scene, Transform, render,
};

const SIZE: [u32; 2] = [73, 55];

fn draw(scene: &Scene, camera: &Camera) -> Frame {
    let outputs = Outputs { ids: true, ..Outputs::NONE };
    let [width, height] = SIZE;
    let settings = RenderSettings { outputs, samples_per_axis: 1, ..RenderSettings::new(width, height) };
    render(scene, camera, &settings).expect("drawn")
}

fn camera() -> Camera {
    Camera::look_at(DVec3::new(2.5, 2.0, 4.0), DVec3::ZERO, DVec3::Y)
}

fn solids() -> Scene {
    let mut scene = Scene::new();
    scene.add_object("dodecahedron", primitives::dodecahedron(0.8), Material::default());
    let cube = scene.add_object("cube", primitives::cube(0.9), Material::default());
    scene.node_mut(cube).expect("just added").transform =
        Transform::from_translation(DVec3::new(0.9, 0.3, 0.6));
    scene
}

fn rectangle(min: [f64; 2], max: [f64; 2]) -> Region {
    Region::Rectangle { min: min.into(), max: max.into() }
}

/// How many faces, vertices and edges are found.
fn counts(picker: &Picker<'_>, region: &Region, reach: Reach) -> [usize; 3] {
    let found = [picker.faces(region, reach), picker.vertices(region, reach), picker.edges(region, reach)];
    found.map(|elements: ElementSet| elements.len())
}

/// The triangles of all objects in the world: node, face, corners.
fn triangles(scene: &Scene) -> Vec<(NodeId, usize, [DVec3; 3])> {
    let mut all = Vec::new();
    for (id, node) in scene.nodes().iter() {
        let mesh = scene.meshes().get(node.mesh.expect("an object")).expect("its mesh").mesh();
        let world = in_world(scene, id);
        for face in 0..mesh.face_count() {
            // Flat and convex, so a fan covers them.
            let around = mesh.face_vertices(face);
            let place = |vertex: u32| world.transform_point3(mesh.positions()[vertex as usize].as_dvec3());
            for pair in around[1..].windows(2) {
                all.push((id, face, [around[0], pair[0], pair[1]].map(place)));
            }
        }
    }
    all
}

/// How far along a ray a triangle is, and the least share of a corner there.
fn meet((origin, direction): (DVec3, DVec3), [a, b, c]: [DVec3; 3]) -> (f64, f64) {
    let normal = (b - a).cross(c - a);
    let distance = (a - origin).dot(normal) / direction.dot(normal);
    let point = origin + direction * distance;
    let share =
        |from: DVec3, to: DVec3| (to - from).cross(point - from).dot(normal) / normal.length_squared();
    (distance, share(a, b).min(share(b, c)).min(share(c, a)))
}

#[test]
fn every_pixel_is_what_a_ray_meets_first() {
    let (scene, camera) = (solids(), camera());
    let frame = draw(&scene, &camera);
    let picker = Picker::new(&scene, &camera, &frame);
    let lens = Lens::new(&camera, DVec2::from(SIZE.map(f64::from)));
    let triangles = triangles(&scene);
    let (mut checked, mut skipped) = (0, 0);
    for (x, y) in (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y))) {
        let ray = lens.ray(DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5));
        let met: Vec<_> =
            triangles.iter().map(|&(node, face, corners)| (meet(ray, corners), node, face)).collect();
        // Within 1/100 of an outline, vertices on the sub-pixel grid may decide
        // otherwise: there the neighbour is as right.
        let close = met.iter().any(|((_, share), ..)| share.abs() < 0.01);
        let inside = met.iter().filter(|((distance, share), ..)| *distance > 0.0 && *share >= 0.0);
        let first = inside.min_by(|a, b| a.0.0.total_cmp(&b.0.0));
        let pick = picker.at(x, y);
        let expected = first.map(|&(_, node, face)| (node, Some(face)));
        let agrees = pick.map(|pick| (pick.hit.node, pick.hit.face)) == expected;
        assert!(agrees || close, "{pick:?} is not {expected:?} at {x}, {y}");
        if agrees { checked += 1 } else { skipped += 1 }
    }
    assert!(skipped * 50 < checked, "{skipped} pixels at outlines, {checked} elsewhere");
}

#[test]
fn the_nearest_vertex_and_edge_are_those_of_all_of_the_polygon() {
    let (scene, camera) = (solids(), camera());
    let frame = draw(&scene, &camera);
    let picker = Picker::new(&scene, &camera, &frame);
    let projector = Projector::new(&camera, Viewport { width: SIZE[0], height: SIZE[1] });
    let mut count = 0;
    for (x, y) in (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y))) {
        let Some(pick) = picker.at(x, y) else { continue };
        count += 1;
        let node = scene.node(pick.hit.node).expect("picked");
        let mesh = scene.meshes().get(node.mesh.expect("an object")).expect("its mesh").mesh();
        let world = scene.world_transform(pick.hit.node);
        let screen = |vertex: u32| {
            let point = world.transform_point3(mesh.positions()[vertex as usize].as_dvec3());
            projector.to_screen(point).expect("before the eye")
        };
        let around = mesh.face_vertices(pick.hit.face.expect("a polygon"));
        let (vertex, edge) = (pick.vertex.expect("has corners"), pick.edge.expect("has sides"));
        let at = center(x, y);
        let least = around.iter().map(|&other| screen(other).distance(at)).fold(f64::INFINITY, f64::min);
        assert_eq!(screen(vertex).distance(at), least, "the nearest corner at {x}, {y}");
        // Points along each side, one a thousandth of it.
        let along = |from: u32, to: u32| {
            let [from, to] = [screen(from), screen(to)];
            (0..=1000)
                .map(|i| from.lerp(to, f64::from(i) / 1000.0).distance(at))
                .fold(f64::INFINITY, f64::min)
        };
        let sides = (0..around.len()).map(|i| along(around[i], around[(i + 1) % around.len()]));
        let least = sides.fold(f64::INFINITY, f64::min);
        let [from, to] = mesh.edges()[edge as usize];
        assert!(around.contains(&from) && around.contains(&to), "an edge of the polygon");
        assert!(along(from, to) <= least + 1e-9, "the nearest side at {x}, {y}");
    }
    assert!(count > 300, "{count} pixels see something");
}

#[test]
fn a_rectangle_finds_what_is_seen_in_it_and_nothing_behind() {
    let mut scene = Scene::new();
    let front = scene.add_object("front", primitives::cube(1.0), Material::default());
    let hidden = scene.add_object("hidden", primitives::cube(0.5), Material::default());
    scene.node_mut(hidden).expect("just added").transform = Transform::from_translation(DVec3::Z * -3.0);
    let camera = Camera::look_at(DVec3::Z * 5.0, DVec3::ZERO, DVec3::Y);
    let frame = draw(&scene, &camera);
    let picker = Picker::new(&scene, &camera, &frame);
    let whole = rectangle([0.0, 0.0], [f64::MAX, f64::MAX]);
    let nodes = |region, reach| picker.nodes(region, reach);
    assert_eq!(nodes(&whole, Reach::Visible), BTreeSet::from([front]), "the other one is hidden");
    assert_eq!(nodes(&whole, Reach::Through), BTreeSet::from([front, hidden]), "and is found through it");
    assert_eq!(counts(&picker, &whole, Reach::Visible), [1, 4, 4], "one side of the cube");
    assert_eq!(counts(&picker, &whole, Reach::Through), [8, 16, 24], "of the far one two sides are all");
    let [width, height] = SIZE.map(f64::from);
    let left = rectangle([0.0, 0.0], [width / 2.0, height]);
    assert_eq!(counts(&picker, &left, Reach::Visible), [1, 2, 3], "its left half");
    let corner = rectangle([0.0, 0.0], [3.0, 3.0]);
    assert_eq!(counts(&picker, &corner, Reach::Through), [0; 3], "a corner of the image is empty");
    assert_eq!(picker.at(SIZE[0], 0), None, "outside the image");
}

#[test]
fn vertices_are_found_where_poses_put_them() {
    let mut scene = Scene::new();
    let mut mesh = primitives::plane(1.0, 1.0);
    let positions = Deltas::from_dense(vec![Vec3::X * 2.0; mesh.vertex_count()]);
    let target = MorphTarget { positions, ..MorphTarget::default() };
    let attributes = trigon_mesh::Attributes { morph_targets: vec![target], ..mesh.attributes().clone() };
    mesh.set_attributes(attributes).expect("one delta each");
    let node = scene.add_object("moved", mesh.clone(), Material::default());
    scene.node_mut(node).expect("just added").morph_weights = vec![0.5];
    let camera = Camera::look_at(DVec3::Y * 6.0, DVec3::ZERO, DVec3::NEG_Z);
    let frame = draw(&scene, &camera);
    let picker = Picker::new(&scene, &camera, &frame);
    let projector = Projector::new(&camera, Viewport { width: SIZE[0], height: SIZE[1] });
    // Towards its corner at x = −0.5 + 1, z = −0.5.
    let at = projector.to_screen(DVec3::new(0.55, 0.0, -0.45)).expect("before the eye");
    let pick = picker.at(at.x as u32, at.y as u32).expect("the plane is there");
    let vertex = mesh.positions()[pick.vertex.expect("has corners") as usize];
    assert_eq!(vertex.to_array(), [-0.5, 0.0, -0.5], "the corner at rest that was moved there");
    assert!(picker.at(5, 27).is_none(), "nothing is left where it was");
}

/// Of what is masked or blended only the pixels hide that it wins.
#[test]
fn glass_and_holes_hide_nothing() {
    use crate::AlphaMode::{Blend, Mask, Opaque};
    let cases = [
        (Opaque, 1.0, 0, "a wall hides the corners"),
        (Blend, 0.5, 4, "glass hides none"),
        (Mask { cutoff: 0.5 }, 1.0, 0, "a mask without holes does"),
        (Mask { cutoff: 0.5 }, 0.2, 4, "where there is a hole it does not"),
    ];
    for (alpha_mode, alpha, expected, what) in cases {
        let mut scene = Scene::new();
        let cube = scene.add_object("cube", primitives::cube(1.0), Material::default());
        let base_color = trigon_math::Vec4::new(1.0, 1.0, 1.0, alpha);
        let material = Material { alpha_mode, base_color, ..Material::default() };
        let wall = scene.add_object("wall", primitives::cube(1.5), material);
        scene.node_mut(wall).expect("just added").transform = Transform::from_translation(DVec3::Z * 2.0);
        let camera = Camera::look_at(DVec3::Z * 6.0, DVec3::ZERO, DVec3::Y);
        let frame = draw(&scene, &camera);
        let picker = Picker::new(&scene, &camera, &frame);
        let found = picker.vertices(&rectangle([0.0, 0.0], [99.0, 99.0]), Reach::Visible);
        assert_eq!(found.iter().filter(|&(node, _)| node == cube).count(), expected, "{what}");
    }
}

#[test]
fn the_nearest_elements_are_found_within_a_radius_only() {
    let mut scene = Scene::new();
    let cube = scene.add_object("cube", primitives::cube(1.0), Material::default());
    let camera = Camera::look_at(DVec3::Z * 5.0, DVec3::ZERO, DVec3::Y);
    let frame = draw(&scene, &camera);
    let picker = Picker::new(&scene, &camera, &frame);
    let projector = Projector::new(&camera, Viewport { width: SIZE[0], height: SIZE[1] });
    let corner = DVec3::new(0.5, 0.5, 0.5);
    let at = projector.to_screen(corner).expect("before the eye");
    let near = at + DVec2::new(2.0, -2.0);
    let found = picker.nearest(near, 4.0, Reach::Visible);
    let mesh = primitives::cube(1.0);
    let (node, vertex) = found.vertex.expect("the corner is less than 4 pixels away");
    assert_eq!((node, mesh.positions()[vertex as usize].as_dvec3()), (cube, corner), "that corner");
    let (_, edge) = found.edge.expect("and so are two sides");
    assert!(mesh.edges()[edge as usize].contains(&vertex), "an edge of the corner");
    assert!(found.face.is_some(), "a pixel of the face is less than 4 pixels away");
    let none = picker.nearest(near, 0.9, Reach::Through);
    assert_eq!(none, crate::Nearest::default(), "nothing is as near as that");
    // The corner behind it is seen further inside.
    let behind = projector.to_screen(DVec3::new(0.5, 0.5, -0.5)).expect("before the eye");
    let vertex_at = |reach| picker.nearest(behind, 0.5, reach).vertex;
    assert_eq!(vertex_at(Reach::Visible), None, "it is hidden");
    let (_, vertex) = vertex_at(Reach::Through).expect("it is there");
    assert_eq!(mesh.positions()[vertex as usize].z, -0.5, "the one behind");
}

#[test]
fn points_that_are_kept_change_nothing_but_the_time() {
    let mut scene = solids();
    let nodes: Vec<NodeId> = scene.nodes().iter().map(|(node, _)| node).collect();
    let region = rectangle([0.0, 0.0], [SIZE[0].into(), SIZE[1].into()]);
    let mut kept = CachedPoints::default();
    let step = |scene: &mut Scene, number: usize| match number {
        1 => {
            let moved = Transform::from_translation(DVec3::X * 0.1);
            scene.node_mut(nodes[0]).expect("it is there").transform = moved;
        }
        2 => {
            let mesh = scene.node(nodes[0]).and_then(|node| node.mesh).expect("a solid");
            let positions = vec![(0, Vec3::new(0.1, 0.2, 2.0))];
            let change = MeshChange { positions, ..MeshChange::default() };
            scene.change_mesh(mesh, &change).expect("it has a vertex");
        }
        5 => scene.materials.iter_mut().for_each(|(_, material)| material.double_sided ^= true),
        6 => scene.node_mut(nodes[0]).expect("it is there").visible = false,
        7 => scene.materials.iter_mut().for_each(|(_, material)| material.alpha_mode = AlphaMode::Blend),
        _ => {}
    };
    for number in 0..8 {
        step(&mut scene, number);
        let seen_from = DVec3::new(if number >= 4 { 0.5 } else { 0.0 }, 0.0, 0.0);
        let camera = Camera { position: camera().position + seen_from, ..camera() };
        let frame = draw(&scene, &camera);
        let picker = Picker::with_points(&scene, &camera, &frame, &kept);
        assert_eq!(picker.visible.get().is_some(), number == 3, "{number}: only then nothing has changed");
        let alone = Picker::new(&scene, &camera, &frame);
        for is_ahead in [false, true] {
            if is_ahead {
                picker.find_visible_vertices();
            }
            for reach in [Reach::Visible, Reach::Through] {
                let vertices = picker.vertices(&region, reach);
                assert_eq!(vertices, alone.vertices(&region, reach), "{number}: {reach:?}");
                assert_eq!(picker.edges(&region, reach), alone.edges(&region, reach), "{number}: {reach:?}");
            }
        }
        kept = picker.points();
        assert_eq!(kept.visible.is_some(), number < 7, "{number}: not where pixels decide what a face hides");
        let shown = if number < 6 { nodes.len() } else { nodes.len() - 1 };
        assert_eq!(kept.objects.iter().flatten().count(), shown, "those of all solids");
    }
}
