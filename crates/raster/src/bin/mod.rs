//! Which triangles each tile has to look at, in order.
//!
//! The frame's primitives are cut into chunks; each chunk is set up and sorted
//! into tiles by one worker, and a tile visits the chunks in order.

mod chunk;
mod earlier;
mod grid;
mod triangle_ref;

pub(crate) use chunk::Chunk;
pub(crate) use earlier::EarlierEntries;
pub(crate) use grid::{Grid, TileRange};
pub(crate) use triangle_ref::{Entry, TriangleRef};
