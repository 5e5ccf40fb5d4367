//! Normals of faces and the angles at their corners, from which normals of vertices are computed. They are
//! kept: a change touches few faces, and the normals of the other faces around a vertex are still valid.

use std::ops::Range;

use rayon::prelude::*;
use trigon_math::{DVec3, Vec3};

use super::Outlines;
use super::corner_faces::FaceCorner;
use crate::Mesh;
use crate::normals::{corner_angle, or_if_zero, unit_or_zero};
use crate::quads::{QuadGroup, Quads};

/// Faces or vertices that a thread takes at a time: about a tenth of a millisecond's work,
/// a few times what it takes to wake a thread.
pub(super) const PIECE: usize = 1024;

/// The normals of all faces of a mesh, and the angles by which they are weighted.
#[derive(Debug, Clone, Default)]
pub(super) struct FaceNormals {
    /// By face.
    normals: Vec<Vec3>,
    /// By corner, in radians; none if no face is smooth.
    angles: Vec<f64>,
}

impl FaceNormals {
    pub(super) fn new(mesh: &Mesh) -> Self {
        let is_smooth = mesh.attributes().face_smooth.as_ref().is_some_and(|smooth| smooth.contains(&true));
        let faces: Vec<usize> = (0..mesh.face_count()).collect();
        let normals = faces.par_iter().with_min_len(PIECE).map(|&face| mesh.face_normal(face)).collect();
        let angles_of = |faces: &[usize]| {
            faces.iter().flat_map(|&face| angles_at(mesh, mesh.face_corners(face))).collect::<Vec<_>>()
        };
        let mut angles = Vec::new();
        if is_smooth {
            angles.reserve_exact(mesh.corner_count());
            for part in faces.par_chunks(PIECE).map(angles_of).collect::<Vec<_>>() {
                angles.extend(part);
            }
        }
        Self { normals, angles }
    }

    /// Brings those of some faces up to date; the faces increase, and have these outlines.
    pub(super) fn update(&mut self, mesh: &Mesh, faces: &[u32], outlines: &Outlines) {
        let (mut normals, mut angles) = (self.normals.as_mut_slice(), self.angles.as_mut_slice());
        let (mut first_face, mut first_corner) = (0, 0);
        let mut parts = Vec::with_capacity(faces.len().div_ceil(PIECE));
        for (faces, first_group) in faces.chunks(PIECE).zip((0..).step_by(PIECE / QuadGroup::MOST)) {
            let end = faces[faces.len() - 1] as usize + 1;
            let end_corner = mesh.face_corners(end - 1).end;
            let own_angles = if angles.is_empty() { 0 } else { end_corner - first_corner };
            parts.push(Part {
                faces,
                first_group,
                first_face,
                first_corner,
                normals: normals.split_off_mut(..end - first_face).expect("faces increase"),
                angles: angles.split_off_mut(..own_angles).expect("so do their corners"),
            });
            (first_face, first_corner) = (end, end_corner);
        }
        parts.into_par_iter().for_each(|part| part.update(mesh, outlines));
    }

    /// The normal that a flat face shows.
    pub(super) fn shown(&self, face: usize) -> Vec3 {
        or_if_zero(self.normals[face], Vec3::Y)
    }

    /// The mean normal of smooth faces at one vertex, weighted by their angles there, and added up in the order of
    /// their corners as for a whole mesh. Zero if there is none.
    pub(super) fn mean(&self, corners: impl Iterator<Item = FaceCorner>) -> Vec3 {
        let mut sum = DVec3::ZERO;
        for FaceCorner { face, corner } in corners {
            // Faces without a normal add nothing: angles are finite, and no sum is a negative zero.
            sum += self.normals[face as usize].as_dvec3() * self.angles[corner as usize];
        }
        unit_or_zero(sum).as_vec3()
    }
}

/// Some faces, and what is known of all from one of them to another.
struct Part<'a> {
    faces: &'a [u32],
    /// Of their quads.
    first_group: usize,
    first_face: usize,
    normals: &'a mut [Vec3],
    first_corner: usize,
    /// None if no face is smooth.
    angles: &'a mut [f64],
}

impl Part<'_> {
    fn update(mut self, mesh: &Mesh, outlines: &Outlines) {
        let mut room = QuadGroup::default();
        for (faces, number) in self.faces.chunks(QuadGroup::MOST).zip(self.first_group..) {
            let group = outlines.group(mesh, number, &mut room);
            for &other in group.others() {
                self.update_any(mesh, faces[other as usize] as usize);
            }
            group.for_each(
                #[inline(always)]
                |numbers, quads| {
                    self.update_quads(mesh, quads, numbers.iter().map(|&number| faces[number as usize]));
                },
            );
        }
    }

    fn update_any(&mut self, mesh: &Mesh, face: usize) {
        self.normals[face - self.first_face] = mesh.face_normal(face);
        let corners = mesh.face_corners(face);
        let own = corners.start - self.first_corner..corners.end - self.first_corner;
        if let Some(angles) = self.angles.get_mut(own) {
            angles.iter_mut().zip(angles_at(mesh, corners)).for_each(|(angle, made)| *angle = made);
        }
    }

    /// Updates the faces of the first of some quads.
    #[inline(always)]
    fn update_quads<const N: usize>(
        &mut self,
        mesh: &Mesh,
        quads: &Quads<N>,
        faces: impl Iterator<Item = u32> + Clone,
    ) {
        for (face, normal) in faces.clone().zip(quads.normals()) {
            self.normals[face as usize - self.first_face] = normal;
        }
        if self.angles.is_empty() {
            return;
        }
        for (face, angles) in faces.zip(quads.angles()) {
            let first = mesh.face_corners(face as usize).start - self.first_corner;
            self.angles[first..first + 4].copy_from_slice(&angles);
        }
    }
}

fn angles_at(mesh: &Mesh, corners: Range<usize>) -> impl Iterator<Item = f64> {
    let vertices = &mesh.corner_vertices()[corners];
    (0..vertices.len()).map(move |index| corner_angle(mesh, vertices, index))
}
