//! Triangles that may hide points, and the points as triangles test them. Consecutive triangles are mostly neighbours, so
//! a few of them test the points around them together.

use std::ops::Range;

use trigon_math::DVec2;
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, InlineMap, LANES, Simd, inlined};

use super::screen::{Screen, Spot};

/// By how much a box around triangles is enlarged before points in f32 are held against it, in
/// pixels: more than what f32 rounds of coordinates up to 65,536, of both.
const ROUNDED: f64 = 1.0 / 64.0;

/// Triangles in a group.
const MOST: usize = LANES;

/// What triangles hide at most.
#[derive(Clone, Copy)]
pub(super) struct Extent {
    min: DVec2,
    max: DVec2,
    /// The depth of the nearest corner.
    nearest: f64,
}

impl Extent {
    #[inline]
    pub(super) fn new(piece: &[Spot; 3]) -> Self {
        let [a, b, c] = piece;
        Self {
            min: a.at.min(b.at).min(c.at),
            max: a.at.max(b.at).max(c.at),
            nearest: a.depth.max(b.depth).max(c.depth),
        }
    }

    fn union(&self, other: &Self) -> Self {
        Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
            nearest: self.nearest.max(other.nearest),
        }
    }

    /// The pixels that it touches among those of an area, counted from the area's first; `None` where it
    /// lies beside the area.
    #[inline]
    pub(super) fn pixels(&self, columns: &Range<u32>, rows: &Range<u32>) -> Option<Pixels> {
        let within = |min: f64, max: f64, pixels: &Range<u32>| {
            // The casts saturate.
            let (start, end) =
                ((min as u32).max(pixels.start), (max as u32).saturating_add(1).min(pixels.end));
            (max >= 0.0 && start < end).then(|| start - pixels.start..end - pixels.start)
        };
        let (columns, rows) =
            (within(self.min.x, self.max.x, columns)?, within(self.min.y, self.max.y, rows)?);
        Some(Pixels { columns, rows })
    }

    /// The points that the triangles may hide, a bit for each: no bit is a proof that they do not hide
    /// the point. Each is given by x, y, and a depth not nearer than that which hides it.
    #[inline(always)]
    pub(super) fn may_hide_some<S: Simd>(&self, simd: S, [x, y, depth]: [F32<S>; 3]) -> u64 {
        let splat = inlined(
            #[inline(always)]
            |value: f64| F32::splat(simd, value as f32),
        );
        let is_near = depth.simd_lt(F32::splat(simd, (self.nearest as f32).next_up()))
            & x.simd_ge(splat(self.min.x - ROUNDED))
            & x.simd_le(splat(self.max.x + ROUNDED))
            & y.simd_ge(splat(self.min.y - ROUNDED))
            & y.simd_le(splat(self.max.y + ROUNDED));
        is_near.to_bitmask()
    }
}

/// Some pixels of an area, counted from its first.
#[derive(Clone)]
pub(super) struct Pixels {
    pub(super) columns: Range<u32>,
    pub(super) rows: Range<u32>,
}

impl Pixels {
    fn union(&self, other: &Self) -> Self {
        let around = |a: &Range<u32>, b: &Range<u32>| a.start.min(b.start)..a.end.max(b.end);
        Self { columns: around(&self.columns, &other.columns), rows: around(&self.rows, &other.rows) }
    }

    fn count(&self) -> usize {
        self.columns.len() * self.rows.len()
    }
}

/// All triangles of a group.
pub(super) struct Around {
    pub(super) pixels: Pixels,
    pub(super) extent: Extent,
}

/// The corners of triangles, number by number.
pub(super) struct Pieces {
    pub(super) x: [[f64; MOST]; 3],
    pub(super) y: [[f64; MOST]; 3],
    pub(super) depth: [[f64; MOST]; 3],
}

/// Triangles side by side.
pub(super) struct Group {
    pub(super) pieces: Pieces,
    faces: [u32; MOST],
    count: usize,
    around: Option<Around>,
}

impl Group {
    pub(super) fn new() -> Self {
        let none = [[0.0; MOST]; 3];
        Self { pieces: Pieces { x: none, y: none, depth: none }, faces: [0; MOST], count: 0, around: None }
    }

    pub(super) fn clear(&mut self) {
        self.count = 0;
        self.around = None;
    }

    /// Whether a triangle in these pixels belongs to the group: together they look at no more
    /// pixels than one after the other.
    #[inline]
    pub(super) fn takes(&self, pixels: &Pixels) -> bool {
        let Some(around) = &self.around else { return true };
        let apart = around.pixels.count() + pixels.count();
        self.count < MOST && around.pixels.union(pixels).count() <= apart
    }

