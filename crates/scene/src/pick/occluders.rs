//! Triangles that may hide points, and the quick tests before the exact one.
//!
//! Most points in the pixels around a triangle lie beside it or in front of it. Comparing slightly enlarged
//! f32 boxes rejects nearly all of them. Consecutive triangles are mostly neighbours, so a few of them test
//! the points around them together.

use std::ops::Range;

use super::screen::{Screen, Spot};

/// By how much a triangle's box is enlarged before points in f32 are held against it, in
/// pixels: more than what f32 rounds of coordinates up to 65,536, of both.
const ROUNDED: f64 = 1.0 / 64.0;

/// Triangles in a group.
const MOST: usize = 8;

/// Points that are asked together.
const TOGETHER: usize = 8;

/// What most triangles need to know of points, rounded: it takes a third of the memory. Number
/// by number, so that the compiler asks several points at once.
#[derive(Default)]
pub(super) struct Probes {
    at: [Vec<f32>; 2],
    /// Not nearer than the depth that hides each point.
    depth: Vec<f32>,
}

/// One of them.
pub(super) struct Probe {
    at: [f32; 2],
    depth: f32,
}

impl Probes {
    pub(super) fn new<'s>(screen: &Screen, spots: impl ExactSizeIterator<Item = &'s Spot>) -> Self {
        let room = spots.len() + TOGETHER;
        let mut probes = Self { at: [Vec::with_capacity(room), Vec::with_capacity(room)], ..Self::default() };
        probes.depth.reserve_exact(room);
        for spot in spots {
            let [x, y] = spot.at.to_array().map(|at| at as f32);
            probes.push([x, y], (screen.hiding_depth(spot.depth) as f32).next_down());
        }
        // What is asked together with the last ones: nothing is nearer.
        (0..TOGETHER).for_each(|_| probes.push([0.0; 2], f32::INFINITY));
        probes
    }

    fn push(&mut self, [x, y]: [f32; 2], depth: f32) {
        self.at[0].push(x);
        self.at[1].push(y);
        self.depth.push(depth);
    }

    pub(super) fn get(&self, number: usize) -> Probe {
        Probe { at: [self.at[0][number], self.at[1][number]], depth: self.depth[number] }
    }

    /// Calls `visit` with the numbers of points that triangles may hide, of some of them.
    #[inline]
    pub(super) fn for_each_hidden(
        &self,
        extent: &Extent,
        numbers: Range<usize>,
        mut visit: impl FnMut(usize),
    ) {
        let mut first = numbers.start;
        while first < numbers.end {
            let lists = [&self.at[0], &self.at[1], &self.depth].map(|list| list[first..].first_chunk());
            let [Some(x), Some(y), Some(depth)] = lists else { return };
            let mut bits = extent.may_hide_some([x, y, depth]);
            let count = numbers.end - first;
            if count < TOGETHER {
                bits &= (1 << count) - 1;
            }
            while bits != 0 {
                visit(first + bits.trailing_zeros() as usize);
                bits &= bits - 1;
            }
            first += TOGETHER;
        }
    }
}

/// What triangles hide at most.
#[derive(Clone, Copy)]
pub(super) struct Extent {
    min: [f32; 2],
    max: [f32; 2],
    /// Not farther than the nearest corner.
    nearest: f32,
}

impl Extent {
    fn new(piece: &[Spot; 3]) -> Self {
        let [a, b, c] = piece.map(|spot| spot.at);
        let (min, max) = (a.min(b).min(c) - ROUNDED, a.max(b).max(c) + ROUNDED);
        let nearest = piece.iter().fold(f64::NEG_INFINITY, |nearest, spot| nearest.max(spot.depth));
        let [min, max] = [min, max].map(|corner| corner.to_array().map(|at| at as f32));
        Self { min, max, nearest: (nearest as f32).next_up() }
    }

    fn union(&self, other: &Self) -> Self {
        Self {
            min: [0, 1].map(|axis| self.min[axis].min(other.min[axis])),
            max: [0, 1].map(|axis| self.max[axis].max(other.max[axis])),
            nearest: self.nearest.max(other.nearest),
        }
    }

