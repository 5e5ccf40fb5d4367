//! The links between the vertices of a render mesh and its mesh, kept so that changes can be followed.

use std::sync::Arc;

use rayon::prelude::*;
use trigon_math::Vec3;

use super::ChangedElements;
use super::corner_faces::CornerFaces;
use super::face_normals::{FaceNormals, PIECE};
use super::fans::Fans;
use super::local_normals::LocalNormals;
use super::neighborhood::Neighborhood;
use super::render_update::{RenderUpdate, UpdatedVertex};
use super::vertex_values::{Shown, SplitOff, VertexValues};
use crate::Mesh;
use crate::groups::Groups;
use crate::normals::unit_keeping;
use crate::weld::Welded;

/// How the vertices of a [`RenderMesh`](crate::RenderMesh) or a [`WeldedMesh`](crate::WeldedMesh) come from its mesh. Made
/// by [`RenderMesh::with_links`](crate::RenderMesh::with_links) and
/// [`WeldedMesh::of_flat_with_links`](crate::WeldedMesh::of_flat_with_links).
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
    /// Whether render vertices have no normals, because all polygons are flat and show their own.
    is_flat: bool,
    /// What lies around the elements of the last change.
    around: Neighborhood,
    /// Those of its vertices that are fans.
    fans: Fans,
    /// What shows the last change. The fans come first.
    update: RenderUpdate,
    /// Whether the vertices of the update stay the same as long as the same elements change.
    is_settled: bool,
}

impl RenderLinks {
    /// `is_flat` says that the mesh was welded without normals.
    pub(crate) fn new(mesh: &Mesh, welded: Welded, is_flat: bool) -> Self {
        let corners = mesh.corner_vertices().iter().copied().zip(0u32..);
        let given = mesh.attributes().corner_normals.as_deref();
        let follows = given.is_none_or(|given| given.iter().any(|&normal| has_no_direction(normal)));
        Self {
            vertex_count: welded.corner_of_vertex.len() as u32,
            vertex_of_corner: welded.vertex_of_corner.into_vec(),
            corners_at: Arc::new(Groups::new(mesh.vertex_count(), corners)),
            face_normals: follows.then(|| FaceNormals::new(mesh)),
            is_flat,
            around: Neighborhood::default(),
            fans: Fans::default(),
            update: RenderUpdate::default(),
            is_settled: false,
        }
    }

    /// The render vertex of each corner of the mesh.
    #[must_use]
    pub fn vertex_of_corner(&self) -> &[u32] {
        &self.vertex_of_corner
    }

    /// Finds out what is to be written anew when these elements of the mesh were changed, in time
    /// proportional to what lies around them; see [`RenderLinks::update`]. `mesh` is the one that these links were made
    /// for, with its new values.
    pub fn follow(&mut self, mesh: &Mesh, changed: &ChangedElements) {
        self.find_face_normals(mesh, changed);
        let has_face_normals = self.face_normals.is_some() && !self.is_flat;
        let is_other = self.around.update(mesh, &self.corners_at, changed, has_face_normals);
        let outlines = &mut self.update.outlines;
        if is_other {
            outlines.replace(mesh, &self.around.faces, &self.around.moved);
        } else {
            outlines.update(mesh);
        }
        if let Some(normals) = &mut self.face_normals {
            if is_other {
                normals.replace(mesh, &self.around.faces);
            }
            normals.update(mesh, outlines);
            if self.is_flat {
                self.update.face_normals.clear();
                self.update.face_normals.extend(normals.shown());
            }
        }
        self.update.faces.clone_from(&self.around.polygons);
        self.update_vertices(mesh, is_other);
        if !self.update.faces.is_sorted_by(|a, b| a < b) {
            self.update.faces.sort_unstable();
            self.update.faces.dedup();
        }
    }

    /// What is to be written anew after the change that was followed last.
    #[must_use]
    pub fn update(&self) -> &RenderUpdate {
        &self.update
    }

    /// Computes the normals of all faces when a corner has lost its own normal.
    fn find_face_normals(&mut self, mesh: &Mesh, changed: &ChangedElements) {
        if self.face_normals.is_some() {
            return;
        }
        let given = mesh.attributes().corner_normals.as_deref().unwrap_or_default();
        let is_lost =
            |&corner: &u32| given.get(corner as usize).is_some_and(|&normal| has_no_direction(normal));
        if changed.corners().iter().any(is_lost) {
            self.face_normals = Some(FaceNormals::new(mesh));
        }
    }

    /// Updates what the corners at affected vertices show; `are_others` says that they are other vertices than those
    /// of the last change.
    fn update_vertices(&mut self, mesh: &Mesh, are_others: bool) {
        if self.is_settled && !are_others {
            return;
        }
        let Self { around, update, .. } = self;
        let mut none = FaceNormals::default();
        let face_normals = self.face_normals.as_mut().unwrap_or(&mut none);
        update.vertices.truncate(self.fans.count);
        update.replaced.truncate(self.fans.moved);
        let are_fans = !are_others && self.fans.update(mesh, face_normals, &mut update.vertices);
        if !are_fans || !self.fans.others.is_empty() {
            face_normals.settle(mesh);
        }
        let normals = (!self.is_flat).then(|| LocalNormals::new(mesh, face_normals.all()));
        let values = VertexValues::new(mesh, &self.vertex_of_corner, &self.corners_at, normals, around);
        if !are_fans {
            let found = around.vertices.par_chunks(PIECE).map(|piece| values.fans_of(piece)).collect();
            self.fans = Fans::new(found, update);
        }
        let shown: Vec<Shown> = self.fans.others.par_chunks(PIECE).map(|piece| values.at(piece)).collect();
        for part in &shown {
            update.add(&part.kept, &part.replaced);
        }
        // Without normals nothing but places changes, and what has parted stays apart.
        let parts = shown.iter().any(|part| !part.split.is_empty());
        self.is_settled = self.is_flat && around.corners.is_empty() && !parts;
        let of_corner = CornerFaces::new(mesh);
        for SplitOff { corners, shown: (corner, normal) } in shown.iter().flat_map(|part| &part.split) {
            let vertex = self.vertex_count;
            self.vertex_count += 1;
            for &corner in corners {
                self.vertex_of_corner[corner as usize] = vertex;
                update.faces.push(of_corner.of(corner).0 as u32);
            }
            update.add(&[UpdatedVertex { vertex, corner: *corner, normal: *normal }], &[0]);
        }
    }
}

/// Whether a normal counts as "none given here".
fn has_no_direction(normal: Vec3) -> bool {
    unit_keeping(normal) == Vec3::ZERO
}
