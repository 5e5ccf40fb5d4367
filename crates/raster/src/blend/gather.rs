//! Collects at each sample the layers in front of those that are already blended.
//!
//! Segments may meet at joints ([`Joints`]): of the segments that share a vertex only one paints a sample, so that a
//! polyline does not blend its joints twice.

use super::runs::{DepthOrder, Layer, Order};
use super::{Layers, Round};
use crate::bin::TriangleRef;
use crate::geometry::Shape;
use crate::pass::RecordedDraw;
use crate::primitive::{SetupTriangle, Stroke};
use crate::simd::{LANES, Simd, at_level, prelude::*};
use crate::tile::{Blocks, Candidate, SampleGroup, TileTriangle, TileView, single};
use crate::view::FrameView;
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

/// An end of a segment: its draw, its vertex, the segment, and one of its
/// triangles in the tile.
type Joint = [u32; 4];

/// The ends of all segments of a tile, in order.
#[derive(Default)]
pub(super) struct Joints(Vec<Joint>);

impl Joints {
    /// Lists the segments among a tile's triangles.
    pub(super) fn collect(&mut self, tile: &TileView<'_>, triangles: Range<usize>) {
        self.0.clear();
        let is_lines = |draw: &RecordedDraw<'_>| matches!(draw.geometry.shape, Shape::Lines { .. });
        if tile.frame.pass.iter().any(is_lines) {
            let ends = |index| Some(Segment::of(tile.frame, tile.triangles[index])?.ends(index));
            self.0.extend(triangles.filter_map(ends).flatten());
            self.0.sort_unstable();
        }
    }

    /// The triangles of other segments that share a vertex with that of a
    /// triangle and come near it; whether they belong to later segments, too.
    pub(super) fn beside<'j>(
        &'j self,
        tile: TileView<'j>,
        index: usize,
    ) -> impl Iterator<Item = (usize, bool)> + 'j {
        let segment = if self.0.is_empty() { None } else { Segment::of(tile.frame, tile.triangles[index]) };
        let ends = segment.map(|segment| segment.ends(index));
        let extent = move |index: usize| extents(&tile.frame.triangle(tile.triangles[index]));
        let own = ends.map(|_| extent(index));
        ends.into_iter().flatten().flat_map(move |[draw, vertex, primitive, _]| {
            let start = self.0.partition_point(|joint| *joint < [draw, vertex, 0, 0]);
            let here = self.0[start..].iter().take_while(move |joint| joint[..2] == [draw, vertex]);
            let others = here.filter(move |joint| joint[2] != primitive);
            others
                .filter(move |joint| own.is_some_and(|own| meet(own, extent(joint[3] as usize))))
                .map(move |joint| (joint[3] as usize, joint[2] > primitive))
        })
    }
}

/// A segment, by one of its triangles.
struct Segment {
    draw: u32,
    primitive: u32,
    vertices: [u32; 2],
}

impl Segment {
    fn of(frame: &FrameView<'_>, triangle: TriangleRef) -> Option<Self> {
        triangle.part()?;
        let plan = &frame.plan.draws[frame.draw_of(triangle)];
        let geometry = &frame.pass[plan.draw()].geometry;
        let segment = || {
            let primitive = triangle.ordinal - plan.ordinals.start;
            let [from, to, _] = geometry.corners(primitive);
            Self { draw: plan.draw() as u32, primitive, vertices: [from, to] }
        };
        matches!(geometry.shape, Shape::Lines { .. }).then(segment)
    }

    fn ends(&self, index: usize) -> [Joint; 2] {
        self.vertices.map(|vertex| [self.draw, vertex, self.primitive, index as u32])
    }
}

/// Whether a sample is painted by another segment that is joined to this one: the
/// other covers more of it, or as much and is the later one.
#[inline(always)]
fn prevails(other: f32, is_later: bool, own: f32) -> bool {
    other > own || (other == own && is_later)
}

/// The share of a sample that a triangle covers.
#[derive(Clone, Copy)]
pub(crate) struct SampleShare {
    pub(crate) triangle: TriangleRef,
    pub(crate) coverage: f32,
}

/// Whether a triangle leaves a sample to another one.
pub(crate) fn leaves(frame: &FrameView<'_>, own: SampleShare, other: SampleShare) -> bool {
    let segments = Segment::of(frame, own.triangle).zip(Segment::of(frame, other.triangle));
    segments.is_some_and(|(a, b)| {
        let joined = a.draw == b.draw && a.vertices.iter().any(|vertex| b.vertices.contains(vertex));
        joined && prevails(other.coverage, b.primitive > a.primitive, own.coverage)
    })
}

/// Ranges of columns and of rows.
type Extents = [[i32; 2]; 2];

fn extents(triangle: &SetupTriangle) -> Extents {
    [0, 1].map(|axis| triangle.extent(axis))
}

fn meet(a: Extents, b: Extents) -> bool {
    (0..2).all(|axis| a[axis][0] <= b[axis][1] && b[axis][0] <= a[axis][1])
}
