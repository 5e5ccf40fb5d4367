//! Normals: of faces by their area vector, of vertices as the mean of their
//! faces weighted by angle, and of corners as a renderer needs them.

use trigon_math::{DVec3, Vec3, elementary};

use crate::Mesh;
use crate::triangulate::area_vector;

impl Mesh {
    /// The area vector of a face: its direction is the face's normal (out of
    /// the side from which the face is counter-clockwise), its length the
    /// area in square metres. For a face that is not planar this is the mean
    /// over its surface, however that is cut.
    ///
    /// # Panics
    ///
    /// When there is no such face.
    pub fn face_area_vector(&self, face: usize) -> DVec3 {
        area_vector(self.face_vertices(face).iter().map(|&v| self.position(v)))
    }

    /// The unit normal of every face. The zero vector where a face has no
    /// area or a position is not finite.
    pub fn face_normals(&self) -> Vec<Vec3> {
        let normals = (0..self.face_count()).map(|face| self.face_area_vector(face));
        normals.map(|n| unit_or_zero(n).as_vec3()).collect()
    }

    /// The unit normal of every vertex: the mean of the normals of all its
    /// faces, weighted by the angle of each face's corner there, so that it
    /// does not depend on how the faces are cut (Thürmer and Wüthrich,
    /// "Computing Vertex Normals from Polygonal Facets", 1998). The zero
    /// vector where faces cancel each other or there are none.
    pub fn vertex_normals(&self) -> Vec<Vec3> {
        let sums = self.sum_normals(&self.face_normals(), |_| true);
        sums.into_iter().map(|n| unit_or_zero(n).as_vec3()).collect()
    }

    /// The unit normal at every corner, as a renderer uses it: the corner's
    /// own if it was given and has a direction, else the vertex normal over
    /// the smooth faces if the face is smooth, else the face's. Where even
    /// that has no direction, straight up: such a face has no area.
    pub fn shading_normals(&self) -> Vec<Vec3> {
        let attributes = self.attributes();
        if let Some(given) = &attributes.corner_normals {
            let units: Vec<Vec3> = given.iter().map(|&n| unit_keeping(n)).collect();
            if units.iter().all(|&n| n != Vec3::ZERO) {
                return units;
            }
            return self.computed_normals(|corner| units[corner]);
        }
        self.computed_normals(|_| Vec3::ZERO)
    }

    /// Shading normals from the faces where the given one is zero.
    fn computed_normals(&self, given: impl Fn(usize) -> Vec3) -> Vec<Vec3> {
        let face_normals = self.face_normals();
        let flags = self.attributes().face_smooth.as_deref();
        let is_smooth = |face: usize| flags.is_some_and(|flags| flags[face]);
        let vertex_normals = match flags {
            Some(flags) if flags.contains(&true) => self.sum_normals(&face_normals, is_smooth),
            _ => Vec::new(),
        };
        let vertex_normals: Vec<Vec3> =
            vertex_normals.into_iter().map(|n| unit_or_zero(n).as_vec3()).collect();
        let mut normals = Vec::with_capacity(self.corner_count());
        for (face, corners) in self.faces().enumerate() {
            let smooth = is_smooth(face);
            let of_face = first_with_direction([face_normals[face], Vec3::Y]);
            for corner in corners {
                let of_vertex = match smooth {
                    true => vertex_normals[self.corner_vertices()[corner] as usize],
                    false => Vec3::ZERO,
                };
                normals.push(first_with_direction([given(corner), of_vertex, of_face]));
            }
        }
        normals
    }

    /// Sums of the normals of those faces that count, per vertex, weighted by
    /// corner angle.
    fn sum_normals(&self, face_normals: &[Vec3], counts: impl Fn(usize) -> bool) -> Vec<DVec3> {
        let mut sums = vec![DVec3::ZERO; self.vertex_count()];
        self.for_each_weighted_corner(face_normals, counts, |corner, weighted| {
            sums[self.corner_vertices()[corner] as usize] += weighted;
        });
        sums
    }

    /// Calls back with every corner of the faces that count and the face's
    /// normal times the angle at that corner.
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

/// The angle between two vectors in radians, 0 if one of them is zero. Taken
/// from the cosine: weights need no more than its precision.
fn angle(a: DVec3, b: DVec3) -> f64 {
    let squares = a.length_squared() * b.length_squared();
    if squares > 0.0 { elementary::acos((a.dot(b) / squares.sqrt()).clamp(-1.0, 1.0)) } else { 0.0 }
}

/// The direction of a vector, the zero vector if it has none.
pub(crate) fn unit_or_zero(vector: DVec3) -> DVec3 {
    let length = vector.length();
    if length > 0.0 && length.is_finite() { vector / length } else { DVec3::ZERO }
}

/// How far a squared length may be from 1 for a normal to be left as it was
/// given: a few roundings of f32.
const UNIT_TOLERANCE: f64 = 1e-6;

/// Like [`unit_or_zero`], but a unit vector keeps its bits.
fn unit_keeping(normal: Vec3) -> Vec3 {
    let wide = normal.as_dvec3();
    if (wide.length_squared() - 1.0).abs() <= UNIT_TOLERANCE { normal } else { unit_or_zero(wide).as_vec3() }
}

fn first_with_direction<const N: usize>(candidates: [Vec3; N]) -> Vec3 {
    let mut found = candidates.into_iter().filter(|&n| n != Vec3::ZERO);
    found.next().unwrap_or(Vec3::Y)
}
