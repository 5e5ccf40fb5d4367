//! What a change of a mesh changes in the render mesh that was made from it.

use trigon_math::Vec3;

use super::Outlines;

/// What of a [`RenderMesh`](crate::RenderMesh) is to be written anew after a change of its
/// mesh; told by [`RenderLinks::update`](crate::RenderLinks::update).
#[derive(Debug, Clone, Default)]
pub struct RenderUpdate {
    /// Vertices with other values. Those beyond the ones that there were are new, and come
    /// in the order of their numbers.
    pub vertices: Vec<UpdatedVertex>,
    /// See [`RenderUpdate::replaced`]; as indices into `vertices`, increasing.
    pub(super) replaced: Vec<u32>,
    /// Polygons that may be cut otherwise, or whose corners are other vertices than
    /// before; increasing. See [`Mesh::triangulation_of`](crate::Mesh::triangulation_of): a polygon may have more
    /// or fewer triangles than before.
    pub faces: Vec<u32>,
    /// The corners of these polygons, if they are quads.
    pub outlines: Outlines,
    /// Polygons that may show another normal than before, increasing, and these normals, of unit length. None unless
    /// the links are those of a [`WeldedMesh::of_flat_with_links`](crate::WeldedMesh::of_flat_with_links).
    pub face_normals: Vec<(u32, Vec3)>,
}

impl RenderUpdate {
    /// Those of `vertices` that may show another position or other attributes than before, in the same
    /// order. Of the rest nothing but normals has changed.
    pub fn replaced(&self) -> impl Iterator<Item = &UpdatedVertex> + Clone {
        self.replaced.iter().map(|&index| &self.vertices[index as usize])
    }

    /// Adds vertices; `replaced` are those of them that show other values than normals, as indices.
    pub(super) fn add(&mut self, vertices: &[UpdatedVertex], replaced: &[u32]) {
        let first = self.vertices.len() as u32;
        self.vertices.extend_from_slice(vertices);
        self.replaced.extend(replaced.iter().map(|index| first + index));
    }
}

/// A vertex of a [`RenderMesh`](crate::RenderMesh) with other values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UpdatedVertex {
    /// Its number in the render mesh.
    pub vertex: u32,
    /// The corner of the mesh whose position and attributes it shows.
    pub corner: u32,
    /// The shading normal of that corner; of unit length. Zero if vertices have none, because all polygons are flat: see
    /// [`RenderUpdate::face_normals`].
    pub normal: Vec3,
}
