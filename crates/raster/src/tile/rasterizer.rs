//! The general kernel: one triangle of any size in one tile.
//!
//! The triangle's bounding box is processed in blocks of 8×8 pixels. A block is skipped if it lies
//! outside an edge or if its farthest depth hides the triangle. If it lies inside all edges, only
//! depths are tested, and not even these if the triangle lies in front of everything in the block.
//! Otherwise its groups of 4×2 pixels are tested, one pixel in each lane: lanes 0 to 3 are the upper
//! row, lanes 4 to 7 the lower one.
//!
//! Three cases differ. A triangle of one depth that covers the whole tile, in front of everything
//! there, is only noted ([`VisibilityBuffer::fill_with`]). For a box of at most 8 pixels each way,
//! blocks are not tested against edges. Triangles with [`Special`](super::triangle::Special) coverage
//! are decided lane by lane in i64.
//!
//! `TileRasterizer::visible_lanes` is **the depth test**: a covered sample shows the triangle if
//! its depth is greater (nearer) than the stored one, or equal and the triangle has the smaller
//! key ([`FrameView::precedes`](crate::view::FrameView::precedes)). The kernels `tiny` and
//! `multisample`, the list of `covered` pixels and the queries of `depth_query` repeat it in the form that suits them.

use super::sides::{ALL, Sides, steps};
use super::state::Ties;
use super::triangle::TileTriangle;
use crate::simd::{F32, I32, InlineMap, LANES, Mask, Simd, lane_numbers, prelude::*};
use crate::stats::Counts;
use crate::tile_buffer::{BLOCKS, NO_TRIANGLE, TileArea, VisibilityBuffer, store, store_where};
use crate::view::FrameView;

/// What all triangles of a tile have in common, for all coverage kernels.
#[derive(Clone, Copy)]
pub(crate) struct TileRasterizer<'f> {
    pub(crate) area: TileArea,
    pub(crate) offsets: &'f [[i32; 2]],
    /// Whether triangles come in the order of their keys, so that a later one is never visible at
    /// equal depth. Otherwise `precedes` decides, as long as `ties` are not too many.
    pub(crate) in_order: bool,
    /// Whether the triangles of a draw come one after the other.
    pub(crate) by_draws: bool,
    pub(crate) ties: &'f Ties,
    /// Whether the tile is drawn again in the order of keys if there are too many ties.
    pub(crate) may_give_up: bool,
    /// Whether bounds of depths are tested before samples.
    pub(crate) hierarchical: bool,
    /// Whether the first triangle is visible and not the second at equal depth, by their indices among
    /// the tile's triangles.
    pub(crate) precedes: &'f dyn Fn(u32, u32) -> bool,
}

/// A triangle at a sample of each pixel of a group.
#[derive(Clone, Copy)]
pub(super) struct GroupSamples<S: Simd> {
    pub(super) index: u32,
    /// The lanes whose samples the triangle covers.
    pub(super) covered: Mask<S>,
    pub(super) depth: F32<S>,
}

/// A triangle that is being drawn, with what its blocks and groups have in common.
struct TriangleWalk<'c, S: Simd> {
    covering: &'c TileTriangle,
    /// The edge functions at the pixels of the tile's first group: at their samples if they have one, else less the
    /// `starts` of each sample.
    lanes: [I32<S>; 3],
    /// What leads from a block's first pixel to the first ones of its groups.
    groups: [I32<S>; 3],
    /// `None` if blocks and groups are not tested against edges.
    sides: Option<&'c Sides<S>>,
    index: u32,
}

impl<'c, S: Simd> TriangleWalk<'c, S> {
    #[inline(always)]
    fn new<const MULTI: bool>(
        simd: S,
        covering: &'c TileTriangle,
        sides: Option<&'c Sides<S>>,
        index: u32,
    ) -> Self {
        let TileTriangle { right, down, starts, .. } = covering;
        let (x, y) = (lane_numbers(simd) & 3, lane_numbers(simd) >> 2);
        let (column, row) = (lane_numbers(simd) & 1, lane_numbers(simd) >> 1);
        let lanes = [0, 1, 2].each(
            #[inline(always)]
            |k| {
                let lanes = x * right[k] + y * down[k];
                if MULTI { lanes } else { lanes + starts[0][k] }
            },
        );
        let groups = [0, 1, 2].each(
            #[inline(always)]
            |k| column * right[k].wrapping_mul(4) + row * down[k].wrapping_mul(2),
        );
        Self { covering, lanes, groups, sides, index }
    }

    /// What leads from the tile's first pixel to the first ones of a block's groups.
    ///
    /// Products and sums may wrap around. What is compared in the end does not: where an edge crosses the tile, its
    /// values in the tile fit 32 bits, and additions that wrap give the right sum if that fits.
    #[inline(always)]
    fn groups_of(&self, block: [i32; 2]) -> [I32<S>; 3] {
        let TileTriangle { right, down, .. } = self.covering;
        [0, 1, 2].each(
            #[inline(always)]
            |k| self.groups[k] + steps([right[k], down[k]], block),
        )
    }

