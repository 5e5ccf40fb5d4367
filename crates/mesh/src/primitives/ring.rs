//! Bands between rings of vertices: what spheres, cylinders, tori and the
//! teapot are made of.

use trigon_math::{DVec3, Vec2, Vec3};

use super::solid::{Corner, Solid};

/// Vertices once round, counter-clockwise seen from the side where the next
/// ring upwards is. Or one vertex only, a pole.
#[derive(Clone)]
pub(super) struct Ring {
    pub(super) vertices: Vec<u32>,
    /// One normal per vertex. At a pole either one, or one for each triangle
    /// that meets there.
    pub(super) normals: Vec<Vec3>,
    /// The texture coordinate along the surface, 0 at the top.
    pub(super) v: f32,
}

impl Ring {
    /// Adds vertices with their normals.
    pub(super) fn new(solid: &mut Solid, v: f64, points: impl Iterator<Item = (DVec3, DVec3)>) -> Self {
        let (vertices, normals) =
            points.map(|(position, normal)| (solid.vertex(position.as_vec3()), normal.as_vec3())).unzip();
        Self { vertices, normals, v: v as f32 }
    }

    /// The same ring met a second time, at the end of the image.
    pub(super) fn again(&self, v: f32) -> Self {
        Self { v, ..self.clone() }
    }

    fn corner(&self, i: usize, u: f32) -> Corner {
        Corner {
            vertex: self.vertices[i % self.vertices.len()],
            uv: Vec2::new(u, self.v),
            normal: self.normals[i % self.normals.len()],
        }
    }

    fn is_pole(&self) -> bool {
        self.vertices.len() == 1
    }
}

/// Closes the surface between two rings with as many vertices, or a ring and a
/// pole: quads, or triangles. Seen from outside, u runs to the right, from 0
/// to 1 once round.
pub(super) fn band(solid: &mut Solid, lower: &Ring, upper: &Ring) {
    let segments = lower.vertices.len().max(upper.vertices.len());
    let u = |numerator: f64| (numerator / segments as f64) as f32;
    for i in 0..segments {
        let (left, right, middle) = (u(i as f64), u(i as f64 + 1.0), u(i as f64 + 0.5));
        let bottom = [lower.corner(i, left), lower.corner(i + 1, right)];
        let top = [upper.corner(i + 1, right), upper.corner(i, left)];
        match (lower.is_pole(), upper.is_pole()) {
            (true, _) => solid.curved_face([lower.corner(i, middle), top[0], top[1]]),
            (_, true) => solid.curved_face([bottom[0], bottom[1], upper.corner(i, middle)]),
            _ => solid.curved_face([bottom[0], bottom[1], top[0], top[1]]),
        }
    }
}
