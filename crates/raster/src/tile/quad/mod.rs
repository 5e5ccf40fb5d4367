//! The quad kernel: lines and points, both triangles at once, only in groups that the outline
//! crosses. A lane is one pixel of a group of 4×2.
//!
//! The outline of a line has two ends, parallel to one axis, and two sides that run along the other, the major
//! axis. For each pixel along it the sides climb by at most one pixel (see [`line`](crate::line)). So the groups
//! are visited along the major axis, four columns or two rows at a time, and across it only from one side to the
//! other. Twelve pixels of a thin line take four or five groups, whatever its length. As for triangles, edge
//! functions decide exactly which samples of a group the outline contains; for a disc, the outline is its square,
//! and the distances of samples from the centre are compared as well. The diagonal decides which of the two
//! triangles a sample belongs to, because that triangle gives its depth and colour.

mod edges;

pub(super) use edges::QuadEdges;

use super::rasterizer::{GroupSamples, TileRasterizer};
use crate::primitive::{DepthPlane, Kind, Quad};
use crate::simd::{F32, I32, InlineMap, LANES, Mask, Row, Simd, U32, inlined, lane_numbers, prelude::*};
use crate::stats::Counts;
use crate::tile_buffer::{GROUPS, TileArea, VisibilityBuffer, store_each_where};
use crate::viewport::SamplePattern;
use edges::{DIAGONAL, EDGES, OutlineStrip, QuadPosition, SHIFT};

/// From this width on, in 1/256 pixel, testing whole blocks first pays, so the two triangles are
/// drawn as such.
const WIDE: i32 = 32 * 256;

/// The round outline of a point, from the tile's corner.
struct TileDisc {
    /// Twice the centre, in 1/256 pixel.
    center: [i32; 2],
    square_of_diameter: i32,
}

impl TileDisc {
    /// Of a point that is not [`WIDE`], so that squares in the groups around it fit 32 bits.
    fn new(quad: &Quad, area: &TileArea) -> Self {
        let [[left, right], [top, bottom]] = [quad.extent(0), quad.extent(1)];
        let [x, y] = area.origin.map(|v| v * 512);
        let diameter = right - left;
        Self { center: [left + right - x, top + bottom - y], square_of_diameter: diameter * diameter }
    }

    /// Which pixels of a group have the sample at this offset in the disc. Samples exactly on the
    /// circle are not in it.
    #[inline(always)]
    fn covers<S: Simd>(&self, simd: S, first: [i32; 2], offset: [i32; 2]) -> Mask<S> {
        let lanes = [lane_numbers(simd) & 3, lane_numbers(simd) >> 2];
        let [dx, dy] = [0, 1].each(
            #[inline(always)]
            |axis| (lanes[axis] << 9) + (first[axis] * 512 + 2 * offset[axis] - self.center[axis]),
        );
        (dx * dx + dy * dy).simd_lt(I32::splat(simd, self.square_of_diameter))
    }
}

/// A line or a point, with the index of its first triangle among the tile's; that of the other comes next.
#[derive(Clone, Copy)]
pub(super) struct IndexedQuad<'q> {
    pub(super) quad: &'q Quad,
    pub(super) index: u32,
}

/// A line or a point that is being drawn, with what its groups have in common.
struct QuadWalk<'q, S: Simd> {
    quad: &'q Quad,
    edges: &'q QuadEdges,
    /// The edges' steps within a group.
    lanes: [I32<S>; EDGES],
    disc: Option<TileDisc>,
    /// The planes of both triangles, if the ends are not equally deep.
    planes: Option<[DepthPlane; 2]>,
    /// The first triangle among the tile's; the other comes next.
    index: u32,
}

