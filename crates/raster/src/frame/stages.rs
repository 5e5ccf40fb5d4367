//! The stages of a frame: plan, vertices, set-up with binning, tiles. All workers
//! share each stage.

use super::FrameOptions;
use super::change::Signature;
use super::changed_vertices::{ChangedVertices, VertexValues};
use super::layout::{Layout, VERTICES};
use super::moving::MovingPrimitives;
use super::occlusion::Occlusion;
use super::set_up::SetUpContext;
use super::tiles::{Scratch, TileCache, draw_tile};
use crate::bin::Chunk;
use crate::pass::{Pass, RecordedDraw};
use crate::resolve::Strip;
use crate::stats::Clock;
use crate::target::Bands;
use crate::vertex::{ScreenVertex, VertexDestination};
use crate::view::{BackgroundRow, FrameView, Plan};
use crate::viewport::Viewport;
use crate::{StageTimes, Stats, Target};
use fixedbitset::FixedBitSet;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, PoisonError};

/// What is held from frame to frame, so that a warm frame allocates nothing.
#[derive(Default)]
pub(crate) struct Arena {
    pub(super) plan: Plan,
    pub(super) screen_vertices: Vec<ScreenVertex>,
    pub(super) varyings: Vec<f32>,
    pub(super) chunks: Vec<Chunk>,
    background_rows: Vec<BackgroundRow>,
    pub(super) scratches: Vec<Scratch>,
    /// The signature of the last frame, if the next frame may follow from it.
    pub(super) last_signature: Option<Signature>,
    pub(super) changed_vertices: ChangedVertices,
    pub(super) moving: MovingPrimitives,
    occlusion: Occlusion,
}

/// Draws a pass into a target.
pub(crate) fn draw(
    arena: &mut Arena,
    pass: &Pass<'_>,
    target: &mut Target<'_>,
    options: FrameOptions<'_>,
) -> Stats {
    let mut scratches = std::mem::take(&mut arena.scratches);
    let mut occlusion = std::mem::take(&mut arena.occlusion);
    let mut clock = Clock::new(options.timed);
    let is_searched = occlusion.choose(pass, target, options);
    let mut earlier = StageTimes::default();
    if is_searched {
        let front = prepare_draws(arena, pass, Some(occlusion.drawn()), target, options);
        warm(&mut scratches, options);
        occlusion.leave_out(&front, options, &mut scratches);
        earlier.visibility = clock.lap();
    }
    let drawn = is_searched.then(|| occlusion.drawn());
    let view = prepare_draws(arena, pass, drawn, target, options);
    let mut stats = finish(&view, None, target, options, &mut scratches);
    stats.times += earlier;
    (arena.scratches, arena.occlusion) = (scratches, occlusion);
    stats
}

/// Sees to it that each worker has memory. That of workers that rest in this frame is held for the next one.
fn warm(scratches: &mut Vec<Scratch>, options: FrameOptions<'_>) {
    scratches.resize_with(options.workers.count().max(scratches.len()), Scratch::new);
}

/// The tiles of a frame that may differ from those of the last one.
#[derive(Clone, Copy)]
pub(super) struct SomeTiles<'t> {
    pub(super) numbers: &'t [u32],
    pub(super) cache: Option<&'t TileCache>,
}

/// Draws the tiles, or some of them, of a frame that is prepared.
pub(super) fn finish(
    view: &FrameView<'_>,
    tiles: Option<SomeTiles<'_>>,
    target: &mut Target<'_>,
    options: FrameOptions<'_>,
    scratches: &mut Vec<Scratch>,
) -> Stats {
    let mut stats = Stats { times: view.times, ..count(view) };
    let bands = Bands::new(target, view.grid.size / view.supersampling);
    warm(scratches, options);
    draw_tiles(view, tiles, &bands, options, scratches);
    for scratch in scratches {
        stats += std::mem::take(&mut scratch.stats);
    }
    stats
}

/// Everything up to the tiles: vertices run, triangles set up and binned.
pub(crate) fn prepare<'f>(
    arena: &'f mut Arena,
    pass: &'f Pass<'_>,
    target: &Target<'_>,
    options: FrameOptions<'_>,
) -> FrameView<'f> {
    prepare_draws(arena, pass, None, target, options)
}

/// The same for some draws of the pass.
fn prepare_draws<'f>(
    arena: &'f mut Arena,
    pass: &'f Pass<'_>,
    drawn: Option<&FixedBitSet>,
    target: &Target<'_>,
    options: FrameOptions<'_>,
) -> FrameView<'f> {
    let layout = Layout::new(pass, target, options);
    let grid = layout.grid;
    arena.last_signature = None;
    let Arena { plan, screen_vertices, varyings, chunks, .. } = arena;
    let used = plan.make(&pass.draws, drawn, chunks, options.workers.count(), layout.axis);
    let chunks = &mut chunks[..used];
    screen_vertices.resize(plan.vertices, ScreenVertex::MISSING);
    varyings.resize(plan.varyings, 0.0);
    let mut clock = Clock::new(options.timed);
    run_vertices(&pass.draws, plan, grid.viewport, options, VertexValues { screen_vertices, varyings });
    let vertices = clock.lap();
    let set_up = SetUpContext {
        pass: &pass.draws,
        plan,
        screen_vertices,
        grid: &grid,
        axis: layout.axis,
        token: options.token,
    };
    set_up.all(options, chunks);
    let times = StageTimes { vertices, set_up: clock.lap(), ..StageTimes::default() };
    arena.view(pass, target, layout, options, times)
}

