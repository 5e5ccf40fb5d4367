//! Where rims end: in the faces beside and between beveled edges.

use trigon_math::{DVec3, elementary};
use trigon_mesh::primitives;

use super::{BevelSettings, BevelWidth};
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, VertexId};
use crate::tests::{keeps_affine_values, with_affine_values};

fn distance_from_line(point: DVec3, [a, b]: [DVec3; 2]) -> f64 {
    (b - a).normalize().cross(point - a).length()
}

/// Three faces lie beyond each corner of the middle square of a grid: the rims there came to half of the width.
#[test]
fn rims_keep_the_width_where_several_faces_lie_between_two_edges() {
    for shift in [0.0, 0.3] {
        let (mut mesh, _) = EditMesh::from_mesh(&with_affine_values(primitives::grid(3.0, 3.0, 3, 3)));
        // Slanted, so that the angles between the edges are not right ones, but flat.
        for vertex in mesh.vertices().collect::<Vec<_>>() {
            let at = mesh.point(vertex);
            mesh.set_position(vertex, DVec3::new(at.x + shift * at.z, at.y, at.z).as_vec3());
        }
        let is_inside =
            |mesh: &EditMesh, vertex: VertexId| !mesh.vertex_edges(vertex).any(|edge| mesh.is_boundary(edge));
        let middle: Vec<EdgeId> = mesh
            .edges()
            .filter(|&edge| mesh.edge_vertices(edge).iter().all(|&vertex| is_inside(&mesh, vertex)))
            .collect();
        assert_eq!(middle.len(), 4, "those of the square in the middle");
        let lines: Vec<[DVec3; 2]> =
            middle.iter().map(|&edge| mesh.edge_vertices(edge).map(|vertex| mesh.point(vertex))).collect();
        let area: f64 = mesh.faces().map(|face| mesh.face_area(face)).sum();
        let settings = BevelSettings { width: 0.125, ..BevelSettings::default() };
        let made = mesh.bevel_edges(&middle, &settings).expect("they are between two faces");
        assert_eq!(made.vertices.len(), 8, "two for each corner");
        for &vertex in &made.vertices {
            let near = lines
                .iter()
                .filter(|&&line| (distance_from_line(mesh.point(vertex), line) - 0.125).abs() < 1e-6);
            assert_eq!(
                near.count(),
                2,
                "{} is at the width from the two edges of its corner",
                mesh.point(vertex)
            );
        }
        let beveled: f64 = mesh.faces().map(|face| mesh.face_area(face)).sum();
        assert!((beveled - area).abs() < 1e-5, "nothing overlaps");
        // Values are affine in the positions before the mesh was slanted.
        if shift == 0.0 {
            keeps_affine_values(&mesh).expect("interpolated");
        }
    }
}

/// On a round solid the planes of the faces beside the edges lie outside of it.
#[test]
fn rims_that_meet_across_faces_stay_on_a_round_solid() {
    let (mut sphere, _) = EditMesh::from_mesh(&primitives::uv_sphere(1.0, 8, 6));
    let side = sphere.faces().find(|&face| sphere.face_size(face) == 4).expect("quads between the poles");
    let edges: Vec<EdgeId> = sphere.face_edges(side).collect();
    let before = sphere.volume();
    let settings = BevelSettings { width: 0.05, ..BevelSettings::default() };
    let made = sphere.bevel_edges(&edges, &settings).expect("between two faces");
    let farthest = made.vertices.iter().map(|&vertex| sphere.point(vertex).length()).fold(0.0, f64::max);
    assert!(farthest < 1.0, "all new vertices are inside of the sphere: {farthest}");
    assert!(sphere.volume() < before, "convex edges lose volume");
}

/// A width that is measured along edges ends on these.
#[test]
fn widths_along_edges_end_between_those_edges() {
    let (mut mesh, _) = EditMesh::from_mesh(&primitives::grid(3.0, 3.0, 3, 3));
    let middle: Vec<EdgeId> = mesh
        .edges()
        .filter(|&edge| {
            let inner = |vertex| !mesh.vertex_edges(vertex).any(|edge| mesh.is_boundary(edge));
            mesh.edge_vertices(edge).into_iter().all(inner)
        })
        .collect();
    let settings =
        BevelSettings { width: 0.25, width_type: BevelWidth::Absolute, ..BevelSettings::default() };
    mesh.bevel_edges(&middle, &settings).expect("they are between two faces");
    let outer = mesh.vertices().map(|vertex| mesh.point(vertex).abs().max_element());
    let outer: Vec<f64> = outer.filter(|&at| (0.5..1.0).contains(&at)).collect();
    assert_eq!(outer, [0.625; 4], "in the middle of two places 0.25 m from the corner");
}

/// The curve at the end of a round bevel was drawn in a plane across the edge, so that a slanted face bent.
#[test]
fn a_round_bevel_stays_in_the_slanted_faces_at_its_ends() {
    let (mut mesh, _) = EditMesh::from_mesh(&primitives::cylinder(1.0, 0.5, 3));
    let edge =
        mesh.edges().find(|&edge| mesh.edge_vertices(edge).iter().all(|&vertex| mesh.point(vertex).y > 0.0));
    let (width, segments) = (0.0625, 4);
    let settings = BevelSettings { width, segments, ..BevelSettings::default() };
    mesh.bevel_edges(&[edge.expect("three at the top")], &settings).expect("between two faces");
    // A polygon with its corners on a quarter of a circle, in the frame of the two rims: what is lost of the square.
    let step = std::f64::consts::FRAC_PI_2 / segments as f64;
    let points = (0..=segments).map(|i| elementary::sin_cos(i as f64 * step));
    let corners: Vec<[f64; 2]> =
        points.map(|(sin, cos)| [width * (1.0 - cos), width * (1.0 - sin)]).collect();
    // Over each trapezoid between two corners the removed prism is as long as the edge less what the two walls, which
    // meet the edge's wall at 60°, take from it.
    let edge_length = 3f64.sqrt();
    let length = |depth: f64| edge_length - 2.0 * depth / 3f64.sqrt();
    let lost: f64 = corners
        .windows(2)
        .map(|pair| {
            let [[a, height_a], [b, height_b]] = [pair[0], pair[1]];
            // Simpson's rule is exact for the product of two lines.
            let middle = length(0.5 * (a + b)) * 0.5 * (height_a + height_b);
            (b - a) / 6.0 * (length(a) * height_a + 4.0 * middle + length(b) * height_b)
        })
        .sum();
    let whole = 0.5 * 0.75 * 3f64.sqrt();
    assert!((mesh.volume() - (whole - lost)).abs() < 1e-6, "{} of {whole} less {lost}", mesh.volume());
    for face in mesh.faces().collect::<Vec<_>>() {
        let (normal, first) = (mesh.face_normal(face), mesh.face_vertices(face).next().expect("corners"));
        for vertex in mesh.face_vertices(face) {
            let height = (mesh.point(vertex) - mesh.point(first)).dot(normal);
            assert!(height.abs() < 1e-6, "a face is bent by {height}");
        }
    }
}
