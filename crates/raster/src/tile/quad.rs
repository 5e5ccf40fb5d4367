//! Opaque lines and points: both triangles at once, in those groups only that the outline
//! crosses.
//!
//! A line's outline has two ends along an axis and two sides that climb by no more than a
//! pixel in each pixel of the other, the major axis (see [`line`](crate::line)). So the groups
//! are gone through along the major axis, four columns or two rows at a time, and across it only
//! from where the one side may pass to where the other may: four or five groups for twelve
//! pixels of a thin line, whatever its length. Where in a group the outline lies, its edge
//! functions say exactly, as for triangles; the diagonal tells which of the two triangles has a
//! sample, as its depth and colour are found from that.

use super::area::GROUPS;
use super::buffer::VisibilityBuffer;
use super::cover::{Counts, Cover};
use super::store::store_places_where;
use super::{DepthPlane, Edge, TileArea};
use crate::samples::{MAX_SAMPLES, SamplePattern};
use crate::setup::{Kind, Quad, SMALL};
use crate::simd::{Each, F32, I32, LANES, Mask, Row, Simd, U32, inlined, lane_numbers, prelude::*};

/// From this width on, in 1/256 pixel, it pays to ask whole blocks, as for triangles.
const WIDE: i32 = 32 * 256;

/// The last of the edges: not one of the outline.
const DIAGONAL: usize = 4;

/// How many there are.
const EDGES: usize = 5;

/// How a line or a point lies in a tile.
enum Place {
    /// It has no sample in it.
    Beside,
    Within,
    /// Its edge functions do not fit 32 bits there.
    TooLong,
}

/// The edge functions of a line or a point in a tile, over 256 and rounded down as those of
/// [`Covering`](super::Covering): of the outline, and of the diagonal. As rows of eight, of which
/// five are used.
pub(super) struct QuadEdges {
    right: Row,
    down: Row,
    /// For each sample of a pixel the values at the tile's first pixel.
    starts: [Row; MAX_SAMPLES],
    /// The greatest of those.
    greatest: Row,
}

impl QuadEdges {
    pub(super) fn new() -> Self {
        let row = [0; LANES];
        Self { right: row, down: row, starts: [row; MAX_SAMPLES], greatest: row }
    }

    /// Finds them for one tile that a line or a point reaches into: of one whose sides are
    /// [`SMALL`] all at once, as then everything fits 32 bits, also a tile away.
    #[inline(always)]
    fn find<S: Simd>(&mut self, simd: S, quad: &Quad, pattern: SamplePattern, area: &TileArea) -> Place {
        let is_small = [0, 1].into_iter().all(|axis| {
            let [low, high] = quad.extent(axis);
            high - low < SMALL
        });
        if is_small {
            self.find_small(simd, quad, pattern, area);
            return Place::Within;
        }
        self.find_large(quad, pattern, area)
    }

    #[inline(always)]
    fn find_small<S: Simd>(&mut self, simd: S, quad: &Quad, pattern: SamplePattern, area: &TileArea) {
        // In the order of `Edge::around`.
        let [[a, b], [d, c]] = quad.corners;
        let [from, to] = [[d, b, a, c, c], [a, c, b, d, a]].each(
            #[inline(always)]
            |[m, n, o, p, q]: [[i32; 2]; EDGES]| {
                [0, 1].each(
                    #[inline(always)]
                    |i| I32::simd_from(simd, [m[i], n[i], o[i], p[i], q[i], q[i], q[i], q[i]]),
                )
            },
        );
        let is_clockwise = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0;
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let (right, down) = if is_clockwise { (-dy, dx) } else { (dy, -dx) };
        let zero = I32::splat(simd, 0);
        let inclusive = right.simd_gt(zero) | (right.simd_eq(zero) & down.simd_gt(zero));
        let [x, y] = [area.origin[0] * 256, area.origin[1] * 256];
        let value = right * (I32::splat(simd, x) - from[0]) + down * (I32::splat(simd, y) - from[1]);
        let value = value - inclusive.select(zero, I32::splat(simd, 1));
        let mut greatest = I32::splat(simd, i32::MIN);
        for (starts, &[x, y]) in self.starts.iter_mut().zip(pattern.offsets()) {
            let start = (value + right * x + down * y) >> 8;
            greatest = greatest.max(start);
            *starts = start.into();
        }
        (self.right, self.down, self.greatest) = (right.into(), down.into(), greatest.into());
    }

