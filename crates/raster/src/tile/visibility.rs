//! Which triangle is visible at each sample of a tile: opaque triangles first, then masked ones, then overlays. Masked
//! triangles go through `masked` and `depth_query`.
//!
//! # Which kernel draws an opaque triangle or an overlay
//!
//! The kernel of the first row whose condition holds. [`cover_triangles`] decides for up to eight triangles at a time,
//! [`cover_one`] for one of them. The last column says how many times the instructions of a frame are needed if the
//! kernel is left out and a later row draws its triangles (callgrind, `workloads --simd avx2 --threads 1`).
//!
//! | condition | kernel | without it |
//! |---|---|---|
//! | points of one draw in a row that are drawn from their vertices | `points` | not measured: W1 to W6 draw no points |
//! | a line or a point with a record, less than 32 pixels wide | `quad` | not measured: W1 to W6 draw no lines |
//! | one sample per pixel; up to eight triangles in a row, all small, of at most 4×4 pixels each | `micro` | W2 1.17; W1, W3 to W6 1.00 |
//! | one sample per pixel; a small triangle at most two pixels wide along an axis, where its longest edge takes fewer steps than its box | `sliver` | W1 to W6 0.99 to 1.00; `--bench slivers` 1.1 to 1.7 (time) |
//! | one sample per pixel; a small triangle of at most 24×24 pixels | `tiny` | W2 1.03, W3 1.30, W4 1.24, W5 1.39 |
//! | several samples per pixel; a small triangle of at most 24×24 pixels | `multisample`, from `tiny` | W6 1.38 |
//! | any other triangle | `rasterizer`, the general kernel | |
//!
//! A triangle is *small* if its bounding box has less than 96 pixels each way. Other sizes count the part of the box that
//! lies in the tile. (`sliver` costs up to one per cent where a frame has few slivers. It is for meshes with many, such as
//! one of which single vertices are dragged far.)

use super::corners::{corners_of_one, corners_of_several};
use super::eight::{EightTriangles, Slivers};
use super::micro::Covered;
use super::multisample::EdgeOrigins;
use super::points::EightPoints;
use super::quad::{IndexedQuad, QuadEdges};
use super::rasterizer::TileRasterizer;
use super::state::COMPARISON;
use super::tiny::PreparedTriangle;
use super::triangle::covering_apart;
use super::{Surfaces, TileState, masked};
use crate::Stats;
use crate::bin::TriangleRef;
use crate::shade::Shading;
use crate::simd::{LANES, Simd, at_level};
use crate::stats::Counts;
use crate::tile_buffer::{NO_TRIANGLE, TileArea, VisibilityBuffer};
use crate::view::FrameView;
use std::cell::Cell;
use std::ops::Range;

/// Finds the nearest opaque or masked triangle at every sample.
pub(crate) fn resolve_visibility(
    frame: &FrameView<'_>,
    area: &TileArea,
    state: &mut TileState,
    surfaces: &Surfaces,
    shading: &mut Shading,
    stats: &mut Stats,
) {
    let mut counts = Counts::default();
    if !surfaces.opaque.is_empty() {
        counts = cover_opaque(frame, area, state, surfaces.opaque.len());
    }
    state.buffer.write_back();
    masked::cover_masked(frame, area, state, surfaces.masked.clone(), shading, stats);
    state.buffer.blank_outside(area);
    stats.add_counts(&counts);
}

/// Draws overlays over what opaque and masked triangles have left.
///
/// The tile cannot be drawn again as in [`cover_opaque`], because the buffer holds masked
/// triangles. So ties are resolved one by one, however many there are.
pub(crate) fn cover_overlay(
    frame: &FrameView<'_>,
    area: &TileArea,
    state: &mut TileState,
    surfaces: &Surfaces,
    stats: &mut Stats,
) {
    if surfaces.overlay.is_empty() {
        return;
    }
    let buffer = &mut state.buffer;
    if !surfaces.masked.is_empty() {
        buffer.forget_nearest();
    }
    buffer.write_back();
    if frame.hierarchical {
        // Most overlays lie behind what hides them, so the bounds are recomputed once for all of them.
        at_level!(frame.token, simd => buffer.refresh_all(simd, area));
    }
    let may_give_up = false;
    cover_more(frame, area, state, surfaces.overlay.clone(), may_give_up, stats);
    state.buffer.blank_outside(area);
}

