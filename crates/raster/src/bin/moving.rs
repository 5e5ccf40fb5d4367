//! Primitives that move from frame to frame, set up and listed apart from the others of their chunk.

use super::{Chunk, Grid};

/// The moving primitives of a chunk.
#[derive(Default)]
pub(crate) struct MovingChunk {
    /// Their indices in the chunk, increasing.
    indices: Vec<u32>,
    /// What tiles list of them. Entries name the same indices as those of the chunk itself.
    pub(crate) listed: Chunk,
}

impl MovingChunk {
    /// Whether [`take`](Self::take) may take primitives of a chunk.
    pub(crate) fn can_take(&self, chunk: &Chunk) -> bool {
        chunk.is_plain(chunk.ordinals.len() - self.indices.len())
    }

    /// Takes primitives from a chunk, by their indices, those that are here already included. They must be set
    /// up next.
    pub(crate) fn take(&mut self, chunk: &mut Chunk, indices: Vec<u32>) {
        if !indices.is_empty() {
            chunk.drop_listed(&indices);
        }
        self.indices = indices;
    }

    /// Starts to set them up.
    pub(crate) fn begin(&mut self, chunk: &Chunk) {
        self.listed.reset(chunk.ordinals.clone(), chunk.blend_mode);
    }

    /// The indices in the chunk of the primitives, increasing.
    pub(crate) fn indices(&self) -> &[u32] {
        &self.indices
    }

    /// Their indices, and what tiles list of them.
    pub(crate) fn parts(&mut self) -> (&[u32], &mut Chunk) {
        (&self.indices, &mut self.listed)
    }

    /// Whether all of them were set up as [`take`](Self::take) requires it.
    pub(crate) fn is_plain(&self) -> bool {
        self.listed.is_plain(self.indices.len())
    }

    /// Visits all tiles that list any of them; some more than once.
    pub(crate) fn for_each_tile(&self, grid: &Grid, visit: impl FnMut(u32)) {
        self.listed.for_each_tile_of(grid, |_| true, visit);
    }
}
