//! The edge of the mesh to which each side of a triangle belongs.

use trigon_mesh::Mesh;

/// Marks a diagonal of a triangulation.
pub(super) const NO_EDGE: u32 = u32::MAX;

/// For each triangle of a mesh's triangulation, the edges of its three sides, starting at the first corner.
pub(super) fn sides_of_mesh(source: &Mesh) -> Vec<[u32; 3]> {
    let triangulation = source.triangulation();
    let triangles = triangulation.triangles.iter().zip(&triangulation.triangle_faces);
    triangles.map(|(triangle, &face)| sides_of_triangle(source, face, triangle)).collect()
}

/// The edges of one triangle of a face. A side is an edge if it joins consecutive corners of the face.
pub(super) fn sides_of_triangle(source: &Mesh, face: u32, &[a, b, c]: &[u32; 3]) -> [u32; 3] {
    let corners = source.face_corners(face as usize);
    let (first, last) = (corners.start as u32, corners.end as u32 - 1);
    [(a, b), (b, c), (c, a)].map(|(from, to)| {
        let next = if from == last { first } else { from + 1 };
        if to == next { source.corner_edge(from as usize).unwrap_or(NO_EDGE) } else { NO_EDGE }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use trigon_mesh::primitives;

    #[test]
    fn every_edge_is_a_side_on_each_of_its_faces() {
        for mesh in [primitives::cube(1.0), primitives::dodecahedron(1.0)] {
            let mut found = vec![0; mesh.edge_count()];
            let triangulation = mesh.triangulation();
            for (sides, triangle) in sides_of_mesh(&mesh).iter().zip(&triangulation.triangles) {
                let vertices = triangle.map(|corner| mesh.corner_vertices()[corner as usize]);
                for (side, &edge) in sides.iter().enumerate().filter(|(_, edge)| **edge != NO_EDGE) {
                    let [from, to] = [vertices[side], vertices[(side + 1) % 3]];
                    assert_eq!(mesh.edges()[edge as usize], [from.min(to), from.max(to)], "side {side}");
                    found[edge as usize] += 1;
                }
            }
            assert!(found.iter().all(|&count| count == 2), "{found:?}");
        }
    }
}
