//! The visibility of a tile: which triangle is seen at each of its samples.

mod area;
mod blocks;
mod buffer;
mod counts;
mod depth;
mod depth_query;
mod edge;
mod edge_origins;
mod eight;
mod key_order;
mod masked;
mod micro;
mod multisample;
mod points;
mod quad;
mod rasterizer;
mod single;
mod state;
mod store;
mod surfaces;
#[cfg(test)]
mod tests;
mod ties;
mod tiny;
mod triangle;
mod visibility;

pub(crate) use area::{MAX_SIDE, PIXELS, TileArea, lane_point};
pub(crate) use blocks::Blocks;
pub(crate) use buffer::{BEHIND_ALL, NOBODY, VisibilityBuffer};
pub(crate) use counts::Counts;
pub(crate) use depth::DepthPlane;
pub(crate) use depth_query::{Candidate, SampleGroup, TileView};
pub(crate) use edge::Edge;
pub(crate) use single::single;
pub(crate) use state::TileState;
pub(crate) use surfaces::Surfaces;
pub(crate) use ties::Ties;
pub(crate) use triangle::TileTriangle;
pub(crate) use visibility::{cover_overlay, resolve_visibility};
