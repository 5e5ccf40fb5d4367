//! What is to be shaded of one draw in a tile: whole groups of pixels, and
//! fragments of a list.

use super::{Records, Work};
use crate::simd::{LANES, Simd, U32, lane_numbers, lanes_of, prelude::*};
use crate::tile::NOBODY;

/// A fragment of a list, with the record of its triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fragment {
    pub(crate) slot: u32,
    pub(crate) work: Work,
}

/// A group of pixels that see one draw, or the background.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Group {
    /// The record of one of its triangles.
    pub(crate) slot: u32,
    pub(crate) number: u32,
}

/// What is to be shaded of one draw in a tile.
pub(crate) struct Task<'t> {
    pub(crate) records: &'t Records,
    /// The number of the first record.
    pub(crate) base: u32,
    pub(crate) groups: &'t [Group],
    /// What the pixels of groups see: from group to group so many.
    pub(crate) winners: (&'t [u32], usize),
    /// The records of the tile's triangles.
    pub(crate) slots: &'t [u32],
    pub(crate) fragments: &'t [Fragment],
}

/// Where the colours of a vector go.
#[derive(Clone, Copy)]
pub(crate) enum Destination<'t> {
    /// To eight places from this one on; what those get that see nothing will be
    /// written over.
    Group(usize),
    Listed(&'t [Fragment]),
}

/// Eight pixels to be shaded together.
pub(super) struct Vector<'t> {
    pub(super) slots: [u32; LANES],
    pub(super) spots: [u32; LANES],
    /// The lanes that are asked for.
    pub(super) active: u64,
    pub(super) destination: Destination<'t>,
}

impl<'t> Vector<'t> {
    /// The fragments of a list; none for a group.
    #[inline(always)]
    pub(super) fn fragments(&self) -> &'t [Fragment] {
        match self.destination {
            Destination::Group(_) => &[],
            Destination::Listed(fragments) => fragments,
        }
    }
}

impl<'t> Task<'t> {
    /// A list of fragments.
    pub(crate) fn of_fragments(records: &'t Records, base: u32, fragments: &'t [Fragment]) -> Self {
        Self { records, base, groups: &[], winners: (&[], 0), slots: &[], fragments }
    }

    /// How many vectors there are.
    #[inline(always)]
    pub(super) fn vectors(&self) -> usize {
        self.groups.len() + self.fragments.len().div_ceil(LANES)
    }

    /// One of the vectors.
    #[inline(always)]
    pub(super) fn vector<S: Simd>(&self, simd: S, number: usize) -> Vector<'t> {
        match self.groups.get(number) {
            Some(group) => self.group(simd, group),
            None => self.listed((number - self.groups.len()) * LANES),
        }
    }

    #[inline(always)]
    fn group<S: Simd>(&self, simd: S, group: &Group) -> Vector<'t> {
        let (winners, step) = self.winners;
        let winners = &winners[group.number as usize * step..][..LANES];
        let first = winners[0];
        let lanes = U32::from_slice(simd, winners);
        let pixel = group.number as usize * LANES;
        let same = lanes.simd_eq(U32::splat(simd, first)).all_true();
        Vector {
            slots: if same {
                [group.slot - self.base; LANES]
            } else {
                lanes_of(
                    #[inline(always)]
                    |lane| self.slots.get(winners[lane] as usize).copied().unwrap_or(group.slot) - self.base,
                )
            },
            spots: (lane_numbers(simd) + pixel as i32).bitcast::<U32<S>>().into(),
            active: !lanes.simd_eq(U32::splat(simd, NOBODY)).to_bitmask() & 0xff,
            destination: Destination::Group(pixel),
        }
    }

    #[inline(always)]
    fn listed(&self, first: usize) -> Vector<'t> {
        let fragments = &self.fragments[first..self.fragments.len().min(first + LANES)];
        // Lanes to spare repeat the first.
        let lane = |lane: usize| fragments.get(lane).unwrap_or(&fragments[0]);
        Vector {
            slots: lanes_of(
                #[inline(always)]
                |number| lane(number).slot - self.base,
            ),
            spots: lanes_of(
                #[inline(always)]
                |number| lane(number).work.spot(),
            ),
            active: (1 << fragments.len()) - 1,
            destination: Destination::Listed(fragments),
        }
    }
}
