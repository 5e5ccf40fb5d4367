//! The visibility stage: which triangle is visible at each sample of a tile.
//!
//! A triangle covers a sample if no edge function is negative there. Of the triangles that cover a sample the
//! nearest is visible. Depth is reversed: **a greater depth is nearer**, so the farthest has the smallest depth
//! (the output `depth` of a frame is a distance). At equal depth the triangle with the smaller key is visible:
//! [`FrameView::compare`](crate::view::FrameView::compare) is that rule.
//!
//! Depth and visible triangle of each sample are kept in a
//! [`VisibilityBuffer`](crate::tile_buffer::VisibilityBuffer), for pixels in the order of
//! [`TileArea`](crate::tile_buffer::TileArea): groups of 4×2 pixels, one pixel in each lane, in blocks
//! of 8×8. Edge functions with the top-left rule, and planes of depths, are those of
//! [`primitive`](crate::primitive).
//!
//! In the order in which a triangle passes through:
//!
//! | file | what it holds |
//! |---|---|
//! | `state` | what a worker holds from tile to tile: the lists of the tile's triangles by kind of surface, the budget for equal depths, the order of keys |
//! | `front_to_back` | opaque triangles from front to back, where many lie above each other |
//! | `visibility` | **the order of the kinds of surface, and the table of which kernel draws a triangle** |
//! | `corners` | the vertices of up to eight triangles |
//! | `eight` | eight small triangles prepared together, and the limits of the kernels |
//! | `triangle` | one triangle prepared for the tile, whatever its size |
//! | `micro` | kernel: up to eight small triangles of at most 4×4 pixels each, one sample per pixel; a lane is a triangle; also the list of pixels that `micro` and `sliver` find, and the test of their depths |
//! | `tiny` | kernel: one small triangle of at most 24×24 pixels, one sample per pixel |
//! | `multisample` | kernel: as `tiny`, with several samples per pixel; also the start values of edge functions that both use |
//! | `sliver` | kernel: one small triangle at most two pixels wide along an axis, one sample per pixel; a lane is a column of pixels |
//! | `rasterizer` | kernel: any other triangle (the *general* kernel); also **the depth test**, of which the other kernels have versions |
//! | `quad` | kernel: opaque lines and points less than 32 pixels wide, both triangles at once |
//! | `points` | kernel: plain points, from their vertices, without edge functions |
//! | `sides` | which blocks and groups lie on which side of a triangle's edges, for `rasterizer` |
//! | `masked` | masked triangles |
//! | `depth_query` | where a masked or translucent triangle would be visible; sets of blocks |
//! | `cached` | what still triangles show, cached while others move |
//!
//! The sizes in pixels count the part of a triangle's bounding box that lies in the tile. Except in `micro`,
//! `sliver` and `points` a lane is a pixel of a group. All kernels make the same decisions with the same integers
//! and depths, so the choice of a kernel never changes a byte.

mod cached;
mod corners;
mod depth_query;
mod eight;
mod front_to_back;
mod masked;
mod micro;
mod multisample;
mod points;
mod quad;
mod rasterizer;
mod sides;
mod sliver;
mod state;
#[cfg(test)]
mod tests;
mod tiny;
mod triangle;
mod visibility;

pub(crate) use cached::{CachedTile, MovingRanges};
pub(crate) use depth_query::{Blocks, Candidate, SampleGroup, TileView};
pub(crate) use state::{Listing, Surfaces, Ties, TileState};
pub(crate) use triangle::{TileTriangle, single};
pub(crate) use visibility::{cover_overlay, resolve_visibility};
