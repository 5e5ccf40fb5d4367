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

use super::buffer::VisibilityBuffer;
use super::cover::{Counts, Cover};
use super::store::store_places_where;
use super::{DepthPlane, Edge, TileArea};
use crate::samples::{MAX_SAMPLES, SamplePattern};
use crate::setup::{Kind, Quad};
use crate::simd::{Each, F32, I32, Mask, Simd, U32, lane_numbers, prelude::*};

/// From this width on, in 1/256 pixel, it pays to ask whole blocks, as for triangles.
const WIDE: i32 = 32 * 256;

/// The last of the edges: not one of the outline.
const DIAGONAL: usize = 4;

/// How a line or a point lies in a tile.
enum Place {
    /// It has no sample in it.
    Beside,
    Within,
    /// Its edge functions do not fit 32 bits there.
    TooLong,
}

/// The edge functions of a line or a point in a tile, over 256 and rounded down as those of
/// [`Covering`](super::Covering): of the outline, and of the diagonal.
pub(super) struct QuadEdges {
    right: [i32; 5],
    down: [i32; 5],
    /// For each sample of a pixel the values at the tile's first pixel.
    starts: [[i32; 5]; MAX_SAMPLES],
    /// The greatest of those.
    greatest: [i32; 5],
}

impl QuadEdges {
    pub(super) fn new() -> Self {
        Self { right: [0; 5], down: [0; 5], starts: [[0; 5]; MAX_SAMPLES], greatest: [0; 5] }
    }

