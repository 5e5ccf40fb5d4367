//! What is to be shaded of one draw in a tile: whole groups of pixels, and fragments of a list.
//!
//! Lists of fragments are columns: eight fragments need one load each for their triangles, their points and the
//! indices of their results.

use super::context::ShadePoint;
use super::records::Records;
use super::surface_point::SurfacePoint;
use crate::simd::{InlineMap, LANES, Mask, Simd, U32, append, lane_numbers, lanes_of, prelude::*};
use std::ops::Range;

/// A group of pixels, some of which show triangles of one draw.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Group {
    /// The record of one of its triangles.
    pub(crate) slot: u32,
    pub(crate) number: u32,
    /// The pixels whose first samples see the draw, by their lanes.
    pub(crate) lanes: u32,
    /// Those of them whose other samples do not all see the same.
    pub(crate) edges: u32,
}

/// The triangles that the pixels of groups show.
#[derive(Clone, Copy, Default)]
pub(crate) struct VisibleTriangles<'t> {
    /// One for each sample.
    pub(crate) triangles: &'t [u32],
    /// From group to group.
    pub(crate) step: usize,
}

/// What is to be shaded of one draw in a tile.
pub(crate) struct Task<'t> {
    pub(crate) records: &'t Records,
    /// The number of the first record.
    pub(crate) base: u32,
    pub(crate) groups: &'t [Group],
    pub(crate) visible: VisibleTriangles<'t>,
    /// The records of the tile's triangles.
    pub(crate) slots: &'t [u32],
    pub(crate) fragments: FragmentSlice<'t>,
    /// The points of the fragments, if something other than the rasterizer found them.
    pub(crate) points: Option<&'t [SurfacePoint]>,
}

/// Where the colours of a vector go.
#[derive(Clone, Copy)]
pub(crate) enum Destination<'t> {
    /// To eight indices from this one on, and whether some are edge pixels, which are needed in
    /// linear light. Lanes that are not active write as well; their outputs are overwritten later.
    Group(usize, bool),
    /// To the indices listed, one for each active lane.
    Listed(&'t [u32]),
}

/// Eight pixels or fragments to be shaded together, one in each lane.
pub(crate) struct FragmentBatch<'t, S: Simd> {
    /// The names of the records of the triangles that the lanes show. Unused lanes repeat the name
    /// of an active one, so that every lane has a record. In a group they keep their own pixels, which
    /// the triangle may not cover: their values are arbitrary.
    pub(crate) names: U32<S>,
    named: RecordNames<'t>,
    pub(crate) spots: U32<S>,
    /// The lanes whose results are used.
    pub(crate) active: u64,
    pub(crate) destination: Destination<'t>,
}

/// How records are named.
#[derive(Clone, Copy)]
enum RecordNames<'t> {
    /// By their numbers.
    Slots,
    /// By the visible triangles, whose slots are listed; and the number of the first record.
    Visible(&'t [u32], u32),
}

impl<'t, S: Simd> FragmentBatch<'t, S> {
    /// The number of the record that a name refers to.
    #[inline(always)]
    pub(crate) fn slot(&self, name: u32) -> u32 {
        match self.named {
            RecordNames::Slots => name,
            RecordNames::Visible(slots, base) => slots[name as usize] - base,
        }
    }

    /// The numbers of the lanes' records.
    #[inline(always)]
    pub(crate) fn slots(&self) -> [u32; LANES] {
        <[u32; LANES]>::from(self.names).each(
            #[inline(always)]
            |name| self.slot(name),
        )
    }

    /// Where the results of a list's fragments go; none for a group.
    #[inline(always)]
    pub(crate) fn outputs(&self) -> &'t [u32] {
        match self.destination {
            Destination::Group(..) => &[],
            Destination::Listed(outputs) => outputs,
        }
    }
}

impl<'t> Task<'t> {
    /// A list of fragments.
    pub(crate) fn of_fragments(records: &'t Records, base: u32, fragments: FragmentSlice<'t>) -> Self {
        let visible = VisibleTriangles::default();
        Self { records, base, groups: &[], visible, slots: &[], fragments, points: None }
    }

    /// How many vectors there are.
    #[inline(always)]
    pub(crate) fn vectors(&self) -> usize {
        self.groups.len() + self.fragments.len().div_ceil(LANES)
    }

    /// One of the vectors.
    #[inline(always)]
    pub(crate) fn vector<S: Simd>(&self, simd: S, number: usize) -> FragmentBatch<'t, S> {
        match self.groups.get(number) {
            Some(group) => self.group(simd, group),
            None => self.listed(simd, (number - self.groups.len()) * LANES),
        }
    }

    #[inline(always)]
    fn group<S: Simd>(&self, simd: S, group: &Group) -> FragmentBatch<'t, S> {
        let VisibleTriangles { triangles, step } = self.visible;
        let visible =
            triangles[group.number as usize * step..].first_chunk().expect("a group has eight pixels");
        let active = u64::from(group.lanes);
        let spare = U32::splat(simd, visible[group.lanes.trailing_zeros() as usize % LANES]);
        let names = Mask::from_bitmask(simd, active).select(U32::simd_from(simd, *visible), spare);
        let pixel = group.number as usize * LANES;
        let mut spots = (lane_numbers(simd) + pixel as i32).bitcast();
        if group.edges != 0 {
            spots = Mask::from_bitmask(simd, u64::from(group.edges))
                .select(ShadePoint::covering_lanes(spots, 0), spots);
        }
        FragmentBatch {
            names,
            named: RecordNames::Visible(self.slots, self.base),
            spots,
            active,
            destination: Destination::Group(pixel, group.edges != 0),
        }
    }

    #[inline(always)]
    fn listed<S: Simd>(&self, simd: S, first: usize) -> FragmentBatch<'t, S> {
        let FragmentSlice { slots, spots, outputs } = self.fragments.part(first..first + LANES);
        FragmentBatch {
            names: U32::simd_from(simd, first_eight(slots)) - self.base,
            named: RecordNames::Slots,
            spots: U32::simd_from(simd, first_eight(spots)),
            active: (1 << outputs.len()) - 1,
            destination: Destination::Listed(outputs),
        }
    }
}

/// Up to eight numbers as lanes; unused lanes repeat the first.
#[inline(always)]
fn first_eight(numbers: &[u32]) -> [u32; LANES] {
    match numbers.first_chunk() {
        Some(eight) => *eight,
        None => lanes_of(
            #[inline(always)]
            |lane| *numbers.get(lane).unwrap_or(&numbers[0]),
        ),
    }
}

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
