//! The triangles of a whole mesh, and which face each one came from.

use crate::Mesh;
use crate::triangulate::Triangulator;

/// A mesh's faces as triangles, in face order.
///
/// Derived from a [`Mesh`] by [`Mesh::triangulation`]; how a polygon is cut is
/// told at [`triangulate_polygon`](crate::triangulate_polygon).
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Triangulation {
    /// Corner indices of the mesh, counter-clockwise like the face.
    pub triangles: Vec<[u32; 3]>,
    /// The face of each triangle: never decreasing.
    pub triangle_faces: Vec<u32>,
}

impl Mesh {
    /// Cuts all faces into triangles.
    pub fn triangulation(&self) -> Triangulation {
        let most = self.corner_count() - 2 * self.face_count();
        let mut triangles = Vec::with_capacity(most);
        let mut triangle_faces = Vec::with_capacity(most);
        let mut triangulator = Triangulator::default();
        let mut outline = Vec::new();
        for (face, corners) in self.faces().enumerate() {
            let before = triangles.len();
            let vertices = &self.corner_vertices()[corners.clone()];
            outline.clear();
            outline.extend(vertices.iter().map(|&v| self.positions()[v as usize]));
            triangulator.polygon(&outline, &mut triangles);
            for triangle in &mut triangles[before..] {
                *triangle = triangle.map(|corner| corner + corners.start as u32);
            }
            triangle_faces.resize(triangles.len(), face as u32);
        }
        Triangulation { triangles, triangle_faces }
    }
}
