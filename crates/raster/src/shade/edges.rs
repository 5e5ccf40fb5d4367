//! Edge pixels: pixels whose samples show different triangles.

use crate::fragments::{FragmentList, ShadePoint};
use crate::simd::{LANES, Mask, Simd, U32, lane_numbers, prelude::*};
use crate::tile_buffer::{NO_TRIANGLE, PIXELS};

/// The index of the colour behind all triangles.
pub(crate) const BEHIND: usize = PIXELS;

/// The first index of a colour that only some samples of a pixel have.
const PARTS: usize = PIXELS + 1;

/// No colour's name.
const UNNAMED: u32 = u32::MAX;

/// The pixels of a tile whose samples see different triangles, and the names of their
/// samples' colours: the indices where they lie.
pub(crate) struct Edges {
    groups: Vec<EdgeGroup>,
    /// Group by group, sample by sample; and room for more.
    names: Vec<[u32; LANES]>,
    samples: usize,
    /// How many colours have an index of their own, beside those of pixels.
    parts: usize,
}

/// A group with such pixels.
#[derive(Clone, Copy)]
pub(crate) struct EdgeGroup {
    pub(crate) number: u32,
    /// Those pixels.
    pub(crate) lanes: u32,
}

impl EdgeGroup {
    /// The pixels, by their lanes.
    #[inline(always)]
    pub(crate) fn lanes(self) -> impl Iterator<Item = usize> {
        let mut rest = self.lanes;
        std::iter::from_fn(move || {
            let lane = (rest != 0).then_some(rest.trailing_zeros() as usize % LANES)?;
            rest &= rest - 1;
            Some(lane)
        })
    }
}

impl Edges {
    pub(super) fn new() -> Self {
        Self { groups: Vec::new(), names: Vec::new(), samples: 1, parts: 0 }
    }

    pub(super) fn clear(&mut self, samples: usize) {
        (self.samples, self.parts) = (samples, 0);
        self.forget();
        let most = PIXELS / LANES * samples;
        if samples > 1 && self.names.len() < most {
            self.names.resize(most, [0; LANES]);
        }
    }

    /// Leaves no pixel in it.
    pub(crate) fn forget(&mut self) {
        self.groups.clear();
    }

    /// How many colours have an index of their own.
    pub(super) fn part_count(&self) -> usize {
        self.parts
    }

    /// How many colours there is memory for.
    pub(super) fn color_count(&self) -> usize {
        PARTS + self.parts
    }

    /// The groups, each with the names of its samples' colours, sample by sample.
    #[inline(always)]
    pub(crate) fn iter(&self) -> impl Iterator<Item = (EdgeGroup, &[[u32; LANES]])> {
        self.groups.iter().copied().zip(self.names.chunks_exact(self.samples))
    }

    /// Lists pixels of a group whose samples show different triangles. The pixels' own slots get the colours
    /// of their first samples, the colour of each other triangle gets a slot of its own, and the samples
    /// refer to these slots.
    #[inline(always)]
    pub(super) fn push<S: Simd>(
        &mut self,
        simd: S,
        group: usize,
        rows: &[[u32; LANES]],
        lanes: u64,
        parts: &mut FragmentList,
    ) {
        let pixel = group * LANES;
        let names = &mut self.names[self.groups.len() * rows.len()..][..rows.len()];
        self.groups.push(EdgeGroup { number: group as u32, lanes: lanes as u32 });
        let (no_triangle, behind) = (U32::splat(simd, NO_TRIANGLE), U32::splat(simd, BEHIND as u32));
        let pixels = (lane_numbers(simd) + pixel as i32).bitcast::<U32<S>>();
        let listed = Mask::from_bitmask(simd, lanes);
        names[0] = U32::simd_from(simd, rows[0]).simd_eq(no_triangle).select(behind, pixels).into();
        for sample in 1..rows.len() {
            let visible = U32::simd_from(simd, rows[sample]);
            let unnamed = U32::splat(simd, UNNAMED);
            let mut name = visible.simd_eq(no_triangle).select(behind, unnamed);
            for (row, names) in rows[..sample].iter().zip(&names[..sample]) {
                name = visible.simd_eq(U32::simd_from(simd, *row)).select(U32::simd_from(simd, *names), name);
            }
            // All lanes without a name at once: how many there are is hard to predict.
            let others = name.simd_eq(unnamed) & listed;
            let indices = (lane_numbers(simd) + (PARTS + self.parts) as i32).bitcast::<U32<S>>();
            parts.push_some(others, [visible, ShadePoint::covering_lanes(pixels, sample)], indices);
            self.parts += others.to_bitmask().count_ones() as usize;
            names[sample] = indices.expand_merge(others, name).into();
        }
    }
}
