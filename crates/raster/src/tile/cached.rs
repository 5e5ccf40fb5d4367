//! What the still triangles of a tile show, cached from frame to frame: where the same vertices move again and again, as
//! in a drag, only the moving triangles are drawn over it.
//!
//! The nearest triangle is visible in whatever order they are drawn, so the result is that of all triangles. What is
//! kept counts only the triangles that are visible somewhere, so the tile's list is short.

use super::TileState;
use super::state::{Listing, Surfaces};
use super::visibility::{cover_more, cover_overlay, resolve_visibility};
use crate::Stats;
use crate::bin::TriangleRef;
use crate::shade::Shading;
use crate::simd::{LANES, U32, at_level, prelude::*};
use crate::tile_buffer::{BlockBounds, NO_TRIANGLE, TileArea};
use crate::view::FrameView;
use std::ops::Range;

/// No triangle, as it is cached.
const NONE: u16 = u16::MAX;

/// What the still triangles of a tile show. It has one sample to a pixel.
pub(crate) struct CachedTile {
    /// Those that are visible: opaque ones, then overlays.
    triangles: Vec<TriangleRef>,
    /// What opaque triangles show.
    opaque: CachedLayer,
    /// Where overlays are visible; empty if there are none.
    overlay: CachedLayer,
    /// Bounds of the depths of opaque triangles.
    bounds: BlockBounds,
}

/// The visible triangle of each sample, by its number among the cached triangles, and its depth.
#[derive(Default)]
struct CachedLayer {
    depth: Vec<f32>,
    visible: Vec<u16>,
}

/// The triangles that are drawn over what is cached: ranges of the tile's list.
pub(crate) struct MovingRanges {
    pub(crate) surfaces: Surfaces,
    /// How many still ones come before them.
    still: usize,
}

impl CachedTile {
    /// Finds what the still triangles of a tile show; `None` if a tile cannot be cached, because some
    /// are masked or translucent.
    pub(crate) fn find(
        frame: &FrameView<'_>,
        area: &TileArea,
        tile: u32,
        state: &mut TileState,
        shading: &mut Shading,
        stats: &mut Stats,
    ) -> Option<Self> {
        let surfaces = state.list(frame, tile, Listing::Still);
        if !surfaces.masked.is_empty() || !surfaces.translucent.is_empty() {
            return None;
        }
        state.begin(frame, tile);
        resolve_visibility(frame, area, state, &surfaces, shading, stats);
        let mut names = TriangleNumbers::new(state.triangles.len());
        let mut opaque = CachedLayer::of(state, &mut names, |_| true);
        let bounds = state.buffer.blocks;
        let mut overlay = CachedLayer::default();
        if !surfaces.overlay.is_empty() {
            cover_overlay(frame, area, state, &surfaces, stats);
            overlay = CachedLayer::of(state, &mut names, |index| surfaces.overlay.contains(&index));
        }
        let triangles = names.sorted(&mut [&mut opaque, &mut overlay], &state.triangles);
        Some(Self { triangles, opaque, overlay, bounds })
    }
}

impl CachedTile {
    /// The cached triangles, in the order of the frame's primitives.
    pub(crate) fn triangles(&self) -> &[TriangleRef] {
        &self.triangles
    }

    /// The lanes of each group of eight pixels that show triangles for which a test holds.
    pub(crate) fn lanes_of(&self, is_one: impl Fn(TriangleRef) -> bool, lanes: &mut [u8]) {
        let is_found: Vec<bool> = self.triangles.iter().map(|&triangle| is_one(triangle)).collect();
        let show = |name: u16| is_found.get(usize::from(name)).copied().unwrap_or(false);
        for (at, &opaque) in self.opaque.visible.iter().enumerate() {
            let overlay = self.overlay.visible.get(at).copied().unwrap_or(NONE);
            let is_shown = show(if overlay == NONE { opaque } else { overlay });
            lanes[at / LANES] |= u8::from(is_shown) << (at % LANES);
        }
    }

    /// Puts the cached samples into a tile, and lists the moving triangles.
    pub(crate) fn restore(
        &self,
        frame: &FrameView<'_>,
        area: &TileArea,
        tile: u32,
        state: &mut TileState,
    ) -> MovingRanges {
        let TileState { triangles, buffer, ties, .. } = state;
        triangles.clear();
        triangles.extend_from_slice(&self.triangles);
        let surfaces = Surfaces::list(frame, tile, Listing::Moving, triangles);
        buffer.restore(area, &self.opaque.depth, self.opaque.triangles(), &self.bounds);
        ties.reset(triangles.len());
        MovingRanges { surfaces, still: self.triangles.len() }
    }

    /// Lays the still overlays over it, where moving triangles have not come to hide them.
    pub(crate) fn lay_overlays(&self, frame: &FrameView<'_>, state: &mut TileState) {
        let TileState { triangles, buffer, .. } = state;
        let overlay = self.overlay.depth.iter().zip(self.overlay.triangles());
        for (at, (&depth, index)) in overlay.enumerate().filter(|(_, (_, index))| *index != NO_TRIANGLE) {
            let (there, visible) = (buffer.depth[at], buffer.visible[at]);
            let precedes = || {
                let [ours, theirs] = [index, visible].map(|index| triangles[index as usize]);
                frame.precedes(ours, theirs)
            };
            if depth > there || depth == there && precedes() {
                (buffer.depth[at], buffer.visible[at]) = (depth, index);
            }
        }
        if !self.overlay.depth.is_empty() {
            buffer.forget_nearest();
        }
    }
}

