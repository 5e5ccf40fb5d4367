//! What the tiles of a chunk listed before some of its primitives were moved.

use super::triangle_ref::Entry;
use std::mem::swap;
use std::ops::Range;

/// Tiles and entries of primitives that are drawn as they are, in their order. They are given
/// back from the first to the last; what is passed over is gone.
#[derive(Default)]
pub(crate) struct EarlierEntries {
    tiles: Vec<u32>,
    entries: Vec<Entry>,
    /// How many were given back or passed over.
    done: usize,
}

impl EarlierEntries {
    /// Takes lists, and leaves empty ones.
    pub(super) fn take(&mut self, (tiles, entries): (&mut Vec<u32>, &mut Vec<Entry>)) {
        self.tiles.clear();
        self.entries.clear();
        self.done = 0;
        swap(&mut self.tiles, tiles);
        swap(&mut self.entries, entries);
    }

    /// Appends those of some primitives to lists; how many primitives have any.
    pub(super) fn give_back(
        &mut self,
        primitives: &Range<u32>,
        (tiles, entries): (&mut Vec<u32>, &mut Vec<Entry>),
    ) -> u64 {
        let rest = &self.entries[self.done..];
        let first = self.done + rest.iter().take_while(|entry| entry.place() < primitives.start).count();
        let rest = &self.entries[first..];
        self.done = first + rest.iter().take_while(|entry| entry.place() < primitives.end).count();
        let kept = &self.entries[first..self.done];
        tiles.extend_from_slice(&self.tiles[first..self.done]);
        entries.extend_from_slice(kept);
        primitives_of(kept)
    }
}

/// How many primitives have entries, of a list in their order.
pub(super) fn primitives_of(entries: &[Entry]) -> u64 {
    let again = entries.windows(2).filter(|pair| pair[0] == pair[1]).count();
    (entries.len() - again) as u64
}
