//! The cube: 8 vertices, 12 edges, 6 quads.

use trigon_math::Vec3;

use super::solid::{SQUARE, Solid, length};
use crate::Mesh;

/// The vertex number has one bit per axis: 1 for x, 2 for y, 4 for z. Each
/// face starts at its lower left corner.
const FACES: [[u32; 4]; 6] =
    [[5, 1, 3, 7], [0, 4, 6, 2], [6, 7, 3, 2], [0, 1, 5, 4], [4, 5, 7, 6], [1, 0, 2, 3]];

/// A cube round the origin, its edges parallel to the axes and `edge` metres
/// long. Each face shows the whole image.
#[must_use]
pub fn cube(edge: f32) -> Mesh {
    let half = length(edge) / 2.0;
    let mut solid = Solid::with_capacity(8, 6, 24);
    for bits in 0..8 {
        let axis = |bit: u32| if bits & bit != 0 { half } else { -half };
        solid.vertex(Vec3::new(axis(1), axis(2), axis(4)));
    }
    for face in FACES {
        solid.face(&face, &SQUARE);
    }
    solid.build()
}
