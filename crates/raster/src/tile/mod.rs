//! The visibility stage: which triangle is visible at each sample of a tile.
//!
//! A triangle covers a sample if no edge function is negative there. Of the triangles that cover a
//! sample the nearest is visible. Depth is reversed: **a greater depth is nearer**, so the
//! farthest of several depths is the least. At
//! equal depth the triangle with the smaller key is visible:
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
//! | `surfaces` | lists the tile's triangles: opaque, masked, overlay, translucent |
//! | `state` | what a worker keeps from tile to tile |
//! | `blocks` | sets of a tile's blocks |
//! | `visibility` | **the order of the kinds of surface, and which kernel draws a triangle** |
//! | `eight` | eight small triangles prepared together, and the limits of the kernels |
//! | `edge_origins` | for the triangles that `eight` prepares: the edge functions of each at its first 4×2 group; for `tiny` and `multisample` |
//! | `triangle`, `single` | one triangle prepared for the tile, whatever its size |
//! | `micro` | kernel: up to eight small triangles of at most 4×4 pixels each, one sample per pixel; a lane is a triangle |
//! | `tiny` | kernel: one small triangle of at most 24×24 pixels, one sample per pixel |
//! | `multisample` | the same with several samples per pixel |
//! | `sliver` | kernel: one small triangle at most two pixels wide along an axis, one sample per pixel; a lane is a column of pixels |
//! | `covered` | the list of pixels that `micro` and `sliver` find, and the test of their depths |
//! | `rasterizer` | kernel: any other triangle (the *general* kernel); also **the depth test**, of which the other kernels have versions |
//! | `quad` | kernel: opaque lines and points less than 32 pixels wide, both triangles at once |
//! | `points` | kernel: plain points, from their vertices, without edge functions |
//! | `masked`, `depth_query` | masked triangles; where a masked or translucent triangle would be visible |
//! | `cached` | what still triangles show, kept while others move |
//! | `store` | writing to the visibility buffer |
//! | `ties`, `key_order` | the tile's budget for equal depths; its triangles sorted by key |
//!
//! The sizes in pixels count the part of a triangle's bounding box that lies in the tile. In the other kernels a lane is
//! a pixel of a group. All kernels make the same decisions with the same integers and depths, so the choice of a
//! kernel never changes a byte.

mod blocks;
mod cached;
mod covered;
mod depth_query;
mod edge_origins;
mod eight;
mod key_order;
mod masked;
mod micro;
mod multisample;
mod points;
mod quad;
mod rasterizer;
mod sides;
mod single;
mod sliver;
mod state;
mod store;
mod surfaces;
#[cfg(test)]
mod tests;
mod ties;
mod tiny;
mod triangle;
mod visibility;

pub(crate) use blocks::Blocks;
pub(crate) use cached::{CachedTile, MovingRanges};
pub(crate) use depth_query::{Candidate, SampleGroup, TileView};
pub(crate) use single::single;
pub(crate) use state::TileState;
pub(crate) use surfaces::{Listing, Surfaces};
pub(crate) use ties::Ties;
pub(crate) use triangle::TileTriangle;
pub(crate) use visibility::{cover_overlay, resolve_visibility};
