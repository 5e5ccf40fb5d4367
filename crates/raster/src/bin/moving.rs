//! Primitives that move from frame to frame, set up and listed apart from the others of their chunk.

use super::{Chunk, Grid};

/// The moving primitives of a chunk.
#[derive(Default)]
pub(crate) struct MovingChunk {
    /// Their places in the chunk, increasing.
    places: Vec<u32>,
    /// What tiles list of them. Entries name the same places as those of the chunk itself.
    pub(crate) listed: Chunk,
}

impl MovingChunk {
    /// Whether [`take`](Self::take) may take primitives of a chunk.
    pub(crate) fn can_take(&self, chunk: &Chunk) -> bool {
        chunk.is_plain(chunk.ordinals.len() - self.places.len())
    }

    /// Takes primitives from a chunk, by their places, those that are here already included. They must be set
    /// up next.
    pub(crate) fn take(&mut self, chunk: &mut Chunk, places: Vec<u32>) {
        if !places.is_empty() {
            chunk.drop_listed(&places);
        }
        self.places = places;
    }

    /// Starts to set them up.
    pub(crate) fn begin(&mut self, chunk: &Chunk) {
        self.listed.reset(chunk.ordinals.clone(), chunk.blend_mode);
    }

    /// The places in the chunk of the primitives, increasing.
    pub(crate) fn places(&self) -> &[u32] {
        &self.places
    }

    /// Their places, and what tiles list of them.
    pub(crate) fn parts(&mut self) -> (&[u32], &mut Chunk) {
        (&self.places, &mut self.listed)
    }

    /// Whether all of them were set up as [`take`](Self::take) requires it.
    pub(crate) fn is_plain(&self) -> bool {
        self.listed.is_plain(self.places.len())
    }

    /// Visits all tiles that list any of them; some more than once.
    pub(crate) fn for_each_tile(&self, grid: &Grid, visit: impl FnMut(u32)) {
        self.listed.for_each_tile_of(grid, |_| true, visit);
    }
}
