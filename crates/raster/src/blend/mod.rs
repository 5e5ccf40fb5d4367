//! Blends translucent fragments from back to front at each sample, in the order of (depth, object, face). Colours
//! are premultiplied by alpha.
//!
//! The order is total, so it depends neither on the order of draws nor on threads. Each sample keeps its farthest
//! layers, as many as it has room for. These layers are shaded and blended. Then the next layers in front of the
//! last one are collected, until none is left. This is depth peeling with k layers at a time, but from the back,
//! where a blended layer is final (L. Bavoil et al., "Multi-Fragment Effects on the GPU using the k-Buffer", 2007;
//! C. Everitt, "Interactive Order-Independent Transparency", 2001). Any number of layers is therefore exact in
//! bounded memory, and the result does not depend on the bound.
//!
//! With one sample per pixel the first round covers the whole tile. With more samples it covers as many blocks as have
//! room for eight layers of each sample. Blocks with more layers get further rounds: as many blocks at a time as their
//! layers have room, down to a single block.
//!
//! With several samples a fragment is shaded once for its triangle, pixel and round, like an opaque one. It is
//! blended over each sample that it covers and where nothing hides it. It stores no depth and no ids.

mod gather;
mod runs;

pub(crate) use gather::{SampleShare, leaves};

use crate::resolve::saturated;
use crate::shade::{JobList, Shading, shade_jobs};
use crate::simd::LANES;
use crate::tile::{Blocks, TileState, TileView};
use crate::tile_buffer::TileArea;
use crate::view::FrameView;
use gather::{JoinedTriangle, Joints};
use runs::{CAPACITY, DepthOrder, Fragments, Layer, Runs};
use std::ops::Range;
use trigon_math::Vec4;

/// So many layers of a sample have room in the first round.
const USUAL_DEPTH: usize = 8;

/// Pixels of a block.
const BLOCK: usize = 64;

/// What blending keeps from tile to tile.
#[derive(Default)]
pub(crate) struct Layers {
    runs: Runs,
    fragments: Fragments,
    colors: Vec<[f32; 4]>,
    /// Colours of samples, where something translucent is laid over them.
    samples: Vec<Vec4>,
    joints: Joints,
    /// The segments joined to the current one.
    beside: Vec<JoinedTriangle>,
    /// For each triangle, the blocks in which it may be visible.
    blocks: Vec<Blocks>,
    /// For each sample the last layer that was laid; of blocks that have had a
    /// round.
    last: Vec<Layer>,
}

/// What one round works on.
struct Round {
    blocks: Blocks,
    /// For each block of the tile where its samples begin among the round's.
    starts: [usize; BLOCK],
    /// Whether layers have been laid before.
    again: bool,
}

impl Round {
    fn new(blocks: Blocks, samples: usize, again: bool) -> Self {
        let mut starts = [0; BLOCK];
        for (number, block) in blocks.iter().enumerate() {
            starts[block] = number * BLOCK * samples;
        }
        Self { blocks, starts, again }
    }

    /// Where the first sample of a group of a block is among the round's.
    #[inline(always)]
    fn group(&self, group: usize, sample: usize, samples: usize) -> usize {
        self.starts[group / 8] + ((group % 8) * samples + sample) * LANES
    }
}

/// Lays the translucent triangles of a tile over its colours, after which all of its pixels have
/// one. Tells how many fragments were shaded.
pub(crate) fn blend_translucent(
    frame: &FrameView<'_>,
    area: &TileArea,
    state: &TileState,
    layers: &mut Layers,
    shading: &mut Shading,
    triangles: Range<usize>,
) -> u64 {
    let buffer = &state.buffer;
    let mut samples = std::mem::take(&mut layers.samples);
    runs::expand(frame, area, buffer, shading, &mut samples);
    let shaded = layers.blend(state.view(frame, area), triangles, shading, &mut samples);
    runs::collapse(frame, buffer, shading, &samples);
    layers.samples = samples;
    shaded
}