    #[inline(never)]
    fn find_large(&mut self, quad: &Quad, pattern: SamplePattern, area: &TileArea) -> Place {
        let [least, greatest] = pattern.reach();
        let first = area.origin.map(|v| v * 256 + least);
        let span = area.padded().map(|side| (side as i64 - 1) * 256 + i64::from(greatest - least));
        for (k, edge) in Edge::around(quad).into_iter().enumerate() {
            let value = edge.at(first) + edge.bias();
            let steps = [i64::from(edge.right), i64::from(edge.down)];
            let rise = steps[0].max(0) * span[0] + steps[1].max(0) * span[1];
            let fall = steps[0].min(0) * span[0] + steps[1].min(0) * span[1];
            let is_outside = value + rise < 0;
            if is_outside && k != DIAGONAL {
                return Place::Beside;
            }
            if is_outside || value + fall >= 0 {
                self.set(k, [0; 2], pattern, |_| if is_outside { -1 } else { 0 });
            } else if (rise - fall) >> 8 >= i64::from(i32::MAX) {
                return Place::TooLong;
            } else {
                // The edge crosses the tile, so no value in it is further from 0 than the span.
                let at = |[x, y]: [i32; 2]| {
                    let way = [i64::from(x - least), i64::from(y - least)];
                    ((value + steps[0] * way[0] + steps[1] * way[1]) >> 8) as i32
                };
                self.set(k, [edge.right, edge.down], pattern, at);
            }
        }
        Place::Within
    }

    #[inline(always)]
    fn set(&mut self, k: usize, steps: [i32; 2], pattern: SamplePattern, at: impl Fn([i32; 2]) -> i32) {
        [self.right[k], self.down[k]] = steps;
        self.greatest[k] = i32::MIN;
        for (starts, &offset) in self.starts.iter_mut().zip(pattern.offsets()) {
            starts[k] = at(offset);
            self.greatest[k] = self.greatest[k].max(starts[k]);
        }
    }

    /// Their steps within a group, each in a vector of its own.
    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S) -> [I32<S>; EDGES] {
        let (x, y) = (lane_numbers(simd) & 3, lane_numbers(simd) >> 2);
        [0, 1, 2, 3, 4].each(
            #[inline(always)]
            |k| x * self.right[k] + y * self.down[k],
        )
    }
}

/// Between which pixels across the major axis an outline may lie, group by group along it.
struct Strip {
    /// The first and the last pixel from the tile's, times 2^24.
    first: i64,
    last: i64,
    /// What both change by from group to group.
    step: i64,
}

impl Strip {
    /// From a group on, that with this number along the major axis.
    #[inline(always)]
    fn new(quad: &Quad, pattern: SamplePattern, area: &TileArea, (major, group): (usize, i32)) -> Self {
        const UNIT: f64 = (1 << 16) as f64;
        // More than all that is rounded, a unit where the corners were, and less than one below.
        const SLACK: i32 = 2;
        let minor = 1 - major;
        let pixels = 1 << SHIFT[major];
        let [least, greatest] = pattern.reach();
        let [[a, b], [d, c]] = quad.corners;
        let slope = f64::from(d[minor] - a[minor]) / f64::from(d[major] - a[major]);
        let along = (area.origin[major] + group * pixels) * 256 + least;
        let low = f64::from(a[minor] - area.origin[minor] * 256) + slope * f64::from(along - a[major]);
        let rise = slope * f64::from((pixels - 1) * 256 + greatest - least);
        let (below, above) = if rise < 0.0 { (rise, 0.0) } else { (0.0, rise) };
        let width = (b[minor] - a[minor]).max(c[minor] - d[minor]);
        Self {
            first: ((low + below + f64::from(255 - greatest - SLACK)) * UNIT) as i64,
            last: ((low + above + f64::from(width + SLACK - least)) * UNIT) as i64,
            step: (slope * f64::from(pixels * 256) * UNIT) as i64,
        }
    }

    /// The groups of the next pixels along the major axis, within a range of pixels across.
    #[inline(always)]
    fn next(&mut self, [first, last]: [i32; 2], shift: i32) -> std::ops::Range<i32> {
        let first = ((self.first >> 24) as i32).max(first);
        let last = ((self.last >> 24) as i32).min(last);
        self.first += self.step;
        self.last += self.step;
        first >> shift..(last >> shift) + 1
    }
}

/// Bits of the number of a pixel's column and row that tell it from others of its group.
const SHIFT: [i32; 2] = [2, 1];

/// The round outline of a point, from the tile's corner.
struct Disc {
    /// Twice the centre, in 1/256 pixel.
    centre: [i32; 2],
    square_of_diameter: i32,
}

impl Disc {
    /// Of a point that is not [`WIDE`], so that squares in the groups around it fit 32 bits.
    fn new(quad: &Quad, area: &TileArea) -> Self {
        let [[left, right], [top, bottom]] = [quad.extent(0), quad.extent(1)];
        let [x, y] = area.origin.map(|v| v * 512);
        let diameter = right - left;
        Self { centre: [left + right - x, top + bottom - y], square_of_diameter: diameter * diameter }
    }

    /// Which pixels of a group have the sample at this offset in the disc.
    #[inline(always)]
    fn covers<S: Simd>(&self, simd: S, first: [i32; 2], offset: [i32; 2]) -> Mask<S> {
        let lanes = [lane_numbers(simd) & 3, lane_numbers(simd) >> 2];
        let [dx, dy] = [0, 1].each(
            #[inline(always)]
            |axis| (lanes[axis] << 9) + (first[axis] * 512 + 2 * offset[axis] - self.centre[axis]),
        );
        (dx * dx + dy * dy).simd_lt(I32::splat(simd, self.square_of_diameter))
    }
}

