//! Which triangles each tile has to look at, in order.
//!
//! The frame's primitives are cut into chunks; each chunk is set up and sorted
//! into tiles by one worker, and a tile visits the chunks in order.

mod chunk;
mod grid;

pub(crate) use chunk::{Chunk, Entry, Place};
pub(crate) use grid::{Grid, TileRange};
