//! What shading keeps from tile to tile.

use super::Records;
use super::columns::Columns;
use super::task::{Fragment, Group};
use crate::tile::PIXELS;
use std::ops::Range;

/// A pixel whose samples see different triangles, under multisampling.
#[derive(Clone, Copy)]
pub(crate) struct EdgePixel {
    pub(crate) pixel: u32,
    /// Where the colours of its samples are named in
    /// [`sample_colors`](Shading::sample_colors).
    pub(crate) first: u32,
}

/// What is visible of one draw.
pub(super) struct Run {
    pub(super) draw: usize,
    /// The records of its triangles.
    pub(super) slots: Range<usize>,
    pub(super) groups: Range<usize>,
    pub(super) fragments: Range<usize>,
    pub(super) parts: Range<usize>,
}

/// What shading keeps from tile to tile, so that nothing allocates once it is
/// warm.
pub(crate) struct Shading {
    /// For each of the tile's triangles its number among the visible ones.
    pub(super) slots: Vec<u32>,
    /// The visible triangles among the tile's, in their order.
    pub(super) seen: Vec<u32>,
    /// Groups of pixels that see one draw.
    pub(super) groups: Vec<Group>,
    /// Pixels that see one triangle, in other groups.
    pub(super) fragments: Vec<Fragment>,
    /// Fragments that cover a part of their pixel.
    pub(super) parts: Vec<Fragment>,
    pub(super) runs: Vec<Run>,
    pub(super) records: Records,
    pub(super) columns: Columns,
    /// A fragment and one colour for each visible triangle of a flat draw, in linear
    /// light and as bytes.
    pub(super) flat: Vec<Fragment>,
    pub(super) flat_codes: Vec<u32>,
    pub(super) flat_colors: Vec<[f32; 4]>,
    /// Pixels as bytes.
    pub(crate) codes: Vec<u32>,
    /// Pixels in linear light, and from [`PIXELS`] on the colours of
    /// [`parts`](Self::parts).
    pub(crate) colors: Vec<[f32; 4]>,
    pub(crate) edge_pixels: Vec<EdgePixel>,
    /// For each sample of each edge pixel an index into the colours.
    pub(crate) sample_colors: Vec<u32>,
}

impl Shading {
    pub(crate) fn new() -> Self {
        Self {
            slots: Vec::new(),
            seen: Vec::new(),
            groups: Vec::new(),
            fragments: Vec::new(),
            parts: Vec::new(),
            runs: Vec::new(),
            records: Records::default(),
            columns: Columns::new(),
            flat: Vec::new(),
            flat_codes: Vec::new(),
            flat_colors: Vec::new(),
            codes: vec![0; PIXELS],
            colors: vec![[0.0; 4]; PIXELS],
            edge_pixels: Vec::new(),
            sample_colors: Vec::new(),
        }
    }
}
