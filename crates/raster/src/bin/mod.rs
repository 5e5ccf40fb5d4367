//! Binning: lists for each tile the triangles that may cover its samples, in order.
//!
//! The frame's primitives are cut into chunks. One worker sets up a chunk and sorts it into tiles. A tile then
//! reads the chunks in order. Primitives that move in every frame can be listed apart ([`MovingChunk`]).

mod chunk;
mod grid;
mod triangle_ref;

pub(crate) use chunk::{Chunk, MovingChunk};
pub(crate) use grid::{Grid, TileRange};
pub(crate) use triangle_ref::{Entry, TriangleRef};
