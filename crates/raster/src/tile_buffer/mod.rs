//! The pixels of a tile in memory: where they lie (`area`), and depth and visible triangle of each sample (`buffer`).

mod area;
mod buffer;

pub(crate) use area::{BLOCKS, GROUPS, MAX_SIDE, PIXELS, TileArea, lane_point};
pub(crate) use buffer::{BEHIND_ALL, BlockBounds, NO_TRIANGLE, VisibilityBuffer};
