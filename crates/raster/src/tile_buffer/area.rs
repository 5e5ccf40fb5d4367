//! Where a tile lies, and how its pixels lie in memory.

use crate::simd::{I32, InlineMap, Simd};

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

#[cfg(test)]
mod tests {
    use super::*;

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
}