impl Arena {
    /// What tiles read when all before them is done.
    pub(super) fn view<'f>(
        &'f mut self,
        pass: &'f Pass<'_>,
        target: &Target<'_>,
        Layout { axis, wants, ink, grid }: Layout,
        options: FrameOptions<'_>,
        times: StageTimes,
    ) -> FrameView<'f> {
        BackgroundRow::list(pass.background, target.height(), wants.bytes, &mut self.background_rows);
        FrameView {
            pass: &pass.draws,
            background: pass.background,
            background_rows: &self.background_rows,
            plan: &self.plan,
            screen_vertices: &self.screen_vertices,
            varyings: &self.varyings,
            chunks: &self.chunks[..self.plan.chunks],
            moving: &[],
            grid,
            drawn: pass.drawn_pixels(target),
            supersampling: axis,
            wants,
            ink,
            token: options.token,
            hierarchical: options.hierarchical,
            timed: options.timed,
            times,
        }
    }
}

fn count(view: &FrameView<'_>) -> Stats {
    let mut stats = Stats { vertices: view.plan.vertices as u64, ..Stats::default() };
    stats.primitives = view.chunks.iter().map(|chunk| chunk.ordinals.len() as u64).sum();
    for chunk in view.chunks.iter().chain(view.moving.iter().map(|moving| &moving.listed)) {
        stats.binned += chunk.binned();
        stats += chunk.stats;
    }
    stats
}

/// The vertex stage: every worker takes some vertices at a time.
fn run_vertices(
    pass: &[RecordedDraw<'_>],
    plan: &Plan,
    viewport: Viewport,
    options: FrameOptions<'_>,
    values: VertexValues<'_>,
) {
    struct VertexQueue<'a> {
        draw: usize,
        slot: usize,
        screen_vertices: &'a mut [ScreenVertex],
        varyings: &'a mut [f32],
    }
    let VertexValues { screen_vertices, varyings } = values;
    let queue = Mutex::new(VertexQueue { draw: 0, slot: 0, screen_vertices, varyings });
    let next = || {
        let mut queue = queue.lock().unwrap_or_else(PoisonError::into_inner);
        while plan.draws.get(queue.draw).is_some_and(|draw| queue.slot == draw.used.len()) {
            (queue.draw, queue.slot) = (queue.draw + 1, 0);
        }
        let draw = plan.draws.get(queue.draw)?;
        let slots = queue.slot..draw.used.len().min(queue.slot + VERTICES);
        queue.slot = slots.end;
        let stride = pass[draw.draw()].pipeline.stride();
        let (screen_vertices, others) = std::mem::take(&mut queue.screen_vertices).split_at_mut(slots.len());
        queue.screen_vertices = others;
        let (varyings, others) = std::mem::take(&mut queue.varyings).split_at_mut(slots.len() * stride);
        queue.varyings = others;
        Some((draw, slots, screen_vertices, varyings))
    };
    options.workers.run(plan.vertices > VERTICES, |_| {
        while let Some((draw, slots, screen_vertices, varyings)) = next()
            && !options.is_cancelled()
        {
            let pipeline = pass[draw.draw()].pipeline;
            pipeline.run_vertices(
                options.token,
                plan.slots(draw),
                slots,
                viewport,
                VertexDestination { vertices: screen_vertices, varyings, position: None },
            );
        }
    });
}

/// The tiles, or some of them: every worker takes the next ones until there are none.
fn draw_tiles(
    view: &FrameView<'_>,
    some: Option<SomeTiles<'_>>,
    bands: &Bands<'_>,
    options: FrameOptions<'_>,
    scratches: &mut [Scratch],
) {
    let tiles = view.tiles();
    let count = some.map_or(tiles.len(), |some| some.numbers.len());
    let index_of = |number: u32| match some {
        Some(some) => some.numbers.get(number as usize).copied(),
        None => tiles.get(number).map(|[column, row]| row * view.grid.columns + column),
    };
    let next = AtomicU32::new(0);
    // A worker takes several neighbouring tiles, which are written together; towards the end
    // fewer, so that no worker waits long for another.
    let shares = 4 * options.workers.count();
    let end = |start: u32| {
        let left = count.saturating_sub(start as usize);
        start + (left / shares).clamp(1, Strip::MOST) as u32
    };
    let take = || {
        let (Ok(start) | Err(start)) =
            next.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |start| Some(end(start)));
        start..end(start)
    };
    if let Some(cancel) = options.cancel {
        cancel.begin_tiles(count);
    }
    let free = Mutex::new(scratches.iter_mut());
    options.workers.run(count > 1, |_| {
        let Some(scratch) = free.lock().unwrap_or_else(PoisonError::into_inner).next() else {
            return;
        };
        let mut own = take();
        while let Some(index) = index_of(own.start)
            && !options.is_cancelled()
        {
            match some.and_then(|some| some.cache) {
                Some(cache) => cache.draw(view, scratch, bands, index),
                None => draw_tile(view, scratch, bands, index),
            }
            if let Some(cancel) = options.cancel {
                cancel.finish_tile();
            }
            own.start += 1;
            if own.is_empty() {
                own = take();
            }
        }
        scratch.strip.write(view, bands);
    });
}
