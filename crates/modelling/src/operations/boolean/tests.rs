//! Booleans against volumes that are known or computed by other means, on degenerate and on random operands.

use std::collections::BTreeMap;

use proptest::prelude::*;
use trigon_math::{DAffine3, DQuat, DVec3};
use trigon_mesh::{Mesh, primitives};

use super::*;
use crate::tests::{check_operation, keeps_affine_values, with_affine_values};
use crate::{EdgeId, VertexId};

use BooleanOperation::{Difference, Intersection, Union};

const ALL: [BooleanOperation; 3] = [Union, Difference, Intersection];

fn editable(mesh: Mesh) -> EditMesh {
    EditMesh::from_mesh(&mesh).0
}

fn cube() -> EditMesh {
    editable(primitives::cube(2.0))
}

fn moved_by(x: f64, y: f64, z: f64) -> DAffine3 {
    DAffine3::from_translation(DVec3::new(x, y, z))
}

/// The outlines of all faces, as positions.
fn faces(mesh: &EditMesh) -> Vec<Vec<DVec3>> {
    mesh.faces().map(|face| mesh.face_vertices(face).map(|v| mesh.position(v).as_dvec3()).collect()).collect()
}

/// By the divergence theorem along the x axis: the area of each face, seen along it, times its mean x.
fn volume(mesh: &EditMesh) -> f64 {
    let mut sum = 0.0;
    for outline in faces(mesh) {
        for i in 1..outline.len() - 1 {
            let [a, b, c] = [outline[0], outline[i], outline[i + 1]];
            let area = (b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y);
            sum += area / 2.0 * (a.x + b.x + c.x) / 3.0;
        }
    }
    sum
}

/// Every side of a face has exactly one opposite side, no face visits a vertex twice, and none lies on another one.
fn check_closed(mesh: &EditMesh) {
    let mut sides: BTreeMap<[VertexId; 2], usize> = BTreeMap::new();
    let mut sets = std::collections::BTreeSet::new();
    for face in mesh.faces() {
        let ring: Vec<VertexId> = mesh.face_vertices(face).collect();
        for (i, &from) in ring.iter().enumerate() {
            *sides.entry([from, ring[(i + 1) % ring.len()]]).or_default() += 1;
        }
        let mut set = ring.clone();
        set.sort_unstable();
        set.dedup();
        assert_eq!(set.len(), ring.len(), "a vertex twice in {face}");
        assert!(sets.insert(set), "{face} lies on another face");
    }
    for (&[from, to], &count) in &sides {
        assert_eq!((count, sides.get(&[to, from])), (1, Some(&1)), "the side from {from} to {to}");
    }
    mesh.check_structure().expect("whole");
}

/// Combines two meshes, checks what holds for every result, and returns it.
fn combined(a: &EditMesh, b: &EditMesh, transform: DAffine3, operation: BooleanOperation) -> EditMesh {
    let tool = BooleanTool { mesh: b, transform };
    let result = check_operation(a, |mesh| mesh.boolean(&[tool], operation)).expect("undone and done again");
    let (mesh, made) = result.expect("both are solid");
    check_closed(&mesh);
    assert!(made.faces.iter().all(|&face| mesh.has_face(face)), "faces exist");
    assert!(made.edges.iter().all(|&edge| mesh.has_edge(edge)), "edges exist");
    mesh
}

/// The volumes of union, difference and intersection.
fn volumes(a: &EditMesh, b: &EditMesh, transform: DAffine3) -> [f64; 3] {
    ALL.map(|operation| volume(&combined(a, b, transform, operation)))
}

fn assert_near(found: [f64; 3], expected: [f64; 3], name: &str) {
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found - expected).abs() < 1e-5, "{name}: {found} instead of {expected}");
    }
}

