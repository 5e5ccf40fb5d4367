//! The base of standard objects.
//!
//! Lengths are metres; one that is not a positive finite number counts as 1. Counts are brought into the range
//! that each function names. So every call gives a mesh. A solid is closed, its faces are counter-clockwise seen
//! from outside, and its vertices are shared: seams exist only in the texture coordinates of corners. +Y is up,
//! and the origin is in the middle unless the function says otherwise.
//!
//! All surfaces have one set of texture coordinates, (0, 0) in the upper left
//! corner of the image, so that the image is upright and not mirrored seen
//! from outside. Curved surfaces carry exact corner normals and are marked
//! smooth; the others are flat.

mod plane;
mod polyhedra;
mod round;
mod solid;
mod teapot;
mod torus_knot;

pub use plane::{grid, plane, polyline, ring, segment};
pub use polyhedra::{cube, dodecahedron, icosahedron, octahedron, pyramid, tetrahedron};
pub use round::{cone, cylinder, disc, icosphere, torus, uv_sphere};
pub use teapot::teapot;
pub use torus_knot::{TorusKnot, torus_knot};
