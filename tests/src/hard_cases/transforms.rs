//! Maps between nodes, meshes and the camera: deep, large, small, flat and mirrored.

use proptest::prelude::*;
use trigon_camera::{Camera, Projection};
use trigon_math::{DAffine3, DMat3, DQuat, DVec2, DVec3, Vec4, elementary};
use trigon_mesh::primitives::{self, TorusKnot};
use trigon_mesh::{Attributes, Mesh, SkinWeights};
use trigon_scene::{
    Frame, Light, Lighting, Material, Node, NodeId, RenderSettings, Scene, Shading, ShadingModel, Skin,
    Transform, render,
};
use trigon_study::oracle::DoubleDouble;

use super::flight::{check_ids, check_numbers, settings};
use super::flight_oracle::{Oracle, own_map};
use super::flight_scenes::in_triangles;
use crate::effort::cases;

const SIZE: [u32; 2] = [48, 36];

/// Seen from outside only.
fn shell() -> Material {
    Material { double_sided: false, ..Material::default() }
}

fn vector(range: std::ops::Range<f64>) -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(range).prop_map(DVec3::from_array)
}

/// A turn about any axis.
fn turn() -> impl Strategy<Value = DQuat> {
    prop::array::uniform4(-1.0..1.0_f64)
        .prop_filter("has a length", |[x, y, z, w]| x * x + y * y + z * z + w * w > 0.01)
        .prop_map(|[x, y, z, w]| DQuat::from_xyzw(x, y, z, w).normalize())
}

/// Nodes that hang on each other; the last one.
fn chain(scene: &mut Scene, transforms: &[Transform]) -> NodeId {
    let mut last = scene.add(Node::default().with_transform(transforms[0]));
    for transform in &transforms[1..] {
        let node = Node::default().with_transform(*transform);
        last = scene.add_child(last, node).expect("the parent is there");
    }
    last
}

fn show(scene: &mut Scene, node: NodeId, mesh: Mesh) {
    let (mesh, material) = (scene.add_mesh("mesh", mesh), scene.add_material(shell()));
    let node = scene.node_mut(node).expect("just added");
    (node.mesh, node.materials) = (Some(mesh), vec![material]);
}

/// The unit normal of a face by its first three corners, to the outside if they are counter-clockwise.
fn unit_normal(mesh: &Mesh, face: usize) -> DVec3 {
    let corner = |i: usize| mesh.positions()[mesh.face_vertices(face)[i] as usize].as_dvec3();
    (corner(1) - corner(0)).cross(corner(2) - corner(1)).normalize()
}

fn draw(scene: &Scene, camera: &Camera) -> Frame {
    render(scene, camera, &settings(SIZE)).expect("in range")
}

/// Rows of a map, the translation last.
type Rows<T> = [[T; 4]; 3];

fn rows(map: &DAffine3) -> Rows<f64> {
    let columns = [map.matrix3.x_axis, map.matrix3.y_axis, map.matrix3.z_axis, map.translation];
    [0, 1, 2].map(|row| columns.map(|column| column[row]))
}

fn product(outer: Rows<DoubleDouble>, inner: Rows<DoubleDouble>) -> Rows<DoubleDouble> {
    outer.map(|row| {
        [0, 1, 2, 3].map(|column| {
            let own = if column == 3 { row[3] } else { DoubleDouble::ZERO };
            (0..3).fold(own, |sum, k| sum + row[k] * inner[k][column])
        })
    })
}

/// Half to twice as large, mirrored along some axes or not.
fn link() -> impl Strategy<Value = (f64, Transform)> {
    (vector(-3.0..3.0), turn(), -1.0..1.0_f64, 0..8_u8).prop_map(
        |(translation, rotation, exponent, signs)| {
            let size = elementary::exp2(exponent);
            let sign = |axis: usize| if signs >> axis & 1 == 0 { size } else { -size };
            let scale = DVec3::from_array([0, 1, 2].map(sign));
            (size, Transform::from_scale_rotation_translation(scale, rotation, translation))
        },
    )
}