impl TileRasterizer<'_> {
    /// Draws a line or a point. Returns false if it has to be drawn as two triangles.
    #[inline(always)]
    pub(super) fn quad<S: Simd, const MULTI: bool>(
        &self,
        simd: S,
        quad: IndexedQuad<'_>,
        edges: &mut QuadEdges,
        buffer: &mut VisibilityBuffer,
        counts: &mut Counts,
    ) -> bool {
        // A separate function, so that it takes no registers from the kernels of triangles.
        simd.vectorize(
            #[inline(always)]
            || self.quad_edge_groups::<S, MULTI>(simd, quad, edges, buffer, counts),
        )
    }

    #[inline(always)]
    fn quad_edge_groups<S: Simd, const MULTI: bool>(
        &self,
        simd: S,
        IndexedQuad { quad, index }: IndexedQuad<'_>,
        edges: &mut QuadEdges,
        buffer: &mut VisibilityBuffer,
        counts: &mut Counts,
    ) -> bool {
        if self.tile_hides(buffer, quad.nearest()) {
            counts.tiles_rejected += 1;
            return true;
        }
        let [[a, b], [d, c]] = quad.corners;
        // The two corners of one end differ only along the minor axis. That holds for sharp outlines;
        // anti-aliased ones are translucent and never come here.
        let major = usize::from(a[0] != b[0]);
        let minor = 1 - major;
        if (b[minor] - a[minor]).max(c[minor] - d[minor]) >= WIDE {
            return false;
        }
        let Some(pixels) = pixels_in(quad, edges.pattern, &self.area) else { return true };
        match edges.find(simd, quad, &self.area) {
            QuadPosition::Beside => return true,
            QuadPosition::TooLong => return false,
            QuadPosition::Within => {}
        }
        buffer.write_back();
        let planes = (quad.depths[0] != quad.depths[1]).then(
            #[inline(always)]
            || [plane_of_half(quad, 0), plane_of_half(quad, 1)],
        );
        let disc = (quad.kind == Kind::RoundPoint).then(|| TileDisc::new(quad, &self.area));
        let pattern = edges.pattern;
        let walk = QuadWalk { quad, lanes: edges.lanes(simd), edges, disc, planes, index };
        let (first, last) = (pixels[major][0] >> SHIFT[major], pixels[major][1] >> SHIFT[major]);
        let mut strip = OutlineStrip::new(quad, pattern, &self.area, major, first);
        for along in first..last + 1 {
            for across in strip.next(pixels[minor], SHIFT[minor]) {
                let at = if major == 0 { [along, across] } else { [across, along] };
                self.group::<S, MULTI>(simd, &walk, at, buffer, counts);
            }
        }
        true
    }

    /// Tests and stores the samples of a group, given by its column and row.
    #[inline(always)]
    fn group<S: Simd, const MULTI: bool>(
        &self,
        simd: S,
        walk: &QuadWalk<'_, S>,
        [column, row]: [i32; 2],
        buffer: &mut VisibilityBuffer,
        counts: &mut Counts,
    ) {
        let group = TileArea::group_of([column as usize, row as usize]);
        let block = group / GROUPS;
        if self.hierarchical && self.hides(buffer.blocks.farthest[block], walk.quad.nearest()) {
            return;
        }
        counts.groups += 1;
        let first = [column << SHIFT[0], row << SHIFT[1]];
        let QuadEdges { right, down, starts, greatest, .. } = walk.edges;
        // What the group and the sample add, of all edges at once. Partial sums may wrap around;
        // the sum fits.
        let [right, down] = [I32::simd_from(simd, *right), I32::simd_from(simd, *down)];
        let here = right * first[0] + down * first[1];
        if MULTI {
            let here: Row = (here + I32::simd_from(simd, *greatest)).into();
            if !walk.inside(simd, &here).any_true() {
                return;
            }
        }
        let mut wrote = false;
        let samples = if MULTI { buffer.samples } else { 1 };
        for (sample, starts) in starts[..samples].iter().enumerate() {
            let here: Row = (here + I32::simd_from(simd, *starts)).into();
            let mut covered = walk.inside(simd, &here);
            if let Some(disc) = &walk.disc {
                covered &= disc.covers(simd, first, self.offsets[sample]);
            }
            if !covered.any_true() {
                continue;
            }
            let is_first = (walk.lanes[DIAGONAL] + here[DIAGONAL]).simd_ge(I32::splat(simd, 0));
            let depth = walk.depth(simd, is_first, self.area.point(first, self.offsets[sample]));
            let at = (group * samples + sample) * LANES;
            let visible =
                self.visible_lanes(simd, GroupSamples { index: walk.index, covered, depth }, buffer, at);
            if visible.any_true() {
                let indices = is_first.select(U32::splat(simd, walk.index), U32::splat(simd, walk.index + 1));
                store_each_where(simd, visible, indices, depth, buffer, at);
                wrote = true;
            }
        }
        if wrote {
            buffer.note_write(block, walk.quad.nearest());
        }
    }
}

impl<S: Simd> QuadWalk<'_, S> {
    /// Which pixels of a group lie inside of the outline, from the values at its first.
    #[inline(always)]
    fn inside(&self, simd: S, here: &Row) -> Mask<S> {
        let [a, b, c, d] = [0, 1, 2, 3].each(
            #[inline(always)]
            |k| self.lanes[k] + here[k],
        );
        (a | b | (c | d)).simd_ge(I32::splat(simd, 0))
    }

    /// The depths in a group whose first point is given, each of the triangle that it is in.
    #[inline(always)]
    fn depth(&self, simd: S, is_first: Mask<S>, point: [i32; 2]) -> F32<S> {
        match &self.planes {
            None => F32::splat(simd, self.quad.depths[0]),
            Some([a, b]) => is_first.select(a.group(simd, point), b.group(simd, point)),
        }
    }
}

/// The plane of the depths of one of the triangles.
#[inline(always)]
fn plane_of_half(quad: &Quad, half: usize) -> DepthPlane {
    let (vertices, order) = quad.sorted(half);
    DepthPlane::through(order.each(
        #[inline(always)]
        |i| vertices[i],
    ))
}

/// The first and last columns and rows of the tile that may have a sample of a line or a point;
/// `None` if there are none.
#[inline(always)]
fn pixels_in(quad: &Quad, pattern: SamplePattern, area: &TileArea) -> Option<[[i32; 2]; 2]> {
    let range = inlined(
        #[inline(always)]
        |axis: usize| {
            let [first, last] = pattern.pixels_between(quad.extent(axis))?;
            let first = (first - area.origin[axis]).max(0);
            let last = (last - area.origin[axis]).min(area.padded()[axis] as i32 - 1);
            (first <= last).then_some([first, last])
        },
    );
    Some([range(0)?, range(1)?])
}
