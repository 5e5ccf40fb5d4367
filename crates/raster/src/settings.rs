//! How a pass is executed. Nothing in here can change a byte of the result.

use std::num::NonZeroUsize;

/// How a pass is executed: what it costs, never what it draws.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ExecuteSettings {
    /// How many threads may work; `None` for as many as the machine runs at
    /// once. Small frames stay on the calling thread regardless.
    pub threads: Option<NonZeroUsize>,
    /// The size of the squares that the frame is cut into.
    pub tile_size: TileSize,
}

/// The edge of a tile in samples; with supersampling the tile is the largest
/// whole number of pixels that fits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TileSize {
    /// 8 by 8 samples: for tests.
    Samples8,
    /// 16 by 16 samples.
    Samples16,
    /// 32 by 32 samples.
    Samples32,
    /// 64 by 64 samples: a depth and an ordinal for each sample fit into the
    /// first-level cache of most processors.
    #[default]
    Samples64,
}

impl TileSize {
    pub(crate) fn samples(self) -> u32 {
        match self {
            Self::Samples8 => 8,
            Self::Samples16 => 16,
            Self::Samples32 => 32,
            Self::Samples64 => 64,
        }
    }
}
