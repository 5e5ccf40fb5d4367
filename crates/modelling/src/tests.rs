//! Random elementary changes on random meshes, a third of them non-manifold or open.

use proptest::prelude::*;
use trigon_math::{Vec2, Vec3, Vec4};
use trigon_mesh::{Attributes, Mesh, MeshBuilder, primitives};

use super::*;

/// Where the values of a corner are affine in its vertex's position.
pub(super) fn affine_uv(position: Vec3) -> Vec2 {
    Vec2::new(0.25 * position.x - 0.5 * position.y + 0.125, 0.5 * position.z + 0.25 * position.x)
}

/// The colour that belongs to a position.
pub(super) fn affine_color(position: Vec3) -> Vec4 {
    Vec4::new(position.x, position.y, position.z, position.x + position.y) * 0.25 + Vec4::splat(0.5)
}

/// A mesh with texture coordinates and colours that are affine in position.
pub(super) fn with_affine_values(mut mesh: Mesh) -> Mesh {
    let at = |&vertex: &u32| mesh.positions()[vertex as usize];
    let positions: Vec<Vec3> = mesh.corner_vertices().iter().map(at).collect();
    let attributes = Attributes {
        uv_sets: vec![positions.iter().map(|&position| affine_uv(position)).collect()],
        corner_colors: Some(positions.iter().map(|&position| affine_color(position)).collect()),
        ..mesh.attributes().clone()
    };
    mesh.set_attributes(attributes).expect("one value for each corner");
    mesh
}

/// Whether all values are still affine in position, but for rounding.
pub(super) fn keeps_affine_values(mesh: &EditMesh) -> Result<(), String> {
    for corner in mesh.corners() {
        let position = mesh.position(mesh.corner_vertex(corner));
        let uv = mesh.uv(0, corner).expect("there is one set");
        let color = mesh.color(corner).expect("there are colours");
        // Each interpolation rounds positions and values once, at the size of the mesh.
        let scale = 1e-5 * (1.0 + position.abs().max_element());
        if !uv.abs_diff_eq(affine_uv(position), scale) || !color.abs_diff_eq(affine_color(position), scale) {
            return Err(format!("{corner} at {position} has {uv} and {color}"));
        }
    }
    Ok(())
}

/// The weight that belongs to a position up to 4 m from the origin along each axis.
pub(super) fn affine_weight(position: Vec3) -> f64 {
    0.5 + 0.0625 * f64::from(position.x) - 0.03125 * f64::from(position.y) + 0.015625 * f64::from(position.z)
}

/// Adds a vertex group with weights that are affine in position, within 0 to 1.
pub(super) fn add_affine_group(mesh: &mut EditMesh, name: &str) {
    mesh.add_vertex_group(name).expect("room");
    for vertex in mesh.vertices().collect::<Vec<_>>() {
        let weight = affine_weight(mesh.position(vertex)).clamp(0.0, 1.0);
        let assignment = GroupAssignment { weight, ..GroupAssignment::default() };
        mesh.assign_to_vertex_group(name, &[vertex], &assignment).expect("it exists");
    }
}

/// Polygons over random vertices: anything may touch anything.
fn soup() -> impl Strategy<Value = Mesh> {
    let vertices = prop::collection::vec(prop::array::uniform3(-4i8..4), 4..20);
    let faces = prop::collection::vec(prop::collection::vec(any::<u32>(), 3..7), 1..16);
    let edges = prop::collection::vec((any::<u32>(), any::<u32>()), 0..4);
    (vertices, faces, edges).prop_map(|(vertices, faces, edges)| {
        let mut builder = MeshBuilder::new();
        for [x, y, z] in &vertices {
            builder.push_vertex(Vec3::new(f32::from(*x), f32::from(*y), f32::from(*z)));
        }
        let vertex = |index: u32| index % vertices.len() as u32;
        for face in faces {
            let face: Vec<u32> = face.into_iter().map(vertex).collect();
            // Some name too few vertices.
            drop(builder.push_face(&face));
        }
        for (from, to) in edges {
            drop(builder.push_loose_edge(vertex(from), vertex(to)));
        }
        // Faces that visit a vertex twice are cut when they are made editable; afterwards numbers stay.
        EditMesh::from_mesh(&builder.build()).0.to_mesh().0
    })
}

