//! Counts of the work on a tile's opaque triangles, for [`Stats`](crate::Stats).

/// Counts of blocks and samples.
#[derive(Clone, Copy, Default)]
pub(crate) struct Counts {
    pub(crate) tiles_rejected: u64,
    pub(crate) tiles_filled: u64,
    pub(crate) blocks_rejected: u64,
    pub(crate) blocks_accepted: u64,
    pub(crate) groups: u64,
    pub(crate) tiles_reordered: u64,
}
