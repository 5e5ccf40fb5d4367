//! What the visibility of a tile is found in, kept from tile to tile.

use super::buffer::VisibilityBuffer;
use super::key_order::KeyOrder;
use super::masked::Questions;
use super::surfaces::Surfaces;
use super::ties::Ties;
use crate::bin::Place;
use crate::frame::FrameView;

/// The triangles of a tile, and what is seen of them.
pub(crate) struct TileState {
    /// The tile's triangles: opaque, masked, shown over surfaces, translucent.
    pub(crate) places: Vec<Place>,
    pub(crate) buffer: VisibilityBuffer,
    pub(crate) ties: Ties,
    pub(super) key_order: KeyOrder,
    /// The opaque triangles in the order of their keys, where that is needed.
    pub(super) reordered: Vec<Place>,
    pub(super) questions: Questions,
}

impl TileState {
    pub(crate) fn new() -> Self {
        Self {
            places: Vec::new(),
            buffer: VisibilityBuffer::new(),
            ties: Ties::default(),
            key_order: KeyOrder::default(),
            reordered: Vec::new(),
            questions: Questions::default(),
        }
    }

    /// Lists the triangles of a tile.
    pub(crate) fn list(&mut self, frame: &FrameView<'_>, tile: u32) -> Surfaces {
        Surfaces::list(frame, tile, &mut self.places)
    }

    /// Empties the buffer for the triangles that are listed.
    pub(crate) fn begin(&mut self, frame: &FrameView<'_>, tile: u32) {
        self.buffer.clear(&frame.area(tile), frame.grid.pattern.count());
        self.ties.reset(self.places.len());
    }
}
