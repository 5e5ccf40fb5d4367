//! The pixels of a tile in memory: where they lie (`area`), and depth and visible triangle of each sample (`buffer`).

mod area;
mod buffer;

pub(crate) use area::{
    BLOCKS, GROUP_COUNT, GROUPS, MAX_SIDE, PIXELS, TileArea, TileLanes, TileRows, lane_point, lanes_of,
    rows_of, rows_of_either,
};
pub(crate) use buffer::{
    BEHIND_ALL, BlockBounds, NO_TRIANGLE, VisibilityBuffer, name_where, store, store_each_where, store_where,
};
