//! The octahedron: 6 vertices, 12 edges, 8 triangles.

use std::f64::consts::FRAC_1_SQRT_2;

use trigon_math::DVec3;

use super::circle::regular_polygon;
use super::solid::{Solid, length};
use crate::Mesh;

/// Vertices: right, left, top, bottom, front, back. Each face starts at the
/// top or at the bottom.
const FACES: [[u32; 3]; 8] =
    [[2, 4, 0], [2, 0, 5], [2, 5, 1], [2, 1, 4], [3, 0, 4], [3, 5, 0], [3, 1, 5], [3, 4, 1]];

/// A regular octahedron with edges of `edge` metres and its corners on the
/// axes. Each face shows a triangle of the image.
#[must_use]
pub fn octahedron(edge: f32) -> Mesh {
    let radius = f64::from(length(edge)) * FRAC_1_SQRT_2;
    let mut solid = Solid::with_capacity(6, 8, 24);
    for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
        solid.vertex((axis * radius).as_vec3());
        solid.vertex((axis * -radius).as_vec3());
    }
    for face in FACES {
        solid.face(&face, &regular_polygon::<3>());
    }
    solid.build()
}
