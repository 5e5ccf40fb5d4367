//! How a frame is drawn. No option changes a byte of it.

use crate::Cancel;
use crate::pool::Workers;
use crate::simd::Token;

/// How many vertices a worker runs at a time.
pub(super) const VERTICES: usize = 2048;

/// How a frame is drawn.
#[derive(Clone, Copy)]
pub(crate) struct FrameOptions<'w> {
    pub(crate) token: Token,
    pub(crate) workers: &'w Workers,
    pub(crate) tile_size: u32,
    pub(crate) hierarchical: bool,
    pub(crate) timed: bool,
    /// Whether colours are found, whatever the target keeps.
    pub(crate) finds_colors: bool,
    pub(crate) cancel: Option<&'w Cancel>,
}

impl FrameOptions<'_> {
    /// Whether no more work is to be begun.
    pub(super) fn is_cancelled(self) -> bool {
        self.cancel.is_some_and(Cancel::is_cancelled)
    }
}
