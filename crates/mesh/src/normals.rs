//! Normals: of faces from their area vectors, of vertices as angle-weighted means of their faces,
//! and of corners as a renderer needs them.

use std::borrow::Cow;

use rayon::prelude::*;
use trigon_math::{DVec3, Vec3, angle, area_vector, or_if_zero, unit_or_zero};

use crate::{Attributes, Mesh};

impl Mesh {
    /// The area vector of a face: its direction is the face's normal (on the side from which the
    /// face is counter-clockwise), its length the area in square metres. For a non-planar face this
    /// is the mean over its surface, however it is triangulated.
    ///
    /// # Panics
    ///
    /// The face does not exist.
    pub fn face_area_vector(&self, face: usize) -> DVec3 {
        area_vector(self.face_vertices(face).iter().map(|&v| self.position(v)))
    }

    /// The unit normal of every face. Zero if a face has no area or a position is not finite.
    pub fn face_normals(&self) -> Vec<Vec3> {
        (0..self.face_count()).map(|face| self.face_normal(face)).collect()
    }

    pub(crate) fn face_normal(&self, face: usize) -> Vec3 {
        unit_or_zero(self.face_area_vector(face)).as_vec3()
    }

    /// The unit normal of every vertex: the mean of the normals of all its faces, weighted by the angle of
    /// each face's corner there. So it does not depend on the triangulation (Thürmer and Wüthrich, "Computing
    /// Vertex Normals from Polygonal Facets", 1998). Zero if faces cancel each other or there are none.
    pub fn vertex_normals(&self) -> Vec<Vec3> {
        let sums = self.sum_normals(&self.face_normals(), |_| true);
        sums.into_iter().map(|n| unit_or_zero(n).as_vec3()).collect()
    }

    /// The unit normal at every corner, as a renderer uses it: the corner's own, if it was given and has a
    /// direction. Otherwise it is the vertex normal over the smooth faces if the face is smooth, or else the
    /// face's. If even that has no direction, straight up: such a face has no area.
    pub fn shading_normals(&self) -> Vec<Vec3> {
        let Some(given) = &self.attributes().corner_normals else {
            return self.computed_normals();
        };
        let mut normals: Vec<Vec3> = given.iter().map(|&normal| unit_keeping(normal)).collect();
        if normals.contains(&Vec3::ZERO) {
            for (normal, computed) in normals.iter_mut().zip(self.computed_normals()) {
                if *normal == Vec3::ZERO {
                    *normal = computed;
                }
            }
        }
        normals
    }

