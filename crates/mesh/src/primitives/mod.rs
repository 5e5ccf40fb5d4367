//! The base of standard objects.
//!
//! Lengths are metres; one that is not a positive finite number counts as 1.
//! Counts are brought into the range that each function names. So every
//! call gives a mesh: a solid is closed, its faces are counter-clockwise seen
//! from outside, and its vertices are shared (seams exist only in the texture
//! coordinates of corners). +Y is up. The wires of a solid are its own edges.
//!
//! All surfaces have one set of texture coordinates, (0, 0) in the upper left
//! corner of the picture. Curved ones carry exact corner normals and are
//! marked smooth; the others are flat.

mod cube;
mod solid;

pub use cube::cube;
