//! A tile's visibility buffer: depth and visible triangle of each sample, with bounds of
//! the depths over blocks and over the whole tile. A greater depth is nearer.
//!
//! A triangle that covers a whole block updates the block's farthest depth at once. After other writes, all samples of
//! the block would have to be read. The general kernel reads them before it uses the bound. The kernels of small
//! triangles do so only after several writes, and only if something in the block is nearer than their triangle. The
//! other kernels use an outdated bound, which hides less and is never wrong.
//!
//! Kernels write eight lanes at a time: [`store`], [`store_where`], [`store_each_where`].

use super::area::{BLOCKS, GROUPS, TileArea};
use crate::simd::{F32, LANES, Mask, Simd, U32, blended, greater, lesser, prelude::*};

/// No triangle: the background.
pub(crate) const NO_TRIANGLE: u32 = u32::MAX;

/// The depth of the background: slightly below 0, the depth of the far plane, so that a
/// triangle in the far plane is visible.
pub(crate) const BEHIND_ALL: f32 = -f32::MIN_POSITIVE;

/// Bounds of the depths in each block, row by row. They may be wider than necessary, never
/// narrower.
#[derive(Clone, Copy)]
pub(crate) struct BlockBounds {
    pub(crate) farthest: [f32; BLOCKS * BLOCKS],
    pub(crate) nearest: [f32; BLOCKS * BLOCKS],
    /// How many writes were noted since `farthest` was found: `micro` and `sliver` note one for each pixel,
    /// `quad` and `points` for each group, the others for each triangle (`tiny` and `multisample`
    /// before they know whether any sample is written).
    pub(crate) writes: [u32; BLOCKS * BLOCKS],
}

impl BlockBounds {
    /// All samples at one depth.
    fn of(depth: f32) -> Self {
        Self { farthest: [depth; _], nearest: [depth; _], writes: [0; _] }
    }
}

/// Depth and visible triangle of each sample of a tile: group by group, sample by sample,
/// eight lanes.
pub(crate) struct VisibilityBuffer {
    pub(crate) depth: Vec<f32>,
    /// The index of the visible triangle among the tile's triangles, or [`NO_TRIANGLE`].
    pub(crate) visible: Vec<u32>,
    pub(crate) blocks: BlockBounds,
    /// No sample lies further away.
    pub(crate) farthest: f32,
    /// The block that this depth was found in. Depths of blocks only come nearer, so `farthest` stays as it is until that
    /// of this block is another one.
    farthest_block: usize,
    stale: bool,
    /// All samples hold this depth and triangle, but the arrays are not filled yet.
    fill: Option<(f32, u32)>,
    pub(crate) samples: usize,
    span: usize,
    /// Blocks in a row that the tile has a pixel of.
    columns: usize,
}

impl VisibilityBuffer {
    pub(crate) fn new() -> Self {
        Self {
            depth: Vec::new(),
            visible: Vec::new(),
            blocks: BlockBounds::of(0.0),
            farthest: 0.0,
            farthest_block: 0,
            stale: false,
            fill: None,
            samples: 1,
            span: 0,
            columns: 0,
        }
    }

    /// Empties it for a tile.
    pub(crate) fn clear(&mut self, area: &TileArea, samples: usize) {
        self.span = area.span();
        self.columns = area.padded()[0] / 8;
        self.samples = samples;
        let length = self.span * samples;
        if self.depth.len() < length {
            self.depth.resize(length, 0.0);
            self.visible.resize(length, NO_TRIANGLE);
        }
        self.fill_with(BEHIND_ALL, NO_TRIANGLE);
    }

    /// Takes the samples of a tile with one sample to a pixel, and bounds of their depths.
    pub(crate) fn restore(
        &mut self,
        area: &TileArea,
        depth: &[f32],
        visible: impl Iterator<Item = u32>,
        bounds: &BlockBounds,
    ) {
        self.clear(area, 1);
        self.fill = None;
        self.depth[..self.span].copy_from_slice(depth);
        self.visible.iter_mut().zip(visible).for_each(|(own, visible)| *own = visible);
        self.blocks = *bounds;
        self.stale = true;
    }

    /// Gives all samples one depth and triangle. Only a note is made; the arrays are filled when they
    /// are needed (`write_back`).
    pub(crate) fn fill_with(&mut self, depth: f32, visible: u32) {
        self.fill = Some((depth, visible));
        (self.farthest, self.farthest_block, self.stale) = (depth, 0, false);
    }

    /// The depth of all samples while a fill is pending.
    pub(crate) fn nearest(&self) -> Option<f32> {
        self.fill.map(|(depth, _)| depth)
    }

    /// Writes a pending fill to the arrays. Samples beside the tile's blocks get no triangle.
    #[inline(always)]
    pub(crate) fn write_back(&mut self) {
        // Called for each triangle, so this part is inlined.
        if let Some((depth, visible)) = self.fill.take() {
            self.write_back_fill(depth, visible);
        }
    }

