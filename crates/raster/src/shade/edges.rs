//! Pixels whose samples see different triangles.

use super::Work;
use super::shading::Shading;
use super::task::Fragment;
use crate::simd::{LANES, Mask, Simd, U32, lane_numbers, prelude::*};
use crate::tile::{NOBODY, PIXELS};

/// A group with pixels whose samples see different triangles.
#[derive(Clone, Copy)]
pub(crate) struct EdgeGroup {
    pub(crate) number: u32,
    /// Those pixels.
    lanes: u32,
    /// Where the colours of its samples are named, sample by sample.
    first: u32,
}

impl EdgeGroup {
    /// The pixels, by their lanes.
    pub(crate) fn lanes(self) -> impl Iterator<Item = usize> {
        (0..LANES).filter(move |lane| self.lanes >> lane & 1 != 0)
    }

    /// For each sample the names of the pixels' colours: an index, or nobody.
    pub(crate) fn names(self, shading: &Shading, samples: usize) -> &[[u32; LANES]] {
        &shading.sample_colors[self.first as usize..][..samples]
    }
}

/// Lists pixels of a group whose samples see different triangles. Their own places
/// get the colours of what their first samples see, each other triangle's colour a
/// place of its own, and the samples name theirs.
#[inline(always)]
pub(super) fn push_edges<S: Simd>(
    simd: S,
    shading: &mut Shading,
    (group, rows): (usize, &[u32]),
    lanes: u64,
) {
    let Shading { slots, parts, edge_groups, sample_colors, part_colors, .. } = shading;
    let (rows, pixel) = (rows.as_chunks::<LANES>().0, group * LANES);
    let first = sample_colors.len();
    edge_groups.push(EdgeGroup { number: group as u32, lanes: lanes as u32, first: first as u32 });
    let nobody = U32::splat(simd, NOBODY);
    let pixels = (lane_numbers(simd) + pixel as i32).bitcast::<U32<S>>();
    sample_colors.push(U32::simd_from(simd, rows[0]).simd_eq(nobody).select(nobody, pixels).into());
    for (sample, row) in rows.iter().enumerate().skip(1) {
        let winners = U32::simd_from(simd, *row);
        let (mut name, mut named) = (nobody, winners.simd_eq(nobody));
        for (row, names) in rows[..sample].iter().zip(&sample_colors[first..]) {
            let same: Mask<S> = winners.simd_eq(U32::simd_from(simd, *row));
            name = same.select(U32::simd_from(simd, *names), name);
            named |= same;
        }
        let mut names: [u32; LANES] = name.into();
        let mut others = !named.to_bitmask() & lanes;
        while others != 0 {
            let lane = others.trailing_zeros() as usize % LANES;
            others &= others - 1;
            let place = PIXELS + *part_colors;
            *part_colors += 1;
            let work = Work::anywhere(pixel + lane, true, place);
            parts.push(Fragment { slot: slots[row[lane] as usize], work });
            names[lane] = place as u32;
        }
        sample_colors.push(names);
    }
}
