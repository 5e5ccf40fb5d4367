//! Shading normals of the corners at one vertex: the bits of [`Mesh::shading_normals`], without computing
//! the rest of the mesh.

use trigon_math::{DVec3, Vec3};

use super::corner_faces::CornerFaces;
use super::face_normals::FaceNormals;
use crate::Mesh;
use crate::normals::{or_if_zero, unit_keeping, unit_or_zero};

/// What the normals at a vertex are made of.
pub(super) struct LocalNormals<'a> {
    faces: CornerFaces<'a>,
    given: Option<&'a [Vec3]>,
    smooth: Option<&'a [bool]>,
    /// Of every face; none where all corners have normals of their own.
    face_normals: &'a FaceNormals,
}

impl<'a> LocalNormals<'a> {
    pub(super) fn new(mesh: &'a Mesh, face_normals: &'a FaceNormals) -> Self {
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
    pub(super) fn at_corners(&self, corners: &[u32], around: &mut Vec<usize>, normals: &mut Vec<Vec3>) {
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
        around.extend(corners.iter().map(|&corner| self.faces.of(corner).0));
        let mut of_vertex = None;
        for (normal, &face) in normals.iter_mut().zip(&*around).filter(|(normal, _)| **normal == Vec3::ZERO) {
            let of_face = or_if_zero(self.face_normals.normal(face), Vec3::Y);
            *normal = if self.is_smooth(face) {
                or_if_zero(*of_vertex.get_or_insert_with(|| self.mean(corners, around)), of_face)
            } else {
                of_face
            };
        }
    }

    /// The normal that all corners at one vertex have where each of them takes it from the
    /// vertex; else `None`. Most vertices of most meshes are such.
    pub(super) fn of_all(&self, corners: &[u32]) -> Option<Vec3> {
        let smooth = self.smooth.filter(|_| self.given.is_none())?;
        let mut sum = DVec3::ZERO;
        for &corner in corners {
            let face = self.faces.of(corner).0;
            if !smooth[face] {
                return None;
            }
            sum += self.weighted(face, corner);
        }
        let normal = unit_or_zero(sum).as_vec3();
        (normal != Vec3::ZERO).then_some(normal)
    }

    fn is_smooth(&self, face: usize) -> bool {
        self.smooth.is_some_and(|smooth| smooth[face])
    }

    /// The mean over the smooth faces at a vertex, added up in the order of their corners
    /// as for a whole mesh.
    fn mean(&self, corners: &[u32], around: &[usize]) -> Vec3 {
        let mut sum = DVec3::ZERO;
        for (&corner, &face) in corners.iter().zip(around) {
            if self.is_smooth(face) {
                sum += self.weighted(face, corner);
            }
        }
        unit_or_zero(sum).as_vec3()
    }

    /// What a smooth face adds to the normal of the vertex at one of its corners.
    fn weighted(&self, face: usize, corner: u32) -> DVec3 {
        let normal = self.face_normals.normal(face).as_dvec3();
        if normal == DVec3::ZERO { DVec3::ZERO } else { normal * self.face_normals.angle(corner) }
    }
}
