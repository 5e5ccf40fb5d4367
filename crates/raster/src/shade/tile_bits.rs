//! A bit for each pixel of a tile, by lanes of groups or by rows.

use crate::simd::LANES;
use crate::tile_buffer::{MAX_SIDE, PIXELS, TileArea};

/// Groups of eight pixels in a tile.
pub(crate) const GROUP_COUNT: usize = PIXELS / LANES;

/// A bit for each lane of each group of a tile.
pub(crate) type TileLanes = [u8; GROUP_COUNT];

/// A bit for each column of each row of a tile.
pub(crate) type TileRows = [u64; MAX_SIDE];

/// Bits of lanes as bits of columns.
pub(crate) fn rows_of(lanes: &TileLanes) -> TileRows {
    let mut rows = [0; MAX_SIDE];
    for [x, y] in groups_in_rows() {
        let mut groups = [0; 8];
        for (two, first) in groups.as_chunks_mut::<2>().0.iter_mut().zip(twos(x, y)) {
            two.copy_from_slice(&lanes[first..first + 2]);
        }
        let groups = u64::from_le_bytes(groups);
        rows[2 * y] |= u64::from(low_halves(groups)) << (4 * x);
        rows[2 * y + 1] |= u64::from(low_halves(groups >> 4)) << (4 * x);
    }
    rows
}

/// Bits of lanes of either as bits of columns.
pub(crate) fn rows_of_either(one: &TileLanes, other: &TileLanes) -> TileRows {
    let mut both = *one;
    both.iter_mut().zip(other).for_each(|(both, other)| *both |= other);
    rows_of(&both)
}

/// Bits of columns as bits of lanes.
pub(crate) fn lanes_of(rows: &TileRows) -> TileLanes {
    let mut lanes = [0; GROUP_COUNT];
    for [x, y] in groups_in_rows() {
        let [upper, lower] = [2 * y, 2 * y + 1].map(|row| as_low_halves((rows[row] >> (4 * x)) as u32));
        let groups = (upper | lower << 4).to_le_bytes();
        for (two, first) in groups.as_chunks::<2>().0.iter().zip(twos(x, y)) {
            lanes[first..first + 2].copy_from_slice(two);
        }
    }
    lanes
}

/// The column and row of every eighth group.
fn groups_in_rows() -> impl Iterator<Item = [usize; 2]> {
    (0..MAX_SIDE / 2).flat_map(|y| [[0, y], [8, y]])
}

/// The indices of the first, third, fifth and seventh of eight groups in a row; the others follow them.
fn twos(x: usize, y: usize) -> impl Iterator<Item = usize> {
    (x..x + 8).step_by(2).map(move |x| TileArea::group_of([x, y]))
}

/// The lower four bits of each byte, side by side.
fn low_halves(bytes: u64) -> u32 {
    let bits = bytes & 0x0f0f_0f0f_0f0f_0f0f;
    let bits = (bits | bits >> 4) & 0x00ff_00ff_00ff_00ff;
    let bits = (bits | bits >> 8) & 0x0000_ffff_0000_ffff;
    (bits | bits >> 16) as u32
}

/// Four bits each as the lower ones of a byte.
fn as_low_halves(bits: u32) -> u64 {
    let bytes = u64::from(bits);
    let bytes = (bytes | bytes << 16) & 0x0000_ffff_0000_ffff;
    let bytes = (bytes | bytes << 8) & 0x00ff_00ff_00ff_00ff;
    (bytes | bytes << 4) & 0x0f0f_0f0f_0f0f_0f0f
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn lanes_and_rows_are_the_same_pixels(pixels in prop::collection::vec([0..MAX_SIDE, 0..MAX_SIDE], 0..200)) {
            let (mut lanes, mut rows) = ([0; GROUP_COUNT], [0; MAX_SIDE]);
            for [x, y] in pixels {
                let index = TileArea::index_of([x, y]);
                lanes[index / LANES] |= 1 << (index % LANES);
                rows[y] |= 1 << x;
            }
            prop_assert!(rows_of(&lanes) == rows);
            prop_assert!(lanes_of(&rows) == lanes);
        }
    }
}