proptest! {
    #![proptest_config(cases(24))]

    /// An entry of a product is a sum of three terms, so that |fl(AB) − AB| is at most
    /// three roundings of |A||B| (N. J. Higham, "Accuracy and Stability of Numerical
    /// Algorithms", 2002, 3.5). Entries of a turn times a size s are at most s, those of
    /// |A||B| at most 3 s t: nine roundings for each of 63 products, of the product of
    /// the sizes. A translation is the sum of what each node adds in its outer nodes'
    /// space; each part takes that and eight roundings more at each of 63 nodes, when
    /// products are taken from the innermost node. Each node's own map from its quaternion
    /// is the oracle's up to six roundings of its size.
    #[test]
    fn a_chain_of_64_nodes_is_the_exact_product(links in prop::collection::vec(link(), 64)) {
        const ROUNDINGS: f64 = ((9.0 + 8.0) * 63.0 + 6.0 * 64.0) * f64::EPSILON / 2.0;
        let (mut scene, transforms) = (Scene::new(), links.iter().map(|&(_, link)| link).collect::<Vec<_>>());
        let last = chain(&mut scene, &transforms);
        let mut exact = rows(&DAffine3::IDENTITY).map(|row| row.map(DoubleDouble::from));
        let [mut size, mut reach] = [1.0, 0.0];
        for (own, link) in &links {
            exact = product(exact, rows(&own_map(link)).map(|row| row.map(DoubleDouble::from)));
            reach += size * link.translation().length();
            size *= own;
        }
        for found in [scene.world_transform(last), scene.visible_transforms()[last.index()].expect("visible")] {
            for (found, exact) in rows(&found).iter().zip(&exact) {
                for ((&found, &exact), size) in found.iter().zip(exact).zip([size, size, size, reach]) {
                    let error = (DoubleDouble::from(found) - exact).abs().to_f64();
                    prop_assert!(error <= ROUNDINGS * size, "{} is off by {}", found, error);
                }
            }
        }
    }

    /// Maps that are exact in binary leave nothing to rounding: a chain of 64 of them,
    /// mirrors among them, draws the very image of their product.
    #[test]
    fn a_chain_of_exact_maps_draws_what_one_node_draws(
        links in prop::collection::vec((0..6_usize, 0..8_u8, -1..=1_i32, prop::array::uniform3(-4..=4_i32)), 64),
    ) {
        let mut size = 0;
        let links: Vec<DAffine3> = links.into_iter().map(|(order, signs, step, offset)| {
            // The scale stays within 2^±3 on the way.
            let step = if (size + step).abs() > 3 { -step } else { step };
            size += step;
            let scale = elementary::exp2(f64::from(step));
            let orders = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
            let columns = [0, 1, 2].map(|axis| {
                DVec3::AXES[orders[order][axis]] * if signs >> axis & 1 == 0 { scale } else { -scale }
            });
            let matrix3 = DMat3::from_cols(columns[0], columns[1], columns[2]);
            DAffine3 { matrix3, translation: DVec3::from_array(offset.map(f64::from)) }
        }).collect();
        let world = links.iter().fold(DAffine3::IDENTITY, |outer, link| outer * *link);
        let nodes: Vec<Transform> = links.into_iter().map(Transform::Affine).collect();
        let image = |transforms: &[Transform]| {
            let mut scene = Scene::new();
            let last = chain(&mut scene, transforms);
            show(&mut scene, last, in_triangles(&primitives::cone(1.0, 2.0, 7)));
            let unit = elementary::exp2(f64::from(size));
            let eye = world.translation + DVec3::new(3.0, 2.0, 4.0) * unit;
            let camera = Camera::look_at(eye, world.translation, DVec3::Y);
            let mut frame = draw(&scene, &camera);
            check_ids(&frame, &Oracle::new(&scene, &camera, SIZE), "a chain of exact maps");
            // The nodes have other numbers.
            frame.object_ids = None;
            frame
        };
        let (chained, single) = (image(&nodes), image(&[Transform::Affine(world)]));
        prop_assert!(single.face_ids.as_ref().is_some_and(|ids| ids.iter().any(|&id| id != u32::MAX)), "seen");
        prop_assert!(chained == single, "the images differ");
    }

    /// Everything 2ᵏ times as large, from 10⁻⁹ to 10⁹, looks the same to the bit, whether
    /// the mesh is that large or its node: no square leaves the range on the way.
    #[test]
    fn scale_does_not_matter_from_a_nanometre_to_a_million_kilometres(
        exponent in -30..=30_i32, inner in -30..=30_i32, eye in vector(-1.0..1.0),
        shading in prop_oneof![Just(ShadingModel::Flat), Just(ShadingModel::Gouraud), Just(ShadingModel::Phong)],
    ) {
        let image = |exponent: i32, inner: i32| {
            let power = |exponent: i32| elementary::exp2(f64::from(exponent));
            let (size, own) = (power(exponent), power(inner));
            let mut scene = Scene::new();
            let mesh = primitives::icosphere(1.0, 1).transformed(&DAffine3::from_scale(DVec3::splat(own)));
            let ball = scene.add_object("ball", mesh, shell());
            scene.node_mut(ball).expect("just added").transform.scale_by(DVec3::splat(size / own));
            let projection = Projection::perspective(0.7, size / 16.0, None).expect("positive");
            let camera = Camera::look_at(eye.normalize_or(DVec3::X) * size * 3.0, DVec3::ZERO, DVec3::Y)
                .with_projection(projection);
            let settings = RenderSettings { shading, ..settings(SIZE) };
            let mut frame = render(&scene, &camera, &settings).expect("in range");
            check_ids(&frame, &Oracle::new(&scene, &camera, SIZE), "scaled");
            frame.positions = None;
            for depth in frame.depth.iter_mut().flatten() {
                *depth /= size as f32;
            }
            frame
        };
        let (usual, scaled) = (image(0, 0), image(exponent, inner));
        prop_assert!(usual.object_ids.as_ref().is_some_and(|ids| ids.contains(&0)), "seen");
        prop_assert!(usual == scaled, "the images differ at 2^{} and 2^{}", exponent, inner);
    }

    /// What is nearly flat shows the side that is turned to the eye and not the other
    /// one, mirrored or not, although the determinant of its map is lost in rounding.
    #[test]
    fn nearly_flat_objects_show_the_right_side(
        outer in turn(), inner in turn(), exponent in 6..30_i32, mirrored in any::<bool>(),
        above in any::<bool>(), aside in prop::array::uniform2(-0.5..0.5_f64),
    ) {
        let flat = elementary::pow(10.0, -f64::from(exponent)) * if mirrored { -1.0 } else { 1.0 };
        let press = Transform::from_scale_rotation_translation(DVec3::new(1.0, flat, 1.0), outer, DVec3::ZERO);
        let turned = Transform::from_scale_rotation_translation(DVec3::ONE, inner, DVec3::ZERO);
        let mut scene = Scene::new();
        let last = chain(&mut scene, &[press, turned]);
        let solid = primitives::icosahedron(1.0);
        let heights: Vec<f64> = (0..solid.face_count()).map(|face| (inner * unit_normal(&solid, face)).y).collect();
        show(&mut scene, last, solid);
        let side = if above { 1.0 } else { -1.0 };
        let away = outer * DVec3::new(aside[0], side, aside[1]);
        let frame = draw(&scene, &Camera::look_at(away * 5.0, DVec3::ZERO, away.any_orthonormal_vector()));
        check_numbers(&frame);
        let facing = if mirrored { -side } else { side };
        let up = outer * DVec3::Y * side;
        let (faces, normals) = (frame.face_ids.expect("asked for"), frame.normals.expect("asked for"));
        let mut seen = 0;
        for (&face, normal) in faces.iter().zip(&normals).filter(|(face, _)| **face != u32::MAX) {
            let height = heights[face as usize] * facing;
            // The eye is at most two metres aside for each metre above: an edge-on face's
            // normal may lean by that times how flat it is, and it shows the eye its back
            // down to three times that.
            prop_assert!(height > -3e-6, "face {} lies on the other side: {}", face, height);
            // The pressed normal leans by at most |flat / height|, 10⁻³ here, so that the cosine
            // is 1 less half the square of that; 8 units of f32 as below are 10⁻⁶.
            prop_assert!(height < 1e-3 || normal.as_dvec3().dot(up) > 1.0 - 1.5e-6, "{} instead of {}", normal, up);
            seen += 1;
        }
        prop_assert!(seen > 100, "only {} pixels show it", seen);
    }

    /// Normals stand square to their faces under any map: sheared, mirrored, a million
    /// times longer one way than another.
    #[test]
    fn normals_stand_square_to_faces_under_any_map(
        columns in prop::array::uniform3(vector(-1.0..1.0)), exponents in prop::array::uniform3(-3.0..3.0_f64),
    ) {
        let unit = columns.map(DVec3::normalize);
        prop_assume!(unit[0].cross(unit[1]).dot(unit[2]).abs() > 0.05);
        check_normals([0, 1, 2].map(|axis| columns[axis] * elementary::pow(10.0, exponents[axis])));
    }

    /// Millimetres, ten million metres from the origin, at any offset.
    #[test]
    fn millimetres_ten_million_metres_away_are_where_rays_meet_them(
        offset in vector(-1e7..1e7), away in vector(-1.0..1.0), turned in turn(),
    ) {
        let shape = TorusKnot {
            major_radius: 0.03, minor_radius: 0.012, tube_radius: 0.004, segments: 60, sides: 4, ..TorusKnot::default()
        };
        let mut scene = Scene::new();
        let knot = scene.add_object("knot", in_triangles(&primitives::torus_knot(&shape)), shell());
        scene.node_mut(knot).expect("just added").transform =
            Transform::from_scale_rotation_translation(DVec3::ONE, turned, offset);
        let projection = Projection::perspective(0.6, 1e-3, None).expect("positive");
        let eye = offset + away.normalize_or(DVec3::X) * 0.15;
        let camera = Camera::look_at(eye, offset, DVec3::Y).with_projection(projection);
        let frame = draw(&scene, &camera);
        check_numbers(&frame);
        check_ids(&frame, &Oracle::new(&scene, &camera, SIZE), "far away");
    }
}