/// Draws more opaque triangles or overlays, a part of the tile's list, over what is there. Returns false if there
/// are too many ties and it may give up.
pub(super) fn cover_more(
    frame: &FrameView<'_>,
    area: &TileArea,
    state: &mut TileState,
    part: Range<usize>,
    may_give_up: bool,
    stats: &mut Stats,
) -> bool {
    if part.is_empty() {
        return true;
    }
    let TileState { triangles, buffer, ties, .. } = state;
    let precedes = |ours: u32, theirs: u32| {
        ties.spend(COMPARISON);
        frame.precedes(triangles[ours as usize], triangles[theirs as usize])
    };
    let rasterizer = TileRasterizer { may_give_up, ..TileRasterizer::new(frame, area, ties, &precedes) };
    let mut counts = Counts::default();
    let triangles = &triangles[..part.end];
    let pass = TilePass { frame, rasterizer, triangles, nearest: &[], buffer, counts: &mut counts };
    let is_drawn = pass.cover_all(part.start);
    buffer.write_back();
    stats.add_counts(&counts);
    is_drawn
}

/// Draws the opaque triangles, which come first in the tile's list. If there are too many ties, draws
/// them again in the order of their keys.
fn cover_opaque(frame: &FrameView<'_>, area: &TileArea, state: &mut TileState, opaque: usize) -> Counts {
    let TileState { triangles, buffer, ties, key_order, front_to_back, reordered, .. } = state;
    let is_sorted = front_to_back.sort(frame, area, &mut triangles[..opaque], reordered);
    let triangles = &triangles[..opaque];
    // Ties of one triangle are mostly with the same other one.
    let last = Cell::new(([NO_TRIANGLE; 2], false));
    let precedes = |ours: u32, theirs: u32| {
        let (pair, wins) = last.get();
        if pair == [ours, theirs] {
            return wins;
        }
        ties.spend(COMPARISON);
        let wins = frame.precedes(triangles[ours as usize], triangles[theirs as usize]);
        last.set(([ours, theirs], wins));
        wins
    };
    let in_order = frame.plan.ordinals_are_keys && !is_sorted;
    let rasterizer = TileRasterizer { in_order, ..TileRasterizer::new(frame, area, ties, &precedes) };
    let mut counts = Counts::default();
    let nearest = front_to_back.nearest();
    if (TilePass { frame, rasterizer, triangles, nearest, buffer, counts: &mut counts }).cover_all(0) {
        return counts;
    }
    key_order.sort(frame, triangles);
    reordered.clear();
    reordered.extend(key_order.of(triangles));
    buffer.clear(area, rasterizer.offsets.len());
    counts = Counts { tiles_reordered: 1, ..Counts::default() };
    let rasterizer = TileRasterizer { in_order: true, by_draws: false, ..rasterizer };
    TilePass { frame, rasterizer, triangles: reordered, nearest: &[], buffer, counts: &mut counts }
        .cover_all(0);
    buffer.write_back();
    key_order.name_visible(buffer);
    counts
}

/// Triangles that are drawn into a tile, without masks.
struct TilePass<'p> {
    frame: &'p FrameView<'p>,
    rasterizer: TileRasterizer<'p>,
    triangles: &'p [TriangleRef],
    /// See [`FrontToBack::nearest`](super::front_to_back::FrontToBack::nearest).
    nearest: &'p [f32],
    buffer: &'p mut VisibilityBuffer,
    counts: &'p mut Counts,
}

impl TilePass<'_> {
    /// Draws triangles from index `first` on. Returns false if there are too many ties.
    fn cover_all(self, first: usize) -> bool {
        at_level!(self.frame.token, simd => match self.frame.grid.pattern.count() {
            1 => cover_triangles::<_, false>(simd, self, first),
            _ => cover_triangles::<_, true>(simd, self, first),
        })
    }
}

