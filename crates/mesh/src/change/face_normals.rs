//! Normals of faces and the angles at their corners, which normals of vertices are made of:
//! kept, as most of what a vertex asks for is of faces that no change has touched.

use std::ops::Range;

use rayon::prelude::*;
use trigon_math::Vec3;

use super::render_links::PIECE;
use crate::Mesh;
use crate::normals::corner_angle;

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

    /// Brings those of some faces up to date.
    pub(super) fn update(&mut self, mesh: &Mesh, faces: &[u32]) {
        let has_angles = !self.angles.is_empty();
        let made = |faces: &[u32]| {
            let mut made = Self::default();
            for &face in faces {
                made.normals.push(mesh.face_normal(face as usize));
                if has_angles {
                    made.angles.extend(angles_at(mesh, mesh.face_corners(face as usize)));
                }
            }
            made
        };
        let parts = faces.par_chunks(PIECE).map(made).collect::<Vec<_>>();
        for (faces, part) in faces.chunks(PIECE).zip(parts) {
            let mut angles = part.angles.as_slice();
            for (&face, normal) in faces.iter().zip(part.normals) {
                self.normals[face as usize] = normal;
                if has_angles {
                    let corners = mesh.face_corners(face as usize);
                    let (own, rest) = angles.split_at(corners.len());
                    self.angles[corners].copy_from_slice(own);
                    angles = rest;
                }
            }
        }
    }

    /// The unit normal of a face; zero if it has none.
    pub(super) fn normal(&self, face: usize) -> Vec3 {
        self.normals[face]
    }

    /// The angle at a corner of a mesh that has smooth faces.
    pub(super) fn angle(&self, corner: u32) -> f64 {
        self.angles[corner as usize]
    }
}

fn angles_at(mesh: &Mesh, corners: Range<usize>) -> impl Iterator<Item = f64> {
    let vertices = &mesh.corner_vertices()[corners];
    (0..vertices.len()).map(move |index| corner_angle(mesh, vertices, index))
}
