//! The mesh from which all representations are built.

use trigon_math::Vec3;
use trigon_mesh::{Mesh, primitives};

/// A triangle mesh, closed and without borders: what all representations are made from.
#[derive(Clone, Debug)]
pub struct Triangles {
    /// Where the vertices lie.
    pub positions: Vec<Vec3>,
    /// Indices of vertices, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl Triangles {
    /// A ball of 20 · 4^`subdivisions` triangles.
    #[must_use]
    pub fn ball(subdivisions: u32) -> Self {
        let mesh = primitives::icosphere(1.0, subdivisions);
        let triangle = |face: usize| {
            let corners = mesh.face_vertices(face);
            [corners[0], corners[1], corners[2]]
        };
        Self {
            positions: mesh.positions().to_vec(),
            triangles: (0..mesh.face_count()).map(triangle).collect(),
        }
    }
}

/// A mesh of the engine with the same triangles.
pub(super) fn mesh_of(triangles: &Triangles) -> Mesh {
    let mut builder = trigon_mesh::MeshBuilder::new();
    triangles.positions.iter().for_each(|&position| {
        builder.push_vertex(position);
    });
    for triangle in &triangles.triangles {
        builder.push_face(triangle).expect("indices are those of the vertices");
    }
    builder.build()
}
