//! Everything up to the tiles of a frame that differs little from the last one, and the tiles that may differ.

use super::change::{DirtyTiles, DrawChange};
use super::moving::Moving;
use super::options::FrameOptions;
use super::set_up::SetUp;
use super::touched::{Found, Touched};
use crate::bin::{Chunk, EarlierEntries, Grid, MovingChunk};
use std::sync::{Mutex, PoisonError};

/// What is brought up to date.
pub(super) struct Follow<'a> {
    pub(super) set_up: SetUp<'a>,
    pub(super) touched: &'a Touched,
    pub(super) changes: &'a [DrawChange<'a>],
    pub(super) has_lines: bool,
    /// Whether primitives that move again and again may be listed apart.
    pub(super) may_part: bool,
    pub(super) options: FrameOptions<'a>,
}

impl Follow<'_> {
    /// Sets primitives up again whose vertices have run, and returns the tiles that may look different.
    pub(super) fn run(&self, chunks: &mut [Chunk], moving: &mut Moving) -> Vec<u32> {
        if self.touched.changed().iter().all(|&word| word == 0) && self.changes.iter().all(is_empty) {
            return Vec::new();
        }
        let tiles = DirtyTiles::new(self.set_up.grid);
        if moving.covers(self.touched, self.set_up.plan, self.changes) {
            self.set_up_apart((chunks, &mut moving.chunks), &tiles);
            moving.tiles.iter().for_each(|&tile| tiles.add_tile(tile));
            self.unite_unless_plain((chunks, moving), &tiles);
            return tiles.listed();
        }
        let found = self.find(chunks);
        let places = self.part((chunks, &found), moving);
        for (number, (chunk, found)) in chunks.iter().zip(&found).enumerate() {
            add_flagged(&tiles, self.set_up.grid, (chunk, moving.chunks.get(number)), &found.differ);
        }
        match places {
            Some(places) => {
                moving.part(self.set_up.grid, chunks, places);
                self.set_up_apart((chunks, &mut moving.chunks), &tiles);
                let look = DirtyTiles::new(self.set_up.grid);
                for (chunk, found) in chunks.iter().zip(&found) {
                    look.add(self.set_up.grid, chunk, |place| found.differ[place as usize]);
                }
                moving.tiles = look.listed();
                moving.tiles.iter().for_each(|&tile| tiles.add_tile(tile));
                self.unite_unless_plain((chunks, moving), &tiles);
            }
            None => {
                self.set_up_again((chunks, &found), moving, &tiles);
                moving.unite();
            }
        }
        tiles.listed()
    }

    /// Finds the primitives of each chunk that may look different.
    fn find(&self, chunks: &[Chunk]) -> Vec<Found> {
        let SetUp { pass, plan, .. } = self.set_up;
        let mut found: Vec<Found> = chunks.iter().map(|_| Found::default()).collect();
        self.for_each(chunks.iter().zip(&mut found), |(chunk, found)| {
            self.touched.triangles(pass, plan, (self.changes, self.has_lines), chunk, found);
        });
        found
    }

    /// The places in each chunk of the primitives that are to be listed apart, if any are.
    fn part(&self, (chunks, found): (&[Chunk], &[Found]), moving: &mut Moving) -> Option<Vec<Vec<u32>>> {
        let SetUp { pass, plan, .. } = self.set_up;
        if !moving.repeats(self.touched) || !self.may_part {
            return None;
        }
        let places = moving.find((pass, plan), self.touched, (chunks, found))?;
        moving.can_part((pass, plan), chunks, &places).then_some(places)
    }

    /// Sets up the primitives that are listed apart. Adds the tiles that listed any of them or do now.
    fn set_up_apart(&self, (chunks, moving): (&[Chunk], &mut [MovingChunk]), tiles: &DirtyTiles) {
        let grid = self.set_up.grid;
        self.for_each(chunks.iter().zip(moving), |(chunk, moving)| {
            if moving.places().is_empty() {
                return;
            }
            moving.for_each_tile(grid, |tile| tiles.add_tile(tile));
            self.set_up.apart(chunk, moving);
            moving.for_each_tile(grid, |tile| tiles.add_tile(tile));
        });
    }

    /// If some of the primitives that are listed apart cannot be any more, because they are cut or very large, sets
    /// up all of their chunks as a whole.
    fn unite_unless_plain(&self, (chunks, moving): (&mut [Chunk], &mut Moving), tiles: &DirtyTiles) {
        if moving.chunks.iter().all(MovingChunk::is_plain) {
            return;
        }
        self.for_each(chunks.iter_mut().zip(&moving.chunks), |(chunk, moving)| {
            if !moving.places().is_empty() {
                chunk.reset(chunk.ordinals.clone(), chunk.blend_mode);
                self.set_up.chunk(chunk);
                tiles.add(self.set_up.grid, chunk, |place| moving.places().binary_search(&place).is_ok());
            }
        });
        moving.unite();
    }

    /// Sets up the primitives of each chunk that moved, and those that were listed apart. Adds the tiles that list
    /// primitives which look different.
    fn set_up_again(&self, (chunks, found): (&mut [Chunk], &[Found]), moving: &Moving, tiles: &DirtyTiles) {
        let numbered = chunks.iter_mut().zip(found).enumerate();
        let earlier = Mutex::new(Vec::<EarlierEntries>::new());
        self.for_each(numbered, |(number, (chunk, found))| {
            let were_apart = moving.chunks.get(number).is_some_and(|moving| !moving.places().is_empty());
            if were_apart {
                chunk.reset(chunk.ordinals.clone(), chunk.blend_mode);
                self.set_up.chunk(chunk);
            } else if found.any_moved {
                let lock = || earlier.lock().unwrap_or_else(PoisonError::into_inner);
                let mut spare = lock().pop().unwrap_or_default();
                self.set_up.moved(chunk, &found.moved, &mut spare);
                lock().push(spare);
            } else {
                return;
            }
            tiles.add(self.set_up.grid, chunk, |place| found.differ[place as usize]);
        });
    }

    /// Shares items among the workers.
    fn for_each<I: Iterator + Send>(&self, items: I, work: impl Fn(I::Item) + Sync) {
        self.options.workers.share(items.take_while(|_| !self.options.is_cancelled()), work);
    }
}

/// Whether no primitive may look different by itself.
fn is_empty(change: &DrawChange<'_>) -> bool {
    change.reshaped.is_empty() && change.recolored.is_empty()
}

/// Adds the tiles that list flagged primitives of a chunk.
fn add_flagged(
    tiles: &DirtyTiles,
    grid: &Grid,
    (chunk, moving): (&Chunk, Option<&MovingChunk>),
    flags: &[bool],
) {
    let is_flagged = |place: u32| flags[place as usize];
    tiles.add(grid, chunk, is_flagged);
    if let Some(moving) = moving {
        tiles.add(grid, &moving.listed, is_flagged);
    }
}
