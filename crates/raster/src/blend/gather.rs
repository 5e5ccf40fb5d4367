//! Collects at each sample the layers in front of those that are already blended.

use super::joints::prevails;
use super::order::DepthOrder;
use super::runs::{Layer, Order};
use super::{Layers, Round};
use crate::primitive::Stroke;
use crate::simd::{LANES, Simd, at_level, prelude::*};
use crate::tile::{Blocks, Candidate, SampleGroup, TileTriangle, TileView, single};
use std::ops::Range;

/// A triangle of a tile.
struct LayerTriangle {
    covering: TileTriangle,
    index: u32,
    /// Its fractional coverage, if it is anti-aliased.
    stroke: Option<Stroke>,
}

/// A triangle of another segment that meets this one.
pub(super) struct JoinedTriangle {
    shape: LayerTriangle,
    is_later: bool,
}

impl LayerTriangle {
    fn new(tile: TileView<'_>, index: usize) -> Option<Self> {
        let at = tile.triangles[index];
        let covering = single(tile.frame, tile.area, at)?;
        let stroke = at.part().and_then(|_| tile.frame.chunk_of(at).stroke_of(at).copied());
        Some(Self { covering, index: index as u32, stroke })
    }

    fn candidate(&self) -> Candidate<'_> {
        Candidate { covering: &self.covering, triangle: self.index }
    }

    /// The share that it covers at the samples of a group.
    #[inline(always)]
    fn coverage<S: Simd>(&self, simd: S, group: SampleGroup) -> [f32; LANES] {
        match &self.stroke {
            Some(stroke) => stroke.coverage(simd, group.point),
            None => [1.0; LANES],
        }
    }
}

impl Layers {
    /// Keeps the farthest layers that are left in the blocks of a round.
    pub(super) fn gather(&mut self, tile: TileView<'_>, round: &Round, triangles: Range<usize>) {
        let first = triangles.start;
        let mut beside = std::mem::take(&mut self.beside);
        for index in triangles {
            if self.blocks[index - first].intersection(round.blocks).is_empty() {
                continue;
            }
            beside.clear();
            beside.extend(self.joints.beside(tile, index).filter_map(|(index, is_later)| {
                Some(JoinedTriangle { shape: LayerTriangle::new(tile, index)?, is_later })
            }));
            let visible = LayerTriangle::new(tile, index).map_or(Blocks::NONE, |shape| {
                at_level!(tile.frame.token, simd => self.gather_one(simd, tile, round, &shape, &beside))
            });
            let blocks = &mut self.blocks[index - first];
            *blocks = blocks.without(round.blocks).union(visible);
        }
        self.beside = beside;
    }

    /// One triangle, and the blocks of this round in which it may be visible.
    #[inline(always)]
    fn gather_one<S: Simd>(
        &mut self,
        simd: S,
        tile: TileView<'_>,
        round: &Round,
        shape: &LayerTriangle,
        beside: &[JoinedTriangle],
    ) -> Blocks {
        let Self { runs, last, .. } = self;
        let order = DepthOrder(tile);
        let samples = tile.buffer.samples;
        let mut blocks = Blocks::NONE;
        tile.for_each_visible(
            simd,
            shape.candidate(),
            round.blocks,
            #[inline(always)]
            |group, visible, depth| {
                blocks.insert(group.group / 8);
                let coverage = shape.coverage(simd, group);
                let mut lanes = visible.to_bitmask();
                if shape.stroke.is_some() {
                    lanes &= where_of(|lane| coverage[lane] > 0.0);
                }
                for beside in beside {
                    lanes &= !beside.paints(simd, tile, group, &coverage);
                }
                let depth: [f32; LANES] = depth.into();
                let first = round.group(group.group, group.sample, samples);
                let in_buffer = (group.group * samples + group.sample) * LANES;
                while lanes != 0 {
                    let lane = lanes.trailing_zeros() as usize;
                    lanes &= lanes - 1;
                    let (depth, coverage) = (depth[lane], coverage[lane]);
                    let layer = Layer { depth, triangle: shape.index, coverage, color: 0 };
                    if !round.again || order.is_behind(&last[in_buffer + lane], &layer) {
                        runs.push(order, first + lane, layer);
                    }
                }
            },
        );
        blocks
    }
}

impl JoinedTriangle {
    /// The lanes of a group that it paints instead of one with this coverage.
    #[inline(always)]
    fn paints<S: Simd>(
        &self,
        simd: S,
        tile: TileView<'_>,
        group: SampleGroup,
        coverage: &[f32; LANES],
    ) -> u64 {
        let Some((visible, _)) = tile.look(simd, self.shape.candidate(), group) else {
            return 0;
        };
        let own = self.shape.coverage(simd, group);
        visible.to_bitmask() & where_of(|lane| prevails(own[lane], self.is_later, coverage[lane]))
    }
}

/// The lanes for which `holds` is true.
#[inline(always)]
fn where_of(holds: impl Fn(usize) -> bool) -> u64 {
    (0..LANES).fold(0, |lanes, lane| lanes | u64::from(holds(lane)) << lane)
}