    #[inline]
    pub(super) fn push(&mut self, piece: &[Spot; 3], face: u32, extent: Extent, pixels: Pixels) {
        self.around = Some(match &self.around {
            None => Around { pixels, extent },
            Some(around) => {
                Around { pixels: around.pixels.union(&pixels), extent: around.extent.union(&extent) }
            }
        });
        for (corner, spot) in piece.iter().enumerate() {
            self.pieces.x[corner][self.count] = spot.at.x;
            self.pieces.y[corner][self.count] = spot.at.y;
            self.pieces.depth[corner][self.count] = spot.depth;
        }
        self.faces[self.count] = face;
        self.count += 1;
    }

    /// The triangles, a bit for each.
    pub(super) fn bits(&self) -> u64 {
        (1 << self.count) - 1
    }

    /// One of them, and the face that it belongs to.
    pub(super) fn get(&self, number: usize) -> ([Spot; 3], u32) {
        let Pieces { x, y, depth } = &self.pieces;
        let spot = |corner: usize| Spot {
            at: DVec2::new(x[corner][number], y[corner][number]),
            depth: depth[corner][number],
        };
        ([0, 1, 2].map(spot), self.faces[number])
    }

    /// What is around all of them; `None` of nothing.
    pub(super) fn around(&self) -> Option<&Around> {
        self.around.as_ref()
    }
}

impl Pieces {
    /// The corners of one triangle: x, y and depth of each, counted from some.
    #[inline(always)]
    pub(super) fn corners(&self, number: usize, origin: DVec2, depth: f64) -> [[f64; 3]; 3] {
        [0, 1, 2].each(
            #[inline(always)]
            |corner: usize| {
                let (x, y) = (self.x[corner][number], self.y[corner][number]);
                [x - origin.x, y - origin.y, self.depth[corner][number] - depth]
            },
        )
    }
}

/// What triangles need to know of points. Rounded, number by number, so that several points are asked at once;
/// and exactly, for the few that are left.
#[derive(Default)]
pub(super) struct Probes {
    at: [Vec<f32>; 2],
    /// Not nearer than the depth that hides each point.
    depth: Vec<f32>,
    exact: Vec<Probe>,
}

/// One of them.
#[derive(Clone, Copy)]
pub(super) struct Probe {
    pub(super) at: DVec2,
    /// Whatever is nearer hides it.
    pub(super) hiding_depth: f64,
}

impl Probes {
    pub(super) fn new<'s>(screen: &Screen, spots: impl ExactSizeIterator<Item = &'s Spot>) -> Self {
        let capacity = spots.len() + LANES;
        let list = || Vec::with_capacity(capacity);
        let mut probes = Self { at: [list(), list()], depth: list(), exact: Vec::with_capacity(capacity) };
        for spot in spots {
            let [x, y] = spot.at.to_array().map(|at| at as f32);
            let hiding_depth = screen.hiding_depth(spot.depth);
            probes.push([x, y], (hiding_depth as f32).next_down());
            probes.exact.push(Probe { at: spot.at, hiding_depth });
        }
        // What is asked together with the last ones: nothing is nearer.
        (0..LANES).for_each(|_| probes.push([0.0; 2], f32::INFINITY));
        probes
    }

    fn push(&mut self, [x, y]: [f32; 2], depth: f32) {
        self.at[0].push(x);
        self.at[1].push(y);
        self.depth.push(depth);
    }

    #[inline(always)]
    pub(super) fn get(&self, number: usize) -> &Probe {
        &self.exact[number]
    }

    /// Calls `visit` with the numbers of points that triangles may hide, of some of them.
    #[inline(always)]
    pub(super) fn for_each_hidden<S: Simd>(
        &self,
        simd: S,
        extent: &Extent,
        numbers: Range<usize>,
        mut visit: impl FnMut(usize),
    ) {
        let mut first = numbers.start;
        while first < numbers.end {
            let lists = [&self.at[0], &self.at[1], &self.depth].each(
                #[inline(always)]
                |list| list[first..].first_chunk::<LANES>(),
            );
            let [Some(x), Some(y), Some(depth)] = lists else { return };
            let point = [x, y, depth].each(
                #[inline(always)]
                |values| F32::simd_from(simd, *values),
            );
            let mut bits = extent.may_hide_some(simd, point);
            let count = numbers.end - first;
            if count < LANES {
                bits &= (1 << count) - 1;
            }
            while bits != 0 {
                visit(first + bits.trailing_zeros() as usize);
                bits &= bits - 1;
            }
            first += LANES;
        }
    }
}
