//! Operations whose result would take more memory than is allowed are refused before they change anything.

use trigon_math::{DAffine3, DVec3, Plane, Vec3};
use trigon_mesh::primitives;

use super::*;
use crate::modifier::{DecimateSettings, SolidifySettings};
use crate::tests::with_affine_values;
use crate::{EdgeId, EditMesh, FaceId, Refusal, VertexId};

type Operation = fn(&mut EditMesh) -> Result<(), Refusal>;

fn faces(mesh: &EditMesh) -> Vec<FaceId> {
    mesh.faces().collect()
}

fn edges(mesh: &EditMesh) -> Vec<EdgeId> {
    mesh.edges().collect()
}

fn vertices(mesh: &EditMesh) -> Vec<VertexId> {
    mesh.vertices().collect()
}

/// The edges of the ends of a tube.
fn rims(mesh: &EditMesh) -> Vec<EdgeId> {
    mesh.edges().filter(|&edge| mesh.is_boundary(edge)).collect()
}

fn plane() -> Plane {
    Plane::from_point_and_normal(DVec3::ZERO, DVec3::X).expect("a direction")
}

/// Each on a tube without its ends.
const OPERATIONS: [(&str, Operation); 34] = [
    ("Catmull-Clark", |mesh| mesh.catmull_clark(3)),
    ("subdivide", |mesh| mesh.subdivide(&edges(mesh), 9).map(drop)),
    ("triangulate", |mesh| mesh.triangulate_faces(&faces(mesh)).map(drop)),
    ("loop cut", |mesh| {
        mesh.loop_cut(rims(mesh)[0], &LoopCutSettings { cuts: 50, ..LoopCutSettings::default() }).map(drop)
    }),
    ("bevel edges", |mesh| {
        let inner: Vec<EdgeId> = mesh.edges().filter(|&edge| !mesh.is_boundary(edge)).collect();
        mesh.bevel_edges(&inner, &BevelSettings { segments: 100, ..BevelSettings::default() }).map(drop)
    }),
    ("bevel vertices", |mesh| {
        let settings = BevelSettings { segments: 20, ..BevelSettings::default() };
        mesh.bevel_vertices(&vertices(mesh), &settings).map(drop)
    }),
    ("extrude a region", |mesh| mesh.extrude_region(&faces(mesh), ExtrudeOffset::Along(1.0)).map(drop)),
    ("extrude faces", |mesh| mesh.extrude_individual(&faces(mesh), ExtrudeOffset::Along(1.0)).map(drop)),
    ("extrude edges", |mesh| mesh.extrude_edges(&rims(mesh), DVec3::Y).map(drop)),
    ("extrude vertices", |mesh| mesh.extrude_vertices(&vertices(mesh), DVec3::Y).map(drop)),
    ("inset faces", |mesh| {
        mesh.inset_individual(&faces(mesh), Inset { thickness: 0.01, ..Inset::default() }).map(drop)
    }),
    ("inset a region", |mesh| {
        let inset = Inset { thickness: 0.01, open_borders: true, ..Inset::default() };
        mesh.inset_region(&faces(mesh), inset).map(drop)
    }),
    ("decimate", |mesh| mesh.decimate(&faces(mesh), &DecimateSettings::default()).map(drop)),
    ("solidify", |mesh| mesh.solidify_faces(&faces(mesh), &SolidifySettings::default()).map(drop)),
    ("spin", |mesh| {
        let settings = SpinSettings { center: [3.0, 0.0, 0.0], ..SpinSettings::default() };
        mesh.spin(&rims(mesh), &[], &settings).map(drop)
    }),
    ("duplicate", |mesh| mesh.duplicate(&[], &[], &faces(mesh)).map(drop)),
    ("mirror a copy", |mesh| mesh.mirror_copy(&faces(mesh), &[], &plane(), None).map(drop)),
    ("bisect", |mesh| {
        let settings = BisectSettings { fill: true, ..BisectSettings::default() };
        mesh.bisect(&faces(mesh), DVec3::ZERO, DVec3::new(1.0, 0.1, 0.2), &settings).map(drop)
    }),
    ("knife", |mesh| {
        // A hole in each face.
        let hole = |face: FaceId| {
            let corners: Vec<Vec3> = mesh.face_vertices(face).map(|vertex| mesh.position(vertex)).collect();
            let center = corners.iter().sum::<Vec3>() / corners.len() as f32;
            let all = corners.iter().chain(&corners[..1]);
            all.map(|&corner| KnifePoint::Face(face, center.lerp(corner, 0.5))).collect()
        };
        let strokes: Vec<Vec<KnifePoint>> = mesh.faces().map(hole).collect();
        mesh.knife(&strokes).map(drop)
    }),
    ("knife project", |mesh| {
        let tool = EditMesh::from_mesh(&primitives::cube(0.8)).0;
        let projection =
            KnifeProjection { transform: DAffine3::IDENTITY, direction: DVec3::X, cut_through: true };
        mesh.knife_project(&faces(mesh), &tool, &projection).map(drop)
    }),
    ("wireframe", |mesh| mesh.wireframe_faces(&faces(mesh), &WireframeSettings::default()).map(drop)),
    ("tube", |mesh| mesh.tube_edges(&rims(mesh), &TubeSettings::default()).map(drop)),
    ("extend vertices", |mesh| mesh.extend_vertices(&vertices(mesh), DVec3::X).map(drop)),
    ("poke", |mesh| mesh.poke_faces(&faces(mesh), 0.1).map(drop)),
    ("convex hull", |mesh| mesh.convex_hull(&vertices(mesh), &HullSettings::default()).map(drop)),
    ("symmetrize", |mesh| mesh.symmetrize(&faces(mesh), &plane(), 0.0).map(drop)),
    ("fill", |mesh| mesh.fill_edges(&rims(mesh)).map(drop)),
    ("make solid", |mesh| mesh.make_solid(&SolidSettings::default()).map(drop)),
    ("bridge", |mesh| mesh.bridge_edges(&rims(mesh), &BridgeSettings::default()).map(drop)),
    ("bridge with cuts", |mesh| {
        mesh.bridge_edges(&rims(mesh), &BridgeSettings { cuts: 9, ..BridgeSettings::default() }).map(drop)
    }),
    ("fill with a grid", |mesh| {
        let rim: Vec<EdgeId> = rims(mesh).into_iter().filter(|&edge| is_above(mesh, edge)).collect();
        mesh.grid_fill(&rim, GridSides::default()).map(drop)
    }),
    ("add a vertex group", |mesh| mesh.add_vertex_group("one")),
    ("join", |mesh| {
        let other = mesh.clone();
        mesh.join_mesh(&other, &DAffine3::from_translation(DVec3::X)).map(drop)
    }),
    ("split off", |mesh| mesh.split_off(&faces(mesh)[..10]).map(drop)),
];