    /// The same as [`lanes`](Self::lanes) for another group, from what leads to its first pixel.
    #[inline(always)]
    fn edges_at(&self, first: [i32; 3]) -> [I32<S>; 3] {
        [0, 1, 2].each(
            #[inline(always)]
            |k| self.lanes[k] + first[k],
        )
    }

    /// The pixels that lie inside all edges at a sample with these `starts`.
    #[inline(always)]
    fn inside(&self, simd: S, edges: [I32<S>; 3], starts: [i32; 3]) -> Mask<S> {
        // The sign bit of the combined value is set if any of the three is negative.
        let [a, b, c] = [edges[0] + starts[0], edges[1] + starts[1], edges[2] + starts[2]];
        (a | b | c).simd_ge(I32::splat(simd, 0))
    }

    /// Whether a sample of any of the pixels, which have several, may be covered.
    #[inline(always)]
    fn may_cover(&self, simd: S, edges: [I32<S>; 3]) -> bool {
        let TileTriangle { range: [_, greatest], special, .. } = self.covering;
        special.is_some() || self.inside(simd, edges, *greatest).any_true()
    }
}

impl<'f> TileRasterizer<'f> {
    /// For triangles in the order of draws. They may give up.
    pub(super) fn new(
        frame: &'f FrameView<'_>,
        area: &TileArea,
        ties: &'f Ties,
        precedes: &'f dyn Fn(u32, u32) -> bool,
    ) -> Self {
        Self {
            area: *area,
            offsets: frame.grid.pattern.offsets(),
            in_order: false,
            by_draws: true,
            ties,
            may_give_up: true,
            hierarchical: frame.hierarchical,
            precedes,
        }
    }
}

