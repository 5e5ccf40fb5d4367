//! The visible triangles of a tile's pixels, row by row, and the pixels near which an edge may show: eight pixels at a
//! time.

use crate::simd::{F32, LANES, Simd, U32, greater, prelude::*};
use crate::tile_buffer::{MAX_SIDE, NO_TRIANGLE};
use std::ops::Range;

/// The farthest that a line reaches, in pixels.
const MOST_REACH: usize = 16;

/// The visible triangles around each pixel of a tile, row by row.
pub(super) struct VisibleRows {
    pub(super) least: [[f32; MAX_SIDE]; MAX_SIDE],
    pub(super) greatest: [[f32; MAX_SIDE]; MAX_SIDE],
    /// 1 for large triangles.
    pub(super) large: [[f32; MAX_SIDE]; MAX_SIDE],
    /// The nearest depth visible in a pixel.
    pub(super) nearest: [[u32; MAX_SIDE]; MAX_SIDE],
    /// The farthest.
    pub(super) farthest: [[u32; MAX_SIDE]; MAX_SIDE],
}

/// One row with room for a reach at both ends.
type WideRow<T> = [T; MAX_SIDE + 2 * MOST_REACH];

impl VisibleRows {
    pub(super) fn new() -> Box<Self> {
        Box::new(Self {
            least: [[f32::NEG_INFINITY; MAX_SIDE]; MAX_SIDE],
            greatest: [[f32::NEG_INFINITY; MAX_SIDE]; MAX_SIDE],
            large: [[0.0; MAX_SIDE]; MAX_SIDE],
            nearest: [[NO_TRIANGLE; MAX_SIDE]; MAX_SIDE],
            farthest: [[NO_TRIANGLE; MAX_SIDE]; MAX_SIDE],
        })
    }
}

/// The columns of a row around which a triangle with lines lies in front of everything visible in the pixel.
#[inline(always)]
pub(super) fn in_front<S: Simd>(
    simd: S,
    rows: &VisibleRows,
    y: usize,
    around: Range<usize>,
    reach: usize,
) -> u64 {
    let mut wide: WideRow<f32> = [f32::NEG_INFINITY; MAX_SIDE + 2 * MOST_REACH];
    for x in (0..MAX_SIDE).step_by(LANES) {
        let mut most = F32::splat(simd, f32::NEG_INFINITY);
        for row in &rows.least[around.clone()] {
            most = greater(F32::from_slice(simd, &row[x..x + LANES]), most);
        }
        most.store_slice(&mut wide[MOST_REACH + x..MOST_REACH + x + LANES]);
    }
    columns_where(
        #[inline(always)]
        |x| {
            let mut most = F32::splat(simd, f32::NEG_INFINITY);
            for at in MOST_REACH + x - reach..=MOST_REACH + x + reach {
                most = greater(F32::from_slice(simd, &wide[at..at + LANES]), most);
            }
            most.simd_gt(F32::from_slice(simd, &rows.greatest[y][x..x + LANES])).to_bitmask()
        },
    )
}

/// The columns of a row around which there is another triangle, and a large one.
#[inline(always)]
pub(super) fn beside_large<S: Simd>(
    simd: S,
    rows: &VisibleRows,
    y: usize,
    around: Range<usize>,
    reach: usize,
) -> u64 {
    let mut large: WideRow<f32> = [0.0; MAX_SIDE + 2 * MOST_REACH];
    // Columns beside the tile are no other triangle.
    let mut least: WideRow<u32> = [u32::MAX; MAX_SIDE + 2 * MOST_REACH];
    let mut most: WideRow<u32> = [0; MAX_SIDE + 2 * MOST_REACH];
    for x in (0..MAX_SIDE).step_by(LANES) {
        let mut found = (F32::splat(simd, 0.0), U32::splat(simd, u32::MAX), U32::splat(simd, 0));
        for row in around.clone() {
            let nearest = U32::from_slice(simd, &rows.nearest[row][x..x + LANES]);
            found.0 = greater(F32::from_slice(simd, &rows.large[row][x..x + LANES]), found.0);
            (found.1, found.2) = (found.1.min(nearest), found.2.max(nearest));
        }
        let at = MOST_REACH + x..MOST_REACH + x + LANES;
        found.0.store_slice(&mut large[at.clone()]);
        found.1.store_slice(&mut least[at.clone()]);
        found.2.store_slice(&mut most[at]);
    }
    columns_where(
        #[inline(always)]
        |x| {
            let own = U32::from_slice(simd, &rows.farthest[y][x..x + LANES]);
            let mut found = (F32::splat(simd, 0.0), own, own);
            for at in MOST_REACH + x - reach..=MOST_REACH + x + reach {
                let at = at..at + LANES;
                found.0 = greater(F32::from_slice(simd, &large[at.clone()]), found.0);
                found.1 = found.1.min(U32::from_slice(simd, &least[at.clone()]));
                found.2 = found.2.max(U32::from_slice(simd, &most[at]));
            }
            let other = !(found.1.simd_eq(own) & found.2.simd_eq(own));
            (found.0.simd_gt(0.0) & other).to_bitmask()
        },
    )
}

/// A bit for each column, from those of eight.
#[inline(always)]
fn columns_where(mut eight: impl FnMut(usize) -> u64) -> u64 {
    (0..MAX_SIDE).step_by(LANES).fold(
        0,
        #[inline(always)]
        |bits, x| bits | eight(x) << x,
    )
}
