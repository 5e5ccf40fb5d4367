//! Ending a drawing before it is done, and how much of it is done.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

/// Ends drawings early, from any thread, and says how much of one is done. Clones are the same token;
/// once cancelled it stays so.
#[derive(Clone, Debug, Default)]
pub struct Cancel(Arc<State>);

#[derive(Debug, Default)]
struct State {
    is_cancelled: AtomicBool,
    /// Of the pass under way.
    tiles: AtomicU32,
    drawn: AtomicU32,
}

impl Cancel {
    /// Drawings that were given this token end: a worker finishes its tile, or a few
    /// thousand vertices or triangles, and begins no other.
    pub fn cancel(&self) {
        self.0.is_cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether [`cancel`](Self::cancel) was called.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.0.is_cancelled.load(Ordering::Relaxed)
    }

    /// How much of the pass under way is drawn: its finished tiles, from 0 to 1. 0 before the first tile.
    #[must_use]
    pub fn progress(&self) -> f32 {
        let [tiles, drawn] = [&self.0.tiles, &self.0.drawn].map(|count| count.load(Ordering::Relaxed));
        if tiles == 0 { 0.0 } else { drawn.min(tiles) as f32 / tiles as f32 }
    }

    /// Starts counting the finished tiles of a pass, which has `count` tiles.
    pub(crate) fn begin_tiles(&self, count: usize) {
        self.0.drawn.store(0, Ordering::Relaxed);
        self.0.tiles.store(u32::try_from(count).unwrap_or(u32::MAX), Ordering::Relaxed);
    }

    /// Counts a finished tile.
    pub(crate) fn finish_tile(&self) {
        self.0.drawn.fetch_add(1, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn progress_is_the_share_of_finished_tiles() {
        let token = Cancel::default();
        assert_eq!(token.progress(), 0.0, "before the first pass");
        token.begin_tiles(4);
        (0..3).for_each(|_| token.clone().finish_tile());
        assert_eq!(token.progress(), 0.75, "three of four");
        token.begin_tiles(2);
        assert_eq!(token.progress(), 0.0, "another pass");
    }
}
