//! The dodecahedron: 20 vertices, 30 edges, 12 pentagons.

use trigon_math::DVec3;

use super::circle::regular_polygon;
use super::icosahedron::{GOLDEN_RATIO, golden_corners};
use super::solid::{Solid, length};
use crate::Mesh;

/// The first eight vertices are those of a cube (one bit per axis), then come
/// those of the rectangles.
const FACES: [[u32; 5]; 12] = [
    [0, 8, 1, 18, 16],
    [0, 12, 2, 10, 8],
    [0, 16, 4, 14, 12],
    [1, 8, 10, 3, 13],
    [1, 13, 15, 5, 18],
    [2, 12, 14, 6, 17],
    [2, 17, 19, 3, 10],
    [3, 19, 7, 15, 13],
    [4, 9, 11, 6, 14],
    [4, 16, 18, 5, 9],
    [5, 15, 7, 11, 9],
    [6, 11, 7, 19, 17],
];

/// A regular dodecahedron with edges of `edge` metres; its edges that cross an
/// axis are parallel to another. Each face shows a pentagon of the image.
#[must_use]
pub fn dodecahedron(edge: f32) -> Mesh {
    let half_cube = f64::from(length(edge)) * GOLDEN_RATIO / 2.0;
    let mut solid = Solid::with_capacity(20, 12, 60);
    for bits in 0..8 {
        let axis = |bit: u32| if bits & bit != 0 { half_cube } else { -half_cube };
        solid.vertex(DVec3::new(axis(1), axis(2), axis(4)).as_vec3());
    }
    for corner in golden_corners(half_cube / GOLDEN_RATIO, half_cube * GOLDEN_RATIO) {
        solid.vertex(corner.as_vec3());
    }
    for face in FACES {
        solid.face(&face, &regular_polygon::<5>());
    }
    solid.build()
}