proptest! {
    #![proptest_config(cases(24))]

    /// A mesh that follows a joint 2ᵏ times as large, from 10⁻¹⁸ to 10¹⁸, has the very
    /// normals of one that follows a joint of its own size.
    #[test]
    fn joints_of_any_size_turn_normals_alike(turned in turn(), exponent in -60..=60_i32, flat in any::<bool>()) {
        let image = |size: f64| {
            let mut mesh = if flat { in_triangles(&primitives::cube(1.0)) } else { primitives::icosphere(1.0, 1) };
            let still = mesh.clone();
            let vertices = mesh.vertex_count();
            let skin = SkinWeights::new(1, vec![0; vertices], vec![1.0; vertices]);
            let attributes = Attributes { skin, ..mesh.attributes().clone() };
            mesh.set_attributes(attributes).expect("a joint for each vertex");
            let mut scene = Scene::new();
            let node = scene.add_object("followed", mesh, shell());
            let joint = Transform::from_scale_rotation_translation(DVec3::splat(size), turned, DVec3::ZERO);
            // The same without a joint: the node itself is where that is.
            let mut placed = Scene::new();
            let twin = placed.add_object("placed", still, shell());
            placed.node_mut(twin).expect("just added").transform = joint;
            let joint = scene.add(Node::default().with_transform(joint));
            let skin = scene.skins.insert(Skin { joints: vec![joint], ..Skin::default() });
            scene.node_mut(node).expect("just added").skin = Some(skin);
            let projection = Projection::perspective(0.7, size / 16.0, None).expect("positive");
            let camera = Camera::look_at(DVec3::new(1.0, 2.0, 3.0) * size, DVec3::ZERO, DVec3::Y)
                .with_projection(projection);
            let frame = draw(&scene, &camera);
            check_ids(&frame, &Oracle::new(&placed, &camera, SIZE), "on a joint");
            (frame.object_ids, frame.normals)
        };
        let usual = image(1.0);
        prop_assert!(usual.0.as_ref().is_some_and(|ids| ids.contains(&0)), "seen");
        prop_assert!(image(elementary::exp2(f64::from(exponent))) == usual, "2^{} differs", exponent);
    }
}

