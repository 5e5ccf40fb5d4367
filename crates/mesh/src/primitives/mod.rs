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

mod circle;
mod cone;
mod cube;
mod cylinder;
mod disc;
mod dodecahedron;
mod icosahedron;
mod icosphere;
mod octahedron;
mod plane;
mod pyramid;
mod ring;
mod solid;
mod teapot;
mod teapot_table;
mod tetrahedron;
mod torus;
mod torus_knot;
mod uv_sphere;
mod wires;

pub use cube::cube;
pub use dodecahedron::dodecahedron;
pub use icosahedron::icosahedron;
pub use octahedron::octahedron;
pub use pyramid::pyramid;
pub use tetrahedron::tetrahedron;

pub use disc::disc;
pub use plane::{grid, plane};

pub use cone::cone;
pub use cylinder::cylinder;
pub use icosphere::icosphere;
pub use teapot::teapot;
pub use torus::torus;
pub use torus_knot::{TorusKnot, torus_knot};
pub use uv_sphere::uv_sphere;

pub use wires::{polyline, ring, segment};