/// Boxes whose faces, edges or corners touch or coincide, with the volumes by hand.
#[test]
fn boxes_that_touch() {
    let half = editable(primitives::cube(1.0));
    let cases: [(&str, &EditMesh, DAffine3, [f64; 3]); 12] = [
        ("equal", &cube(), DAffine3::IDENTITY, [8.0, 0.0, 8.0]),
        ("touching faces", &cube(), moved_by(2.0, 0.0, 0.0), [16.0, 8.0, 0.0]),
        ("halves of faces", &cube(), moved_by(2.0, 1.0, 0.0), [16.0, 8.0, 0.0]),
        ("touching edges", &cube(), moved_by(2.0, 2.0, 0.0), [16.0, 8.0, 0.0]),
        ("touching corners", &cube(), moved_by(2.0, 2.0, 2.0), [16.0, 8.0, 0.0]),
        ("a face within another", &half, moved_by(1.5, 0.0, 0.0), [9.0, 8.0, 0.0]),
        ("a face within another, inside", &half, moved_by(0.5, 0.0, 0.0), [8.0, 7.0, 1.0]),
        ("in a corner", &half, moved_by(0.5, 0.5, 0.5), [8.0, 7.0, 1.0]),
        ("nested", &half, DAffine3::IDENTITY, [8.0, 7.0, 1.0]),
        ("disjoint", &half, moved_by(5.0, 0.0, 0.0), [9.0, 8.0, 0.0]),
        ("overlapping", &cube(), moved_by(1.0, 1.0, 1.0), [15.0, 7.0, 1.0]),
        ("along an edge", &cube(), moved_by(1.0, 0.0, 0.0), [12.0, 4.0, 4.0]),
    ];
    for (name, tool, transform, expected) in cases {
        assert_near(volumes(&cube(), tool, transform), expected, name);
    }
    let turned = DAffine3::from_rotation_y(std::f64::consts::FRAC_PI_4);
    let octagon = 8.0 * (2f64.sqrt() - 1.0) * 2.0;
    assert_near(volumes(&cube(), &cube(), turned), [16.0 - octagon, 8.0 - octagon, octagon], "turned by 45°");
    let quarter = DAffine3::from_rotation_z(std::f64::consts::FRAC_PI_2);
    assert_near(volumes(&cube(), &cube(), quarter), [8.0, 0.0, 8.0], "turned by 90°");
}

/// Numbers of vertices, edges and faces.
fn counts(mesh: &EditMesh) -> [usize; 3] {
    [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()]
}

#[test]
fn results_are_polygons_without_needless_vertices() {
    let half = editable(primitives::cube(1.0));
    let of = |tool: &EditMesh, transform, operation| counts(&combined(&cube(), tool, transform, operation));
    assert_eq!(of(&cube(), moved_by(1.0, 1.0, 1.0), Union), [20, 30, 12], "two boxes");
    assert_eq!(of(&cube(), moved_by(1.0, 1.0, 1.0), Intersection), [8, 12, 6], "a box");
    assert_eq!(of(&cube(), moved_by(1.0, 1.0, 1.0), Difference), [14, 21, 9], "a notch");
    assert_eq!(of(&cube(), DAffine3::IDENTITY, Union), [8, 12, 6], "equal boxes");
    assert_eq!(of(&cube(), moved_by(2.0, 0.0, 0.0), Difference), [8, 12, 6], "nothing cut off");
    assert_eq!(of(&half, DAffine3::IDENTITY, Difference), [16, 24, 12], "a cavity");
    assert_eq!(of(&cube(), moved_by(2.0, 1.0, 0.0), Intersection), [0, 0, 0], "nothing in common");
    assert_eq!(of(&half, DAffine3::IDENTITY, Intersection), [8, 12, 6], "what was inside");
}

