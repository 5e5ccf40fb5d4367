//! The links between the vertices of a render mesh and its mesh, kept so that changes can be followed.

use std::sync::Arc;

use rayon::prelude::*;
use trigon_math::Vec3;

use super::ChangedElements;
use super::corner_faces::CornerFaces;
use super::face_normals::FaceNormals;
use super::marks::Marks;
use super::render_update::{RenderUpdate, UpdatedVertex};
use super::vertex_values::{Shown, SplitOff, VertexValues};
use crate::Mesh;
use crate::groups::Groups;
use crate::normals::unit_keeping;
use crate::weld::Welded;

/// Faces or vertices that a thread takes at a time: about a tenth of a millisecond's work,
/// a few times what it takes to wake a thread.
pub(super) const PIECE: usize = 1024;

/// How the vertices of a [`RenderMesh`](crate::RenderMesh) come from its mesh. Made by
/// [`RenderMesh::with_links`](crate::RenderMesh::with_links).
///
/// Corners of a vertex that no longer agree get render vertices of their own, at the end
/// of the list. Those that agree again stay apart, so that no render vertex is without a
/// corner: triangles show the same values as those of a render mesh made from the changed
/// mesh, to the bit, but may name them by other numbers.
#[derive(Debug, Clone)]
pub struct RenderLinks {
    /// The render vertex of each corner.
    vertex_of_corner: Vec<u32>,
    vertex_count: u32,
    /// The corners at each vertex of the mesh, increasing. No change alters them.
    corners_at: Arc<Groups<u32>>,
    /// The normals of all faces, as soon as a corner takes its normal from them.
    face_normals: Option<FaceNormals>,
}

impl RenderLinks {
    pub(crate) fn new(mesh: &Mesh, welded: Welded) -> Self {
        let corners = mesh.corner_vertices().iter().copied().zip(0u32..);
        let given = mesh.attributes().corner_normals.as_deref();
        let follows = given.is_none_or(|given| given.iter().any(|&normal| has_no_direction(normal)));
        Self {
            vertex_count: welded.corner_of_vertex.len() as u32,
            vertex_of_corner: welded.vertex_of_corner.into_vec(),
            corners_at: Arc::new(Groups::new(mesh.vertex_count(), corners)),
            face_normals: follows.then(|| FaceNormals::new(mesh)),
        }
    }

    /// The render vertex of each corner of the mesh.
    #[must_use]
    pub fn vertex_of_corner(&self) -> &[u32] {
        &self.vertex_of_corner
    }

    /// What is to be written anew when these elements of the mesh were changed, in time
    /// proportional to what lies around them. `mesh` is the one that these links were made
    /// for, with its new values.
    pub fn follow(&mut self, mesh: &Mesh, changed: &ChangedElements) -> RenderUpdate {
        let (vertices, corners) = (changed.vertices(), changed.corners());
        let faces = self.faces_around(mesh, &vertices);
        self.update_face_normals(mesh, &faces, &corners);
        let affected = self.affected_vertices(mesh, &vertices, &corners, &faces);
        let mut update = RenderUpdate { faces, ..RenderUpdate::default() };
        // Triangles are cut in one way only.
        update.faces.retain(|&face| mesh.face_corners(face as usize).len() > 3);
        self.update_vertices(mesh, &affected, &corners, &mut update);
        if !update.faces.is_sorted_by(|a, b| a < b) {
            update.faces.sort_unstable();
            update.faces.dedup();
        }
        let cut = |faces: &[u32]| mesh.triangulation_of(faces.iter().copied(), 2 * faces.len());
        for part in update.faces.par_chunks(PIECE).map(cut).collect::<Vec<_>>() {
            update.triangulation.triangles.extend(part.triangles);
            update.triangulation.triangle_faces.extend(part.triangle_faces);
        }
        update
    }

    /// The faces that have one of these vertices, increasing.
    fn faces_around(&self, mesh: &Mesh, vertices: &[u32]) -> Vec<u32> {
        let (of_corner, mut met) = (CornerFaces::new(mesh), Marks::new(mesh.face_count()));
        let corners = vertices.iter().flat_map(|&vertex| self.corners_at.get(vertex));
        corners.for_each(|&corner| met.insert(of_corner.of(corner).0 as u32));
        met.listed()
    }

    /// Brings the normals of faces up to date whose corners moved.
    fn update_face_normals(&mut self, mesh: &Mesh, faces: &[u32], corners: &[u32]) {
        if let Some(normals) = &mut self.face_normals {
            return normals.update(mesh, faces);
        }
        let given = mesh.attributes().corner_normals.as_deref().unwrap_or_default();
        if corners.iter().any(|&corner| given.get(corner as usize).is_some_and(|&n| has_no_direction(n))) {
            self.face_normals = Some(FaceNormals::new(mesh));
        }
    }

    /// The vertices at which a corner may show other values than before, increasing.
    fn affected_vertices(&self, mesh: &Mesh, vertices: &[u32], corners: &[u32], faces: &[u32]) -> Vec<u32> {
        let mut met = Marks::new(mesh.vertex_count());
        vertices.iter().for_each(|&vertex| met.insert(vertex));
        corners.iter().for_each(|&corner| met.insert(mesh.corner_vertices()[corner as usize]));
        if self.face_normals.is_some() {
            let around = faces.iter().flat_map(|&face| mesh.face_vertices(face as usize));
            around.for_each(|&vertex| met.insert(vertex));
        }
        met.listed()
    }

    /// Updates what the corners at some vertices show; `changed` are those with other
    /// attributes.
    fn update_vertices(&mut self, mesh: &Mesh, vertices: &[u32], changed: &[u32], update: &mut RenderUpdate) {
        let none = FaceNormals::default();
        let face_normals = self.face_normals.as_ref().unwrap_or(&none);
        let values = VertexValues::new(mesh, &self.vertex_of_corner, &self.corners_at, face_normals, changed);
        let shown: Vec<Shown> = vertices.par_chunks(PIECE).map(|piece| values.at(piece)).collect();
        update.vertices.reserve(vertices.len());
        for part in &shown {
            update.vertices.extend_from_slice(&part.kept);
        }
        let of_corner = CornerFaces::new(mesh);
        for SplitOff { corners, shown: (corner, normal) } in shown.iter().flat_map(|part| &part.split) {
            let vertex = self.vertex_count;
            self.vertex_count += 1;
            for &corner in corners {
                self.vertex_of_corner[corner as usize] = vertex;
                update.faces.push(of_corner.of(corner).0 as u32);
            }
            update.vertices.push(UpdatedVertex { vertex, corner: *corner, normal: *normal });
        }
    }
}

/// Whether a normal counts as "none given here".
fn has_no_direction(normal: Vec3) -> bool {
    unit_keeping(normal) == Vec3::ZERO
}
