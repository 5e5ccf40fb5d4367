//! The normals of all faces of a mesh, kept so that a change computes only those of the faces around it, and the
//! shading normals at vertices that follow from them: the bits of [`Mesh::shading_normals`].

use std::ops::Range;

use rayon::prelude::*;
use trigon_math::{DVec3, Vec3, or_if_zero, unit_or_zero};

use super::ELEMENTS_PER_TASK;
use crate::Mesh;
use crate::normals::{corner_angle, unit_keeping};

/// The normals of faces, and the angles by which they are weighted at vertices.
#[derive(Debug, Clone, Default)]
pub(super) struct FaceNormals {
    /// By face; zero of a face without area.
    normals: Vec<Vec3>,
    /// By corner, in radians; none if no face is smooth.
    angles: Vec<f64>,
}

/// A face and one of its corners.
#[derive(Debug, Clone, Copy)]
pub(super) struct FaceCorner {
    pub(super) face: u32,
    pub(super) corner: u32,
}

impl FaceNormals {
    pub(super) fn new(mesh: &Mesh) -> Self {
        let is_smooth = mesh.attributes().face_smooth.as_ref().is_some_and(|smooth| smooth.contains(&true));
        let angles = if is_smooth { mesh.corner_count() } else { 0 };
        let mut all = Self { normals: vec![Vec3::ZERO; mesh.face_count()], angles: vec![0.0; angles] };
        let faces: Vec<u32> = (0..mesh.face_count() as u32).collect();
        all.update(mesh, &faces);
        all
    }

    /// Computes the normals of some faces, which increase, and the angles at their corners.
    pub(super) fn update(&mut self, mesh: &Mesh, faces: &[u32]) {
        let (mut normals, mut angles) = (self.normals.as_mut_slice(), self.angles.as_mut_slice());
        let (mut first_face, mut first_corner) = (0, 0);
        let mut tasks = Vec::with_capacity(faces.len().div_ceil(ELEMENTS_PER_TASK));
        for faces in faces.chunks(ELEMENTS_PER_TASK) {
            let end = faces[faces.len() - 1] as usize + 1;
            let end_corner = mesh.face_corners(end - 1).end;
            let own_angles = if angles.is_empty() { 0 } else { end_corner - first_corner };
            tasks.push(UpdateTask {
                faces,
                first_face,
                first_corner,
                normals: normals.split_off_mut(..end - first_face).expect("faces increase"),
                angles: angles.split_off_mut(..own_angles).expect("so do their corners"),
            });
            (first_face, first_corner) = (end, end_corner);
        }
        tasks.into_par_iter().for_each(|task| task.run(mesh));
    }

    /// The normal that a flat face shows.
    pub(super) fn shown(&self, face: u32) -> Vec3 {
        or_if_zero(self.normals[face as usize], Vec3::Y)
    }

    /// The mean normal of smooth faces at one vertex, weighted by their angles there, and added up in the order of
    /// their corners as for a whole mesh. Zero if there is none.
    fn mean(&self, corners: impl Iterator<Item = FaceCorner>) -> Vec3 {
        let mut sum = DVec3::ZERO;
        for FaceCorner { face, corner } in corners {
            // Faces without a normal add nothing: angles are finite, and no sum is a negative zero.
            sum += self.normals[face as usize].as_dvec3() * self.angles[corner as usize];
        }
        unit_or_zero(sum).as_vec3()
    }
}

/// Some faces, and what is known of all faces of the mesh from one of them to another.
struct UpdateTask<'a> {
    faces: &'a [u32],
    first_face: usize,
    normals: &'a mut [Vec3],
    first_corner: usize,
    /// None if no face is smooth.
    angles: &'a mut [f64],
}

impl UpdateTask<'_> {
    fn run(self, mesh: &Mesh) {
        /// Faces whose corners are read ahead: they may lie all over the memory.
        const READ_AHEAD: usize = 256;
        for faces in self.faces.chunks(READ_AHEAD) {
            mesh.prefetch_faces(faces.iter().copied());
            for face in faces.iter().map(|&face| face as usize) {
                self.normals[face - self.first_face] = mesh.face_normal(face);
                let Range { start, end } = mesh.face_corners(face);
                let own = start - self.first_corner..end - self.first_corner;
                let vertices = mesh.face_vertices(face);
                for (index, angle) in self.angles.get_mut(own).into_iter().flatten().enumerate() {
                    *angle = corner_angle(mesh, vertices, index);
                }
            }
        }
    }
}

/// What the normals at a vertex are made of.
pub(super) struct VertexNormals<'a> {
    corner_faces: CornerFaces<'a>,
    given: Option<&'a [Vec3]>,
    smooth: Option<&'a [bool]>,
    /// None where all corners have normals of their own.
    face_normals: &'a FaceNormals,
}

impl<'a> VertexNormals<'a> {
    pub(super) fn new(mesh: &'a Mesh, face_normals: &'a FaceNormals) -> Self {
        let attributes = mesh.attributes();
        Self {
            corner_faces: CornerFaces::new(mesh),
            given: attributes.corner_normals.as_deref(),
            smooth: attributes.face_smooth.as_deref(),
            face_normals,
        }
    }

    /// The normals of all corners at one vertex; the corners increase.
    pub(super) fn at_corners(&self, corners: &[u32], normals: &mut Vec<Vec3>) {
        normals.clear();
        let mut mean = None;
        for &corner in corners {
            let given = self.given.map_or(Vec3::ZERO, |given| unit_keeping(given[corner as usize]));
            if given != Vec3::ZERO {
                normals.push(given);
                continue;
            }
            let face = self.corner_faces.face_of(corner);
            let of_face = self.face_normals.shown(face);
            normals.push(if self.is_smooth(face) {
                or_if_zero(*mean.get_or_insert_with(|| self.mean(corners)), of_face)
            } else {
                of_face
            });
        }
    }

    /// The mean over the smooth faces at a vertex with these corners.
    fn mean(&self, corners: &[u32]) -> Vec3 {
        let of = corners.iter().map(|&corner| FaceCorner { face: self.corner_faces.face_of(corner), corner });
        self.face_normals.mean(of.filter(|of| self.is_smooth(of.face)))
    }

    fn is_smooth(&self, face: u32) -> bool {
        self.smooth.is_some_and(|smooth| smooth[face as usize])
    }
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

    /// The face of a corner.
    pub(super) fn face_of(&self, corner: u32) -> u32 {
        // The middle of the corner, so that rounding cannot lead to a neighbour.
        let face = ((f64::from(corner) + 0.5) * self.faces_per_corner) as usize;
        let is_guessed = self.mesh.face_corners(face).contains(&(corner as usize));
        (if is_guessed { face } else { self.mesh.face_at(corner) }) as u32
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
            builder.push_vertex(Vec3::ZERO);
        }
        for corners in [3, 9, 4, 3, 3, 7, 3] {
            builder.push_face(&(0..corners).collect::<Vec<_>>()).expect("distinct vertices");
        }
        for mesh in [builder.build(), primitives::torus(2.0, 1.0, 30, 20), primitives::icosphere(1.0, 3)] {
            let corner_faces = CornerFaces::new(&mesh);
            for (face, corners) in (0..).zip(mesh.faces()) {
                for corner in corners.clone() {
                    assert_eq!(corner_faces.face_of(corner as u32), face, "corner {corner}");
                }
            }
        }
    }
}
