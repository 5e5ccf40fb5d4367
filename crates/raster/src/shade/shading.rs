//! Memory that shading keeps from tile to tile.

use super::edges::Edges;
use crate::fragments::{Columns, FragmentList, Group, RecordShape, Records};
use crate::outer_ink::OuterInk;
use crate::tile_buffer::PIXELS;
use std::ops::Range;

/// What is visible of one draw.
pub(super) struct DrawRun {
    pub(super) draw: usize,
    /// The records of its triangles.
    pub(super) slots: Range<usize>,
    pub(super) groups: Range<usize>,
    pub(super) fragments: Range<usize>,
    pub(super) parts: Range<usize>,
    /// Its records, if they are there already.
    pub(super) records: Option<RecordShape>,
}

/// A group with pixels whose first samples show the background.
#[derive(Clone, Copy)]
pub(crate) struct EmptyGroup {
    pub(crate) number: u32,
    /// Those pixels.
    pub(crate) lanes: u32,
}

/// What shading keeps from tile to tile, so that nothing allocates once it is
/// warm.
pub(crate) struct Shading {
    /// For each of the tile's triangles its number among the visible ones.
    pub(super) slots: Vec<u32>,
    /// The visible triangles among the tile's, in their order.
    pub(super) visible_triangles: Vec<u32>,
    /// Groups of pixels that see one draw.
    pub(super) groups: Vec<Group>,
    /// Pixels that see one triangle, in other groups.
    pub(super) fragments: FragmentList,
    /// Fragments that cover a part of their pixel.
    pub(super) parts: FragmentList,
    pub(super) runs: Vec<DrawRun>,
    pub(crate) records: Records,
    pub(super) columns: [Columns; 2],
    /// A fragment and one colour for each visible triangle of a flat draw, in linear
    /// light and as bytes.
    pub(super) flat: FragmentList,
    pub(super) flat_codes: Vec<u32>,
    pub(super) flat_colors: Vec<[f32; 4]>,
    /// Pixels as bytes.
    pub(crate) codes: Vec<u32>,
    /// Pixels in linear light; edge pixels with the colour of their first samples; then the background; then
    /// the other samples of edge pixels.
    pub(crate) colors: Vec<[f32; 4]>,
    /// Groups with pixels that see the background.
    pub(crate) empty_groups: Vec<EmptyGroup>,
    /// Pixels whose samples see different triangles.
    pub(crate) edges: Edges,
    /// What edges cover beyond their faces.
    pub(crate) outer: OuterInk,
    /// How many triangles got edges.
    pub(crate) edged: u64,
}

impl Shading {
    /// Starts a tile with this many triangles, and samples per pixel.
    pub(super) fn clear(&mut self, triangle_count: usize, samples: usize) {
        self.slots.clear();
        // One more, for samples without a triangle.
        self.slots.resize(triangle_count + 1, 0);
        self.groups.clear();
        self.fragments.clear();
        self.parts.clear();
        self.empty_groups.clear();
        self.edges.clear(samples);
    }

    pub(crate) fn new() -> Self {
        Self {
            slots: Vec::new(),
            visible_triangles: Vec::new(),
            groups: Vec::new(),
            fragments: FragmentList::default(),
            parts: FragmentList::default(),
            runs: Vec::new(),
            records: Records::default(),
            columns: [Columns::new(), Columns::new()],
            flat: FragmentList::default(),
            flat_codes: Vec::new(),
            flat_colors: Vec::new(),
            codes: vec![0; PIXELS],
            colors: vec![[0.0; 4]; PIXELS + 1],
            empty_groups: Vec::new(),
            edges: Edges::new(),
            outer: OuterInk::default(),
            edged: 0,
        }
    }
}
