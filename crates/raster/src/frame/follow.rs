//! Everything up to the tiles of a frame that differs little from the last one, and the tiles that may differ.

use super::affected_primitives::{AffectedPrimitives, AffectedSearch};
use super::change::{DirtyTiles, DrawChange};
use super::moving::MovingPrimitives;
use super::options::FrameOptions;
use super::set_up::SetUpContext;
use crate::bin::{Chunk, MovingChunk};

/// What is brought up to date.
pub(super) struct PrimitiveUpdate<'a> {
    pub(super) set_up: SetUpContext<'a>,
    pub(super) search: AffectedSearch<'a>,
    /// Whether primitives that move again and again may be listed apart.
    pub(super) may_part: bool,
    pub(super) options: FrameOptions<'a>,
}

impl PrimitiveUpdate<'_> {
    /// Sets primitives up again whose vertices have run, and returns the tiles that may look different.
    pub(super) fn run(&self, chunks: &mut [Chunk], moving: &mut MovingPrimitives) -> Vec<u32> {
        let AffectedSearch { plan, vertices, changes, .. } = self.search;
        if vertices.changed().iter().all(|&word| word == 0) && changes.iter().all(is_empty) {
            return Vec::new();
        }
        let tiles = DirtyTiles::new(self.set_up.grid);
        if moving.covers(vertices, plan, changes) {
            self.set_up_apart(chunks, moving, &tiles);
            return tiles.listed();
        }
        let affected = self.find(chunks);
        for (number, (chunk, affected)) in chunks.iter().zip(&affected).enumerate() {
            self.add_different(chunk, affected, &tiles);
            if let Some(moving) = moving.chunks.get(number) {
                self.add_different(&moving.listed, affected, &tiles);
            }
        }
        match self.part(chunks, &affected, moving) {
            Some(indices) => {
                moving.part(self.set_up.grid, chunks, indices);
                let still = DirtyTiles::new(self.set_up.grid);
                for (chunk, affected) in chunks.iter().zip(&affected) {
                    self.add_different(chunk, affected, &still);
                }
                moving.tiles = still.listed();
                self.set_up_apart(chunks, moving, &tiles);
            }
            None => {
                self.set_up_again(chunks, &affected, moving, &tiles);
                moving.unite();
            }
        }
        tiles.listed()
    }

    /// Finds the primitives of each chunk that may look different.
    fn find(&self, chunks: &[Chunk]) -> Vec<AffectedPrimitives> {
        let mut affected: Vec<_> = chunks.iter().map(|_| AffectedPrimitives::default()).collect();
        self.for_each(chunks.iter().zip(&mut affected), |(chunk, affected)| {
            self.search.find(chunk, affected);
        });
        affected
    }

    /// The indices in each chunk of the primitives that are to be listed apart, if any are.
    fn part(
        &self,
        chunks: &[Chunk],
        affected: &[AffectedPrimitives],
        moving: &mut MovingPrimitives,
    ) -> Option<Vec<Vec<u32>>> {
        let AffectedSearch { pass, plan, vertices, .. } = self.search;
        if !moving.repeats(vertices) || !self.may_part {
            return None;
        }
        let indices = moving.find(pass, plan, vertices, chunks, affected)?;
        moving.can_part(pass, plan, chunks, &indices).then_some(indices)
    }

    /// Sets up the primitives that are listed apart. Adds the tiles that listed any of them or do now, and the tiles in
    /// which others may look different. If some of the primitives cannot be listed apart any more, because they are cut or
    /// very large, sets up all of their chunks as a whole.
    fn set_up_apart(&self, chunks: &mut [Chunk], moving: &mut MovingPrimitives, tiles: &DirtyTiles) {
        let grid = self.set_up.grid;
        self.for_each(chunks.iter().zip(&mut moving.chunks), |(chunk, moving)| {
            if !moving.indices().is_empty() {
                moving.for_each_tile(grid, |tile| tiles.add_tile(tile));
                self.set_up.apart(chunk, moving);
                moving.for_each_tile(grid, |tile| tiles.add_tile(tile));
            }
        });
        moving.tiles.iter().for_each(|&tile| tiles.add_tile(tile));
        if moving.chunks.iter().all(MovingChunk::is_plain) {
            return;
        }
        self.for_each(chunks.iter_mut().zip(&moving.chunks), |(chunk, moving)| {
            if !moving.indices().is_empty() {
                self.set_up.again(chunk);
                tiles.add(grid, chunk, |index| moving.indices().binary_search(&index).is_ok());
            }
        });
        moving.unite();
    }

    /// Sets up the chunks with primitives that moved or were listed apart. Adds the tiles that list primitives which look
    /// different.
    fn set_up_again(
        &self,
        chunks: &mut [Chunk],
        affected: &[AffectedPrimitives],
        moving: &MovingPrimitives,
        tiles: &DirtyTiles,
    ) {
        self.for_each(chunks.iter_mut().zip(affected).enumerate(), |(number, (chunk, affected))| {
            let were_apart = moving.chunks.get(number).is_some_and(|moving| !moving.indices().is_empty());
            if were_apart || affected.any_moved {
                self.set_up.again(chunk);
                self.add_different(chunk, affected, tiles);
            }
        });
    }

    /// Adds the tiles that list primitives of a chunk which look different.
    fn add_different(&self, chunk: &Chunk, affected: &AffectedPrimitives, tiles: &DirtyTiles) {
        if affected.any_differs {
            tiles.add(self.set_up.grid, chunk, |index| affected.differs[index as usize]);
        }
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
