//! Normals of faces and the angles at their corners, from which normals of vertices are computed.

use std::ops::Range;

use rayon::prelude::*;
use trigon_math::{DVec3, Vec3, or_if_zero, unit_or_zero};

use super::corner_faces::FaceCorner;
use super::face_normals::PIECE;
use crate::Mesh;
use crate::normals::corner_angle;

/// The normals of faces, and the angles by which they are weighted.
#[derive(Debug, Clone, Default)]
pub(super) struct NormalLists {
    /// By face.
    pub(super) normals: Vec<Vec3>,
    /// By corner, in radians; none if no face is smooth.
    pub(super) angles: Vec<f64>,
}

impl NormalLists {
    /// Of all faces of a mesh.
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

pub(super) fn angles_at(mesh: &Mesh, corners: Range<usize>) -> impl Iterator<Item = f64> {
    let vertices = &mesh.corner_vertices()[corners];
    (0..vertices.len()).map(move |index| corner_angle(mesh, vertices, index))
}
