//! The stages of a frame: plan, vertices, set-up with binning, tiles. Each is
//! worked off by all workers together.

use super::change::{DirtyTiles, Signature, can_follow};
use super::touched::Touched;
use super::{DrawChange, FrameView, Plan, Redraw, Wants};
use crate::bin::{Chunk, Grid};
use crate::clip;
use crate::clock::Clock;
use crate::geometry::Shape;
use crate::ink::Ink;
use crate::line::LineStyle;
use crate::pass::{Pass, Recorded};
use crate::point::PointStyle;
use crate::pool::Workers;
use crate::resolve::{BackgroundRow, Strip};
use crate::setup::Setup;
use crate::shade::Encoding;
use crate::simd::{Simd, Token, at_level};
use crate::target::Bands;
use crate::tile::{MAX_SIDE, Scratch, draw_tile};
use crate::vertex::{DrawVertices, ScreenVertex};
use crate::viewport::Viewport;
use crate::{Cancel, Culling, StageTimes, Stats, Target};
use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, PoisonError};

/// How many vertices a worker runs at a time.
pub(super) const VERTICES: usize = 2048;

/// What is kept from frame to frame, so that a warm frame allocates nothing.
#[derive(Default)]
pub(crate) struct Arena {
    plan: Plan,
    places: Vec<ScreenVertex>,
    varyings: Vec<f32>,
    chunks: Vec<Chunk>,
    background_rows: Vec<BackgroundRow>,
    scratches: Vec<Scratch>,
    /// What the last frame was, if the next one may follow it.
    followed: Option<Signature>,
    touched: Touched,
}

/// How a frame is drawn.
#[derive(Clone, Copy)]
pub(crate) struct How<'w> {
    pub(crate) token: Token,
    pub(crate) workers: &'w Workers,
    pub(crate) tile_size: u32,
    pub(crate) hierarchical: bool,
    pub(crate) timed: bool,
    /// Whether colours are found, whatever the target keeps.
    pub(crate) finds_colors: bool,
    pub(crate) cancel: Option<&'w Cancel>,
}

impl How<'_> {
    /// Whether no more work is to be begun.
    pub(super) fn is_cancelled(self) -> bool {
        self.cancel.is_some_and(Cancel::is_cancelled)
    }
}

/// Draws a pass into a target.
pub(crate) fn draw(arena: &mut Arena, pass: &Pass<'_>, target: &mut Target<'_>, how: How<'_>) -> Stats {
    let mut scratches = std::mem::take(&mut arena.scratches);
    let view = prepare(arena, pass, target, how);
    let stats = finish(&view, (None, target), how, &mut scratches);
    arena.scratches = scratches;
    stats
}

/// Draws a pass of which the target holds an earlier frame, and those tiles alone that may
/// differ, if the changes tell how it differs from the last pass that was drawn so.
pub(crate) fn redraw(
    arena: &mut Arena,
    pass: &Pass<'_>,
    (target, changes): (&mut Target<'_>, Option<&[DrawChange<'_>]>),
    how: How<'_>,
) -> Redraw {
    let layout = Layout::new(pass, target, how);
    let signature = Signature::new(pass, &layout, how.workers.count());
    let is_last = arena.followed.take().is_some_and(|last| last == signature);
    let changes = changes.filter(|changes| is_last && can_follow(&arena.plan, pass, changes));
    let mut scratches = std::mem::take(&mut arena.scratches);
    let (view, tiles) = match changes {
        Some(changes) => {
            let (view, tiles) = follow(arena, pass, (layout, target), changes, how);
            (view, Some(tiles))
        }
        None => (prepare(arena, pass, target, how), None),
    };
    let parts = match &tiles {
        Some(tiles) => tiles.iter().map(|&tile| view.drawn_rect(tile)).collect(),
        None => vec![view.drawn],
    };
    let stats = finish(&view, (tiles.as_deref(), target), how, &mut scratches);
    arena.scratches = scratches;
    // What was cancelled may be half done.
    arena.followed = (!how.is_cancelled()).then_some(signature);
    Redraw { stats, parts }
}

