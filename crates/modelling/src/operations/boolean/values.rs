//! The values of faces that are parts of others.

use smallvec::{SmallVec, smallvec};
use trigon_math::{DVec3, Vec3};

use super::solid::FLATNESS;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};

/// Corners and their weights, which add up to 1.
pub(in crate::operations) type CornerWeights = SmallVec<[(CornerId, f64); 3]>;

/// A face that others are parts of, or a triangle of it.
pub(in crate::operations) struct SourceFace<'s> {
    corners: Vec<CornerId>,
    /// The triangles, as numbers of corners.
    triangles: &'s [[u32; 3]],
}

impl<'s> SourceFace<'s> {
    pub(in crate::operations) fn new(mesh: &EditMesh, face: FaceId, triangles: &'s [[u32; 3]]) -> Self {
        Self { corners: mesh.face_corners(face).collect(), triangles }
    }

    /// The corner of one of the triangles in a position.
    pub(super) fn corner_at(&self, mesh: &EditMesh, position: Vec3) -> Option<CornerId> {
        let at = |&corner: &CornerId| mesh.position(mesh.corner_vertex(corner)) == position;
        match self.triangles {
            [triangle] => triangle.map(|corner| self.corners[corner as usize]).into_iter().find(at),
            _ => self.corners.iter().copied().find(at),
        }
    }

    /// What a value in a position of the face is made of.
    pub(in crate::operations) fn parts_at(&self, mesh: &EditMesh, position: DVec3) -> CornerWeights {
        let of = |triangle: &[u32; 3]| {
            let corners = triangle.map(|corner| self.corners[corner as usize]);
            let weights = weights(corners.map(|corner| mesh.point(mesh.corner_vertex(corner))), position)?;
            let least = weights.into_iter().fold(f64::INFINITY, f64::min);
            Some((least, corners, weights))
        };
        // The one that holds the position, or is the nearest to do so.
        let best = self.triangles.iter().filter_map(of).max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, corners, weights)) = best else {
            let squared =
                |corner: CornerId| mesh.point(mesh.corner_vertex(corner)).distance_squared(position);
            let nearest = self.corners.iter().min_by(|a, b| squared(**a).total_cmp(&squared(**b)));
            return nearest.map(|&corner| smallvec![(corner, 1.0)]).unwrap_or_default();
        };
        // Beside an edge by rounding is on it.
        let inside = weights.map(|weight| if weight < 1e-9 { 0.0 } else { weight });
        let sum: f64 = inside.iter().sum();
        corners
            .into_iter()
            .zip(inside.map(|weight| weight / sum))
            .filter(|(_, weight)| *weight > 0.0)
            .collect()
    }

    /// Gives a part of the face its values: those of corners, and the marks of edges.
    pub(super) fn give_values(&self, mesh: &mut EditMesh, piece: FaceId) {
        let corners: Vec<CornerId> = mesh.face_corners(piece).collect();
        for &corner in &corners {
            let vertex = mesh.corner_vertex(corner);
            match self.corner_at(mesh, mesh.position(vertex)) {
                Some(source) => mesh.copy_corner(source, corner),
                None => {
                    let parts = self.parts_at(mesh, mesh.point(vertex));
                    mesh.blend_corner(&parts, corner);
                }
            }
        }
        self.mark_edges(mesh, &corners);
    }

    /// Gives edges along those of the face their marks.
    fn mark_edges(&self, mesh: &mut EditMesh, corners: &[CornerId]) {
        let edges: Vec<EdgeId> = self.corners.iter().map(|&corner| mesh.corner_edge(corner)).collect();
        let marked: Vec<EdgeId> = edges
            .into_iter()
            .filter(|&edge| mesh.is_sharp(edge) || mesh.is_seam(edge) || mesh.crease(edge) > 0.0)
            .collect();
        if marked.is_empty() {
            return;
        }
        for &corner in corners {
            let edge = mesh.corner_edge(corner);
            let ends = mesh.edge_vertices(edge);
            let along = |&marked: &EdgeId| ends.iter().all(|&end| is_on(mesh, end, marked));
            if let Some(source) = marked.iter().copied().find(along).filter(|source| *source != edge) {
                mesh.unite_edge_marks(source, edge);
            }
        }
    }
}

/// The weights of a triangle's corners in the point of its plane nearest to a position; `None` without area.
fn weights([a, b, c]: [DVec3; 3], position: DVec3) -> Option<[f64; 3]> {
    let normal = (b - a).cross(c - a);
    let squared = normal.length_squared();
    let at = |from: DVec3, to: DVec3| (from - position).cross(to - position).dot(normal) / squared;
    let weights = [at(b, c), at(c, a), at(a, b)];
    (squared > 0.0 && weights.iter().all(|weight| weight.is_finite())).then_some(weights)
}

/// Whether a vertex lies on an edge but for the rounding of its coordinates.
fn is_on(mesh: &EditMesh, vertex: VertexId, edge: EdgeId) -> bool {
    let [a, b] = mesh.edge_vertices(edge).map(|end| mesh.point(end));
    let position = mesh.point(vertex);
    let largest = a.abs().max_element().max(b.abs().max_element());
    let near = 2.0 * FLATNESS * largest;
    let direction = (b - a).normalize_or_zero();
    let along = (position - a).dot(direction);
    let across = (position - a - direction * along).length();
    across <= near && along >= -near && along <= (b - a).length() + near
}