    /// The points that the triangles may hide, a bit for each: no bit is a proof that they
    /// do not hide the point.
    #[inline(always)]
    fn may_hide_some(&self, [x, y, depth]: [&[f32; TOGETHER]; 3]) -> u32 {
        let mut bits = 0;
        for point in 0..TOGETHER {
            let is_near = (depth[point] < self.nearest)
                & (x[point] >= self.min[0])
                & (x[point] <= self.max[0])
                & (y[point] >= self.min[1])
                & (y[point] <= self.max[1]);
            bits |= u32::from(is_near) << point;
        }
        bits
    }
}

/// Extents of the triangles of a group, number by number.
struct Extents {
    min: [[f32; MOST]; 2],
    max: [[f32; MOST]; 2],
    nearest: [f32; MOST],
}

impl Extents {
    /// Of no triangles.
    const NONE: Self =
        Self { min: [[0.0; MOST]; 2], max: [[0.0; MOST]; 2], nearest: [f32::NEG_INFINITY; MOST] };

    fn set(&mut self, number: usize, extent: &Extent) {
        for axis in 0..2 {
            self.min[axis][number] = extent.min[axis];
            self.max[axis][number] = extent.max[axis];
        }
        self.nearest[number] = extent.nearest;
    }

    /// The triangles that may hide a point, a bit for each: no bit is a proof that the
    /// triangle does not.
    #[inline(always)]
    fn that_may_hide(&self, probe: &Probe) -> u32 {
        let mut bits = 0;
        for number in 0..MOST {
            let is_near = (probe.depth < self.nearest[number])
                & (probe.at[0] >= self.min[0][number])
                & (probe.at[0] <= self.max[0][number])
                & (probe.at[1] >= self.min[1][number])
                & (probe.at[1] <= self.max[1][number]);
            bits |= u32::from(is_near) << number;
        }
        bits
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

/// A triangle that may hide points.
pub(super) struct Occluder {
    pub(super) piece: [Spot; 3],
    pub(super) face: u32,
}

/// All triangles of a group.
pub(super) struct Around {
    pub(super) pixels: Pixels,
    pub(super) extent: Extent,
}

/// Triangles side by side.
pub(super) struct Group {
    occluders: Vec<Occluder>,
    extents: Extents,
    around: Option<Around>,
}

impl Group {
    pub(super) fn new() -> Self {
        Self { occluders: Vec::with_capacity(MOST), extents: Extents::NONE, around: None }
    }

    pub(super) fn clear(&mut self) {
        self.occluders.clear();
        self.extents = Extents::NONE;
        self.around = None;
    }

    /// Whether a triangle in these pixels belongs to the group: together they look at no more
    /// pixels than one after the other.
    pub(super) fn takes(&self, pixels: &Pixels) -> bool {
        let Some(around) = &self.around else { return true };
        let apart = around.pixels.count() + pixels.count();
        self.occluders.len() < MOST && around.pixels.union(pixels).count() <= apart
    }

    pub(super) fn push(&mut self, occluder: Occluder, pixels: Pixels) {
        let extent = Extent::new(&occluder.piece);
        self.around = Some(match &self.around {
            None => Around { pixels, extent },
            Some(around) => {
                Around { pixels: around.pixels.union(&pixels), extent: around.extent.union(&extent) }
            }
        });
        self.extents.set(self.occluders.len(), &extent);
        self.occluders.push(occluder);
    }

    /// The triangles that may hide a point.
    #[inline(always)]
    pub(super) fn that_may_hide(&self, probe: &Probe) -> impl Iterator<Item = &Occluder> {
        let mut bits = self.extents.that_may_hide(probe);
        std::iter::from_fn(move || {
            let number = bits.trailing_zeros() as usize;
            bits &= bits.wrapping_sub(1);
            self.occluders.get(number)
        })
    }

    /// What is around all of them; `None` of nothing.
    pub(super) fn around(&self) -> Option<&Around> {
        self.around.as_ref()
    }
}