    /// Finds them for one tile.
    fn find(&mut self, quad: &Quad, pattern: SamplePattern, area: &TileArea) -> Place {
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

    /// At the pixels of a group, but for what the samples add. Partial sums may wrap around; the
    /// sum fits.
    #[inline(always)]
    fn at<S: Simd>(&self, lanes: &[I32<S>; 5], [x, y]: [i32; 2]) -> [I32<S>; 5] {
        [0, 1, 2, 3, 4].each(
            #[inline(always)]
            |k| lanes[k] + self.right[k].wrapping_mul(x).wrapping_add(self.down[k].wrapping_mul(y)),
        )
    }

    /// Their steps within a group.
    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S) -> [I32<S>; 5] {
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
    fn new(quad: &Quad, pattern: SamplePattern, area: &TileArea, (major, group): (usize, i32)) -> Self {
        const UNIT: f64 = (1 << 16) as f64;
        // More than all that is rounded, a unit where the corners were, and less than one below.
        const SLACK: f64 = 2.0;
        let minor = 1 - major;
        let pixels = GROUP[major];
        let [least, greatest] = pattern.reach();
        let [[a, b], [d, c]] = quad.corners;
        let slope = f64::from(d[minor] - a[minor]) / f64::from(d[major] - a[major]);
        let along = (area.origin[major] + group * pixels) * 256 + least;
        let low = f64::from(a[minor] - area.origin[minor] * 256) + slope * f64::from(along - a[major]);
        let rise = slope * f64::from((pixels - 1) * 256 + greatest - least);
        let (below, above) = if rise < 0.0 { (rise, 0.0) } else { (0.0, rise) };
        let width = f64::from((b[minor] - a[minor]).max(c[minor] - d[minor]));
        Self {
            first: ((low + below - SLACK + f64::from(255 - greatest)) * UNIT) as i64,
            last: ((low + above + width + SLACK - f64::from(least)) * UNIT) as i64,
            step: (slope * f64::from(pixels * 256) * UNIT) as i64,
        }
    }

    /// The groups of the next pixels along the major axis, within a range of pixels.
    #[inline(always)]
    fn next(&mut self, [first, last]: [i32; 2], pixels: i32) -> std::ops::Range<i32> {
        let first = ((self.first >> 24) as i32).max(first);
        let last = ((self.last >> 24) as i32).min(last);
        self.first += self.step;
        self.last += self.step;
        first / pixels..(last + pixels) / pixels
    }
}

/// Pixels in a row and a column of a group.
const GROUP: [i32; 2] = [4, 2];

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

/// What the samples of a line or a point are compared with.
struct Fill<'q> {
    edges: &'q QuadEdges,
    disc: Option<Disc>,
    /// The depth of all, or the planes of both triangles.
    depth: f32,
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
        if self.tile_hides(buffer, quad.nearest()) {
            counts.tiles_rejected += 1;
            return true;
        }
        let [[a, b], [d, c]] = quad.corners;
        let major = usize::from(a[0] != b[0]);
        if (b[1 - major] - a[1 - major]).max(c[1 - major] - d[1 - major]) >= WIDE {
            return false;
        }
        let Some(pixels) = pixels_in(quad, pattern, &self.area) else { return true };
        match edges.find(quad, pattern, &self.area) {
            Place::Beside => return true,
            Place::TooLong => return false,
            Place::Within => {}
        }
        buffer.settle();
        let fill = Fill {
            edges,
            disc: (quad.kind == Kind::RoundPoint).then(|| Disc::new(quad, &self.area)),
            depth: quad.depths[0],
            planes: (quad.depths[0] != quad.depths[1]).then(|| [0, 1].map(|i| DepthPlane::of(&quad.half(i)))),
            place,
        };
        // Apart, so that it takes no registers where there are only triangles.
        simd.vectorize(
            #[inline(always)]
            || {
                let lanes = fill.edges.lanes(simd);
                let groups = [pixels[major][0] / GROUP[major], pixels[major][1] / GROUP[major]];
                let mut strip = Strip::new(quad, pattern, &self.area, (major, groups[0]));
                let mut noted = usize::MAX;
                for along in groups[0]..groups[1] + 1 {
                    for across in strip.next(pixels[1 - major], GROUP[1 - major]) {
                        let at = if major == 0 { [along, across] } else { [across, along] };
                        let group = TileArea::group_of(at.each(
                            #[inline(always)]
                            |v| v as usize,
                        ));
                        let block = group / super::area::GROUPS;
                        if self.hierarchical && self.hides(buffer.blocks[block].farthest, quad.nearest()) {
                            continue;
                        }
                        counts.groups += 1;
                        let first = [at[0] * GROUP[0], at[1] * GROUP[1]];
                        let wrote = self.group::<S, MULTI>(simd, &fill, &lanes, (group, first), buffer);
                        if wrote && block != noted {
                            buffer.note_write(block, quad.nearest());
                            noted = block;
                        }
                    }
                }
            },
        );
        true
    }

    /// Lets the samples of a group compete; whether any was written.
    #[inline(always)]
    fn group<S: Simd, const MULTI: bool>(
        &self,
        simd: S,
        fill: &Fill<'_>,
        lanes: &[I32<S>; 5],
        (group, first): (usize, [i32; 2]),
        buffer: &mut VisibilityBuffer,
    ) -> bool {
        let edges = fill.edges.at(lanes, first);
        if MULTI && !inside(simd, edges, fill.edges.greatest).any_true() {
            return false;
        }
        let samples = if MULTI { buffer.samples } else { 1 };
        let mut wrote = false;
        for sample in 0..samples {
            let starts = fill.edges.starts[sample];
            let mut covered = inside(simd, edges, starts);
            if let Some(disc) = &fill.disc {
                covered &= disc.covers(simd, first, self.offsets[sample]);
            }
            if !covered.any_true() {
                continue;
            }
            let is_first = (edges[DIAGONAL] + starts[DIAGONAL]).simd_ge(I32::splat(simd, 0));
            let depth = match &fill.planes {
                None => F32::splat(simd, fill.depth),
                Some([a, b]) => {
                    let point = self.area.point(first, self.offsets[sample]);
                    is_first.select(a.group(simd, point), b.group(simd, point))
                }
            };
            let at = (group * samples + sample) * crate::simd::LANES;
            let seen = self.seen(simd, fill.place, (covered, depth), buffer, at);
            if seen.any_true() {
                let places = is_first.select(U32::splat(simd, fill.place), U32::splat(simd, fill.place + 1));
                store_places_where(simd, seen, (places, depth), buffer, at);
                wrote = true;
            }
        }
        wrote
    }
}

/// Which pixels lie inside of the outline, with what a sample adds.
#[inline(always)]
fn inside<S: Simd>(simd: S, edges: [I32<S>; 5], starts: [i32; 5]) -> Mask<S> {
    let [a, b, c, d] = [0, 1, 2, 3].each(
        #[inline(always)]
        |k| edges[k] + starts[k],
    );
    (a | b | (c | d)).simd_ge(I32::splat(simd, 0))
}

/// The first and last columns and rows of the tile that may have a sample of a line or a point;
/// `None` if there are none.
fn pixels_in(quad: &Quad, pattern: SamplePattern, area: &TileArea) -> Option<[[i32; 2]; 2]> {
    let range = |axis: usize| {
        let [first, last] = pattern.pixels_between(quad.extent(axis))?;
        let first = (first - area.origin[axis]).max(0);
        let last = (last - area.origin[axis]).min(area.padded()[axis] as i32 - 1);
        (first <= last).then_some([first, last])
    };
    Some([range(0)?, range(1)?])
}