/// Draws the tiles, or some of them, of a frame that is prepared.
fn finish(
    view: &FrameView<'_>,
    (tiles, target): (Option<&[u32]>, &mut Target<'_>),
    how: How<'_>,
    scratches: &mut Vec<Scratch>,
) -> Stats {
    let mut stats = Stats { times: view.times, ..count(view.plan, view.chunks) };
    let bands = Bands::new(target, view.grid.size / view.supersampling);
    // Those of workers that rest in this frame are kept.
    scratches.resize_with(how.workers.count().max(scratches.len()), Scratch::new);
    draw_tiles(view, tiles, &bands, how, scratches);
    for scratch in scratches {
        stats += std::mem::take(&mut scratch.stats);
    }
    stats
}

/// How a target is cut into tiles, and what is wanted of it.
#[derive(Clone, Copy)]
pub(super) struct Layout {
    pub(super) axis: u32,
    pub(super) wants: Wants,
    pub(super) ink: Option<Ink>,
    pub(super) grid: Grid,
}

impl Layout {
    fn new(pass: &Pass<'_>, target: &Target<'_>, how: How<'_>) -> Self {
        let axis = target.samples_per_axis();
        let viewport = Viewport { width: target.width() * axis, height: target.height() * axis };
        let wants = wants(target);
        let ink = if wants.color || how.finds_colors { ink(pass, axis) } else { None };
        let apron = ink.map_or(0, |ink| ink.reach().next_multiple_of(axis));
        let tile_pixels = (own_side(how.tile_size, apron) / axis).max(1);
        let grid = Grid::new(viewport, target.pattern(), tile_pixels * axis).with_apron(apron);
        Self { axis, wants, ink, grid }
    }
}

/// Everything up to the tiles: vertices run, triangles set up and binned.
pub(crate) fn prepare<'f>(
    arena: &'f mut Arena,
    pass: &'f Pass<'_>,
    target: &Target<'_>,
    how: How<'_>,
) -> FrameView<'f> {
    let layout = Layout::new(pass, target, how);
    let Layout { axis, grid, .. } = layout;
    arena.followed = None;
    let Arena { plan, places, varyings, chunks, .. } = arena;
    let used = plan.make(&pass.draws, chunks, how.workers.count());
    let chunks = &mut chunks[..used];
    places.resize(plan.places, ScreenVertex::MISSING);
    varyings.resize(plan.varyings, 0.0);
    let mut clock = Clock::new(how.timed);
    run_vertices(&pass.draws, plan, grid.viewport, how, (places, varyings));
    let vertices = clock.lap();
    set_up(&pass.draws, plan, places, (&grid, axis), how, chunks);
    let times = StageTimes { vertices, set_up: clock.lap(), ..StageTimes::default() };
    arena.view((pass, target), layout, how, used, times)
}

/// The same for a pass that differs little from the last one, and the tiles that may
/// differ.
fn follow<'f>(
    arena: &'f mut Arena,
    pass: &'f Pass<'_>,
    (layout, target): (Layout, &Target<'_>),
    changes: &[DrawChange<'_>],
    how: How<'_>,
) -> (FrameView<'f>, Vec<u32>) {
    let Layout { axis, grid, ink, .. } = layout;
    let Arena { plan, places, varyings, chunks, touched, .. } = arena;
    let used = chunks.len().min(plan.chunks);
    let mut clock = Clock::new(how.timed);
    touched.mark(plan, changes);
    touched.run_vertices(&pass.draws, plan, grid.viewport, how, (places, varyings));
    let vertices = clock.lap();
    let tiles = DirtyTiles::new(&grid);
    let rest = Mutex::new(chunks[..used].iter_mut());
    let next = || rest.lock().unwrap_or_else(PoisonError::into_inner).next();
    let many = used > 1;
    how.workers.run(many, |_| {
        let mut flags = Vec::new();
        while let Some(chunk) = next()
            && !how.is_cancelled()
        {
            let found = touched.triangles(&pass.draws, plan, (changes, ink.is_some()), chunk, &mut flags);
            if found.any {
                tiles.add(&grid, chunk, &flags);
            }
            if found.moved {
                chunk.reset(chunk.ordinals.clone(), chunk.surface);
                set_up_chunk(&pass.draws, plan, places, (&grid, axis), how.token, chunk);
                tiles.add(&grid, chunk, &flags);
            }
        }
    });
    let times = StageTimes { vertices, set_up: clock.lap(), ..StageTimes::default() };
    (arena.view((pass, target), layout, how, used, times), tiles.listed())
}

impl Arena {
    /// What tiles read when all before them is done.
    fn view<'f>(
        &'f mut self,
        (pass, target): (&'f Pass<'_>, &Target<'_>),
        Layout { axis, wants, ink, grid }: Layout,
        how: How<'_>,
        used: usize,
        times: StageTimes,
    ) -> FrameView<'f> {
        BackgroundRow::list(pass.background, target.height(), wants.bytes, &mut self.background_rows);
        FrameView {
            pass: &pass.draws,
            background: pass.background,
            background_rows: &self.background_rows,
            plan: &self.plan,
            places: &self.places,
            varyings: &self.varyings,
            chunks: &self.chunks[..used],
            grid,
            drawn: pass.drawn_pixels(target),
            supersampling: axis,
            wants,
            ink,
            token: how.token,
            hierarchical: how.hierarchical,
            timed: how.timed,
            times,
        }
    }
}