/// Closed, open and non-manifold meshes of some dozen faces, with values.
pub(super) fn meshes() -> impl Strategy<Value = Mesh> {
    let closed = prop_oneof![
        Just(primitives::cube(2.0)),
        Just(primitives::torus(2.0, 0.5, 6, 5)),
        Just(primitives::icosphere(1.0, 1)),
        Just(primitives::cylinder(1.0, 2.0, 7)),
    ];
    let open = (1u32..5, 1u32..5).prop_map(|(x, y)| primitives::grid(2.0, 3.0, x, y));
    prop_oneof![4 => closed, 1 => open, 2 => soup()].prop_map(with_affine_values)
}

/// Undoing all changes of a mesh gives the first bytes, redoing all the last.
pub(super) fn check_undo_and_redo(
    mut mesh: EditMesh,
    first: &EditMesh,
    differences: &mut [Difference],
) -> Result<(), TestCaseError> {
    let last = mesh.clone();
    differences.iter_mut().rev().for_each(|difference| difference.apply(&mut mesh));
    prop_assert!(mesh == *first, "undone");
    differences.iter_mut().for_each(|difference| difference.apply(&mut mesh));
    prop_assert!(mesh == last, "redone");
    Ok(())
}

/// Runs an operation on a copy of a mesh and checks what holds for each: the structure is whole
/// afterwards, a refusal changes nothing, undoing gives the first bytes and redoing the last. The
/// mesh afterwards and what the operation returned; `None` if it was refused.
pub(super) fn check_operation<T>(
    before: &EditMesh,
    operation: impl FnOnce(&mut EditMesh) -> Result<T, Refusal>,
) -> Result<Option<(EditMesh, T)>, String> {
    let mut mesh = before.clone();
    let Ok((result, mut difference)) = mesh.transaction(operation) else {
        return if mesh == *before { Ok(None) } else { Err("a refusal changed the mesh".into()) };
    };
    mesh.check_structure()?;
    let after = mesh.clone();
    difference.apply(&mut mesh);
    if mesh != *before {
        return Err("undoing does not give the first mesh".into());
    }
    difference.apply(&mut mesh);
    if mesh == after { Ok(Some((after, result))) } else { Err("redoing does not give the last mesh".into()) }
}

/// Which elementary change, and two numbers that choose elements.
type Step = (u8, u32, u32);

