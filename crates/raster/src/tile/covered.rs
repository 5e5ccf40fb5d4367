//! The pixels that up to eight triangles cover, wherever they lie in the tile: the kernels `micro` and `sliver` append
//! them to a list, then their depths are tested pixel by pixel. Two triangles may cover the same pixel, so lanes
//! cannot be written together.
//!
//! The depth test is that of `TileRasterizer::visible_lanes`, for one pixel.

use super::eight::{EightTriangles, MICRO};
use super::rasterizer::TileRasterizer;
use crate::simd::{F32, I32, LANES, Mask, Simd, U32, prelude::*};
use crate::tile_buffer::{BLOCKS, GROUPS, NO_TRIANGLE, VisibilityBuffer};

/// The maximum number of pixels in the boxes of eight triangles for `micro`.
const PIXELS: usize = (MICRO * MICRO) as usize * LANES;

/// Pixels that eight triangles cover.
pub(super) struct Covered {
    count: usize,
    /// The index of each pixel in the tile, times eight, plus the lane of its triangle; and sixteen more
    /// entries, because eight are written at a time, and `sliver` writes two times eight before it asks.
    entries: [u32; PIXELS + 2 * LANES],
    depths: [f32; PIXELS + 2 * LANES],
}

impl Covered {
    pub(super) fn new() -> Self {
        Self { count: 0, entries: [0; PIXELS + 2 * LANES], depths: [0.0; PIXELS + 2 * LANES] }
    }

    /// Whether pixels must not be appended more than twice.
    #[inline(always)]
    pub(super) fn is_full(&self) -> bool {
        self.count > PIXELS
    }

    /// Appends the pixels whose lanes are set, from their indices in the tile and the lanes of their triangles.
    ///
    /// `compress` moves the set lanes to the front. All eight are stored, and the count grows
    /// by those that were set, so the next call overwrites the rest: no branch depends on how
    /// many pixels are covered, which a processor could not predict.
    #[inline(always)]
    pub(super) fn push<S: Simd>(&mut self, lanes: Mask<S>, depth: F32<S>, [index, of]: [I32<S>; 2]) {
        let entries = ((index << 3) + of).bitcast::<U32<S>>();
        let count = self.count;
        entries.compress(lanes).store_slice(&mut self.entries[count..count + LANES]);
        depth.compress(lanes).store_slice(&mut self.depths[count..count + LANES]);
        self.count += lanes.to_bitmask().count_ones() as usize;
    }

    /// Drops pixels that are hidden by what is in the buffer, without a branch on whether they are.
    #[inline(never)]
    pub(super) fn drop_hidden(&mut self, buffer: &VisibilityBuffer) {
        let mut count = 0;
        // A limit that the compiler knows, so that it checks no index.
        for index in 0..self.count.min(self.entries.len()) {
            let (entry, depth) = (self.entries[index], self.depths[index]);
            (self.entries[count], self.depths[count]) = (entry, depth);
            count += usize::from(depth >= buffer.depth[entry as usize / LANES]);
        }
        self.count = count;
    }
}

impl TileRasterizer<'_> {
    /// Tests the depths of the covered pixels and stores those that are visible.
    ///
    /// Not inlined, so that the first pass can use all registers.
    #[inline(never)]
    pub(super) fn scatter(
        &self,
        eight: &EightTriangles,
        pixels: &mut Covered,
        buffer: &mut VisibilityBuffer,
    ) {
        let count = std::mem::take(&mut pixels.count);
        for (&entry, &depth) in pixels.entries[..count].iter().zip(&pixels.depths) {
            // The list packs a pixel's index and its lane into one value. With one sample per
            // pixel the index is also that of the sample in the buffer.
            let (at, lane) = (entry as usize / LANES, entry as usize % LANES);
            let (there, triangle) = (buffer.depth[at], eight.index + lane as u32);
            if depth > there || (depth == there && self.precedes_at_tie(triangle, buffer.visible[at])) {
                buffer.depth[at] = depth;
                buffer.visible[at] = triangle;
                buffer.note_write(at / (GROUPS * LANES), eight.high[lane]);
            }
        }
    }

    /// Whether a triangle is visible rather than another at the same depth.
    ///
    /// Of two triangles in the same eight the later one may come first: `micro` lists pixel by pixel of the boxes, not
    /// triangle by triangle, and slivers are drawn after the other triangles of the eight. That is why numbers are
    /// compared even when triangles are drawn in the order of their keys.
    #[cold]
    fn precedes_at_tie(&self, triangle: u32, visible: u32) -> bool {
        if self.in_order {
            visible != NO_TRIANGLE && triangle < visible
        } else {
            self.may_decide(1) && visible != NO_TRIANGLE && (self.precedes)(triangle, visible)
        }
    }
}

/// The indices of pixels in the tile: see
/// [`TileArea::index_of`](crate::tile_buffer::TileArea::index_of).
#[inline(always)]
pub(super) fn index_of<S: Simd>(x: I32<S>, y: I32<S>) -> I32<S> {
    // Blocks of 8×8 pixels row by row; in each block eight groups of 4×2, two to a row.
    let block = (y >> 3) * BLOCKS as i32 + (x >> 3);
    let group = (y & 6) + ((x >> 2) & 1);
    (((block << 3) + group) << 3) + ((y & 1) << 2) + (x & 3)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::{SimdLevel, at_level};
    use crate::tile_buffer::TileArea;

    #[test]
    fn numbers_of_pixels_agree() {
        let token = SimdLevel::best().token().expect("the best level is there");
        for y in 0..64 {
            for x in 0..64 {
                let index = at_level!(token, simd => index_of(I32::splat(simd, x), I32::splat(simd, y))[0]);
                assert_eq!(index as usize, TileArea::index_of([x as usize, y as usize]), "{x} {y}");
            }
        }
    }
}