/// The same polygons as before, wherever nothing was cut.
#[test]
fn untouched_faces_stay() {
    let sphere = editable(primitives::uv_sphere(1.0, 32, 16));
    let mesh = combined(&sphere, &cube(), moved_by(0.0, 1.9, 0.0), Difference);
    let same = sphere.faces().filter(|&face| {
        let ring = |mesh: &EditMesh| mesh.face_vertices(face).collect::<Vec<_>>();
        mesh.has_face(face) && ring(&mesh) == ring(&sphere)
    });
    let top = |face: FaceId| sphere.face_vertices(face).any(|vertex| sphere.position(vertex).y > 0.9);
    let untouched = sphere.faces().filter(|&face| !top(face)).count();
    assert!(untouched > 350, "{untouched} of 512");
    assert_eq!(same.count(), untouched, "with their numbers");
}

/// Values that are affine in position still are: nothing is taken from a wrong face.
#[test]
fn values_and_marks_are_carried_over() {
    let mut a = editable(with_affine_values(primitives::cube(2.0)));
    let b = editable(with_affine_values(primitives::cube(2.0)));
    let edges: Vec<EdgeId> = a.edges().collect();
    edges.iter().for_each(|&edge| a.set_sharp(edge, true));
    a.set_crease(edges[0], 0.5);
    let faces: Vec<FaceId> = a.faces().collect();
    faces.iter().for_each(|&face| a.set_material(face, 3));
    let turn = DQuat::from_rotation_y(0.3) * DQuat::from_rotation_x(0.7);
    let transform = DAffine3::from_rotation_translation(turn, DVec3::new(1.0, 0.9, 0.8));
    for operation in ALL {
        let tool = BooleanTool { mesh: &b, transform };
        let (mesh, made) =
            check_operation(&a, |mesh| mesh.boolean(&[tool], operation)).expect("undone").expect("solid");
        let own: Vec<FaceId> = mesh.faces().filter(|&face| mesh.material(face) == 3).collect();
        assert!(!own.is_empty() && own.len() < mesh.face_count(), "both have faces in the result");
        let part = mesh.extract(&[], &[], &own).expect("they exist");
        keeps_affine_values(&part).expect("of the first mesh");
        let mut back = mesh.clone();
        let others: Vec<FaceId> = mesh.faces().filter(|&face| mesh.material(face) != 3).collect();
        back = back.extract(&[], &[], &others).expect("they exist");
        let mut moved = EditMesh::new();
        moved.join_mesh(&back, &transform.inverse()).expect("few");
        keeps_affine_values(&moved).expect("of the second mesh");
        for edge in mesh.edges() {
            let is_own = mesh.edge_faces(edge).all(|face| mesh.material(face) == 3);
            assert_eq!(mesh.is_sharp(edge), is_own, "{operation:?}: sharp where the first cube's edges are");
            let is_seam = mesh.edge_faces(edge).any(|face| mesh.material(face) == 3) && !is_own;
            assert_eq!(made.edges.contains(&edge), is_seam, "{operation:?}: where both meet");
        }
    }
}

#[test]
fn what_bounds_no_volume_is_refused_with_the_position() {
    let mut open = cube();
    open.delete_faces(&[FaceId(4)]).expect("a face");
    let tool = BooleanTool { mesh: &open, transform: DAffine3::IDENTITY };
    let refusal = cube().boolean(&[tool], Union).expect_err("open");
    let Refusal::NotSolid { fault: crate::SolidFault::Open(edge), position, .. } = refusal else {
        panic!("{refusal}")
    };
    let [a, b] = open.edge_vertices(edge).map(|vertex| open.position(vertex).as_dvec3());
    assert_eq!(position, (a + b) / 2.0, "on the rim");
    assert!(refusal.to_string().contains("hole"), "{refusal}");
    let mut turned = cube();
    turned.flip_face(FaceId(2)).expect("a face");
    let refusal = turned.check_solid().expect_err("one face is turned over");
    assert!(matches!(refusal, Refusal::NotSolid { fault: crate::SolidFault::Turned(_), .. }), "{refusal}");
    let mut inside_out = cube();
    let faces: Vec<FaceId> = inside_out.faces().collect();
    inside_out.flip_faces(&faces).expect("all");
    let refusal = inside_out.check_solid().expect_err("all are");
    assert!(matches!(refusal, Refusal::NotSolid { fault: crate::SolidFault::InsideOut(_), .. }), "{refusal}");
    let mut hollow = cube();
    let mut inner = editable(primitives::cube(1.0));
    inner.flip_faces(&faces).expect("all");
    hollow.join_mesh(&inner, &DAffine3::IDENTITY).expect("few");
    hollow.check_solid().expect("a cavity looks inwards");
    assert_near(volumes(&hollow, &cube(), moved_by(1.0, 0.0, 0.0)), [11.5, 3.5, 3.5], "half a hollow cube");
}

