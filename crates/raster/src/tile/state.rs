//! What a worker keeps from tile to tile for the visibility stage.

use super::depth_query::TileView;
use super::key_order::KeyOrder;
use super::masked::MaskQueue;
use super::surfaces::{Listing, Surfaces};
use super::ties::Ties;
use crate::bin::TriangleRef;
use crate::tile_buffer::{TileArea, VisibilityBuffer};
use crate::view::{FrameView, VisibleTile};

/// The triangles of a tile, and which of them is visible at each sample.
pub(crate) struct TileState {
    /// The tile's triangles: opaque, masked, overlay, translucent.
    pub(crate) triangles: Vec<TriangleRef>,
    pub(crate) buffer: VisibilityBuffer,
    pub(crate) ties: Ties,
    pub(super) key_order: KeyOrder,
    /// Triangles in another order, where that is needed.
    pub(super) reordered: Vec<TriangleRef>,
    /// Where each triangle stands in that order.
    pub(super) ranks: Vec<u32>,
    pub(super) mask_queue: MaskQueue,
}

impl TileState {
    pub(crate) fn new() -> Self {
        Self {
            triangles: Vec::new(),
            buffer: VisibilityBuffer::new(),
            ties: Ties::default(),
            key_order: KeyOrder::default(),
            reordered: Vec::new(),
            ranks: Vec::new(),
            mask_queue: MaskQueue::default(),
        }
    }

    /// Lists triangles of a tile, and no others.
    pub(crate) fn list(&mut self, frame: &FrameView<'_>, tile: u32, listing: Listing) -> Surfaces {
        self.triangles.clear();
        Surfaces::list(frame, tile, listing, &mut self.triangles)
    }

    /// Empties the buffer for the triangles that are listed.
    pub(crate) fn begin(&mut self, frame: &FrameView<'_>, tile: u32) {
        self.buffer.clear(&frame.area(tile), frame.grid.pattern.count());
        self.ties.reset(self.triangles.len());
    }

    /// What the tile shows.
    pub(crate) fn visible<'t>(&'t self, area: &'t TileArea) -> VisibleTile<'t> {
        VisibleTile { area, buffer: &self.buffer, triangles: &self.triangles }
    }

    /// The tile for queries of masked and translucent triangles.
    #[inline(always)]
    pub(crate) fn view<'t>(&'t self, frame: &'t FrameView<'t>, area: &'t TileArea) -> TileView<'t> {
        let Self { buffer, triangles, ties, .. } = self;
        TileView { frame, area, buffer, triangles, ties }
    }
}
