//! The edge functions of a line or a point in a tile, in 32 bits, and which groups of the tile its outline may cross.

use crate::primitive::{Edge, Quad, SMALL, owns_boundary};
use crate::simd::{I32, InlineMap, LANES, Row, Simd, lane_numbers, prelude::*};
use crate::tile_buffer::TileArea;
use crate::viewport::{MAX_SAMPLES, SamplePattern};

/// The last of the edges: not one of the outline.
pub(super) const DIAGONAL: usize = 4;

/// How many there are.
pub(super) const EDGES: usize = 5;

/// How a line or a point lies in a tile.
pub(super) enum QuadPosition {
    /// It has no sample in it.
    Beside,
    Within,
    /// Its edge functions do not fit 32 bits there.
    TooLong,
}

/// The edge functions of a line or a point in a tile, over 256 and rounded down as those of
/// [`TileTriangle`](crate::tile::TileTriangle): of the outline, and of the diagonal. As rows of eight, of which
/// five are used.
pub(in crate::tile) struct QuadEdges {
    pub(super) pattern: SamplePattern,
    pub(super) right: Row,
    pub(super) down: Row,
    /// For each sample of a pixel the values at the tile's first pixel.
    pub(super) starts: [Row; MAX_SAMPLES],
    /// The greatest of those.
    pub(super) greatest: Row,
}

impl QuadEdges {
    /// Of none yet, in pixels with such samples.
    pub(in crate::tile) fn new(pattern: SamplePattern) -> Self {
        let row = [0; LANES];
        Self { pattern, right: row, down: row, starts: [row; MAX_SAMPLES], greatest: row }
    }

    /// Finds them for one tile that a line or a point reaches into: of one whose sides are
    /// [`SMALL`] all at once, as then everything fits 32 bits, also a tile away.
    #[inline(always)]
    pub(super) fn find<S: Simd>(&mut self, simd: S, quad: &Quad, area: &TileArea) -> QuadPosition {
        let is_small = [0, 1].into_iter().all(|axis| {
            let [low, high] = quad.extent(axis);
            high - low < SMALL
        });
        if is_small {
            self.find_small(simd, quad, area);
            return QuadPosition::Within;
        }
        self.find_large(quad, area)
    }

    #[inline(always)]
    fn find_small<S: Simd>(&mut self, simd: S, quad: &Quad, area: &TileArea) {
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
        let bias = owns_boundary(right, down).select(I32::splat(simd, 0), I32::splat(simd, 1));
        let [x, y] = [area.origin[0] * 256, area.origin[1] * 256];
        let value = right * (I32::splat(simd, x) - from[0]) + down * (I32::splat(simd, y) - from[1]);
        let value = value - bias;
        let mut greatest = I32::splat(simd, i32::MIN);
        for (starts, &[x, y]) in self.starts.iter_mut().zip(self.pattern.offsets()) {
            let start = (value + right * x + down * y) >> 8;
            greatest = greatest.max(start);
            *starts = start.into();
        }
        (self.right, self.down, self.greatest) = (right.into(), down.into(), greatest.into());
    }

    #[inline(never)]
    fn find_large(&mut self, quad: &Quad, area: &TileArea) -> QuadPosition {
        let [least, greatest] = self.pattern.reach();
        let first = area.origin.map(|v| v * 256 + least);
        let span = area.padded().map(|side| (side as i64 - 1) * 256 + i64::from(greatest - least));
        for (k, edge) in Edge::around(quad).into_iter().enumerate() {
            let value = edge.at(first) + edge.bias();
            let steps = [i64::from(edge.right), i64::from(edge.down)];
            let rise = steps[0].max(0) * span[0] + steps[1].max(0) * span[1];
            let fall = steps[0].min(0) * span[0] + steps[1].min(0) * span[1];
            let is_outside = value + rise < 0;
            if is_outside && k != DIAGONAL {
                return QuadPosition::Beside;
            }
            if is_outside || value + fall >= 0 {
                // All of the tile lies on one side of the edge, so a constant with the right sign is
                // enough: 0 inside, −1 outside. Only the diagonal can be outside here; then all samples
                // are in the second triangle.
                self.set(k, [0; 2], |_| if is_outside { -1 } else { 0 });
            } else if (rise - fall) >> 8 >= i64::from(i32::MAX) {
                return QuadPosition::TooLong;
            } else {
                // The edge crosses the tile, so no value in it is further from 0 than the span.
                let at = |[x, y]: [i32; 2]| {
                    let way = [i64::from(x - least), i64::from(y - least)];
                    ((value + steps[0] * way[0] + steps[1] * way[1]) >> 8) as i32
                };
                self.set(k, [edge.right, edge.down], at);
            }
        }
        QuadPosition::Within
    }

    #[inline(always)]
    fn set(&mut self, k: usize, steps: [i32; 2], at: impl Fn([i32; 2]) -> i32) {
        [self.right[k], self.down[k]] = steps;
        self.greatest[k] = i32::MIN;
        for (starts, &offset) in self.starts.iter_mut().zip(self.pattern.offsets()) {
            starts[k] = at(offset);
            self.greatest[k] = self.greatest[k].max(starts[k]);
        }
    }

    /// Their steps within a group, a vector for each.
    #[inline(always)]
    pub(super) fn lanes<S: Simd>(&self, simd: S) -> [I32<S>; EDGES] {
        let (x, y) = (lane_numbers(simd) & 3, lane_numbers(simd) >> 2);
        [0, 1, 2, 3, 4].each(
            #[inline(always)]
            |k| x * self.right[k] + y * self.down[k],
        )
    }
}

/// Between which pixels across the major axis an outline may lie, group by group along it.
pub(super) struct OutlineStrip {
    /// The first and the last pixel from the tile's, times 2^24.
    first: i64,
    last: i64,
    /// What both change by from group to group.
    step: i64,
}

impl OutlineStrip {
    /// From a group on, that with this number along the major axis.
    #[inline(always)]
    pub(super) fn new(
        quad: &Quad,
        pattern: SamplePattern,
        area: &TileArea,
        major: usize,
        group: i32,
    ) -> Self {
        const UNIT: f64 = (1 << 16) as f64;
        // In 1/256 pixel: the corners were rounded to this grid, by at most one; all that is rounded below is
        // less than one.
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
    pub(super) fn next(&mut self, [first, last]: [i32; 2], shift: i32) -> std::ops::Range<i32> {
        let first = ((self.first >> 24) as i32).max(first);
        let last = ((self.last >> 24) as i32).min(last);
        self.first += self.step;
        self.last += self.step;
        first >> shift..(last >> shift) + 1
    }
}

/// Bits of the number of a pixel's column and row that tell it from others of its group.
pub(super) const SHIFT: [i32; 2] = [2, 1];