#[inline(always)]
fn cover_triangles<S: Simd, const MULTI: bool>(simd: S, mut pass: TilePass<'_>, first: usize) -> bool {
    let TilePass { frame, triangles, .. } = pass;
    // A local copy, which may stay in registers.
    let rasterizer = &{ pass.rasterizer };
    let mut origins = EdgeOrigins::new(rasterizer.offsets);
    let mut covered = Covered::new();
    let mut edges = QuadEdges::new(frame.grid.pattern);
    let mut start = first;
    while start < triangles.len() {
        if let Some(&nearest) = pass.nearest.get(start)
            && rasterizer.tile_hides_all(simd, pass.buffer, nearest)
        {
            pass.counts.tiles_rejected += (triangles.len() - start) as u64;
            return true;
        }
        let points = points_side_by_side(frame, &triangles[start..]);
        if points > 0 {
            cover_points::<S, MULTI>(simd, &mut pass, start..start + points);
            start += points;
            if !rasterizer.in_order && rasterizer.may_give_up && rasterizer.ties.are_many() {
                return false;
            }
            continue;
        }
        let together = side_by_side(frame, rasterizer, &triangles[start..]);
        let mut eight = (together > 0).then(|| prepare_batch(simd, &pass, start..start + together));
        let mut end = start + together.max(1);
        if eight.is_none() && cover_quad::<S, MULTI>(simd, &mut pass, &mut edges, start) {
            // Both of its triangles.
            end += 1;
        } else if !MULTI && let Some(eight) = eight.as_ref().filter(|eight| eight.micro) {
            rasterizer.micro(simd, eight, &mut covered, pass.buffer, pass.counts);
        } else {
            if let Some(eight) = &mut eight {
                origins.find::<S, MULTI>(simd, rasterizer, eight);
                if !MULTI {
                    eight.slivers = Slivers::find(simd, eight);
                }
            }
            for lane in 0..end - start {
                if eight.as_ref().is_some_and(|eight| eight.slivers.contain(lane)) {
                    continue;
                }
                let ready =
                    eight.as_ref().map(|eight| PreparedTriangle { eight, origins: &mut origins, lane });
                cover_one::<S, MULTI>(simd, &mut pass, ready, start + lane);
            }
            if let Some(eight) = eight.as_ref().filter(|eight| !eight.slivers.is_empty()) {
                rasterizer.slivers(simd, eight, &mut covered, pass.buffer, pass.counts);
            }
        }
        if !rasterizer.in_order && rasterizer.may_give_up && rasterizer.ties.are_many() {
            return false;
        }
        start = end;
    }
    true
}

/// How many of the next are points of one draw that are drawn from their vertices: up to eight.
#[inline(always)]
fn points_side_by_side(frame: &FrameView<'_>, triangles: &[TriangleRef]) -> usize {
    let first = triangles[0];
    if !first.is_point() {
        return 0;
    }
    let draw = &frame.plan.draws[frame.draw_of(first)].ordinals;
    let belongs = |triangle: &TriangleRef| triangle.is_point() && draw.contains(&triangle.ordinal);
    triangles.iter().take(LANES).take_while(|triangle| belongs(triangle)).count()
}

/// Draws up to eight points of one draw from their vertices.
#[inline(always)]
fn cover_points<S: Simd, const MULTI: bool>(simd: S, pass: &mut TilePass<'_>, range: Range<usize>) {
    let TilePass { frame, rasterizer, triangles, buffer, counts, .. } = pass;
    // A separate function, so that it takes no registers from the kernels of triangles.
    simd.vectorize(
        #[inline(always)]
        || {
            let (pattern, points) = (frame.grid.pattern, &triangles[range.clone()]);
            if let Some(eight) = EightPoints::new(simd, frame, &rasterizer.area, pattern, points) {
                rasterizer.points::<S, MULTI>(simd, &eight, range.start as u32, buffer, counts);
            }
        },
    );
}