/// Two overlapping boxes in one mesh are what both fill.
#[test]
fn operands_may_cross_themselves() {
    let mut twice = cube();
    twice.join_mesh(&cube(), &moved_by(1.0, 0.0, 0.0)).expect("few");
    assert_near(volumes(&twice, &cube(), moved_by(0.0, 1.0, 0.0)), [16.0, 8.0, 4.0], "against a cube");
}

#[test]
fn several_tools_at_once() {
    let half = editable(primitives::cube(1.0));
    let offsets = [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.5, 0.0, 0.0]];
    let tools = offsets.map(|[x, y, z]| BooleanTool { mesh: &half, transform: moved_by(x, y, z) });
    for (operation, expected) in
        [(Union, 8.0 + 4.0 * 0.5), (Difference, 8.0 - 3.0 * 0.5), (Intersection, 0.0)]
    {
        let mut mesh = cube();
        mesh.boolean(&tools, operation).expect("all are solid");
        check_closed(&mesh);
        assert!((volume(&mesh) - expected).abs() < 1e-6, "{operation:?}: {}", volume(&mesh));
    }
}

/// A part of a mesh against the others.
#[test]
fn faces_of_a_mesh_against_the_others() {
    let mut mesh = cube();
    let added = mesh.join_mesh(&cube(), &moved_by(1.0, 1.0, 1.0)).expect("few");
    let (mesh, _) = check_operation(&mesh, |mesh| mesh.boolean_of_faces(&added.faces, Difference))
        .expect("undone")
        .expect("both are closed");
    assert!((volume(&mesh) - 7.0).abs() < 1e-6, "a notch");
    assert_eq!(counts(&mesh), [14, 21, 9], "in polygons");
}

/// Whether a point is inside, by the parity of the faces' triangles that a ray crosses.
fn is_inside(faces: &[Vec<DVec3>], point: DVec3) -> bool {
    // Of no special direction.
    let ray = DVec3::new(0.612_3, 0.337_1, 0.715_9);
    let crossed = faces
        .iter()
        .flat_map(|outline| (1..outline.len() - 1).map(|i| [outline[0], outline[i], outline[i + 1]]));
    let is_crossed = |[a, b, c]: [DVec3; 3]| {
        let side = |from: DVec3, to: DVec3| ray.dot((from - point).cross(to - point)) > 0.0;
        let sides = [side(a, b), side(b, c), side(c, a)];
        let normal = (b - a).cross(c - a);
        (sides == [true; 3] || sides == [false; 3]) && (a - point).dot(normal) * ray.dot(normal) > 0.0
    };
    crossed.filter(|&triangle| is_crossed(triangle)).count() % 2 == 1
}

fn solids() -> impl Strategy<Value = Mesh> {
    prop_oneof![
        Just(primitives::cube(2.0)),
        Just(primitives::torus(1.0, 0.4, 9, 7)),
        Just(primitives::icosphere(1.2, 1)),
        Just(primitives::uv_sphere(1.1, 9, 6)),
        Just(primitives::cylinder(0.8, 2.0, 7)),
    ]
}

