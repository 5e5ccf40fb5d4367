//! Lists of fragments, in columns: eight fragments need one load each for their triangles, their points and the
//! indices of their results.

use super::context::ShadePoint;
use crate::simd::{Mask, Simd, U32, append, prelude::*};
use std::ops::Range;

/// Fragments in a list, each with the record of its triangle.
#[derive(Default)]
pub(crate) struct FragmentList {
    slots: Vec<u32>,
    spots: Vec<u32>,
    outputs: Vec<u32>,
    /// For sorting.
    rows: Vec<[u32; 3]>,
}

/// Some neighbours of a list.
#[derive(Clone, Copy, Default)]
pub(crate) struct FragmentSlice<'l> {
    /// The records of their triangles.
    pub(crate) slots: &'l [u32],
    /// See [`ShadePoint::spot`].
    pub(crate) spots: &'l [u32],
    /// Where the results go.
    pub(crate) outputs: &'l [u32],
}

impl FragmentList {
    pub(crate) fn clear(&mut self) {
        self.slots.clear();
        self.spots.clear();
        self.outputs.clear();
    }

    #[inline(always)]
    pub(crate) fn push(&mut self, slot: u32, point: ShadePoint) {
        self.slots.push(slot);
        self.spots.push(point.spot());
        self.outputs.push(point.output);
    }

    /// Appends some of eight fragments; their results go to the first of `outputs`, one
    /// after the other.
    #[inline(always)]
    pub(crate) fn push_some<S: Simd>(&mut self, mask: Mask<S>, [slots, spots]: [U32<S>; 2], outputs: U32<S>) {
        let count = mask.to_bitmask().count_ones() as usize;
        let columns = [slots.compress(mask), spots.compress(mask), outputs];
        for (list, column) in [&mut self.slots, &mut self.spots, &mut self.outputs].into_iter().zip(columns) {
            append(list, &column.into(), count);
        }
    }

    /// The triangles' records.
    pub(crate) fn slots(&self) -> &[u32] {
        &self.slots
    }

    pub(crate) fn slots_mut(&mut self) -> &mut [u32] {
        &mut self.slots
    }

    /// Sorts by the triangles' records.
    pub(crate) fn sort(&mut self) {
        let Self { slots, spots, outputs, rows } = self;
        rows.clear();
        rows.extend((0..slots.len()).map(|i| [slots[i], spots[i], outputs[i]]));
        rows.sort_unstable_by_key(|row| row[0]);
        for (i, &[slot, spot, output]) in rows.iter().enumerate() {
            (slots[i], spots[i], outputs[i]) = (slot, spot, output);
        }
    }

    /// Some of them.
    pub(crate) fn part(&self, range: Range<usize>) -> FragmentSlice<'_> {
        self.all().part(range)
    }

    pub(crate) fn all(&self) -> FragmentSlice<'_> {
        FragmentSlice { slots: &self.slots, spots: &self.spots, outputs: &self.outputs }
    }
}

impl<'l> FragmentSlice<'l> {
    #[inline(always)]
    pub(crate) fn len(self) -> usize {
        self.slots.len()
    }

    /// The part of a range that exists.
    #[inline(always)]
    pub(crate) fn part(self, range: Range<usize>) -> Self {
        let range = range.start..range.end.min(self.len());
        Self {
            slots: &self.slots[range.clone()],
            spots: &self.spots[range.clone()],
            outputs: &self.outputs[range],
        }
    }
}
