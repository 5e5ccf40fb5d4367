//! Where a tile lies, and how its pixels lie in memory. Sets of pixels of a tile have a bit for each pixel, by lanes of
//! groups ([`TileLanes`]) or by rows ([`TileRows`]).

use crate::simd::{I32, InlineMap, LANES, Simd};

/// The most pixels in a row or a column of a tile.
pub(crate) const MAX_SIDE: usize = 64;

/// Pixels of the largest tile.
pub(crate) const PIXELS: usize = MAX_SIDE * MAX_SIDE;

/// A tile's rectangle of pixels.
///
/// Its pixels are kept in groups of eight, 4 by 2, one for each lane; eight of
/// those groups, 2 by 4, make a block of 8 by 8 pixels, and blocks go row by
/// row: so a small triangle touches few groups, and a block is contiguous.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TileArea {
    /// The first pixel.
    pub(crate) origin: [i32; 2],
    /// Pixels in a row and in a column, at most [`MAX_SIDE`].
    pub(crate) size: [usize; 2],
    /// The margin: how many pixels on the left and at the top belong to neighbouring tiles.
    pub(crate) margin: [usize; 2],
}

/// Blocks in a row of a tile.
pub(crate) const BLOCKS: usize = MAX_SIDE / 8;

/// Groups in a block.
pub(crate) const GROUPS: usize = 8;

impl TileArea {
    /// The index of the pixel in this column and row of the tile.
    #[inline(always)]
    pub(crate) fn index_of([x, y]: [usize; 2]) -> usize {
        Self::group_of([x / 4, y / 2]) * 8 + (y & 1) * 4 + (x & 3)
    }

    /// The index of a group by its column and row.
    #[inline(always)]
    pub(crate) fn group_of([x, y]: [usize; 2]) -> usize {
        // Two terms, of which the compiler can move one out of a loop over columns or rows.
        ((x / 2) * GROUPS + (x & 1)) + ((y / 4) * (BLOCKS * GROUPS) + (y & 3) * 2)
    }

    /// The column and row of a pixel by its index.
    #[inline(always)]
    pub(crate) fn pixel_at(index: usize) -> [usize; 2] {
        let x = (index & 3) | (index >> 1 & 4) | (index >> 3 & 0x38);
        let y = (index >> 2 & 1) | (index >> 3 & 6) | (index >> 6 & 0x38);
        [x, y]
    }

    /// The columns and rows of eight pixels by their indices.
    #[inline(always)]
    pub(crate) fn pixels_at<S: Simd>(index: I32<S>) -> [I32<S>; 2] {
        let x = (index & 3) | ((index >> 1) & 4) | ((index >> 3) & 0x38);
        let y = ((index >> 2) & 1) | ((index >> 3) & 6) | ((index >> 6) & 0x38);
        [x, y]
    }

    /// The position in 1/256 pixel of a pixel's sample at an offset.
    #[inline(always)]
    pub(crate) fn point(&self, pixel: [i32; 2], offset: [i32; 2]) -> [i32; 2] {
        [0, 1].each(
            #[inline(always)]
            |axis| (self.origin[axis] + pixel[axis]) * 256 + offset[axis],
        )
    }

    /// The first pixel that belongs to no neighbour.
    pub(crate) fn own_origin(&self) -> [i32; 2] {
        [0, 1].map(|axis| self.origin[axis] + self.margin[axis] as i32)
    }

    /// Whether a pixel of the tile lies in the image.
    #[inline(always)]
    pub(crate) fn contains(&self, [x, y]: [usize; 2]) -> bool {
        x < self.size[0] && y < self.size[1]
    }

    /// The size in whole blocks, all of which are drawn: otherwise blocks at the image's edge would
    /// hold samples that were never drawn, and their bounds would be useless.
    #[inline(always)]
    pub(crate) fn padded(&self) -> [usize; 2] {
        self.size.map(|side| side.next_multiple_of(8))
    }

    /// The number of pixel indices that the tile needs; some of them may be unused.
    pub(crate) fn span(&self) -> usize {
        let [width, height] = self.size.map(|side| side.div_ceil(8));
        ((height - 1) * BLOCKS + width) * GROUPS * 8
    }
}

/// The point of a lane, from that of the first.
#[inline(always)]
pub(crate) fn lane_point([x, y]: [i32; 2], lane: usize) -> [i32; 2] {
    [x + (lane as i32 & 3) * 256, y + (lane as i32 >> 2) * 256]
}

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

    #[test]
    fn numbers_and_places_belong_together() {
        let mut visited = vec![false; MAX_SIDE * MAX_SIDE];
        for y in 0..MAX_SIDE {
            for x in 0..MAX_SIDE {
                let index = TileArea::index_of([x, y]);
                assert_eq!(TileArea::pixel_at(index), [x, y], "pixel {index}");
                assert!(!std::mem::replace(&mut visited[index], true), "{index} is given once");
            }
        }
    }

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
