//! Where vertices as drawn come from: their vertices of the mesh.

use std::sync::atomic::{AtomicU32, Ordering};

use rayon::prelude::*;
use trigon_mesh::Mesh;

use super::Geometry;

/// Triangles per task.
const SHARE: usize = 4096;

/// For each vertex of geometry at rest that a triangle has, a vertex of the mesh at the same position, to the bit;
/// 0 for the others.
pub(super) fn mesh_vertices(source: &Mesh, geometry: &Geometry) -> Vec<u32> {
    let vertices: Vec<AtomicU32> = (0..geometry.columns.vertex_count()).map(|_| AtomicU32::new(0)).collect();
    let bits = |position: [f32; 3]| position.map(f32::to_bits);
    let triangles = geometry.triangles.par_iter().enumerate().with_min_len(SHARE);
    // Fillers cover nothing, and need not be anywhere.
    let triangles = triangles.filter(|(_, [a, b, c])| a != b || b != c);
    triangles.for_each(|(number, triangle)| {
        let candidates = source.face_vertices(geometry.face(number) as usize);
        for &drawn in triangle {
            let position = geometry.columns.positions.each_ref().map(|column| column[drawn as usize]);
            let is_here =
                |&&vertex: &&u32| bits(source.positions()[vertex as usize].to_array()) == bits(position);
            let vertex = candidates.iter().find(is_here);
            // Triangles that share a vertex may find different ones, all at the same position.
            let vertex = vertex.expect("triangles have corners of their faces");
            vertices[drawn as usize].store(*vertex, Ordering::Relaxed);
        }
    });
    vertices.into_iter().map(AtomicU32::into_inner).collect()
}

#[cfg(test)]
mod tests {
    use trigon_mesh::primitives;

    use super::*;

    #[test]
    fn drawn_vertices_lie_where_those_of_the_mesh_do() {
        for mesh in [primitives::cube(1.0), primitives::torus(2.0, 0.5, 6, 5)] {
            let geometry = Geometry::new(&mesh);
            let vertices = mesh_vertices(&mesh, &geometry);
            assert_eq!(vertices.len(), geometry.columns.vertex_count(), "one for each");
            for (&vertex, drawn) in vertices.iter().zip(0..) {
                let position = geometry.columns.position(drawn).expect("it is drawn");
                assert_eq!(mesh.positions()[vertex as usize], position, "vertex {drawn}");
            }
        }
    }
}