proptest! {
    #![proptest_config(cases(24))]

    /// Light on a face is the cosine between its normal and the light, and a mirror turns no normal round: a cube under
    /// a map with one or three negative factors, lit and seen from outside.
    #[test]
    fn mirrored_faces_are_lit_by_lamberts_law(
        turned in turn(), light in turn(), sizes in prop::array::uniform3(0.5..2.0_f64), mirrored in prop::sample::select(vec![1_u8, 2, 4, 7]),
    ) {
        let scale = DVec3::from_array([0, 1, 2].map(|axis| if mirrored >> axis & 1 == 1 { -sizes[axis] } else { sizes[axis] }));
        let mut scene = Scene::new();
        let white = Material { base_color: Vec4::ONE, shading: Shading::Lambert, double_sided: false, ..Material::default() };
        let cube = scene.add_object("cube", primitives::cube(1.0), white);
        scene.node_mut(cube).expect("just added").transform =
            Transform::from_scale_rotation_translation(scale, turned, DVec3::ZERO);
        let lamp = Transform::from_scale_rotation_translation(DVec3::ONE, light, DVec3::ZERO);
        scene.add(Node::from_light(Light::directional(1.0)).with_transform(lamp));
        let mut settings = RenderSettings { lighting: Lighting::Scene, ..settings(SIZE) };
        settings.outputs.radiance = true;
        let frame = render(&scene, &Camera::look_at(DVec3::new(2.0, 3.0, 5.0), DVec3::ZERO, DVec3::Y), &settings).expect("in range");
        let mesh = primitives::cube(1.0);
        let (faces, radiance) = (frame.face_ids.expect("asked for"), frame.radiance.expect("asked for"));
        let mut seen = 0;
        for (&face, shown) in faces.iter().zip(&radiance).filter(|(face, _)| **face != u32::MAX) {
            let corners: Vec<DVec3> = mesh.face_vertices(face as usize).iter()
                .map(|&vertex| turned * (mesh.positions()[vertex as usize].as_dvec3() * scale)).collect();
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[1]).normalize();
            // The cube is around the origin.
            let outside = normal * normal.dot(corners[0]).signum();
            let exact = outside.dot(light * DVec3::Z).max(0.0);
            let error = (f64::from(shown.x) - exact).abs();
            prop_assert!(error < 8.0 * f64::from(f32::EPSILON), "face {} shows {}, not {}", face, shown.x, exact);
            seen += 1;
        }
        prop_assert!(seen > 50, "only {} pixels show it", seen);
    }
}