    /// The same, without a copy where all are used as they were given.
    pub(crate) fn shading_normals_or_given(&self) -> Cow<'_, [Vec3]> {
        // Without a way out after each normal, the compiler tests several at a time.
        let are_unit = |some: &[Vec3]| some.iter().fold(true, |so_far, &normal| so_far & is_unit(normal));
        match &self.attributes().corner_normals {
            Some(given) if given.par_chunks(1024).with_min_len(16).all(are_unit) => Cow::Borrowed(given),
            _ => Cow::Owned(self.shading_normals()),
        }
    }

    /// Whether the shading normals at all corners of each polygon are the polygon's: no corner has its own, no
    /// polygon is smooth, and no pose deforms the mesh.
    pub(crate) fn is_flat(&self) -> bool {
        let Attributes { corner_normals, face_smooth, skin, morph_targets, .. } = self.attributes();
        let is_smooth = face_smooth.iter().flatten().any(|&smooth| smooth);
        corner_normals.is_none() && !is_smooth && skin.is_none() && morph_targets.is_empty()
    }

    /// The shading normals of the polygons of a flat mesh.
    pub(crate) fn flat_normals(&self) -> Vec<Vec3> {
        let faces = (0..self.face_count()).into_par_iter().with_min_len(1 << 12);
        faces.map(|face| or_if_zero(self.face_normal(face), Vec3::Y)).collect()
    }

    /// Shading normals from the faces alone.
    fn computed_normals(&self) -> Vec<Vec3> {
        let mut face_normals = self.face_normals();
        let smooth = self.attributes().face_smooth.as_deref().filter(|flags| flags.contains(&true));
        let vertex_normals = smooth.map(|flags| {
            let sums = self.sum_normals(&face_normals, |face| flags[face]);
            sums.into_iter().map(|n| unit_or_zero(n).as_vec3()).collect::<Vec<_>>()
        });
        for normal in &mut face_normals {
            *normal = or_if_zero(*normal, Vec3::Y);
        }
        let mut normals = Vec::with_capacity(self.corner_count());
        for (face, corners) in self.faces().enumerate() {
            let of_face = face_normals[face];
            match (&vertex_normals, smooth) {
                (Some(of_vertices), Some(flags)) if flags[face] => {
                    let vertices = self.corner_vertices()[corners].iter();
                    normals.extend(vertices.map(|&v| or_if_zero(of_vertices[v as usize], of_face)));
                }
                _ => normals.resize(corners.end, of_face),
            }
        }
        normals
    }

    /// Sums of the normals of the selected faces, per vertex, weighted by corner angle.
    fn sum_normals(&self, face_normals: &[Vec3], counts: impl Fn(usize) -> bool) -> Vec<DVec3> {
        let mut sums = vec![DVec3::ZERO; self.vertex_count()];
        self.for_each_weighted_corner(face_normals, counts, |corner, weighted| {
            sums[self.corner_vertices()[corner] as usize] += weighted;
        });
        sums
    }

    /// Calls back with every corner of the selected faces and the face's normal times the angle at
    /// that corner.
    pub(crate) fn for_each_weighted_corner(
        &self,
        face_normals: &[Vec3],
        counts: impl Fn(usize) -> bool,
        mut call: impl FnMut(usize, DVec3),
    ) {
        for (face, corners) in self.faces().enumerate() {
            let normal = face_normals[face].as_dvec3();
            if !counts(face) || normal == DVec3::ZERO {
                continue;
            }
            let vertices = &self.corner_vertices()[corners.clone()];
            let last = vertices[vertices.len() - 1];
            let mut here = self.position(vertices[0]);
            let mut back = self.position(last) - here;
            for (i, corner) in corners.enumerate() {
                let next = self.position(*vertices.get(i + 1).unwrap_or(&vertices[0]));
                let ahead = next - here;
                call(corner, normal * angle(back, ahead));
                back = -ahead;
                here = next;
            }
        }
    }

    pub(crate) fn position(&self, vertex: u32) -> DVec3 {
        self.positions()[vertex as usize].as_dvec3()
    }
}

/// The angle of a face at the corner of this number among its own: the bits that
/// [`Mesh::for_each_weighted_corner`] weighs by.
pub(crate) fn corner_angle(mesh: &Mesh, vertices: &[u32], index: usize) -> f64 {
    let here = mesh.position(vertices[index]);
    // Subtracted as on the way round the face.
    let back = match index {
        0 => mesh.position(vertices[vertices.len() - 1]) - here,
        _ => -(here - mesh.position(vertices[index - 1])),
    };
    let next = mesh.position(*vertices.get(index + 1).unwrap_or(&vertices[0]));
    angle(back, next - here)
}

/// The largest deviation of a squared length from 1 for a normal to be kept as given: a few f32
/// roundings.
const UNIT_TOLERANCE: f64 = 1e-6;

/// Like [`unit_or_zero`], but a unit vector keeps its bits.
pub(crate) fn unit_keeping(normal: Vec3) -> Vec3 {
    let wide = normal.as_dvec3();
    if is_unit(normal) { normal } else { unit_or_zero(wide).as_vec3() }
}

fn is_unit(normal: Vec3) -> bool {
    (normal.as_dvec3().length_squared() - 1.0).abs() <= UNIT_TOLERANCE
}