/// Draws a line or a point if this is its first triangle. Returns false if it is not, or if the line
/// or point has to be drawn as two triangles.
#[inline(always)]
fn cover_quad<S: Simd, const MULTI: bool>(
    simd: S,
    pass: &mut TilePass<'_>,
    edges: &mut QuadEdges,
    index: usize,
) -> bool {
    let triangle = pass.triangles[index];
    let first = triangle.is_first_half().then(|| pass.frame.chunk_of(triangle));
    let Some(quad) = first.and_then(|chunk| chunk.quad(triangle)) else { return false };
    let quad = IndexedQuad { quad, index: index as u32 };
    pass.rasterizer.quad::<S, MULTI>(simd, quad, edges, pass.buffer, pass.counts)
}

/// Draws one triangle, possibly one of eight that are prepared. A prepared triangle that
/// [`EightTriangles::is_tiny`] goes through `tiny`, which with several samples per pixel uses
/// `multisample`; all others go through the general kernel.
#[inline(always)]
fn cover_one<S: Simd, const MULTI: bool>(
    simd: S,
    pass: &mut TilePass<'_>,
    ready: Option<PreparedTriangle<'_>>,
    index: usize,
) {
    let TilePass { frame, rasterizer, triangles, buffer, counts, .. } = pass;
    let covering = match ready.filter(|ready| ready.eight.small >> ready.lane & 1 != 0) {
        None => {
            let triangle = frame.triangle(triangles[index]);
            if rasterizer.tile_hides(buffer, triangle.nearest()) {
                counts.tiles_rejected += 1;
                return;
            }
            covering_apart(frame, &rasterizer.area, &triangle)
        }
        Some(prepared) => {
            let PreparedTriangle { eight, lane, .. } = prepared;
            if eight.is_tiny(lane) {
                return rasterizer.tiny::<S, MULTI>(simd, prepared, index as u32, buffer, counts);
            }
            if rasterizer.tile_hides(buffer, eight.high[lane]) {
                counts.tiles_rejected += 1;
                return;
            }
            eight.covering(lane, rasterizer.offsets)
        }
    };
    if let Some(covering) = covering {
        rasterizer.triangle::<S, MULTI>(simd, &covering, index as u32, buffer, counts);
    }
}

/// How many of the next triangles, up to eight, can be prepared together: uncut ones, of one
/// draw if triangles are in the order of draws. Triangles that are drawn again in the order of their
/// keys may belong to several draws.
#[inline(always)]
fn side_by_side(frame: &FrameView<'_>, rasterizer: &TileRasterizer<'_>, triangles: &[TriangleRef]) -> usize {
    let first = triangles[0];
    if !first.is_whole() {
        return 0;
    }
    let end =
        if rasterizer.by_draws { frame.plan.draws[frame.draw_of(first)].ordinals.end } else { u32::MAX };
    let belongs = |triangle: &TriangleRef| triangle.is_whole() && triangle.ordinal < end;
    triangles.iter().take(LANES).take_while(|triangle| belongs(triangle)).count()
}

/// Prepares up to eight whole primitives; unused lanes repeat the first.
#[inline(always)]
fn prepare_batch<S: Simd>(simd: S, pass: &TilePass<'_>, range: Range<usize>) -> EightTriangles {
    let (frame, area, index) = (pass.frame, &pass.rasterizer.area, range.start as u32);
    let (pattern, triangles) = (frame.grid.pattern, &pass.triangles[range]);
    // Each branch is a separate function, so that it is compiled once.
    if pass.rasterizer.by_draws {
        simd.vectorize(
            #[inline(always)]
            || {
                let corners = corners_of_one(frame, triangles);
                EightTriangles::new(simd, area, pattern, corners, triangles.len(), index)
            },
        )
    } else {
        simd.vectorize(
            #[inline(always)]
            || {
                let corners = corners_of_several(frame, triangles);
                EightTriangles::new(simd, area, pattern, corners, triangles.len(), index)
            },
        )
    }
}