impl MovingRanges {
    /// Draws moving triangles of one kind, opaque ones or overlays, over what is there; `None` if there are too
    /// many ties.
    pub(crate) fn cover(
        frame: &FrameView<'_>,
        area: &TileArea,
        state: &mut TileState,
        part: &Range<usize>,
        stats: &mut Stats,
    ) -> Option<()> {
        let may_give_up = true;
        let is_drawn = cover_more(frame, area, state, part.clone(), may_give_up, stats);
        state.buffer.blank_outside(area);
        is_drawn.then_some(())
    }

    /// The lanes of each group of eight pixels that show moving triangles, while the tile's list is as it was
    /// [restored](CachedTile::restore).
    pub(crate) fn lanes(&self, frame: &FrameView<'_>, state: &TileState, lanes: &mut [u8]) {
        let groups = state.buffer.visible().as_chunks::<LANES>().0;
        at_level!(frame.token, simd => {
            let still = U32::splat(simd, self.still as u32);
            for (lanes, group) in lanes.iter_mut().zip(groups) {
                // NO_TRIANGLE becomes the least number.
                let numbers = U32::simd_from(simd, *group) + 1;
                *lanes = numbers.simd_gt(still).to_bitmask() as u8;
            }
        });
    }

    /// The indices of the still triangles in the tile's list after it was sorted.
    pub(crate) fn still_indices<'s>(&self, state: &'s TileState) -> &'s [u32] {
        &state.ranks[..self.still]
    }

    /// Brings the tile's list into the order of the frame's draws, which shading requires. Triangles of a draw may have
    /// any order.
    pub(crate) fn sort(&self, frame: &FrameView<'_>, state: &mut TileState) {
        let TileState { triangles, buffer, reordered, ranks, .. } = state;
        ranks.clear();
        ranks.extend(0..triangles.len() as u32);
        // Both parts of the list are in order.
        let ends = [self.still, triangles.len()];
        let last_draw = |&end: &usize| triangles[..end].last().map_or(0, |last| frame.draw_of(*last));
        if ends.iter().all(|end| last_draw(end) == 0) {
            return;
        }
        reordered.clear();
        let mut parts = [0..ends[0], ends[0]..ends[1]];
        while let Some(draw) =
            parts.iter().filter_map(|part| Some(frame.draw_of(*triangles[part.clone()].first()?))).min()
        {
            let end = frame.plan.draws[draw].ordinals.end;
            for part in &mut parts {
                let count = triangles[part.clone()].partition_point(|triangle| triangle.ordinal < end);
                let run = part.start..part.start + count;
                ranks[run.clone()]
                    .iter_mut()
                    .zip(reordered.len() as u32..)
                    .for_each(|(own, rank)| *own = rank);
                reordered.extend_from_slice(&triangles[run.clone()]);
                part.start = run.end;
            }
        }
        std::mem::swap(triangles, reordered);
        for visible in buffer.visible_mut() {
            *visible = ranks.get(*visible as usize).copied().unwrap_or(NO_TRIANGLE);
        }
    }
}

impl CachedLayer {
    /// What the triangles show for which a test of their indices in the tile's list holds. Their numbers are appended to `names`.
    fn of(state: &TileState, names: &mut TriangleNumbers, is_one: impl Fn(usize) -> bool) -> Self {
        let buffer = &state.buffer;
        let name = |&index: &u32| match index {
            NO_TRIANGLE => NONE,
            index if is_one(index as usize) => names.of(index),
            _ => NONE,
        };
        let visible = buffer.visible().iter().map(name).collect();
        Self { depth: buffer.depth[..buffer.span()].to_vec(), visible }
    }

    /// The indices of the visible triangles in the tile's list.
    fn triangles(&self) -> impl Iterator<Item = u32> {
        self.visible.iter().map(|&name| if name == NONE { NO_TRIANGLE } else { u32::from(name) })
    }
}

/// Numbers the visible ones of a tile's triangles.
struct TriangleNumbers {
    /// The number of each triangle, if it has one.
    numbers: Vec<u16>,
    /// Those that have one.
    numbered: Vec<u32>,
}

impl TriangleNumbers {
    fn new(count: usize) -> Self {
        Self { numbers: vec![NONE; count], numbered: Vec::new() }
    }

    fn of(&mut self, index: u32) -> u16 {
        let number = &mut self.numbers[index as usize];
        if *number == NONE {
            // Two layers have fewer samples than there are numbers.
            *number = self.numbered.len() as u16;
            self.numbered.push(index);
        }
        *number
    }

    /// The triangles that have numbers, in their order. Layers get their numbers in it.
    fn sorted(self, layers: &mut [&mut CachedLayer], triangles: &[TriangleRef]) -> Vec<TriangleRef> {
        let mut order: Vec<u32> = self.numbered.clone();
        order.sort_unstable();
        let mut ranks = self.numbers;
        (0..).zip(&order).for_each(|(rank, &index)| ranks[index as usize] = rank);
        for name in layers.iter_mut().flat_map(|layer| &mut layer.visible).filter(|name| **name != NONE) {
            *name = ranks[self.numbered[usize::from(*name)] as usize];
        }
        order.into_iter().map(|index| triangles[index as usize]).collect()
    }
}
