//! Cancelling a drawing, and its progress.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

/// Ends drawings early, from any thread, and says how much of one is done. Clones are the same token;
/// once cancelled it stays so.
#[derive(Clone, Debug, Default)]
pub struct Cancel(Arc<State>);

#[derive(Debug, Default)]
struct State {
    is_cancelled: AtomicBool,
    /// Expected drawings, if there are several, and those that were begun.
    drawings: AtomicU32,
    begun_drawings: AtomicU32,
    /// Expected passes of the drawing under way, and those that were begun.
    passes: AtomicU32,
    begun_passes: AtomicU32,
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

    /// A token for so many drawings, one after the other: [`progress`](Self::progress) is the share of all of them.
    #[must_use]
    pub fn for_drawings(count: u32) -> Self {
        Self(Arc::new(State { drawings: count.into(), ..State::default() }))
    }

    /// Begins a drawing of so many passes; the one before is finished.
    pub fn begin_drawing(&self, passes: u32) {
        let State { begun_drawings, begun_passes, tiles, .. } = &*self.0;
        begun_drawings.fetch_add(1, Ordering::Relaxed);
        [begun_passes, tiles].iter().for_each(|count| count.store(0, Ordering::Relaxed));
        self.0.passes.store(passes, Ordering::Relaxed);
    }

    /// The drawing under way has so many passes more than was known when it began.
    pub fn expect_passes(&self, more: u32) {
        self.0.passes.fetch_add(more, Ordering::Relaxed);
    }

    /// How much is drawn, from 0 to 1: finished drawings, and of the one under way its finished passes and the finished
    /// tiles of the pass under way. All passes count alike.
    #[must_use]
    pub fn progress(&self) -> f32 {
        let State { drawings, begun_drawings, passes, begun_passes, tiles, drawn, .. } = &*self.0;
        let count = |count: &AtomicU32| count.load(Ordering::Relaxed);
        let of_pass = if count(tiles) == 0 { 0.0 } else { count(drawn) as f32 / count(tiles) as f32 };
        let of_drawing = share(count(begun_passes), count(passes), of_pass);
        share(count(begun_drawings), count(drawings), of_drawing)
    }

    /// Starts counting the finished tiles of a pass, which has `count` tiles.
    pub(crate) fn begin_tiles(&self, count: usize) {
        self.0.begun_passes.fetch_add(1, Ordering::Relaxed);
        self.0.drawn.store(0, Ordering::Relaxed);
        self.0.tiles.store(u32::try_from(count).unwrap_or(u32::MAX), Ordering::Relaxed);
    }

    /// Counts a finished tile.
    pub(crate) fn finish_tile(&self) {
        self.0.drawn.fetch_add(1, Ordering::Relaxed);
    }
}

/// The share of parts that are finished: all but the last that was begun, and that share of this one. There may be more of
/// them than were expected.
fn share(begun: u32, expected: u32, of_last: f32) -> f32 {
    let finished = begun.saturating_sub(1);
    (finished as f32 + of_last.min(1.0)) / expected.max(begun).max(1) as f32
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
        token.finish_tile();
        token.begin_tiles(2);
        assert_eq!(token.progress(), 0.5, "a second pass that nobody expected");
    }

    /// It began anew for each shadow map and for each of four views.
    #[test]
    fn progress_restarted_with_each_pass() {
        let token = Cancel::for_drawings(2);
        let mut seen = vec![token.progress()];
        for _ in 0..2 {
            token.begin_drawing(1);
            token.expect_passes(1);
            for _ in 0..2 {
                token.begin_tiles(2);
                seen.push(token.progress());
                token.finish_tile();
                seen.push(token.progress());
                token.finish_tile();
            }
        }
        seen.push(token.progress());
        assert_eq!(seen, [0.0, 0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0]);
    }
}