/// Positions on a grid, so that faces coincide often, and any.
fn transforms() -> impl Strategy<Value = DAffine3> {
    let on_grid = prop::array::uniform3(-2i8..3)
        .prop_map(|[x, y, z]| moved_by(f64::from(x) / 2.0, f64::from(y) / 2.0, f64::from(z) / 2.0));
    let any = (prop::array::uniform3(-1.0f64..1.0), prop::array::uniform3(-3.0f64..3.0), prop::bool::ANY);
    let any = any.prop_map(|([x, y, z], [a, b, c], is_mirrored)| {
        let turn = DQuat::from_rotation_x(a) * DQuat::from_rotation_y(b) * DQuat::from_rotation_z(c);
        let scale = DVec3::new(if is_mirrored { -0.8 } else { 0.8 }, 1.0, 1.0);
        DAffine3::from_scale_rotation_translation(scale, turn, DVec3::new(x, y, z))
    });
    prop_oneof![1 => on_grid, 2 => any]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn volumes_add_up_and_points_are_where_they_belong(
        a in solids(),
        b in solids(),
        transform in transforms(),
        points in prop::collection::vec(prop::array::uniform3(-1.5f64..1.5), 20),
    ) {
        let (a, b) = (editable(a), editable(b));
        let results = ALL.map(|operation| combined(&a, &b, transform, operation));
        let [union, difference, intersection] = [0, 1, 2].map(|index| volume(&results[index]));
        let mut moved = EditMesh::new();
        moved.join_mesh(&b, &transform).expect("few");
        // Each position is rounded once, by 1e-7 of at most 4 m, on surfaces of at most 60 m².
        let tolerance = 60.0 * 4.0 * 1e-7;
        prop_assert!((union + intersection - volume(&a) - volume(&moved)).abs() < tolerance);
        prop_assert!((difference + intersection - volume(&a)).abs() < tolerance);
        let solids = [faces(&a), faces(&moved)];
        let results = results.map(|mesh| faces(&mesh));
        for point in points.into_iter().map(DVec3::from) {
            let [is_in_a, is_in_b] = [0, 1].map(|index| is_inside(&solids[index], point));
            let expected = [is_in_a || is_in_b, is_in_a && !is_in_b, is_in_a && is_in_b];
            prop_assert_eq!([0, 1, 2].map(|index| is_inside(&results[index], point)), expected, "at {}", point);
        }
    }
}

#[test]
fn a_thousand_spheres() {
    let sphere = editable(primitives::uv_sphere(1.0, 8, 6));
    let mut random = trigon_math::SplitMix64::new(1);
    let mut offset = || DVec3::new(random.unit(), random.unit(), random.unit()) * 14.0;
    let tools: Vec<BooleanTool<'_>> = (1..1000)
        .map(|_| BooleanTool { mesh: &sphere, transform: DAffine3::from_translation(offset()) })
        .collect();
    let mut mesh = sphere.clone();
    mesh.boolean(&tools, Union).expect("all are solid");
    check_closed(&mesh);
    assert!(volume(&mesh) < 1000.0 * volume(&sphere), "they overlap");
}

/// As for the operations of `memory_tests.rs`, whose mesh is open.
#[test]
fn what_would_take_too_much_memory_is_refused_and_changes_nothing() {
    let sphere = editable(with_affine_values(primitives::uv_sphere(1.0, 16, 8)));
    let tool = BooleanTool { mesh: &sphere, transform: moved_by(0.5, 0.0, 0.0) };
    let mut mesh = sphere.clone();
    let bytes = mesh.bytes() as u64;
    let refusal = mesh
        .transaction_within(bytes, |mesh| mesh.boolean(&[tool], Union))
        .map(drop)
        .expect_err("no byte more");
    let Refusal::Memory { needed, allowed } = refusal else { panic!("{refusal}") };
    assert_eq!(allowed, bytes, "as given");
    assert!(mesh == sphere && mesh.bytes() as u64 == bytes, "no list has grown");
    let again = mesh.transaction_within(needed - 1, |mesh| mesh.boolean(&[tool], Union));
    assert!(again.is_err() && mesh == sphere, "with a byte too little");
    mesh.transaction_within(needed, |mesh| mesh.boolean(&[tool], Union))
        .map(drop)
        .expect("what is needed is enough");
}