/// Flattened to a plane, a line and a point: nothing is NaN, and the plane is seen with
/// the normals of a plane.
#[test]
fn flattened_objects_are_drawn_without_nan() {
    for scale in
        [DVec3::new(1.0, 0.0, 1.0), DVec3::new(0.0, 0.0, 1.0), DVec3::ZERO, DVec3::new(-1.0, -0.0, 1.0)]
    {
        let mut scene = Scene::new();
        let ball = scene.add_object("ball", primitives::icosphere(1.0, 2), Material::default());
        scene.node_mut(ball).expect("just added").transform.scale_by(scale);
        let frame = draw(&scene, &Camera::look_at(DVec3::new(1.0, 4.0, 2.0), DVec3::ZERO, DVec3::Y));
        check_numbers(&frame);
        let seen = frame.object_ids.iter().flatten().filter(|&&id| id == 0).count();
        let upright = frame.normals.iter().flatten().filter(|normal| normal.y.abs() == 1.0).count();
        // At the rim a smooth normal may have nothing left along the flattened axis.
        assert!((seen > 100) == (scale.x != 0.0), "scaled by {scale}: {seen} pixels show it");
        assert!(2 * upright >= seen, "scaled by {scale}: {upright} of {seen} normals are square to it");
    }
}

/// A face so thin that rounding shows the eye its back was once taken for a wrong normal.
#[test]
fn a_face_seen_edge_on_shows_its_back_by_rounding_only() {
    let columns = [
        DVec3::new(-0.5968793130672319, -0.4020702406147786, 0.0),
        DVec3::new(0.6076361706843828, 0.5369069658163824, 0.7195228885839583),
        DVec3::new(-0.9650511975229622, -0.5084630864780072, -0.2953448875909784),
    ];
    let exponents = [-2.210953865307193, -0.6292225965874402, 2.4735007322334384];
    check_normals([0, 1, 2].map(|axis| columns[axis] * elementary::pow(10.0, exponents[axis])));
}

