//! Opaque triangles of a tile from front to back, where many lie above each other.
//!
//! The nearest triangle is visible in whatever order they are drawn. From front to back, blocks hide most of those that
//! come later, and as soon as the whole tile lies in front of all the others, none of them is prepared.
//!
//! The order is approximate: triangles are distributed over buckets by the depths of their nearest vertices, and each
//! bucket keeps the order of the list. A tile is sorted only if a few of its triangles suggest that this pays, and only if
//! all are uncut and of one draw, because shading requires draws to be in order and lets triangles of a draw have any order.

use super::corners::corners_of_one;
use crate::bin::TriangleRef;
use crate::simd::{I32, InlineMap, LANES, Simd, append, at_level, prelude::*};
use crate::tile_buffer::TileArea;
use crate::vertex::ScreenVertex;
use crate::view::FrameView;

/// Tiles with fewer triangles are drawn in the order of their list.
const LEAST: usize = 64;

/// How many triangles tell whether sorting pays: those in equal steps through the list.
const SAMPLES: usize = 8;

/// Sorting pays if bounding boxes of triangles lie so many times above each other, averaged over the tile: about half as
/// many triangles.
const LAYERS: i64 = 6;

/// A power of two.
const BUCKETS: usize = 256;

/// The order of a tile's triangles from front to back.
#[derive(Default)]
pub(super) struct FrontToBack {
    /// The bits of each triangle's nearest depth. (Those of numbers that are not negative are in the order of the numbers.)
    depths: Vec<i32>,
    /// For each of the sorted triangles a depth such that neither it nor any later one is nearer.
    nearest: Vec<f32>,
}

impl FrontToBack {
    /// Sorts a tile's opaque triangles if that pays; `spare` is memory. Returns whether it has.
    pub(super) fn sort(
        &mut self,
        frame: &FrameView<'_>,
        area: &TileArea,
        triangles: &mut [TriangleRef],
        spare: &mut Vec<TriangleRef>,
    ) -> bool {
        self.nearest.clear();
        if !frame.hierarchical || triangles.len() < LEAST || !lie_above_each_other(frame, area, triangles) {
            return false;
        }
        let draw = &frame.plan.draws[frame.draw_of(triangles[0])].ordinals;
        if !triangles.iter().all(|triangle| triangle.is_whole() && draw.contains(&triangle.ordinal)) {
            return false;
        }
        let [farthest, nearest] = at_level!(frame.token, simd => self.find_depths(simd, frame, triangles));
        // Triangles of one depth stay in the order of their keys, in which there are no ties.
        let is_sorted = farthest < nearest;
        if is_sorted {
            self.distribute(triangles, [farthest, nearest], spare);
        }
        is_sorted
    }

    /// For each of the triangles that were sorted last a depth such that neither it nor any later one is nearer; none if
    /// they were not sorted.
    pub(super) fn nearest(&self) -> &[f32] {
        &self.nearest
    }

    /// Finds the nearest depth of each triangle, and the least and the greatest of these.
    #[inline(always)]
    fn find_depths<S: Simd>(
        &mut self,
        simd: S,
        frame: &FrameView<'_>,
        triangles: &[TriangleRef],
    ) -> [i32; 2] {
        self.depths.clear();
        let mut range = [i32::MAX, 0].each(
            #[inline(always)]
            |end| I32::splat(simd, end),
        );
        for triangles in triangles.chunks(LANES) {
            let [a, b, c] = corners_of_one(frame, triangles).each(
                #[inline(always)]
                |vertices| {
                    let depths = vertices.each(
                        #[inline(always)]
                        |vertex| vertex.depth().to_bits().cast_signed(),
                    );
                    I32::simd_from(simd, depths)
                },
            );
            let depths = a.max(b).max(c).max(0);
            range = [range[0].min(depths), range[1].max(depths)];
            append(&mut self.depths, &depths.into(), triangles.len());
        }
        let [least, greatest] = range.each(<[i32; LANES]>::from);
        [least.into_iter().fold(i32::MAX, i32::min), greatest.into_iter().fold(0, i32::max)]
    }

    /// Sorts triangles by buckets of their depths, whose bits lie in a range.
    fn distribute(
        &mut self,
        triangles: &mut [TriangleRef],
        [farthest, nearest]: [i32; 2],
        spare: &mut Vec<TriangleRef>,
    ) {
        let bits = i32::BITS - (nearest - farthest).leading_zeros();
        let shift = bits.saturating_sub(BUCKETS.ilog2());
        let bucket = |depth: i32| ((nearest - depth) >> shift) as usize % BUCKETS;
        let mut starts = [0; BUCKETS];
        for &depth in &self.depths {
            starts[bucket(depth)] += 1;
        }
        let mut start = 0;
        for count in &mut starts {
            start += std::mem::replace(count, start);
        }
        spare.clear();
        spare.extend_from_slice(triangles);
        self.nearest.resize(triangles.len(), 0.0);
        for (&triangle, &depth) in spare.iter().zip(&self.depths) {
            let bucket = bucket(depth);
            let at = starts[bucket];
            starts[bucket] += 1;
            triangles[at] = triangle;
            self.nearest[at] = f32::from_bits((nearest - ((bucket as i32) << shift)).cast_unsigned());
        }
    }
}

/// Whether bounding boxes cover the tile often, as far as some of the triangles tell.
fn lie_above_each_other(frame: &FrameView<'_>, area: &TileArea, triangles: &[TriangleRef]) -> bool {
    let some = triangles.iter().step_by(triangles.len() / SAMPLES).take(SAMPLES);
    let boxes = some.filter(|triangle| triangle.is_whole());
    let covered: i64 = boxes.map(|&triangle| box_in_tile(area, frame.corners(triangle))).sum();
    let [width, height] = area.size.map(|side| 256 * side as i64);
    covered * triangles.len() as i64 >= LAYERS * SAMPLES as i64 * width * height
}

/// The area of the part of a triangle's bounding box that lies in the tile, in squares of 1/256 pixel.
fn box_in_tile(area: &TileArea, vertices: [&ScreenVertex; 3]) -> i64 {
    let side = |axis: usize| {
        let [a, b, c] = vertices.map(|vertex| vertex.raw()[axis]);
        let begin = area.origin[axis] * 256;
        let end = begin + 256 * area.size[axis] as i32;
        let [first, last] = [a.min(b).min(c).max(begin), a.max(b).max(c).min(end)];
        i64::from((last - first).max(0))
    };
    side(0) * side(1)
}
