//! Closed forms of what the settings of a bevel change: width types, miters, marks, hardened normals.

use trigon_math::{DVec3, Vec3};
use trigon_mesh::primitives;

use super::*;
use crate::tests::{keeps_affine_values, with_affine_values};

fn cube() -> EditMesh {
    EditMesh::from_mesh(&with_affine_values(primitives::cube(2.0))).0
}

fn settings(width: f64, width_type: BevelWidth) -> BevelSettings {
    BevelSettings { width, width_type, ..BevelSettings::default() }
}

/// The edge of a mesh between two positions.
fn edge_between(mesh: &EditMesh, ends: [[f32; 3]; 2]) -> EdgeId {
    let at = |position: [f32; 3]| {
        mesh.vertices().find(|&vertex| mesh.position(vertex).abs_diff_eq(Vec3::from(position), 1e-6))
    };
    let [a, b] = ends.map(|end| at(end).expect("a vertex is there"));
    mesh.find_edge(a, b).expect("they are joined")
}

/// A solid between an outline at y = 0 and at y = 1, counter-clockwise seen from above.
fn prism(outline: &[[f32; 2]]) -> EditMesh {
    let mut mesh = EditMesh::new();
    let mut ring = |y: f32| -> Vec<VertexId> {
        outline.iter().map(|&[x, z]| mesh.add_vertex(Vec3::new(x, y, z)).expect("room")).collect()
    };
    let (below, above) = (ring(0.0), ring(1.0));
    mesh.add_face(&above).expect("the lid");
    mesh.add_face(&below.iter().rev().copied().collect::<Vec<_>>()).expect("the bottom");
    let count = outline.len();
    for i in 0..count {
        let next = (i + 1) % count;
        mesh.add_face(&[below[i], below[next], above[next], above[i]]).expect("a side");
    }
    EditMesh::from_mesh(&with_affine_values(mesh.to_mesh().0)).0
}

/// An equilateral triangle with sides of 1 m.
const TRIANGLE: [[f32; 2]; 3] = [[0.0, 0.0], [0.5, -0.866_025_4], [-0.5, -0.866_025_4]];
/// An L around the origin, where its outline has a reflex angle.
const L: [[f32; 2]; 6] = [[0.0, 0.0], [0.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0], [1.0, 0.0]];

/// The positions of new vertices, with 1e-6 for rounded f32.
fn check_positions(mesh: &EditMesh, made: &Beveled, expected: &[[f64; 3]]) {
    for &position in expected {
        let is_there = |&vertex: &VertexId| mesh.point(vertex).distance(DVec3::from(position)) < 1e-6;
        let positions: Vec<DVec3> = made.vertices.iter().map(|&vertex| mesh.point(vertex)).collect();
        assert!(made.vertices.iter().any(is_there), "{position:?} is not among {positions:?}");
    }
}

#[test]
fn a_width_measures_what_its_type_says_at_a_right_angle() {
    let half = 0.5f64.sqrt();
    // How far the rims move along the edges beside the bevel, which are 2 m long.
    let cases = [
        (BevelWidth::Offset, 0.25, 0.25),
        // The rims are √2 times as far apart.
        (BevelWidth::Width, 0.25, 0.25 * half),
        (BevelWidth::Depth, 0.25, 0.25 / half),
        (BevelWidth::Percent, 25.0, 0.5),
        (BevelWidth::Absolute, 0.25, 0.25),
    ];
    for (width_type, width, moved) in cases {
        let mut mesh = cube();
        let edge = edge_between(&mesh, [[1.0, 1.0, -1.0], [1.0, 1.0, 1.0]]);
        let made = mesh.bevel_edges(&[edge], &settings(width, width_type)).expect("an edge");
        assert_eq!(made.width, width, "{width_type:?}: nothing is in the way");
        for z in [-1.0, 1.0] {
            check_positions(&mesh, &made, &[[1.0 - moved, 1.0, z], [1.0, 1.0 - moved, z]]);
        }
        keeps_affine_values(&mesh).expect("interpolated");
    }
}

