//! The icosahedron: 12 vertices, 30 edges, 20 triangles.

use trigon_math::DVec3;

use super::circle::regular_polygon;
use super::solid::{Solid, length};
use crate::Mesh;

/// Half the diagonal of a regular pentagon whose half edge is 1.
pub(super) const GOLDEN_RATIO: f64 = 1.618_033_988_749_895;

/// Indices into [`golden_corners`].
pub(super) const FACES: [[u32; 3]; 20] = [
    [0, 2, 5],
    [0, 4, 2],
    [0, 5, 10],
    [0, 8, 4],
    [0, 10, 8],
    [1, 3, 6],
    [1, 6, 8],
    [1, 7, 3],
    [1, 8, 10],
    [1, 10, 7],
    [2, 4, 9],
    [2, 9, 11],
    [2, 11, 5],
    [3, 7, 11],
    [3, 9, 6],
    [3, 11, 9],
    [4, 6, 9],
    [4, 8, 6],
    [5, 7, 10],
    [5, 11, 7],
];

/// A regular icosahedron with edges of `edge` metres; its edges that cross an
/// axis are parallel to another. Each face shows a triangle of the image.
#[must_use]
pub fn icosahedron(edge: f32) -> Mesh {
    let half = f64::from(length(edge)) / 2.0;
    let mut solid = Solid::with_capacity(12, 20, 60);
    for corner in golden_corners(half, half * GOLDEN_RATIO) {
        solid.vertex(corner.as_vec3());
    }
    for face in FACES {
        solid.face(&face, &regular_polygon::<3>());
    }
    solid.build()
}

/// The corners of three rectangles that stand in each other: in turn each
/// axis is 0, the next one ± `one`, the one after that ± `other` (minus
/// before plus).
pub(super) fn golden_corners(one: f64, other: f64) -> impl Iterator<Item = DVec3> {
    let signs = [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)];
    (0..3).flat_map(move |axis| {
        signs.into_iter().map(move |(a, b)| {
            let mut corner = [0.0; 3];
            corner[(axis + 1) % 3] = a * one;
            corner[(axis + 2) % 3] = b * other;
            DVec3::from_array(corner)
        })
    })
}
