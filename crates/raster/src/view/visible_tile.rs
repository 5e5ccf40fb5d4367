//! What a tile shows.

use crate::bin::TriangleRef;
use crate::tile_buffer::{TileArea, VisibilityBuffer};

/// What a tile shows: the visible triangle at each sample, by its index among the tile's.
#[derive(Clone, Copy)]
pub(crate) struct VisibleTile<'t> {
    pub(crate) area: &'t TileArea,
    pub(crate) buffer: &'t VisibilityBuffer,
    pub(crate) triangles: &'t [TriangleRef],
}