#[test]
fn a_width_measures_what_its_type_says_at_sixty_degrees() {
    let (sin, cos) = (0.5, 0.75f64.sqrt());
    // An upright edge: faces enclose 60°, and the edges beside it are at right angles to it.
    for (width_type, rim) in
        [(BevelWidth::Offset, 0.1), (BevelWidth::Width, 0.1 / (2.0 * sin)), (BevelWidth::Depth, 0.1 / cos)]
    {
        let mut mesh = prism(&TRIANGLE);
        let edge = edge_between(&mesh, [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        let made = mesh.bevel_edges(&[edge], &settings(0.1, width_type)).expect("an edge");
        for y in [0.0, 1.0] {
            check_positions(&mesh, &made, &[[rim * sin, y, -rim * cos], [-rim * sin, y, -rim * cos]]);
        }
    }
    // An edge of the lid: the lid's other edges leave it at 60°, those of the sides at 90°.
    for (width_type, width, on_lid, on_side) in [
        (BevelWidth::Offset, 0.1, 0.1 / cos, 0.1),
        (BevelWidth::Absolute, 0.1, 0.1, 0.1),
        (BevelWidth::Percent, 10.0, 0.1, 0.1),
    ] {
        let mut mesh = prism(&TRIANGLE);
        let edge = edge_between(&mesh, [[-0.5, 1.0, -0.866_025_4], [0.5, 1.0, -0.866_025_4]]);
        let made = mesh.bevel_edges(&[edge], &settings(width, width_type)).expect("an edge");
        for side in [-1.0, 1.0] {
            let x = side * (0.5 - on_lid * sin);
            let z = -0.866_025_4;
            check_positions(&mesh, &made, &[[x, 1.0, z + on_lid * cos], [side * 0.5, 1.0 - on_side, z]]);
        }
    }
}

#[test]
fn a_width_measures_what_its_type_says_at_a_vertex() {
    // All edges of a cube's corner enclose the angle a with the diagonal: cos a = 1/√3.
    let (cos, sin) = ((1.0f64 / 3.0).sqrt(), (2.0f64 / 3.0).sqrt());
    for (width_type, width, moved) in [
        (BevelWidth::Offset, 0.25, 0.25),
        (BevelWidth::Width, 0.25, 0.125 / sin),
        (BevelWidth::Depth, 0.25, 0.25 / cos),
        (BevelWidth::Percent, 25.0, 0.5),
        (BevelWidth::Absolute, 0.25, 0.25),
    ] {
        let mut mesh = cube();
        let corner = mesh.vertices().find(|&vertex| mesh.position(vertex) == Vec3::ONE).expect("a corner");
        let made = mesh.bevel_vertices(&[corner], &settings(width, width_type)).expect("a vertex");
        let at = 1.0 - moved;
        check_positions(&mesh, &made, &[[at, 1.0, 1.0], [1.0, at, 1.0], [1.0, 1.0, at]]);
        keeps_affine_values(&mesh).expect("interpolated");
    }
}

#[test]
fn almost_flat_edges_do_not_move_rims_to_infinity() {
    let mut grid = EditMesh::from_mesh(&primitives::grid(4.0, 4.0, 4, 4)).0;
    let inside = |edge: &EdgeId| grid.edge_vertices(*edge).iter().all(|&v| grid.vertex_edges(v).count() == 4);
    let edge = grid.edges().find(inside).expect("the grid is large");
    let free = BevelSettings { clamp_overlap: false, ..settings(0.01, BevelWidth::Depth) };
    let middle = {
        let [a, b] = grid.edge_vertices(edge).map(|vertex| grid.point(vertex));
        (a, (b - a).normalize())
    };
    let made = grid.bevel_edges(&[edge], &free).expect("an edge");
    let far = made.vertices.iter().map(|&vertex| {
        let way = grid.point(vertex) - middle.0;
        (way - middle.1 * way.dot(middle.1)).length()
    });
    let far = far.fold(0.0, f64::max);
    assert!((far - 0.2).abs() < 1e-6, "20 times the depth: {far}");
}

#[test]
fn an_inner_arc_rounds_the_corners_of_a_face() {
    for segments in 1..6 {
        let mut mesh = cube();
        let edges: Vec<EdgeId> = mesh.edges().filter(|&edge| is_at_top(&mesh, edge)).collect();
        let settings =
            BevelSettings { width: 0.25, segments, inner_miter: InnerMiter::Arc, ..BevelSettings::default() };
        let lid = mesh.faces().find(|&face| mesh.face_vertices(face).all(|v| mesh.position(v).y == 1.0));
        let made = mesh.bevel_edges(&edges, &settings).expect("four edges");
        mesh.check_structure().expect("whole");
        keeps_affine_values(&mesh).expect("interpolated");
        assert!(mesh.edges().all(|edge| mesh.edge_pair(edge).is_some()), "closed");
        let counts = [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()];
        assert_eq!(counts[0] + counts[2], counts[1] + 2, "genus 0");
        assert_eq!(made.width, 0.25, "nothing is in the way");
        let rim: Vec<DVec3> =
            mesh.face_vertices(lid.expect("a cube has one")).map(|v| mesh.point(v)).collect();
        assert_eq!(rim.len(), 4 * (segments + 1), "a curve at each corner");
        for position in rim {
            // Rims are at 0.75; the curve begins 0.25 from where they meet.
            let center = DVec3::new(0.5 * position.x.signum(), 1.0, 0.5 * position.z.signum());
            assert!((position.distance(center) - 0.25).abs() < 1e-6, "{position} is on a circle");
        }
    }
}

fn is_at_top(mesh: &EditMesh, edge: EdgeId) -> bool {
    mesh.edge_vertices(edge).iter().all(|&vertex| mesh.position(vertex).y == 1.0)
}

#[test]
fn outer_miters_keep_rims_near_a_reflex_corner() {
    for segments in 1..5 {
        for (outer_miter, corners) in
            [(OuterMiter::Sharp, 6), (OuterMiter::Patch, 6 + 2 * segments), (OuterMiter::Arc, 6 + segments)]
        {
            let mut mesh = prism(&L);
            let edges: Vec<EdgeId> = mesh.edges().filter(|&edge| is_at_top(&mesh, edge)).collect();
            let lid = mesh.faces().find(|&face| mesh.face_vertices(face).all(|v| mesh.position(v).y == 1.0));
            let settings = BevelSettings { width: 0.125, segments, outer_miter, ..BevelSettings::default() };
            mesh.bevel_edges(&edges, &settings).expect("six edges");
            mesh.check_structure().expect("whole");
            keeps_affine_values(&mesh).expect("interpolated");
            assert!(mesh.edges().all(|edge| mesh.edge_pair(edge).is_some()), "closed");
            let counts = [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()];
            assert_eq!(counts[0] + counts[2], counts[1] + 2, "genus 0 with {outer_miter:?}");
            let rim: Vec<DVec3> =
                mesh.face_vertices(lid.expect("it has one")).map(|v| mesh.point(v)).collect();
            assert_eq!(rim.len(), corners, "{outer_miter:?} with {segments} segments");
            let has = |x: f64, z: f64| rim.iter().any(|p| p.distance(DVec3::new(x, 1.0, z)) < 1e-6);
            let feet = has(-0.125, 0.0) && has(0.0, -0.125);
            assert_eq!(has(-0.125, -0.125), outer_miter != OuterMiter::Arc, "where the rims meet");
            assert_eq!(feet, outer_miter != OuterMiter::Sharp, "the feet of the corner: {rim:?}");
            if outer_miter == OuterMiter::Arc {
                let near = rim.iter().filter(|position| position.distance(DVec3::Y) < 0.2);
                assert!(near.clone().count() == segments + 1, "a curve around the corner");
                assert!(near.clone().all(|p| (p.distance(DVec3::Y) - 0.125).abs() < 1e-6), "a circle");
            }
        }
    }
}

#[test]
fn rims_are_marked_on_request() {
    for (mark_sharp, mark_seams) in [(false, false), (true, false), (false, true), (true, true)] {
        let mut mesh = cube();
        let edges = [EdgeId(0)];
        let settings = BevelSettings { segments: 3, mark_sharp, mark_seams, ..BevelSettings::default() };
        mesh.bevel_edges(&edges, &settings).expect("an edge");
        let of = |has: &dyn Fn(EdgeId) -> bool| mesh.edges().filter(|&edge| has(edge)).count();
        assert_eq!(of(&|edge| mesh.is_sharp(edge)), 2 * usize::from(mark_sharp), "both rims");
        assert_eq!(of(&|edge| mesh.is_seam(edge)), 2 * usize::from(mark_seams), "both rims");
    }
}

#[test]
fn hardened_normals_let_old_faces_look_flat() {
    for (inner_miter, harden_normals) in
        [(InnerMiter::Sharp, true), (InnerMiter::Arc, true), (InnerMiter::Sharp, false)]
    {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let faces: Vec<FaceId> = mesh.faces().collect();
        mesh.shade_smooth(&faces).expect("six faces");
        let edges: Vec<EdgeId> = mesh.edges().collect();
        let settings = BevelSettings { segments: 3, harden_normals, inner_miter, ..BevelSettings::default() };
        let made = mesh.bevel_edges(&edges, &settings).expect("twelve edges");
        let (shown, map) = mesh.to_mesh();
        let normals = shown.shading_normals();
        let of_face = |face: FaceId| {
            let of = |(_, corner): &(&Vec3, &_)| mesh.corner_face(**corner) == face;
            normals
                .iter()
                .zip(&map.corners)
                .filter(of)
                .map(|(normal, corner)| (*normal, *corner))
                .collect::<Vec<_>>()
        };
        for &face in &faces {
            let flat = mesh.face_normal(face).as_vec3();
            let is_flat = of_face(face).iter().all(|(normal, _)| normal.abs_diff_eq(flat, 1e-6));
            assert_eq!(is_flat, harden_normals, "{face} with {inner_miter:?}");
        }
        if !harden_normals {
            continue;
        }
        // A corner of a new face that touches an old one continues its shading.
        for (normal, corner) in made.faces.iter().flat_map(|&face| of_face(face)) {
            let position = mesh.position(mesh.corner_vertex(corner));
            let sides = position.to_array().map(|x| x.abs() > 1.0 - 1e-6);
            if sides.iter().filter(|is_outside| **is_outside).count() == 1 {
                let axis = Vec3::from_array(sides.map(|is_outside| f32::from(u8::from(is_outside))));
                assert!(normal.abs_diff_eq(axis * position.signum(), 1e-6), "{normal} at {position}");
            }
        }
    }
}

#[test]
fn hardened_normals_keep_a_smooth_side_round() {
    let (mut mesh, _) = EditMesh::from_mesh(&primitives::cylinder(1.0, 2.0, 12));
    let is_cap = |mesh: &EditMesh, face: FaceId| mesh.face_normal(face).y.abs() > 0.5;
    let (caps, sides): (Vec<FaceId>, Vec<FaceId>) = mesh.faces().partition(|&face| is_cap(&mesh, face));
    mesh.shade_smooth(&sides).expect("there are sides");
    mesh.shade_flat(&caps).expect("there are caps");
    let edges: Vec<EdgeId> = mesh.edges().filter(|&edge| is_at_top(&mesh, edge)).collect();
    let settings = BevelSettings { harden_normals: true, segments: 2, ..BevelSettings::default() };
    mesh.bevel_edges(&edges, &settings).expect("a ring of edges");
    let (shown, map) = mesh.to_mesh();
    for (normal, &corner) in shown.shading_normals().iter().zip(&map.corners) {
        if sides.contains(&mesh.corner_face(corner)) {
            let position = mesh.position(mesh.corner_vertex(corner));
            let away = Vec3::new(position.x, 0.0, position.z).normalize();
            assert!(normal.abs_diff_eq(away, 1e-5), "{normal} at {position}: away from the axis");
        }
    }
}
