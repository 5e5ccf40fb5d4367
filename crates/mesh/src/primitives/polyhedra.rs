//! Polyhedra: cube, octahedron, tetrahedron, pyramid, dodecahedron and icosahedron.

use std::f64::consts::FRAC_1_SQRT_2;

use trigon_math::{DVec3, Vec3};

use super::round::{on_ground, regular_polygon, turned};
use super::solid::{SQUARE, Solid, length};
use crate::Mesh;

/// The vertex number has one bit per axis: 1 for x, 2 for y, 4 for z. Each
/// face starts at its lower left corner.
const CUBE_FACES: [[u32; 4]; 6] =
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
    for face in CUBE_FACES {
        solid.face(&face, &SQUARE);
    }
    solid.build()
}

/// The lowest face and the three that meet at the top, vertex 3.
const TETRAHEDRON_FACES: [[u32; 3]; 4] = [[0, 2, 1], [3, 0, 1], [3, 1, 2], [3, 2, 0]];

/// A regular tetrahedron with edges of `edge` metres, its lowest face level,
/// its centre in the origin. Each face shows a triangle of the image.
#[must_use]
pub fn tetrahedron(edge: f32) -> Mesh {
    let edge = f64::from(length(edge));
    let to_corner = edge * 6.0_f64.sqrt() / 4.0;
    let base_radius = edge / 3.0_f64.sqrt();
    let mut solid = Solid::with_capacity(4, 4, 12);
    for third in 0..3 {
        let position = on_ground(turned(third, 3).perp()) * base_radius;
        solid.vertex((position - DVec3::Y * (to_corner / 3.0)).as_vec3());
    }
    solid.vertex((DVec3::Y * to_corner).as_vec3());
    for face in TETRAHEDRON_FACES {
        solid.face(&face, &regular_polygon::<3>());
    }
    solid.build()
}

/// Vertices: right, left, top, bottom, front, back. Each face starts at the
/// top or at the bottom.
const OCTAHEDRON_FACES: [[u32; 3]; 8] =
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
    for face in OCTAHEDRON_FACES {
        solid.face(&face, &regular_polygon::<3>());
    }
    solid.build()
}

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

/// The first eight vertices are those of a cube (one bit per axis), then come
/// those of the rectangles.
const DODECAHEDRON_FACES: [[u32; 5]; 12] = [
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
    for face in DODECAHEDRON_FACES {
        solid.face(&face, &regular_polygon::<5>());
    }
    solid.build()
}

/// Half the diagonal of a regular pentagon whose half edge is 1.
pub(super) const GOLDEN_RATIO: f64 = 1.618_033_988_749_895;

/// Indices into [`golden_corners`].
pub(super) const ICOSAHEDRON_FACES: [[u32; 3]; 20] = [
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
    for face in ICOSAHEDRON_FACES {
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
