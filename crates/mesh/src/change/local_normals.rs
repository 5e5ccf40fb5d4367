//! Shading normals of the corners at one vertex: the bits of [`Mesh::shading_normals`], without computing
//! the rest of the mesh.

use trigon_math::{Vec3, or_if_zero};

use super::corner_faces::{CornerFaces, FaceCorner};
use super::fans::FanPiece;
use super::normal_lists::NormalLists;
use crate::Mesh;
use crate::normals::unit_keeping;

/// What the normals at a vertex are made of.
pub(super) struct LocalNormals<'a> {
    faces: CornerFaces<'a>,
    given: Option<&'a [Vec3]>,
    smooth: Option<&'a [bool]>,
    /// Of every face; none where all corners have normals of their own.
    face_normals: &'a NormalLists,
}

impl<'a> LocalNormals<'a> {
    pub(super) fn new(mesh: &'a Mesh, face_normals: &'a NormalLists) -> Self {
        let attributes = mesh.attributes();
        Self {
            faces: CornerFaces::new(mesh),
            given: attributes.corner_normals.as_deref(),
            smooth: attributes.face_smooth.as_deref(),
            face_normals,
        }
    }

    /// The normals of all corners at one vertex; the corners increase. `around` is room
    /// for their faces.
    pub(super) fn at_corners(&self, corners: &[u32], around: &mut Vec<FaceCorner>, normals: &mut Vec<Vec3>) {
        normals.clear();
        let given = |&corner: &u32| match self.given {
            Some(given) => unit_keeping(given[corner as usize]),
            None => Vec3::ZERO,
        };
        normals.extend(corners.iter().map(given));
        if !normals.contains(&Vec3::ZERO) {
            return;
        }
        around.clear();
        around.extend(corners.iter().map(|&corner| self.face_corner(corner)));
        // The mean over the smooth faces at the vertex.
        let mean = || self.face_normals.mean(around.iter().copied().filter(|of| self.is_smooth(of.face)));
        let mut of_vertex = None;
        for (normal, of) in normals.iter_mut().zip(&*around).filter(|(normal, _)| **normal == Vec3::ZERO) {
            let of_face = self.face_normals.shown(of.face as usize);
            *normal = if self.is_smooth(of.face) {
                or_if_zero(*of_vertex.get_or_insert_with(mean), of_face)
            } else {
                of_face
            };
        }
    }

    /// Adds the corners at a vertex to a fan, if each of them takes its normal from the vertex; returns that normal.
    /// Most vertices of most meshes are such.
    pub(super) fn add_fan(&self, corners: &[u32], fans: &mut FanPiece) -> Option<Vec3> {
        self.smooth.filter(|_| self.given.is_none())?;
        let smooth = |&corner: &u32| Some(self.face_corner(corner)).filter(|of| self.is_smooth(of.face));
        fans.push(self.face_normals, corners.iter().map(smooth))
    }

    fn face_corner(&self, corner: u32) -> FaceCorner {
        FaceCorner { face: self.faces.of(corner).0 as u32, corner }
    }

    fn is_smooth(&self, face: u32) -> bool {
        self.smooth.is_some_and(|smooth| smooth[face as usize])
    }
}