/// What paints edges, if there are any.
fn ink(pass: &Pass<'_>, axis: u32) -> Option<Ink> {
    let has_edges = pass.draws.iter().any(|draw| draw.geometry.shows_edges());
    has_edges.then(|| Ink::new(&pass.edges?, axis)).flatten()
}

/// The side of a tile without what it sees of its neighbours. With that it is as large as
/// was asked for, unless too little would be left of it, and never larger than can be.
fn own_side(tile_size: u32, apron: u32) -> u32 {
    if tile_size >= 4 * apron { tile_size - 2 * apron } else { tile_size.min(MAX_SIDE as u32 - 2 * apron) }
}

fn wants(target: &Target<'_>) -> Wants {
    let (srgb8, unorm8) = (target.srgb8().is_some(), target.unorm8().is_some());
    let linear = target.linear().is_some();
    let bytes = match (srgb8, unorm8, linear, target.samples_per_axis()) {
        (true, false, false, 1) => Some(Encoding::Srgb8),
        (false, true, false, 1) => Some(Encoding::Unorm8),
        _ => None,
    };
    let ids = target.objects().is_some() || target.faces().is_some() || target.triangles().is_some();
    Wants { color: srgb8 || unorm8 || linear, depth: target.depth().is_some(), ids, bytes }
}

fn count(plan: &Plan, chunks: &[Chunk]) -> Stats {
    let mut stats = Stats { vertices: plan.vertices as u64, ..Stats::default() };
    for chunk in chunks {
        stats.primitives += chunk.ordinals.len() as u64;
        stats.binned += chunk.binned();
        stats += chunk.stats;
    }
    stats
}

/// The vertex stage: every worker takes some vertices at a time.
fn run_vertices(
    pass: &[Recorded<'_>],
    plan: &Plan,
    viewport: Viewport,
    how: How<'_>,
    (places, varyings): (&mut [ScreenVertex], &mut [f32]),
) {
    struct Rest<'a> {
        draw: usize,
        slot: usize,
        places: &'a mut [ScreenVertex],
        varyings: &'a mut [f32],
    }
    let rest = Mutex::new(Rest { draw: 0, slot: 0, places, varyings });
    let next = || {
        let mut rest = rest.lock().unwrap_or_else(PoisonError::into_inner);
        while plan.draws.get(rest.draw).is_some_and(|draw| rest.slot == draw.used.len()) {
            (rest.draw, rest.slot) = (rest.draw + 1, 0);
            let (missing, others) = std::mem::take(&mut rest.places).split_first_mut()?;
            *missing = ScreenVertex::MISSING;
            rest.places = others;
        }
        let draw = plan.draws.get(rest.draw)?;
        let slots = rest.slot..draw.used.len().min(rest.slot + VERTICES);
        rest.slot = slots.end;
        let stride = pass[draw.draw].pipeline.stride();
        let (places, others) = std::mem::take(&mut rest.places).split_at_mut(slots.len());
        rest.places = others;
        let (varyings, others) = std::mem::take(&mut rest.varyings).split_at_mut(slots.len() * stride);
        rest.varyings = others;
        Some((draw, slots, places, varyings))
    };
    how.workers.run(plan.vertices > VERTICES, |_| {
        while let Some((draw, slots, places, varyings)) = next()
            && !how.is_cancelled()
        {
            let pipeline = pass[draw.draw].pipeline;
            pipeline.run_vertices(how.token, plan.slots(draw), slots, viewport, (places, varyings));
        }
    });
}