impl TileRasterizer<'_> {
    /// Whether samples that are all at `farthest` or nearer hide a triangle at `depth`: a greater depth
    /// is nearer.
    #[inline(always)]
    pub(super) fn hides(&self, farthest: f32, depth: f32) -> bool {
        if self.in_order { depth <= farthest } else { depth < farthest }
    }

    /// Whether all samples of the tile hide a triangle whose nearest depth is `depth`.
    #[inline(always)]
    pub(crate) fn tile_hides(&self, buffer: &mut VisibilityBuffer, depth: f32) -> bool {
        self.hierarchical && self.hides(buffer.farthest_of_all(&self.area), depth)
    }

    /// The same, with bounds as near as they have to be to decide it.
    #[inline(always)]
    pub(super) fn tile_hides_all<S: Simd>(&self, simd: S, buffer: &mut VisibilityBuffer, depth: f32) -> bool {
        // A separate function: few tiles need it.
        simd.vectorize(
            #[inline(always)]
            || loop {
                if self.tile_hides(buffer, depth) {
                    return true;
                }
                if !buffer.refresh_farthest(simd) {
                    return false;
                }
            },
        )
    }

    /// Draws a triangle that the tile does not hide as a whole.
    #[inline(always)]
    pub(crate) fn triangle<S: Simd, const MULTI: bool>(
        &self,
        simd: S,
        covering: &TileTriangle,
        index: u32,
        buffer: &mut VisibilityBuffer,
        counts: &mut Counts,
    ) {
        if self.fills_tile(covering, buffer) {
            counts.tiles_filled += 1;
            buffer.fill_with(covering.depth.low, index);
            return;
        }
        buffer.write_back();
        let [columns, rows] = [covering.columns, covering.rows];
        // For a box of at most 8 pixels each way, testing blocks against edges costs more than it saves.
        let is_small = columns[1] - columns[0] < 8 && rows[1] - rows[0] < 8;
        let made;
        let sides = if is_small || covering.special.is_some() {
            None
        } else {
            made = Sides::new(simd, covering);
            Some(&made)
        };
        let walk = TriangleWalk::new::<MULTI>(simd, covering, sides, index);
        let requested = ALL << (columns[0] >> 3) & ALL >> (7 - (columns[1] >> 3));
        for block_y in rows[0] >> 3..(rows[1] >> 3) + 1 {
            let [outside, inside] = match walk.sides {
                Some(sides) => sides.blocks(simd, covering, block_y * 8),
                None => [0, 0],
            };
            counts.blocks_rejected += u64::from((requested & outside).count_ones());
            let mut rest = requested & !outside;
            while rest != 0 {
                let block_x = rest.trailing_zeros() as i32;
                rest &= rest - 1;
                let [left, top] = [block_x * 8, block_y * 8];
                let block = (block_y as usize) * BLOCKS + block_x as usize;
                let is_hidden = self.hierarchical
                    && match is_small {
                        true => self.hides(buffer.blocks.farthest[block], covering.depth.high),
                        false => self.block_hides(simd, covering, buffer, block, [left, top]),
                    };
                if is_hidden {
                    counts.blocks_rejected += 1;
                } else if inside >> block_x & 1 != 0 {
                    counts.blocks_accepted += 1;
                    self.whole_block::<S, MULTI>(simd, &walk, buffer, block, [left, top]);
                } else {
                    counts.groups += self.part_of_block::<S, MULTI>(simd, &walk, buffer, block, [left, top]);
                }
            }
        }
    }

    /// Whether a triangle of one depth covers the whole tile and lies in front of all of it. Then
    /// nothing has to be written: the buffer notes that all samples hold it.
    #[inline(always)]
    fn fills_tile(&self, covering: &TileTriangle, buffer: &VisibilityBuffer) -> bool {
        let constant = covering.depth.low == covering.depth.high;
        let nearer = buffer.nearest().is_some_and(|nearest| covering.depth.low > nearest);
        self.hierarchical
            && constant
            && nearer
            && covering.special.is_none()
            && covering.right == [0; 3]
            && covering.down == [0; 3]
            && covering.columns == [0, self.area.padded()[0] as i32 - 1]
            && covering.rows == [0, self.area.padded()[1] as i32 - 1]
    }

    /// Whether the samples of a block hide all of the triangle.
    #[inline(always)]
    fn block_hides<S: Simd>(
        &self,
        simd: S,
        covering: &TileTriangle,
        buffer: &mut VisibilityBuffer,
        block: usize,
        corner: [i32; 2],
    ) -> bool {
        let farthest = buffer.farthest_in(simd, block);
        if self.hides(farthest, covering.depth.high) {
            return true;
        }
        // No depth of the triangle is farther than the block: its depths here cannot decide.
        if farthest <= covering.depth.low {
            return false;
        }
        let [_, nearest] = self.depths_in_block(covering, corner);
        self.hides(farthest, nearest)
    }

    /// Bounds of the triangle's depths in a block.
    #[inline(always)]
    fn depths_in_block(&self, covering: &TileTriangle, corner: [i32; 2]) -> [f32; 2] {
        let low = [0, 1].each(
            #[inline(always)]
            |axis| (self.area.origin[axis] + corner[axis]) * 256,
        );
        covering.depth.bounds(
            low,
            low.each(
                #[inline(always)]
                |v| v + 8 * 256,
            ),
        )
    }

    /// Draws the triangle in a block that it covers completely.
    #[inline(always)]
    fn whole_block<S: Simd, const MULTI: bool>(
        &self,
        simd: S,
        walk: &TriangleWalk<'_, S>,
        buffer: &mut VisibilityBuffer,
        block: usize,
        corner: [i32; 2],
    ) {
        let [least, greatest] = self.depths_in_block(walk.covering, corner);
        // If the triangle's farthest depth in the block is in front of the block's nearest, no
        // depth has to be compared.
        let overwrites = self.hierarchical && least > buffer.blocks.nearest[block];
        for group in 0..8 {
            let first = [corner[0] + (group & 1) * 4, corner[1] + (group >> 1) * 2];
            let samples = if MULTI { buffer.samples } else { 1 };
            for sample in 0..samples {
                let depth = self.depth(simd, walk, first, sample);
                let at = ((block * 8 + group as usize) * samples + sample) * LANES;
                if overwrites {
                    store(simd, walk.index, depth, buffer, at);
                } else {
                    let covered = Mask::splat(simd, true);
                    let tested = GroupSamples { index: walk.index, covered, depth };
                    self.test_and_store(simd, tested, buffer, at);
                }
            }
        }
        buffer.note_write(block, greatest);
        buffer.note_cover(block, least);
    }

    /// Draws the triangle in the groups of a block within its bounding box. Returns how many groups
    /// were tested.
    #[inline(always)]
    fn part_of_block<S: Simd, const MULTI: bool>(
        &self,
        simd: S,
        walk: &TriangleWalk<'_, S>,
        buffer: &mut VisibilityBuffer,
        block: usize,
        [left, top]: [i32; 2],
    ) -> u64 {
        let clip = |[first, last]: [i32; 2], start: i32, shift: i32| {
            [(first.max(start) - start) >> shift, (last.min(start + 7) - start) >> shift]
        };
        let [rows, columns] = [clip(walk.covering.rows, top, 1), clip(walk.covering.columns, left, 2)];
        // Two groups in a row.
        let in_rows = ALL << (2 * rows[0]) & ALL >> (6 - 2 * rows[1]);
        let in_columns = [0x55, ALL, 0, 0xaa][(columns[0] * 2 + columns[1]) as usize % 4];
        let mut rest = in_rows & in_columns;
        let firsts = walk.groups_of([left, top]);
        if let Some(sides) = walk.sides {
            rest &= sides.groups(simd, firsts);
        }
        let firsts: [[i32; LANES]; 3] = firsts.each(Into::into);
        let looked_at = u64::from(rest.count_ones());
        let mut wrote = false;
        let samples = if MULTI { buffer.samples } else { 1 };
        while rest != 0 {
            let number = rest.trailing_zeros() as usize % LANES;
            rest &= rest - 1;
            let first = [left + (number as i32 & 1) * 4, top + (number as i32 >> 1) * 2];
            let edges = walk.edges_at([0, 1, 2].each(
                #[inline(always)]
                |k| firsts[k][number],
            ));
            if MULTI && !walk.may_cover(simd, edges) {
                continue;
            }
            let group = block * 8 + number;
            for sample in 0..samples {
                let covered = self.covered::<S, MULTI>(simd, walk, edges, first, sample);
                if !covered.any_true() {
                    continue;
                }
                let depth = self.depth(simd, walk, first, sample);
                let at = (group * samples + sample) * LANES;
                let tested = GroupSamples { index: walk.index, covered, depth };
                wrote |= self.test_and_store(simd, tested, buffer, at);
            }
        }
        if wrote {
            buffer.note_write(block, walk.covering.depth.high);
        }
        looked_at
    }

    /// Which pixels of a group the triangle covers at a sample.
    #[inline(always)]
    fn covered<S: Simd, const MULTI: bool>(
        &self,
        simd: S,
        walk: &TriangleWalk<'_, S>,
        edges: [I32<S>; 3],
        first: [i32; 2],
        sample: usize,
    ) -> Mask<S> {
        let starts = if MULTI { walk.covering.starts[sample] } else { [0; 3] };
        match &walk.covering.special {
            Some(special) => special.covers_group(simd, self.point(first, sample)),
            None => walk.inside(simd, edges, starts),
        }
    }

    #[inline(always)]
    fn depth<S: Simd>(&self, simd: S, walk: &TriangleWalk<'_, S>, first: [i32; 2], sample: usize) -> F32<S> {
        walk.covering.depth.group(simd, self.point(first, sample))
    }

    /// The point of a pixel's sample in 1/256 pixel.
    #[inline(always)]
    fn point(&self, pixel: [i32; 2], sample: usize) -> [i32; 2] {
        self.area.point(pixel, self.offsets[sample])
    }

    /// Stores the triangle in the covered lanes in which it is visible. Returns whether there are any.
    #[inline(always)]
    fn test_and_store<S: Simd>(
        &self,
        simd: S,
        samples: GroupSamples<S>,
        buffer: &mut VisibilityBuffer,
        at: usize,
    ) -> bool {
        let visible = self.visible_lanes(simd, samples, buffer, at);
        let any = visible.any_true();
        if any {
            store_where(simd, visible, samples.index, samples.depth, buffer, at);
        }
        any
    }

    /// The depth test: the covered lanes in which the triangle is visible.
    ///
    /// `tiny` and `multisample` (`rows`), `covered` (`scatter`) and `TileView::visible_lanes` repeat it.
    #[inline(always)]
    pub(super) fn visible_lanes<S: Simd>(
        &self,
        simd: S,
        GroupSamples { index, covered, depth }: GroupSamples<S>,
        buffer: &VisibilityBuffer,
        at: usize,
    ) -> Mask<S> {
        let there = F32::from_slice(simd, &buffer.depth[at..at + LANES]);
        let visible = covered & depth.simd_gt(there);
        if !self.in_order {
            let ties = covered & depth.simd_eq(there);
            if ties.any_true() {
                let won = self.preceded_ties(index, ties.to_bitmask(), &buffer.visible[at..at + LANES]);
                return visible | Mask::from_bitmask(simd, won);
            }
        }
        visible
    }

    /// Counts work spent on ties. Returns whether they are to be resolved: not if the tile has too
    /// many and is drawn again.
    #[inline(always)]
    pub(super) fn may_decide(&self, units: u32) -> bool {
        self.ties.spend(units) || !self.may_give_up
    }

    /// In which of the lanes of equal depth the new triangle has the smaller key.
    #[cold]
    fn preceded_ties(&self, index: u32, ties: u64, visible: &[u32]) -> u64 {
        if !self.may_decide(ties.count_ones()) {
            // The tile is drawn again.
            return 0;
        }
        let wins = |visible: u32| visible != NO_TRIANGLE && (self.precedes)(index, visible);
        visible
            .iter()
            .enumerate()
            .filter(|&(lane, &visible)| ties >> lane & 1 != 0 && wins(visible))
            .fold(0, |won, (lane, _)| won | 1 << lane)
    }
}
