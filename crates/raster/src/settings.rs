//! How a pass is executed. No setting changes a byte of the result.

use crate::simd::SimdLevel;
use std::num::NonZeroUsize;

/// How a pass is executed: what it costs, never what it draws.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ExecuteSettings {
    /// How many threads may work; `None` for as many as the machine runs at
    /// once. Small frames stay on the calling thread regardless.
    pub threads: Option<NonZeroUsize>,
    /// Which vector instructions are used; `None` for the best that the
    /// processor has.
    pub simd: Option<SimdLevel>,
    /// The size of the squares that the frame is cut into.
    pub tile_size: TileSize,
    /// Whether hidden blocks are rejected by bounds of their depths.
    pub depth_test: DepthTest,
    /// Whether [`Stats::times`](crate::Stats::times) are measured, a few calls of a
    /// clock for each tile, and [`Stats::samples_visible`](crate::Stats::samples_visible)
    /// counted.
    pub timed: bool,
}

/// When depth is tested.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DepthTest {
    /// Bounds of blocks and tiles first, so that hidden ones are skipped as a whole.
    #[default]
    Hierarchical,
    /// At every sample: for comparison.
    Late,
}

/// The edge of a tile in pixels; with supersampling, of the finer grid, and the
/// tile is the largest whole number of pixels that fits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TileSize {
    /// 64 by 64, and 32 by 32 from eight samples on: what a worker keeps of a tile
    /// fits into the caches nearest to it.
    #[default]
    Automatic,
    /// 8 by 8: for tests.
    Pixels8,
    /// 16 by 16.
    Pixels16,
    /// 32 by 32.
    Pixels32,
    /// 64 by 64.
    Pixels64,
}

impl TileSize {
    pub(crate) fn pixels(self, samples: u32) -> u32 {
        match self {
            Self::Automatic if samples >= 8 => 32,
            Self::Automatic | Self::Pixels64 => 64,
            Self::Pixels8 => 8,
            Self::Pixels16 => 16,
            Self::Pixels32 => 32,
        }
    }
}
