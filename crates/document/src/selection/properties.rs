//! Selecting by properties of elements: border, non-manifold, sharp, similar, by normal, by
//! material.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::DVec3;
use trigon_modelling::{EdgeId, EditMesh, FaceId, VertexId};

use super::Elements;

/// The property that elements must share with a selected one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Similarity {
    /// Faces: the same number of corners.
    #[default]
    Corners,
    /// Faces: the same material slot.
    Material,
    /// Faces: about the same area.
    Area,
    /// Faces: about the same direction.
    Normal,
    /// Edges: about the same length.
    Length,
    /// Edges: the same number of faces.
    Faces,
    /// Vertices: the same number of edges.
    Edges,
}

/// Edges with exactly one face.
#[must_use]
pub fn border_edges(mesh: &EditMesh) -> Elements {
    Elements::Edges(mesh.edges().filter(|&edge| mesh.is_boundary(edge)).collect())
}

/// Edges that do not have exactly two faces running in opposite directions.
#[must_use]
pub fn non_manifold_edges(mesh: &EditMesh) -> Elements {
    let is_manifold = |edge: EdgeId| {
        mesh.edge_pair(edge).is_some_and(|[a, b]| mesh.corner_vertex(a) != mesh.corner_vertex(b))
    };
    Elements::Edges(mesh.edges().filter(|&edge| !is_manifold(edge)).collect())
}

/// Edges that are marked sharp, and edges between two faces whose directions differ by more than an
/// angle (in radians).
#[must_use]
pub fn sharp_edges(mesh: &EditMesh, angle: f64) -> Elements {
    Elements::Edges(mesh.edges_by_angle(angle))
}

/// Faces whose direction differs from another by at most an angle (in radians).
#[must_use]
pub fn faces_towards(mesh: &EditMesh, direction: DVec3, angle: f64) -> Elements {
    let least = trigon_mesh::math::elementary::sin_cos(angle).1;
    let direction = direction.normalize_or_zero();
    Elements::Faces(mesh.faces().filter(|&face| face_direction(mesh, face).dot(direction) >= least).collect())
}

/// Faces of a material slot.
#[must_use]
pub fn faces_of_material(mesh: &EditMesh, material: u32) -> Elements {
    Elements::Faces(mesh.faces().filter(|&face| mesh.material(face) == material).collect())
}

/// Elements that share a property with at least one of the given ones. Lengths and areas may differ by the
/// fraction `tolerance`, directions by that many radians.
#[must_use]
pub fn similar(mesh: &EditMesh, given: &Elements, what: Similarity, tolerance: f64) -> Elements {
    let near = |values: &[f64], value: f64| {
        // The values are sorted: the nearest ones are next to the insertion point.
        let index = values.partition_point(|&other| other < value);
        let is_near = |other: &f64| (other - value).abs() <= tolerance * other.abs().max(value.abs());
        values[..index].last().is_some_and(is_near) || values[index..].first().is_some_and(is_near)
    };
    let sorted = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values
    };
    match given {
        Elements::Vertices(vertices) => {
            let degree = |vertex: VertexId| mesh.vertex_edges(vertex).count() as f64;
            let known = sorted(vertices.iter().map(|&vertex| degree(vertex)).collect());
            Elements::Vertices(mesh.vertices().filter(|&v| near(&known, degree(v))).collect())
        }
        Elements::Edges(edges) => {
            let value = |edge: EdgeId| match what {
                Similarity::Faces => mesh.edge_faces(edge).count() as f64,
                _ => mesh.edge_length(edge),
            };
            let known = sorted(edges.iter().map(|&edge| value(edge)).collect());
            Elements::Edges(mesh.edges().filter(|&edge| near(&known, value(edge))).collect())
        }
        Elements::Faces(faces) if what == Similarity::Normal => {
            let least = trigon_mesh::math::elementary::sin_cos(tolerance).1;
            // Most meshes have few different directions.
            let mut known: Vec<DVec3> = faces.iter().map(|&face| face_direction(mesh, face)).collect();
            known.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z)));
            known.dedup();
            let is_near = |face: FaceId| {
                let direction = face_direction(mesh, face);
                known.iter().any(|other| other.dot(direction) >= least)
            };
            Elements::Faces(mesh.faces().filter(|&face| is_near(face)).collect())
        }
        Elements::Faces(faces) => {
            let value = |face: FaceId| match what {
                Similarity::Material => f64::from(mesh.material(face)),
                Similarity::Area => mesh.face_area(face),
                _ => mesh.face_size(face) as f64,
            };
            let known = sorted(faces.iter().map(|&face| value(face)).collect());
            Elements::Faces(mesh.faces().filter(|&face| near(&known, value(face))).collect())
        }
    }
}

fn face_direction(mesh: &EditMesh, face: FaceId) -> DVec3 {
    mesh.face_area_vector(face).normalize_or_zero()
}