fn is_above(mesh: &EditMesh, edge: EdgeId) -> bool {
    mesh.position(mesh.edge_vertices(edge)[0]).y > 0.0
}

fn tube() -> EditMesh {
    let (mut mesh, _) = EditMesh::from_mesh(&with_affine_values(primitives::cylinder(1.0, 2.0, 64)));
    let ends: Vec<FaceId> = mesh.faces().filter(|&face| mesh.face_size(face) > 4).collect();
    mesh.delete_faces(&ends).expect("two");
    let across = mesh.edges().find(|&edge| !mesh.is_boundary(edge)).expect("the sides have some");
    // Of two rings, so that there is no face between both rims.
    mesh.loop_cut(across, &LoopCutSettings::default()).expect("a ring");
    mesh
}

#[test]
fn what_would_take_too_much_memory_is_refused_and_changes_nothing() {
    for (name, operation) in OPERATIONS {
        let mut mesh = tube();
        let (before, bytes) = (mesh.clone(), mesh.bytes());
        let result = mesh.transaction_within(bytes as u64, operation);
        let refusal = result.map(drop).expect_err("not a byte more is allowed");
        let Refusal::Memory { needed, allowed } = refusal else { panic!("{name}: {refusal}") };
        assert_eq!(allowed, bytes as u64, "{name}");
        assert!(mesh == before && mesh.bytes() == bytes, "{name}: no list has grown");
        // One byte less than is needed is too little, and what is needed is enough.
        let again = mesh.transaction_within(needed - 1, operation);
        assert!(again.is_err() && mesh == before, "{name} with a byte too little");
        mesh.transaction_within(needed, operation).map(drop).expect(name);
        let used = used_bytes(&mesh);
        assert!(used <= needed, "{name} takes {used} bytes, and {needed} were expected");
    }
}

/// The memory of the elements that a mesh has, counted apart from the estimate: texture coordinates and colours of
/// corners are 24 bytes, records and positions of all kinds as they are defined.
fn used_bytes(mesh: &EditMesh) -> u64 {
    let [vertices, edges, corners, faces] =
        [mesh.vertex_count(), mesh.edge_count(), mesh.corner_count(), mesh.face_count()]
            .map(|count| count as u64);
    vertices * (8 + 24) + edges * 36 + corners * (28 + 24) + faces * 16
}

/// Both of these ended the program when nothing limited them.
#[test]
fn the_default_refuses_what_no_machine_has() {
    let (mut grid, _) = EditMesh::from_mesh(&primitives::grid(1.0, 1.0, 100, 100));
    let before = grid.clone();
    let refusal = grid.catmull_clark(10).expect_err("ten billion faces");
    assert!(matches!(refusal, Refusal::Memory { .. } | Refusal::TooMany), "{refusal}");
    let inner = edges(&grid);
    let settings = BevelSettings { segments: 100, width: 0.001, ..BevelSettings::default() };
    let refusal = grid.bevel_edges(&inner, &settings).expect_err("five hundred million faces");
    let told = refusal.to_string();
    assert!(told.contains("GiB") && told.contains("4.0 GiB") && told.contains("`memory`"), "{told}");
    assert!(grid == before, "nothing changed");
    let mut cube = EditMesh::from_mesh(&primitives::cube(2.0)).0;
    let once = |_: &i32| cube.transaction_within(16 << 20, |cube| cube.catmull_clark(1)).is_ok();
    let levels = (0..30).take_while(once).count();
    assert!((5..8).contains(&levels), "{levels} levels of thirty in 16 MiB");
}
