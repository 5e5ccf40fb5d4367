//! Vertex clustering: a coarser mesh for a quick look at a large one.
//!
//! After J. Rossignac and P. Borrel, "Multi-resolution 3D approximations for rendering complex scenes", in: Modeling in
//! Computer Graphics, Springer 1993, pages 455 to 465. Space is divided into cubic cells. All vertices in a cell become one
//! of them, and of the triangles those remain whose corners end up in three cells, once for each three cells and each
//! direction. Two steps differ from theirs. The vertex of a cell is the one nearest to the mean of the corners in it, and
//! vertices have no weights. Where nothing remains in a cell they draw points and lines; here such a cell retains its
//! largest triangle as it is, so that leaves and wires do not disappear.
//!
//! It reads the mesh a few times from the beginning to the end on one thread. Beside the triangles of its polygons, its
//! memory does not depend on the mesh: 24 MB for the grid, and less than 100 bytes for each triangle of the result.

mod cells;
mod grid;

use trigon_math::Vec3;

use crate::{Attributes, Mesh, MeshBuilder, Triangulation};
use cells::{Cells, MovedCorner, Remaining};
use grid::CellGrid;

/// A corner takes the normal of its cell's vertex, so that neighbours share it, unless the cosine of the angle between
/// the two is less: then an edge or another side lies in the cell.
const SAME_SIDE: f32 = 0.5;

/// A coarser mesh, and how far it is from the one that it was made from.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ClusteredMesh {
    /// Triangles, with the normals, tangents, texture coordinates, colours, material slots and smoothness of those that
    /// they were made from. No loose edges or points, joints or morph targets.
    pub mesh: Mesh,
    /// The diagonal of a cell, in metres. No corner of a triangle has moved farther, and every vertex of a triangle of
    /// the original lies within this distance of a vertex of this mesh.
    pub error: f64,
}

impl Mesh {
    /// A coarser mesh with at most so many triangles, at least one, made of cells whose vertices become one. Usually it
    /// has a third to two thirds as many as allowed; of a mesh with few triangles for its size, fewer than it has itself.
    ///
    /// It has no more than about a thousand cells along its longest side. A mesh that poses deform is taken at rest.
    ///
    /// ```
    /// use trigon_mesh::primitives;
    ///
    /// let torus = primitives::torus(1.0, 0.4, 200, 100);
    /// let coarse = torus.clustered(5_000);
    /// assert!((1_500..=5_000).contains(&coarse.mesh.face_count()));
    /// assert!(coarse.error < 0.3);
    /// ```
    #[must_use]
    pub fn clustered(&self, most_triangles: usize) -> ClusteredMesh {
        let source = SourceTriangles::of(self);
        let grid = CellGrid::with_at_most(&source, most_triangles.max(1));
        let mesh = Cells::of(&source, &grid).remaining(&source, &grid).mesh(&source);
        ClusteredMesh { mesh, error: grid.diagonal() }
    }
}

/// The triangles of a mesh.
struct SourceTriangles<'m> {
    mesh: &'m Mesh,
    /// `None` if every face is one.
    triangulation: Option<Triangulation>,
}

impl<'m> SourceTriangles<'m> {
    fn of(mesh: &'m Mesh) -> Self {
        Self { mesh, triangulation: (!mesh.has_only_triangles()).then(|| mesh.triangulation()) }
    }

    fn count(&self) -> usize {
        self.triangulation.as_ref().map_or(self.mesh.face_count(), |of| of.triangles.len())
    }

    /// The corners of each triangle, in order.
    fn corners(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        (0..self.count() as u32).map(|triangle| self.corners_of(triangle))
    }

    fn corners_of(&self, triangle: u32) -> [u32; 3] {
        match &self.triangulation {
            Some(of) => of.triangles[triangle as usize],
            None => [3 * triangle, 3 * triangle + 1, 3 * triangle + 2],
        }
    }

    fn face_of(&self, triangle: u32) -> usize {
        self.triangulation.as_ref().map_or(triangle, |of| of.triangle_faces[triangle as usize]) as usize
    }

    fn position(&self, corner: u32) -> Vec3 {
        self.mesh.positions()[self.mesh.corner_vertices()[corner as usize] as usize]
    }
}

impl Remaining {
    fn mesh(self, source: &SourceTriangles<'_>) -> Mesh {
        let attributes = self.attributes(source);
        let Self { vertices, triangles, .. } = self;
        let mut builder = MeshBuilder::with_capacity(vertices.len(), triangles.len(), 3 * triangles.len());
        for corner in vertices {
            builder.push_vertex(source.position(corner));
        }
        builder.push_triangles(&triangles).expect("their vertices exist and differ");
        let mut mesh = builder.build();
        mesh.set_attributes(attributes).expect("there is a value for each corner and each triangle");
        mesh
    }

    /// Values of corners are those that the corners had, so that seams remain what they are.
    fn attributes(&self, source: &SourceTriangles<'_>) -> Attributes {
        let attributes = source.mesh.attributes();
        let corners = self.corners.as_flattened();
        Attributes {
            corner_normals: attributes.corner_normals.as_ref().map(|normals| {
                let normal = |corner: &MovedCorner| shared_normal(normals, corner);
                corners.iter().map(normal).collect()
            }),
            corner_tangents: attributes.corner_tangents.as_ref().map(|of| own_values(of, corners)),
            uv_sets: attributes.uv_sets.iter().map(|set| own_values(set, corners)).collect(),
            corner_colors: attributes.corner_colors.as_ref().map(|of| own_values(of, corners)),
            face_materials: attributes.face_materials.as_ref().map(|of| self.of_faces(source, of)),
            face_smooth: attributes.face_smooth.as_ref().map(|of| self.of_faces(source, of)),
            ..Attributes::default()
        }
    }

    fn of_faces<T: Copy>(&self, source: &SourceTriangles<'_>, values: &[T]) -> Vec<T> {
        self.sources.iter().map(|&triangle| values[source.face_of(triangle)]).collect()
    }
}

fn own_values<T: Copy>(values: &[T], corners: &[MovedCorner]) -> Vec<T> {
    corners.iter().map(|corner| values[corner.own as usize]).collect()
}

fn shared_normal(normals: &[Vec3], corner: &MovedCorner) -> Vec3 {
    let [own, shared] = [corner.own, corner.of_cell].map(|corner| normals[corner as usize]);
    let is_same_side = own.dot(shared) > SAME_SIDE * own.length() * shared.length();
    if is_same_side { shared } else { own }
}

#[cfg(test)]
mod tests;
