//! What the visibility of a tile is found in, kept from tile to tile.

use super::area::TileArea;
use super::buffer::VisibilityBuffer;
use super::depth_query::TileView;
use super::key_order::KeyOrder;
use super::masked::Questions;
use super::surfaces::Surfaces;
use super::ties::Ties;
use crate::bin::TriangleRef;
use crate::view::FrameView;

/// The triangles of a tile, and what is seen of them.
pub(crate) struct TileState {
    /// The tile's triangles: opaque, masked, shown over surfaces, translucent.
    pub(crate) triangles: Vec<TriangleRef>,
    pub(crate) buffer: VisibilityBuffer,
    pub(crate) ties: Ties,
    pub(super) key_order: KeyOrder,
    /// The opaque triangles in the order of their keys, where that is needed.
    pub(super) reordered: Vec<TriangleRef>,
    pub(super) questions: Questions,
}

impl TileState {
    pub(crate) fn new() -> Self {
        Self {
            triangles: Vec::new(),
            buffer: VisibilityBuffer::new(),
            ties: Ties::default(),
            key_order: KeyOrder::default(),
            reordered: Vec::new(),
            questions: Questions::default(),
        }
    }

    /// Lists the triangles of a tile.
    pub(crate) fn list(&mut self, frame: &FrameView<'_>, tile: u32) -> Surfaces {
        Surfaces::list(frame, tile, &mut self.triangles)
    }

    /// Empties the buffer for the triangles that are listed.
    pub(crate) fn begin(&mut self, frame: &FrameView<'_>, tile: u32) {
        self.buffer.clear(&frame.area(tile), frame.grid.pattern.count());
        self.ties.reset(self.triangles.len());
    }

    /// The tile as masked and translucent triangles meet it.
    #[inline(always)]
    pub(crate) fn view<'t>(&'t self, frame: &'t FrameView<'t>, area: &'t TileArea) -> TileView<'t> {
        let Self { buffer, triangles, ties, .. } = self;
        TileView { frame, area, buffer, triangles, ties }
    }
}
