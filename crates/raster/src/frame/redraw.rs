//! Redraws a frame after a small change. Few vertices run again, few chunks are set up again, and only the tiles that may
//! look different are drawn.

use super::Redraw;
use super::change::{DirtyTiles, DrawChange, Signature, can_update};
use super::changed_vertices::{AffectedPrimitives, AffectedSearch, VertexValues};
use super::layout::{FrameOptions, Layout};
use super::moving::MovingPrimitives;
use super::set_up::SetUpContext;
use super::stages::{Arena, SomeTiles, finish, prepare};
use crate::bin::{Chunk, MovingChunk};
use crate::ink::Ink;
use crate::pass::Pass;
use crate::stats::Clock;
use crate::{StageTimes, Target};

/// Draws a pass into a target that holds an earlier frame. If `changes` lists how the pass differs
/// from the last one, only the tiles that may differ are drawn.
pub(crate) fn redraw(
    arena: &mut Arena,
    pass: &Pass<'_>,
    target: &mut Target<'_>,
    changes: Option<&[DrawChange<'_>]>,
    options: FrameOptions<'_>,
) -> Redraw {
    let layout = Layout::new(pass, target, options);
    let signature = Signature::new(pass, &layout, options.workers.count());
    let is_last = arena.last_signature.take().is_some_and(|last| last == signature);
    let changes = changes.filter(|changes| {
        let can_update = || can_update(&arena.plan, pass, changes);
        is_last && can_update() && arena.plan.has_points_of(&pass.draws, layout.axis)
    });
    let mut scratches = std::mem::take(&mut arena.scratches);
    let mut moving = std::mem::take(&mut arena.moving);
    let (mut view, tiles) = match changes {
        Some(changes) => {
            let UpdatedStages { tiles, times } = update(arena, &mut moving, pass, &layout, changes, options);
            (arena.view(pass, target, layout, options, times), Some(tiles))
        }
        None => {
            moving.clear();
            (prepare(arena, pass, target, options), None)
        }
    };
    view.moving = &moving.chunks;
    let parts = match &tiles {
        Some(tiles) => tiles.iter().map(|&tile| view.drawn_rect(tile)).collect(),
        None => vec![view.drawn],
    };
    let some = tiles.as_deref().map(|numbers| SomeTiles { numbers, cache: moving.cache() });
    let stats = finish(&view, some, target, options, &mut scratches);
    (arena.scratches, arena.moving) = (scratches, moving);
    // What was cancelled may be half done.
    arena.last_signature = (!options.is_cancelled()).then_some(signature);
    Redraw { stats, parts }
}

/// What is known when all before the tiles is done.
struct UpdatedStages {
    /// The tiles that may differ.
    tiles: Vec<u32>,
    times: StageTimes,
}

/// The stages up to the tiles for a pass that differs little from the last one.
fn update(
    arena: &mut Arena,
    moving: &mut MovingPrimitives,
    pass: &Pass<'_>,
    layout: &Layout,
    changes: &[DrawChange<'_>],
    options: FrameOptions<'_>,
) -> UpdatedStages {
    let (axis, grid) = (layout.axis, layout.grid);
    let Arena { plan, screen_vertices, varyings, chunks, changed_vertices, .. } = arena;
    plan.update_points(&pass.draws, axis);
    let mut clock = Clock::new(options.timed);
    changed_vertices.mark(plan, changes);
    changed_vertices.run(
        &pass.draws,
        plan,
        grid.viewport,
        options,
        VertexValues { screen_vertices, varyings },
    );
    let vertices = clock.lap();
    let update = PrimitiveUpdate {
        set_up: SetUpContext {
            pass: &pass.draws,
            plan,
            screen_vertices,
            grid: &grid,
            axis,
            token: options.token,
        },
        search: AffectedSearch {
            pass: &pass.draws,
            plan,
            vertices: changed_vertices,
            changes,
            has_edges: layout.ink.as_ref().is_some_and(Ink::has_lines),
        },
        may_part: layout.wants.bytes.is_some() && grid.pattern.count() == 1,
        options,
    };
    let tiles = update.run(&mut chunks[..plan.chunks], moving);
    UpdatedStages { tiles, times: StageTimes { vertices, set_up: clock.lap(), ..StageTimes::default() } }
}

/// What is brought up to date.
struct PrimitiveUpdate<'a> {
    set_up: SetUpContext<'a>,
    search: AffectedSearch<'a>,
    /// Whether primitives that move again and again may be listed apart.
    may_part: bool,
    options: FrameOptions<'a>,
}

impl PrimitiveUpdate<'_> {
    /// Sets primitives up again whose vertices have run, and returns the tiles that may look different.
    fn run(&self, chunks: &mut [Chunk], moving: &mut MovingPrimitives) -> Vec<u32> {
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
