//! How given normals and tangents of corners change when vertices move.
//!
//! The rule: if all vertices of a face move entirely by the same linear map, its normals and
//! tangents rotate with it. At any other face that moves, the given normals are cleared, so that
//! computed ones take their place; it is marked smooth if they showed it as such. Its tangents are
//! unchanged. So are morph targets: they are relative to the position.

use fixedbitset::FixedBitSet;
use smallvec::SmallVec;
use trigon_math::{DMat3, Vec3, Vec4, cofactors, transformed_direction};

use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, FaceId, VertexId};
use crate::layers::{LayerKind, LayerValues};

/// How far the cosine between a given normal and the face's may be from 1 for the face to count
/// as flat: half a degree, more than what files round to.
const FLAT: f64 = 4e-5;

/// The normals and tangents of the faces at vertices that move, from before they do.
#[derive(Debug, Clone, Default)]
pub(in super::super) struct GivenNormals {
    faces: Vec<FaceStart>,
    /// Those of each face in turn.
    corners: Vec<CornerStart>,
}

#[derive(Debug, Clone, Copy)]
struct FaceStart {
    face: FaceId,
    corners: u32,
    /// All of its vertices move wholly.
    is_whole: bool,
    /// It is not marked smooth, but its normals show it so.
    gets_smooth: bool,
}

#[derive(Debug, Clone, Copy)]
struct CornerStart {
    corner: CornerId,
    normal: Vec3,
    tangent: Vec4,
}

impl GivenNormals {
    /// Of the faces at some vertices, each of which moves wholly or in part.
    pub(in super::super) fn at(
        mesh: &EditMesh,
        vertices: &[VertexId],
        is_whole: impl Fn(usize) -> bool,
    ) -> Self {
        let mut given = Self::default();
        if !mesh.has_given_directions() {
            return given;
        }
        let mut whole = FixedBitSet::with_capacity(mesh.vertex_capacity());
        for (index, vertex) in vertices.iter().enumerate() {
            whole.set(vertex.0 as usize, is_whole(index));
        }
        let mut listed = FixedBitSet::with_capacity(mesh.face_capacity());
        for face in vertices.iter().flat_map(|&vertex| mesh.vertex_faces(vertex)) {
            if !listed.put(face.0 as usize) {
                let is_whole = mesh.face_vertices(face).all(|vertex| whole.contains(vertex.0 as usize));
                given.add(mesh, face, is_whole);
            }
        }
        given
    }

    fn add(&mut self, mesh: &EditMesh, face: FaceId, is_whole: bool) {
        let gets_smooth = mesh.is_smooth_by_normals(face);
        self.faces.push(FaceStart { face, corners: mesh.face_size(face) as u32, is_whole, gets_smooth });
        self.corners.extend(mesh.face_corners(face).map(|corner| CornerStart {
            corner,
            normal: mesh.custom_normal(corner).unwrap_or(Vec3::ZERO),
            tangent: mesh.tangent(corner),
        }));
    }

    /// Turns them by the matrix by which directions turn, or clears them without one and where
    /// faces bend.
    pub(in super::super) fn apply(&self, mesh: &mut EditMesh, linear: Option<&DMat3>) {
        let turn = linear.map(|matrix| (matrix, cofactors(matrix)));
        let mut corners = self.corners.iter();
        for start in &self.faces {
            let turn = turn.as_ref().filter(|_| start.is_whole);
            if start.gets_smooth {
                mesh.set_smooth(start.face, turn.is_none());
            }
            for corner in corners.by_ref().take(start.corners as usize) {
                let (normal, tangent) = match turn {
                    Some((matrix, of_normals)) => {
                        let tangent = transformed_direction(matrix, corner.tangent.truncate());
                        let normal = transformed_direction(of_normals, corner.normal);
                        (normal, tangent.extend(corner.tangent.w))
                    }
                    None => (Vec3::ZERO, corner.tangent),
                };
                mesh.set_custom_normal(corner.corner, normal);
                mesh.set_tangent(corner.corner, tangent);
            }
        }
    }

    /// Puts back what was there before.
    pub(super) fn restore(&self, mesh: &mut EditMesh) {
        for start in self.faces.iter().filter(|start| start.gets_smooth) {
            mesh.set_smooth(start.face, false);
        }
        for start in &self.corners {
            mesh.set_custom_normal(start.corner, start.normal);
            mesh.set_tangent(start.corner, start.tangent);
        }
    }
}

impl EditMesh {
    fn has_given_directions(&self) -> bool {
        let given = [LayerKind::Normal, LayerKind::Tangent];
        self.corner_layers.iter().any(|layer| given.contains(&layer.kind))
    }

    /// Whether a face that is not marked smooth is shown so by the normals that were given for it.
    fn is_smooth_by_normals(&self, face: FaceId) -> bool {
        if self.is_smooth(face) || !self.has_given_directions() {
            return false;
        }
        let normal = self.face_normal(face);
        let bends = |normal_of_corner: Vec3| normal_of_corner.as_dvec3().dot(normal) < 1.0 - FLAT;
        self.face_corners(face).filter_map(|corner| self.custom_normal(corner)).any(bends)
    }

    /// Clears the normals that were given for a face's corners, so that computed ones show; a
    /// face that they showed as smooth is marked so. Whether there were any.
    pub(in super::super) fn clear_custom_normals(&mut self, face: FaceId) -> bool {
        let given = |mesh: &Self, corner| mesh.custom_normal(corner).is_some();
        let corners: SmallVec<[CornerId; 8]> =
            self.face_corners(face).filter(|&corner| given(self, corner)).collect();
        if self.is_smooth_by_normals(face) {
            self.set_smooth(face, true);
        }
        corners.iter().for_each(|&corner| self.set_custom_normal(corner, Vec3::ZERO));
        !corners.is_empty()
    }

    /// Clears the normals that were given for the corners at vertices; faces that they showed as
    /// smooth are marked so.
    pub(in super::super) fn clear_custom_normals_at(&mut self, vertices: &[VertexId]) {
        if !self.has_given_directions() {
            return;
        }
        let corners = vertices.iter().flat_map(|&vertex| self.vertex_corners(vertex));
        let corners: Vec<CornerId> = corners.filter(|&corner| self.custom_normal(corner).is_some()).collect();
        let mut faces: Vec<FaceId> = corners.iter().map(|&corner| self.corner_face(corner)).collect();
        // Each face is judged once: it may have very many corners.
        faces.sort_unstable();
        faces.dedup();
        faces.retain(|&face| self.is_smooth_by_normals(face));
        faces.iter().for_each(|&face| self.set_smooth(face, true));
        corners.iter().for_each(|&corner| self.set_custom_normal(corner, Vec3::ZERO));
    }

    /// The tangent that was given for a corner; zero without one.
    fn tangent(&self, corner: CornerId) -> Vec4 {
        let layer = self.corner_layers.iter().find(|layer| layer.kind == LayerKind::Tangent);
        match layer.map(|layer| &layer.values) {
            Some(LayerValues::Vec4(column)) => column[corner.0],
            _ => Vec4::ZERO,
        }
    }

    /// Gives a corner a tangent; nothing happens where the mesh has none.
    fn set_tangent(&mut self, corner: CornerId, tangent: Vec4) {
        let layer = self.corner_layers.iter_mut().find(|layer| layer.kind == LayerKind::Tangent);
        if let Some(LayerValues::Vec4(column)) = layer.map(|layer| &mut layer.values) {
            *column.write(corner.0) = tangent;
        }
    }
}