    #[inline(never)]
    fn write_back_fill(&mut self, depth: f32, visible: u32) {
        let length = self.span * self.samples;
        self.depth[..length].fill(depth);
        let block = GROUPS * LANES * self.samples;
        for row in self.visible[..length].chunks_mut(BLOCKS * block) {
            let (within, beside) = row.split_at_mut(self.columns * block);
            within.fill(visible);
            beside.fill(NO_TRIANGLE);
        }
        self.blocks = BlockBounds::of(depth);
    }

    /// Notes that any sample may have been written, at any depth.
    pub(crate) fn forget_nearest(&mut self) {
        (self.blocks.nearest, self.blocks.writes) = ([f32::INFINITY; _], [1; _]);
    }

    /// Removes the triangles of samples outside the image.
    pub(crate) fn blank_outside(&mut self, area: &TileArea) {
        self.each_outside(area, |buffer, index| buffer.visible[index] = NO_TRIANGLE);
    }

    /// Brings samples outside the image before all others, so that they decide no farthest depth.
    pub(crate) fn bring_outside_near(&mut self, area: &TileArea) {
        self.each_outside(area, |buffer, index| buffer.depth[index] = f32::INFINITY);
        self.forget_nearest();
    }

    /// Does something to each sample outside the image, by its index in the arrays.
    fn each_outside(&mut self, area: &TileArea, change: impl Fn(&mut Self, usize)) {
        if area.size == area.padded() {
            return;
        }
        for pixel in (0..self.span).filter(|&pixel| !area.contains(TileArea::pixel_at(pixel))) {
            for sample in 0..self.samples {
                let index = self.index(pixel, sample);
                change(self, index);
            }
        }
    }

    /// The index in the arrays of a pixel's sample.
    #[inline(always)]
    pub(crate) fn index(&self, pixel: usize, sample: usize) -> usize {
        (pixel / LANES * self.samples + sample) * LANES + pixel % LANES
    }

    /// The visible triangles: group by group, sample by sample, eight lanes.
    pub(crate) fn visible(&self) -> &[u32] {
        &self.visible[..self.span * self.samples]
    }

    pub(crate) fn visible_mut(&mut self) -> &mut [u32] {
        &mut self.visible[..self.span * self.samples]
    }

    /// The number of samples at which a triangle is visible.
    pub(crate) fn visible_count(&self) -> usize {
        self.visible().iter().filter(|&&visible| visible != NO_TRIANGLE).count()
    }

    /// How many pixels the arrays hold.
    pub(crate) fn span(&self) -> usize {
        self.span
    }

    /// Notes that samples of a block were written, none nearer than `nearest`.
    #[inline(always)]
    pub(crate) fn note_write(&mut self, block: usize, nearest: f32) {
        let bounds = &mut self.blocks;
        bounds.writes[block] = bounds.writes[block].wrapping_add(1);
        let there = bounds.nearest[block];
        bounds.nearest[block] = if nearest > there { nearest } else { there };
    }

    /// The same for some blocks of a row.
    #[inline(always)]
    pub(crate) fn note_writes<S: Simd>(&mut self, simd: S, row: usize, blocks: Mask<S>, nearest: F32<S>) {
        let bits = blocks.select(U32::splat(simd, u32::MAX), U32::splat(simd, 0));
        let writes = &mut self.blocks.writes.as_chunks_mut().0[row];
        // One more where all bits are set.
        *writes = (U32::simd_from(simd, *writes) - bits).into();
        let bounds = &mut self.blocks.nearest.as_chunks_mut().0[row];
        let there = F32::simd_from(simd, *bounds);
        let nearer = greater(nearest, there).bitcast();
        *bounds = blended(bits, there.bitcast(), nearer).bitcast::<F32<S>>().into();
    }

    /// Notes that all samples of a block lie at least as near as `farthest`.
    #[inline(always)]
    pub(crate) fn note_cover(&mut self, block: usize, farthest: f32) {
        let there = &mut self.blocks.farthest[block];
        if farthest > *there {
            *there = farthest;
            self.stale |= block == self.farthest_block;
        }
    }

    /// The farthest depth of a block, recomputed if something was written since.
    #[inline(always)]
    pub(crate) fn farthest_in<S: Simd>(&mut self, simd: S, block: usize) -> f32 {
        if self.blocks.writes[block] > 0 {
            self.refresh(simd, block);
        }
        self.blocks.farthest[block]
    }

    /// Recomputes the farthest depth of the block that decides that of the tile. Returns whether it is nearer now.
    #[inline(always)]
    pub(crate) fn refresh_farthest<S: Simd>(&mut self, simd: S) -> bool {
        let may_be_nearer = self.fill.is_none() && self.blocks.writes[self.farthest_block] > 0;
        if may_be_nearer {
            self.refresh(simd, self.farthest_block);
        }
        may_be_nearer && self.stale
    }