/// Holds what is seen of a cube under a map against its faces in f64.
fn check_normals([x, y, z]: [DVec3; 3]) {
    let matrix3 = DMat3::from_cols(x, y, z);
    let mesh = in_triangles(&primitives::cube(1.0));
    let mut scene = Scene::new();
    let cube = scene.add_object("cube", mesh.clone(), shell());
    scene.node_mut(cube).expect("just added").transform =
        Transform::Affine(DAffine3 { matrix3, translation: DVec3::ZERO });
    let camera = scene.overview(4.0 / 3.0);
    let frame = draw(&scene, &camera);
    // It is there at all, where rays meet it.
    check_ids(&frame, &Oracle::new(&scene, &camera, SIZE), "any map");
    let (faces, normals) = (frame.face_ids.expect("asked for"), frame.normals.expect("asked for"));
    for (&face, normal) in faces.iter().zip(&normals).filter(|(face, _)| **face != u32::MAX) {
        let corners = <[u32; 3]>::try_from(mesh.face_vertices(face as usize)).expect("a triangle");
        let corners = corners.map(|vertex| matrix3 * mesh.positions()[vertex as usize].as_dvec3());
        let (along, across) = (corners[1] - corners[0], corners[2] - corners[1]);
        let expected = along.cross(across).normalize() * matrix3.determinant().signum();
        // Snapping moves corners by half a step on either axis, √2/512 pixel, and turns a
        // triangle over whose least height is twice that at most; the rest of a 128th is for
        // f32, whose roundings are 2⁻¹⁸ of an image of 48 pixels.
        let is_thin = least_height(corners.map(|corner| on_screen(&camera, corner))) <= 1.0 / 128.0;
        let towards = expected.dot(camera.position - corners[0]);
        assert!(towards > 0.0 || is_thin, "face {face} is seen from behind");
        // A cube's normals are axes: they pick a column of f32 entries (half a unit
        // of the last place each), and length, quotient and result round once each
        // more; twice that, as three components share it.
        let off = |expected: DVec3| (normal.as_dvec3() - expected).length();
        // Of a face that is turned over the other side's is right.
        let error = if is_thin { off(expected).min(off(-expected)) } else { off(expected) };
        assert!(error < 8.0 * f64::from(f32::EPSILON), "{normal} is off by {error}");
    }
}

/// Where a point is seen, in pixels from the middle of the image.
fn on_screen(camera: &Camera, point: DVec3) -> DVec2 {
    let Projection::Perspective { vertical_fov, .. } = camera.projection else {
        panic!("a perspective camera");
    };
    let seen = camera.orientation.conjugate() * (point - camera.position);
    let down = f64::from(SIZE[1]) / 2.0 / elementary::tan(vertical_fov / 2.0);
    DVec2::new(seen.x, -seen.y) * down / -seen.z
}

/// The least height of a triangle: twice its area over its longest side.
fn least_height([a, b, c]: [DVec2; 3]) -> f64 {
    let longest = (b - a).length().max((c - b).length()).max((a - c).length());
    (b - a).perp_dot(c - a).abs() / longest
}
