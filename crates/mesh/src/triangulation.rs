//! The triangles of a whole mesh, and which face each one came from.

use std::hint::black_box;

use super::Mesh;
use super::triangulate::Triangulator;

/// A mesh's faces as triangles, in face order.
///
/// Derived from a [`Mesh`] by [`Mesh::triangulation`], or some of its faces by [`Mesh::triangulation_of`];
/// [`triangulate_polygon`](crate::triangulate_polygon) explains how a polygon is triangulated.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Triangulation {
    /// Corner indices of the mesh, counter-clockwise like the face.
    pub triangles: Vec<[u32; 3]>,
    /// The face of each triangle: never decreasing, if all faces are triangulated.
    pub triangle_faces: Vec<u32>,
}

impl Mesh {
    /// Triangulates all faces.
    pub fn triangulation(&self) -> Triangulation {
        let faces = self.face_count() as u32;
        if self.has_only_triangles() {
            let corners = |face| [3 * face, 3 * face + 1, 3 * face + 2];
            let (triangles, triangle_faces) = ((0..faces).map(corners).collect(), (0..faces).collect());
            return Triangulation { triangles, triangle_faces };
        }
        let most = self.corner_count() - 2 * self.face_count();
        self.triangulated(0..faces, most)
    }

    /// Triangulates some faces, in the order in which they are given.
    ///
    /// # Panics
    ///
    /// When one of the faces does not exist.
    pub fn triangulation_of(&self, faces: impl ExactSizeIterator<Item = u32> + Clone) -> Triangulation {
        let most = 2 * faces.len();
        self.triangulated(faces, most)
    }

    /// Triangulates some faces, into about `capacity` triangles.
    fn triangulated(&self, mut faces: impl Iterator<Item = u32> + Clone, capacity: usize) -> Triangulation {
        /// Faces whose corners are read ahead.
        const GROUP: usize = 256;
        let mut triangles = Vec::with_capacity(capacity);
        let mut triangle_faces = Vec::with_capacity(capacity);
        let mut triangulator = Triangulator::default();
        let mut outline = Vec::new();
        for (number, face) in faces.clone().enumerate() {
            if number % GROUP == 0 {
                self.prefetch_faces(faces.clone().take(GROUP));
                faces.by_ref().take(GROUP).for_each(drop);
            }
            let (before, corners) = (triangles.len(), self.face_corners(face as usize));
            let vertices = &self.corner_vertices()[corners.clone()];
            outline.clear();
            outline.extend(vertices.iter().map(|&v| self.positions()[v as usize]));
            triangulator.polygon(&outline, &mut triangles);
            for triangle in &mut triangles[before..] {
                *triangle = triangle.map(|corner| corner + corners.start as u32);
            }
            triangle_faces.resize(triangles.len(), face);
        }
        Triangulation { triangles, triangle_faces }
    }

    /// Reads the corners of faces, which lie all over the memory, and their positions.
    pub(crate) fn prefetch_faces(&self, faces: impl Iterator<Item = u32> + Clone) {
        prefetch(faces.clone().map(|face| self.corner_vertices()[self.face_corners(face as usize).start]));
        prefetch(faces.flat_map(|face| {
            let vertices = self.face_vertices(face as usize);
            vertices.iter().map(|&vertex| self.positions()[vertex as usize].x.to_bits())
        }));
    }
}

/// Reads values that are needed soon, from places all over the memory. A processor waits for many of them at once if
/// nothing else is done meanwhile, and finds them nearby afterwards; one after the other, each would take as long.
pub(crate) fn prefetch(values: impl Iterator<Item = u32>) {
    black_box(values.fold(0, |all, value| all ^ value));
}
