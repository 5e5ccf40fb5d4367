//! Points as triangles ask for them.

use std::ops::Range;

use trigon_math::DVec2;
use trigon_raster::simd::{F32, InlineMap, LANES, Simd, prelude::*};

use super::occluders::Extent;
use super::screen::{Screen, Spot};

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