    /// Recomputes the farthest depth of each block of a tile where that may help.
    #[inline(always)]
    pub(crate) fn refresh_all<S: Simd>(&mut self, simd: S, area: &TileArea) {
        let [columns, rows] = area.padded().map(|side| side / 8);
        for row in 0..rows {
            for block in row * BLOCKS..row * BLOCKS + columns {
                self.farthest_in(simd, block);
            }
        }
    }

    #[inline(always)]
    fn refresh<S: Simd>(&mut self, simd: S, block: usize) {
        let length = GROUPS * self.samples;
        let depths = &self.depth.as_chunks::<LANES>().0[block * length..(block + 1) * length];
        // Four independent chains, so that few comparisons wait for the one before.
        let mut least = [F32::splat(simd, f32::INFINITY); GROUPS / 2];
        for groups in depths.as_chunks::<{ GROUPS / 2 }>().0 {
            for (least, group) in least.iter_mut().zip(groups) {
                *least = lesser(F32::simd_from(simd, *group), *least);
            }
        }
        let [a, b, c, d] = least;
        let farthest = least_of(lesser(lesser(a, b), lesser(c, d)).into());
        self.stale |= block == self.farthest_block && farthest > self.blocks.farthest[block];
        (self.blocks.farthest[block], self.blocks.writes[block]) = (farthest, 0);
    }

    /// The farthest depth of the tile, recomputed from the blocks' if that of the farthest one
    /// has changed. Blocks outside the image count like all others.
    #[inline(always)]
    pub(crate) fn farthest_of_all(&mut self, area: &TileArea) -> f32 {
        if self.stale {
            self.stale = false;
            let [columns, rows] = area.size.map(|side| side.div_ceil(8));
            let blocks = (0..rows).flat_map(|row| (0..columns).map(move |column| row * BLOCKS + column));
            (self.farthest, self.farthest_block) = blocks.fold((f32::INFINITY, 0), |least, block| {
                let farthest = self.blocks.farthest[block];
                if farthest < least.0 { (farthest, block) } else { least }
            });
        }
        self.farthest
    }
}

/// The least of eight, in a tree of three levels of comparisons.
#[inline(always)]
fn least_of([a, b, c, d, e, f, g, h]: [f32; LANES]) -> f32 {
    let lesser = |a: f32, b: f32| if a < b { a } else { b };
    let [a, b, c, d] = [lesser(a, e), lesser(b, f), lesser(c, g), lesser(d, h)];
    lesser(lesser(a, c), lesser(b, d))
}

/// Writes one triangle to all lanes.
#[inline(always)]
pub(crate) fn store<S: Simd>(
    simd: S,
    triangle: u32,
    depth: F32<S>,
    buffer: &mut VisibilityBuffer,
    at: usize,
) {
    depth.store_slice(&mut buffer.depth[at..at + LANES]);
    U32::splat(simd, triangle).store_slice(&mut buffer.visible[at..at + LANES]);
}

/// Writes one triangle to some lanes.
#[inline(always)]
pub(crate) fn store_where<S: Simd>(
    simd: S,
    mask: Mask<S>,
    triangle: u32,
    depth: F32<S>,
    buffer: &mut VisibilityBuffer,
    at: usize,
) {
    store_each_where(simd, mask, U32::splat(simd, triangle), depth, buffer, at);
}

/// Writes some lanes, each with its own triangle.
#[inline(always)]
pub(crate) fn store_each_where<S: Simd>(
    simd: S,
    mask: Mask<S>,
    triangles: U32<S>,
    depth: F32<S>,
    buffer: &mut VisibilityBuffer,
    at: usize,
) {
    let bits = mask.select(U32::splat(simd, u32::MAX), U32::splat(simd, 0));
    let there = F32::from_slice(simd, &buffer.depth[at..at + LANES]);
    let depth: F32<S> = blended(bits, there.bitcast(), depth.bitcast()).bitcast();
    depth.store_slice(&mut buffer.depth[at..at + LANES]);
    let visible = buffer.visible[at..].first_chunk_mut().expect("groups are whole");
    *visible = blended(bits, U32::simd_from(simd, *visible), triangles).into();
}

/// Makes a triangle the visible one in some lanes, without writing its depth.
#[inline(always)]
pub(crate) fn name_where<S: Simd>(simd: S, mask: Mask<S>, triangle: u32, visible: &mut [u32; LANES]) {
    let bits = mask.select(U32::splat(simd, u32::MAX), U32::splat(simd, 0));
    *visible = blended(bits, U32::simd_from(simd, *visible), U32::splat(simd, triangle)).into();
}
