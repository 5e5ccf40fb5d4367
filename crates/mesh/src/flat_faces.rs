//! Polygons that are shaded flat. Transforming their old normals would be wrong in a pose: their normals are
//! those of the posed polygons (glTF 2.0 specification, section 3.7.2.1: flat normals where none are given).

use std::ops::Range;

use trigon_math::{DVec3, Vec3, area_vector, unit_or_zero};

use crate::{Attributes, Mesh};

/// Polygons that are shaded flat, by their vertices in a
/// [`RenderMesh`](crate::RenderMesh), which they share with no other polygon.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FlatFaces {
    /// Where the vertices of each begin, and the end.
    starts: Vec<u32>,
    vertices: Vec<u32>,
}

impl FlatFaces {
    /// The flat faces of a mesh; none of one that no pose bends.
    pub(crate) fn of(mesh: &Mesh, vertex_of_corner: &[u32]) -> Self {
        let mut faces = Self { starts: vec![0], vertices: Vec::new() };
        for corners in flat_faces(mesh) {
            faces.vertices.extend_from_slice(&vertex_of_corner[corners]);
            faces.starts.push(faces.vertices.len() as u32);
        }
        faces
    }

    /// Gives every one the normal of its polygon. One without area keeps what it has,
    /// and `is_mirrored` says of a vertex whether its surroundings are turned inside out.
    pub(super) fn set_normals(
        &self,
        positions: &[Vec3],
        normals: &mut [Vec3],
        is_mirrored: impl Fn(usize) -> bool,
    ) {
        for ends in self.starts.windows(2) {
            let vertices = &self.vertices[ends[0] as usize..ends[1] as usize];
            let corners = vertices.iter().map(|&vertex| positions[vertex as usize].as_dvec3());
            let normal = unit_or_zero(area_vector(corners)).as_vec3();
            let Some(&first) = vertices.first().filter(|_| normal != Vec3::ZERO) else { continue };
            let normal = if is_mirrored(first as usize) { -normal } else { normal };
            vertices.iter().for_each(|&vertex| normals[vertex as usize] = normal);
        }
    }
}

/// A number for each corner that no two flat faces share; 0 at other faces, and no
/// numbers at all for a mesh that no pose bends.
pub(crate) fn flat_classes(mesh: &Mesh) -> Vec<u32> {
    let mut classes = Vec::new();
    for (corners, class) in flat_faces(mesh).zip(1..) {
        classes.resize(mesh.corner_count(), 0);
        classes[corners].fill(class);
    }
    classes
}

/// The corners of each face that a pose can bend and that is shaded flat: it is not
/// smooth, and no corner has a normal of its own or is told by a target where its
/// normal goes.
fn flat_faces(mesh: &Mesh) -> impl Iterator<Item = Range<usize>> + '_ {
    let attributes = mesh.attributes();
    let mut targets = attributes.morph_targets.iter();
    let moves = attributes.skin.is_some() || targets.any(|target| !target.positions.is_empty());
    let is_smooth = |face: usize| attributes.face_smooth.as_ref().is_some_and(|smooth| smooth[face]);
    let told = if moves { told_corners(attributes, mesh.corner_count()) } else { Vec::new() };
    let faces = mesh.faces().enumerate().take(if moves { mesh.face_count() } else { 0 });
    let flat =
        faces.filter(move |(face, corners)| !is_smooth(*face) && !told[corners.clone()].contains(&true));
    flat.map(|(_, corners)| corners)
}

/// Which corners have a normal, or a change of it.
fn told_corners(attributes: &Attributes, count: usize) -> Vec<bool> {
    let is_given = |normal: &Vec3| unit_or_zero(normal.as_dvec3()) != DVec3::ZERO;
    let given = attributes.corner_normals.as_ref();
    let mut told = given.map_or_else(|| vec![false; count], |normals| normals.iter().map(is_given).collect());
    for target in &attributes.morph_targets {
        target.normals.iter().for_each(|(corner, _)| told[corner as usize] = true);
    }
    told
}
