//! The pyramid: 5 vertices, 8 edges, a square and four triangles.

use trigon_math::Vec3;

use super::circle::regular_polygon;
use super::solid::{SQUARE, Solid, length};
use crate::Mesh;

/// A pyramid over a square of `edge` metres, `height` metres high, its base at
/// half its height below the origin. As wires it has its own 8 edges, as a
/// surface 6 triangles.
#[must_use]
pub fn pyramid(edge: f32, height: f32) -> Mesh {
    let half = length(edge) / 2.0;
    let top = length(height) / 2.0;
    let mut solid = Solid::with_capacity(5, 5, 16);
    for (x, z) in [(-half, half), (half, half), (half, -half), (-half, -half)] {
        solid.vertex(Vec3::new(x, -top, z));
    }
    solid.vertex(Vec3::new(0.0, top, 0.0));
    solid.face(&[3, 2, 1, 0], &SQUARE);
    for i in 0..4 {
        solid.face(&[4, i, (i + 1) % 4], &regular_polygon::<3>());
    }
    solid.build()
}