/// Set-up and binning: every worker takes a chunk at a time.
fn set_up(
    pass: &[Recorded<'_>],
    plan: &Plan,
    places: &[ScreenVertex],
    (grid, axis): (&Grid, u32),
    how: How<'_>,
    chunks: &mut [Chunk],
) {
    let many = chunks.len() > 1;
    let rest = Mutex::new(chunks.iter_mut());
    let next = || rest.lock().unwrap_or_else(PoisonError::into_inner).next();
    how.workers.run(many, |_| {
        while let Some(chunk) = next()
            && !how.is_cancelled()
        {
            set_up_chunk(pass, plan, places, (grid, axis), how.token, chunk);
        }
    });
}

/// Sets up the primitives of a chunk that is empty.
fn set_up_chunk(
    pass: &[Recorded<'_>],
    plan: &Plan,
    places: &[ScreenVertex],
    (grid, axis): (&Grid, u32),
    token: Token,
    chunk: &mut Chunk,
) {
    for (draw, range) in plan.parts(chunk.ordinals.clone()) {
        let recorded = &pass[draw.draw];
        let vertices = DrawVertices {
            slots: plan.slots(draw),
            places: &places[draw.places.clone()],
            pipeline: recorded.pipeline,
            token,
        };
        let setup = Setup {
            grid,
            volume: &clip::volume(grid.viewport),
            vertices,
            first: draw.ordinals.start,
            culling: Culling::None,
            chunk,
        };
        set_up_part(setup, &recorded.geometry.shape, axis, token, range);
    }
    chunk.sort();
}

/// Sets up some primitives of one draw.
fn set_up_part(mut setup: Setup<'_>, shape: &Shape<'_>, axis: u32, token: Token, range: Range<u32>) {
    let multisampled = setup.grid.pattern.count() > 1;
    match *shape {
        Shape::Triangles { triangles, culling, .. } => {
            setup.culling = culling;
            let triangles = &triangles[range.start as usize..range.end as usize];
            at_level!(token, simd => set_up_triangles(simd, &mut setup, range.start, triangles));
        }
        Shape::Lines { segments, width, outline, toward_eye } => {
            let style = LineStyle::new((width, outline), toward_eye, axis, multisampled);
            for index in range {
                setup.segment(index, segments[index as usize], style);
            }
        }
        Shape::Points { points, sizes, shape, outline, toward_eye } => {
            let style_of = sizes.each(|size| PointStyle::new((size, outline), shape, toward_eye, axis));
            for index in range {
                setup.point(index, points[index as usize], style_of(index));
            }
        }
    }
}

#[inline(always)]
fn set_up_triangles<S: Simd>(simd: S, setup: &mut Setup<'_>, first: u32, triangles: &[[u32; 3]]) {
    for (group, triangles) in triangles.chunks(crate::simd::LANES).enumerate() {
        setup.eight_triangles(simd, first + (group * crate::simd::LANES) as u32, triangles);
    }
}

/// The tiles, or some of them: every worker takes the next ones until there are none.
fn draw_tiles(
    view: &FrameView<'_>,
    some: Option<&[u32]>,
    bands: &Bands<'_>,
    how: How<'_>,
    scratches: &mut [Scratch],
) {
    let tiles = view.tiles();
    let count = some.map_or(tiles.len(), <[u32]>::len);
    let index_of = |number: u32| match some {
        Some(some) => some.get(number as usize).copied(),
        None => tiles.get(number).map(|[column, row]| row * view.grid.columns + column),
    };
    let next = AtomicU32::new(0);
    // Neighbours, which are written together; towards the end fewer, so that nobody waits long.
    let shares = 4 * how.workers.count();
    let end = |start: u32| {
        let left = count.saturating_sub(start as usize);
        start + (left / shares).clamp(1, Strip::MOST) as u32
    };
    let take = || {
        let (Ok(start) | Err(start)) =
            next.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |start| Some(end(start)));
        start..end(start)
    };
    let free = Mutex::new(scratches.iter_mut());
    how.workers.run(count > 1, |_| {
        let Some(scratch) = free.lock().unwrap_or_else(PoisonError::into_inner).next() else {
            return;
        };
        let mut own = take();
        while let Some(index) = index_of(own.start)
            && !how.is_cancelled()
        {
            draw_tile(view, scratch, bands, index);
            own.start += 1;
            if own.is_empty() {
                own = take();
            }
        }
        scratch.strip.write(view, bands);
    });
}