/// A line or a point on its way through a tile.
struct Walk<'q, S: Simd> {
    quad: &'q Quad,
    edges: &'q QuadEdges,
    /// The edges' steps within a group.
    lanes: [I32<S>; EDGES],
    disc: Option<Disc>,
    /// The planes of both triangles, if the ends are not equally deep.
    planes: Option<[DepthPlane; 2]>,
    /// The first triangle among the tile's; the other comes next.
    place: u32,
}

impl Cover<'_> {
    /// Lets a line or a point compete for the samples that it covers; false if it has to go the
    /// way of triangles.
    #[inline(always)]
    pub(super) fn quad<S: Simd, const MULTI: bool>(
        &self,
        simd: S,
        (quad, edges): (&Quad, &mut QuadEdges),
        pattern: SamplePattern,
        place: u32,
        buffer: &mut VisibilityBuffer,
        counts: &mut Counts,
    ) -> bool {
        // Apart, so that it takes no registers where there are only triangles.
        simd.vectorize(
            #[inline(always)]
            || self.quad_apart::<S, MULTI>(simd, (quad, edges), pattern, place, buffer, counts),
        )
    }

    #[inline(always)]
    fn quad_apart<S: Simd, const MULTI: bool>(
        &self,
        simd: S,
        (quad, edges): (&Quad, &mut QuadEdges),
        pattern: SamplePattern,
        place: u32,
        buffer: &mut VisibilityBuffer,
        counts: &mut Counts,
    ) -> bool {
        if self.tile_hides(buffer, quad.nearest()) {
            counts.tiles_rejected += 1;
            return true;
        }
        let [[a, b], [d, c]] = quad.corners;
        let major = usize::from(a[0] != b[0]);
        let minor = 1 - major;
        if (b[minor] - a[minor]).max(c[minor] - d[minor]) >= WIDE {
            return false;
        }
        let Some(pixels) = pixels_in(quad, pattern, &self.area) else { return true };
        match edges.find(simd, quad, pattern, &self.area) {
            Place::Beside => return true,
            Place::TooLong => return false,
            Place::Within => {}
        }
        buffer.settle();
        let planes = (quad.depths[0] != quad.depths[1]).then(
            #[inline(always)]
            || [plane_of_half(quad, 0), plane_of_half(quad, 1)],
        );
        let disc = (quad.kind == Kind::RoundPoint).then(|| Disc::new(quad, &self.area));
        let walk = Walk { quad, lanes: edges.lanes(simd), edges, disc, planes, place };
        let (first, last) = (pixels[major][0] >> SHIFT[major], pixels[major][1] >> SHIFT[major]);
        let mut strip = Strip::new(quad, pattern, &self.area, (major, first));
        for along in first..last + 1 {
            for across in strip.next(pixels[minor], SHIFT[minor]) {
                let at = if major == 0 { [along, across] } else { [across, along] };
                self.group::<S, MULTI>(simd, &walk, at, buffer, counts);
            }
        }
        true
    }

    /// Lets the samples of a group, by its column and row, compete.
    #[inline(always)]
    fn group<S: Simd, const MULTI: bool>(
        &self,
        simd: S,
        walk: &Walk<'_, S>,
        [column, row]: [i32; 2],
        buffer: &mut VisibilityBuffer,
        counts: &mut Counts,
    ) {
        let group = TileArea::group_of([column as usize, row as usize]);
        let block = group / GROUPS;
        if self.hierarchical && self.hides(buffer.blocks[block].farthest, walk.quad.nearest()) {
            return;
        }
        counts.groups += 1;
        let first = [column << SHIFT[0], row << SHIFT[1]];
        let QuadEdges { right, down, starts, greatest } = walk.edges;
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
        for sample in 0..if MULTI { buffer.samples } else { 1 } {
            let here: Row = (here + I32::simd_from(simd, starts[sample])).into();
            let mut covered = walk.inside(simd, &here);
            if let Some(disc) = &walk.disc {
                covered &= disc.covers(simd, first, self.offsets[sample]);
            }
            if !covered.any_true() {
                continue;
            }
            let is_first = (walk.lanes[DIAGONAL] + here[DIAGONAL]).simd_ge(I32::splat(simd, 0));
            let depth = walk.depth(simd, is_first, self.area.point(first, self.offsets[sample]));
            let at = (group * buffer.samples + sample) * LANES;
            let seen = self.seen(simd, walk.place, (covered, depth), buffer, at);
            if seen.any_true() {
                let places = is_first.select(U32::splat(simd, walk.place), U32::splat(simd, walk.place + 1));
                store_places_where(simd, seen, (places, depth), buffer, at);
                wrote = true;
            }
        }
        if wrote {
            buffer.note_write(block, walk.quad.nearest());
        }
    }
}

impl<S: Simd> Walk<'_, S> {
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