/// Does one step where it is possible; whether it was.
fn step(mesh: &mut EditMesh, (kind, a, b): Step) -> Result<(), Refusal> {
    let pick = |index: u32, capacity: usize| index % capacity.max(1) as u32;
    let vertex = |mesh: &EditMesh, index| VertexId(pick(index, mesh.vertex_capacity()));
    let edge = |mesh: &EditMesh, index| EdgeId(pick(index, mesh.edge_capacity()));
    let face = |mesh: &EditMesh, index| FaceId(pick(index, mesh.face_capacity()));
    match kind % 12 {
        0 | 1 => mesh.split_edge(edge(mesh, a), f64::from(b % 9) / 8.0).map(drop),
        2 | 3 => {
            let face = face(mesh, a);
            mesh.check_face(face)?;
            let size = mesh.face_size(face) as u32;
            let corners: Vec<CornerId> = mesh.face_corners(face).collect();
            let corner = |index: u32| corners[(index % size) as usize];
            mesh.split_face(corner(b), corner(b / size)).map(drop)
        }
        4 => mesh.join_edges(vertex(mesh, a)).map(drop),
        5 => mesh.join_faces(edge(mesh, a)).map(drop),
        6 => mesh.merge_vertices(&[(vertex(mesh, a), vertex(mesh, b))]),
        7 => mesh.flip_face(face(mesh, a)),
        8 => mesh.remove_face(face(mesh, a)),
        9 => mesh.remove_edge(edge(mesh, a)),
        10 => {
            let position = Vec3::new(a as u8 as f32, b as u8 as f32, 1.0) / 64.0;
            let new = mesh.add_vertex(position)?;
            let face = face(mesh, b);
            mesh.check_face(face)?;
            let mut vertices: Vec<VertexId> = mesh.face_vertices(face).collect();
            vertices[0] = new;
            let added = mesh.add_face(&vertices)?;
            let corners: Vec<CornerId> = mesh.face_corners(added).collect();
            for corner in corners {
                let position = mesh.position(mesh.corner_vertex(corner));
                mesh.set_uv(0, corner, affine_uv(position));
                mesh.set_color(corner, affine_color(position));
            }
            Ok(())
        }
        _ => {
            mesh.remove_face(face(mesh, a))?;
            mesh.remove_vertex(vertex(mesh, b))
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// After each step the structure is whole and values are affine in position; a refusal
    /// changes nothing; undoing all gives the first bytes, redoing all the last.
    #[test]
    fn random_elementary_changes_keep_every_rule(
        start in meshes(),
        steps in prop::collection::vec((any::<u8>(), any::<u32>(), any::<u32>()), 1..40),
    ) {
        let (mut mesh, _) = EditMesh::from_mesh(&start);
        prop_assert_eq!(mesh.check_structure(), Ok(()));
        let first = mesh.clone();
        let mut differences = Vec::new();
        for s in steps {
            let before = mesh.clone();
            match mesh.transaction(|mesh| step(mesh, s)) {
                Ok(((), difference)) => differences.push(difference),
                Err(_) => prop_assert!(mesh == before, "a refusal changes nothing"),
            }
            prop_assert_eq!(mesh.check_structure(), Ok(()), "after {:?}", s);
            // Merging moves faces' corners to other places.
            if s.0 % 12 != 6 {
                let was = keeps_affine_values(&before);
                prop_assert!(was.is_err() || keeps_affine_values(&mesh).is_ok(), "after {:?}", s);
            }
        }
        check_undo_and_redo(mesh, &first, &mut differences)?;
    }

    #[test]
    fn a_mesh_that_is_not_edited_comes_back_as_it_was(start in meshes()) {
        let (mesh, left_out) = EditMesh::from_mesh(&start);
        let (back, map) = mesh.to_mesh();
        if left_out.repeated_corners == 0 && left_out.cut_faces == 0 {
            prop_assert_eq!(back.edges(), start.edges());
            prop_assert_eq!(&back, &start);
        }
        let edges = map.edges(&back, &mesh);
        prop_assert_eq!(edges.len(), back.edge_count());
        for (ends, &edge) in back.edges().iter().zip(&edges) {
            let mut known = mesh.edge_vertices(edge);
            known.sort_unstable();
            prop_assert_eq!(known, ends.map(|vertex| map.vertices[vertex as usize]));
        }
    }
}

#[test]
fn an_edge_that_is_split_and_joined_again_is_one() {
    let (mut mesh, _) = EditMesh::from_mesh(&with_affine_values(primitives::cube(2.0)));
    let edge = EdgeId(0);
    mesh.set_crease(edge, 0.5);
    let split = mesh.split_edge(edge, 0.25).expect("a cube has edges");
    assert_eq!((mesh.vertex_count(), mesh.edge_count()), (9, 13), "one more of each");
    assert_eq!(mesh.face_corners(FaceId(0)).count(), mesh.face_size(FaceId(0)), "corners are counted");
    assert_eq!(mesh.crease(split.edge), 0.5, "marks are copied");
    let joined = mesh.join_edges(split.vertex).expect("it is between two edges");
    assert_eq!((mesh.vertex_count(), mesh.edge_count()), (8, 12), "as before");
    assert_eq!(mesh.crease(joined), 0.5, "and kept");
    mesh.check_structure().expect("whole");
}

#[test]
fn a_face_that_is_cut_and_joined_again_is_one() {
    let (mut mesh, _) = EditMesh::from_mesh(&with_affine_values(primitives::cube(2.0)));
    let corners: Vec<CornerId> = mesh.face_corners(FaceId(0)).collect();
    let split = mesh.split_face(corners[0], corners[2]).expect("a diagonal");
    assert_eq!((mesh.face_count(), mesh.face_size(FaceId(0)), mesh.face_size(split.face)), (7, 3, 3), "cut");
    let joined = mesh.join_faces(split.edge).expect("two faces meet there");
    assert_eq!((mesh.face_count(), mesh.edge_count(), mesh.face_size(joined)), (6, 12, 4), "joined");
    mesh.check_structure().expect("whole");
    keeps_affine_values(&mesh).expect("no value was moved");
}

#[test]
fn merging_the_corners_of_a_cubes_face_makes_a_pyramid() {
    let (mut mesh, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    let vertices: Vec<VertexId> = mesh.face_vertices(FaceId(0)).collect();
    let pairs: Vec<_> = vertices[1..].iter().map(|&vertex| (vertex, vertices[0])).collect();
    mesh.merge_vertices(&pairs).expect("four into one");
    assert_eq!((mesh.vertex_count(), mesh.edge_count(), mesh.face_count()), (5, 8, 5), "a pyramid");
    mesh.check_structure().expect("whole");
}

#[test]
fn the_hub_of_a_fan_does_not_make_edges_slow_to_find() {
    let mut mesh = EditMesh::new();
    let hub = mesh.add_vertex(Vec3::ZERO).expect("room");
    let rim: Vec<VertexId> = (0..100_000).map(|_| mesh.add_vertex(Vec3::X).expect("room")).collect();
    for pair in rim.windows(2) {
        mesh.add_face(&[hub, pair[0], pair[1]]).expect("three vertices");
    }
    for &vertex in &rim {
        // In quadratic time this would not end.
        assert!(mesh.find_edge(hub, vertex).is_some(), "{vertex}");
    }
    mesh.remove_vertex(hub).expect("it is there");
}

#[test]
fn a_difference_that_only_adds_is_not_empty() {
    let mut mesh = EditMesh::from_mesh(&primitives::cube(2.0)).0;
    let (_, added) = mesh.transaction(|mesh| mesh.add_vertex(Vec3::X)).expect("room");
    assert!(!added.is_empty(), "there is a vertex more");
    let ((), nothing) = mesh.transaction(|_| Ok::<(), Refusal>(())).expect("nothing is done");
    assert!(nothing.is_empty(), "nothing was done");
}

#[test]
fn marks_of_any_element_are_changes_and_positions_are_none() {
    type Change = fn(&mut EditMesh, u32);
    let mut mesh = EditMesh::from_mesh(&primitives::cube(1.0)).0;
    let changes: [(&str, Change, bool); 4] = [
        ("a vertex", |mesh, index| mesh.set_vertex_hidden(VertexId::new(index), true), true),
        ("an edge", |mesh, index| mesh.set_sharp(EdgeId::new(index), true), true),
        ("a face", |mesh, index| mesh.set_smooth(FaceId::new(index), true), true),
        ("a place", |mesh, index| mesh.set_position(VertexId::new(index), Vec3::ZERO), false),
    ];
    for (what, change, is_mark) in changes {
        let done = mesh.transaction(|mesh| {
            change(mesh, 0);
            Ok::<_, Refusal>(())
        });
        let (_, difference) = done.expect("it is not refused");
        assert_eq!(difference.changes_marks(), is_mark, "{what}");
    }
}