impl Layers {
    /// Lays all layers of a tile over its samples; how many fragments were shaded.
    fn blend(
        &mut self,
        tile: TileView<'_>,
        triangles: Range<usize>,
        shading: &mut Shading,
        colors: &mut [Vec4],
    ) -> u64 {
        self.joints.collect(&tile, triangles.clone());
        self.blocks.clear();
        self.blocks.resize(triangles.len(), Blocks::ALL);
        let samples = tile.buffer.samples;
        let (mut left, mut depth, mut again) = (Blocks::of(tile.area), USUAL_DEPTH, false);
        let mut shaded = 0;
        while !left.is_empty() {
            let at_once = (CAPACITY / (BLOCK * samples * depth)).max(1);
            let (mut rest, mut deepest) = (Blocks::NONE, 0);
            while !left.is_empty() {
                let round = Round::new(left.take(at_once), samples, again);
                self.runs.reset(round.blocks.len() * BLOCK * samples, CAPACITY);
                self.gather(tile, &round, triangles.clone());
                self.list(tile, &round);
                self.shade(tile, shading);
                shaded += self.fragments.len() as u64;
                let (blocks, waiting) = self.lay(tile, &round, colors);
                rest = rest.union(blocks);
                deepest = deepest.max(waiting);
            }
            (left, depth, again) = (rest, deepest, true);
        }
        shaded
    }

    /// Puts the layers that were held in order and lists their fragments.
    fn list(&mut self, tile: TileView<'_>, round: &Round) {
        let Self { runs, fragments, .. } = self;
        let samples = tile.buffer.samples;
        let order = DepthOrder(tile);
        fragments.reset(tile.triangles.len());
        for block in round.blocks.iter() {
            for pixel in block * BLOCK..(block + 1) * BLOCK {
                // With one sample no fragment is named twice.
                let first = if samples == 1 { usize::MAX } else { fragments.len() };
                for sample in 0..samples {
                    let at = round.group(pixel / LANES, sample, samples) + pixel % LANES;
                    fragments.name(pixel, first, runs.sorted(order, at));
                }
            }
        }
        fragments.sort(samples > 1);
    }

    fn shade(&mut self, tile: TileView<'_>, shading: &mut Shading) {
        let Self { fragments, colors, .. } = self;
        if colors.len() < fragments.len() {
            colors.resize(fragments.len(), [0.0; 4]);
        }
        let jobs = JobList { triangles: tile.triangles, jobs: &fragments.jobs, points: &fragments.points };
        shade_jobs(tile.frame, tile.area, shading, jobs, colors);
    }

    /// Lays the layers of a round; the blocks in which more are waiting, and the
    /// most that wait at one sample.
    fn lay(&mut self, tile: TileView<'_>, round: &Round, samples: &mut [Vec4]) -> (Blocks, usize) {
        let (mut rest, mut deepest) = (Blocks::NONE, 0);
        let count = BLOCK * tile.buffer.samples;
        for block in round.blocks.iter() {
            let start = round.starts[block];
            let mut waiting = 0;
            for (at, color) in samples[block * count..(block + 1) * count].iter_mut().enumerate() {
                let layers = self.runs.of(start + at);
                if !layers.is_empty() {
                    *color = laid_over(*color, layers, &self.colors);
                    waiting = waiting.max(self.runs.waiting(start + at));
                }
            }
            if waiting > 0 {
                rest.insert(block);
                deepest = deepest.max(waiting);
                self.keep_last(start, block * count..(block + 1) * count, round.again);
            }
        }
        (rest, deepest)
    }

    /// Notes what lies on top at the samples of a block.
    fn keep_last(&mut self, start: usize, samples: Range<usize>, again: bool) {
        if self.last.len() < samples.end {
            self.last.resize(samples.end, Layer::default());
        }
        // A sample without layers: every layer lies in front of this one.
        let nothing = Layer { depth: f32::NEG_INFINITY, ..Layer::default() };
        for (at, last) in self.last[samples].iter_mut().enumerate() {
            match self.runs.of(start + at).last() {
                Some(layer) => *last = *layer,
                None if again => {}
                None => *last = nothing,
            }
        }
    }
}

/// A colour under layers, the first of which lies behind. All are premultiplied: a layer
/// is multiplied by its coverage alone, and what lies below by one minus the resulting alpha.
#[inline(always)]
fn laid_over(behind: Vec4, layers: &[Layer], colors: &[[f32; 4]]) -> Vec4 {
    let over = |below: Vec4, layer: &Layer| {
        let source = Vec4::from_array(colors[layer.color as usize]) * layer.coverage;
        source + below * (1.0 - source.w)
    };
    let color = layers.iter().fold(behind, over);
    if color.is_finite() {
        // Then no sum on the way was infinite or NaN.
        color
    } else {
        layers.iter().fold(behind, |below, layer| saturated(over(below, layer)))
    }
}
