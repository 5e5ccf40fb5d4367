//! Which face a corner belongs to.

use std::ops::Range;

use crate::Mesh;

/// A face and one of its corners.
#[derive(Debug, Clone, Copy)]
pub(super) struct FaceCorner {
    pub(super) face: u32,
    pub(super) corner: u32,
}

/// Finds faces by their corners, at once where all have equally many, and else by a
/// search. A table would take as much memory as the corners themselves.
pub(super) struct CornerFaces<'m> {
    mesh: &'m Mesh,
    faces_per_corner: f64,
}

impl<'m> CornerFaces<'m> {
    pub(super) fn new(mesh: &'m Mesh) -> Self {
        Self { mesh, faces_per_corner: mesh.face_count() as f64 / mesh.corner_count() as f64 }
    }

    /// The face of a corner, and its corners.
    pub(super) fn of(&self, corner: u32) -> (usize, Range<usize>) {
        // The middle of the corner, so that rounding cannot lead to a neighbour.
        let face = ((f64::from(corner) + 0.5) * self.faces_per_corner) as usize;
        let corners = self.mesh.face_corners(face);
        if corners.contains(&(corner as usize)) {
            return (face, corners);
        }
        let face = self.mesh.face_at(corner);
        (face, self.mesh.face_corners(face))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{MeshBuilder, primitives};

    #[test]
    fn every_corner_knows_its_face() {
        let mut builder = MeshBuilder::new();
        for _ in 0..9 {
            builder.push_vertex(trigon_math::Vec3::ZERO);
        }
        for corners in [3, 9, 4, 3, 3, 7, 3] {
            builder.push_face(&(0..corners).collect::<Vec<_>>()).expect("distinct vertices");
        }
        for mesh in [builder.build(), primitives::torus(2.0, 1.0, 30, 20), primitives::icosphere(1.0, 3)] {
            let faces = CornerFaces::new(&mesh);
            for (face, corners) in mesh.faces().enumerate() {
                for corner in corners.clone() {
                    assert_eq!(faces.of(corner as u32), (face, corners.clone()), "corner {corner}");
                }
            }
        }
    }
}
