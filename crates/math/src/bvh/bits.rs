//! Sets of eight lanes, or of eight boxes, as bits.

use super::wide::WIDTH;

/// Takes the lowest bit.
#[inline(always)]
pub(super) fn next_bit(bits: &mut u32) -> Option<usize> {
    let bit = bits.trailing_zeros();
    if *bits == 0 {
        return None;
    }
    *bits &= *bits - 1;
    Some(bit as usize % WIDTH)
}

/// Takes the highest bit.
#[inline(always)]
pub(super) fn last_bit(bits: &mut u32) -> Option<usize> {
    let bit = bits.checked_ilog2()?;
    *bits ^= 1 << bit;
    Some(bit as usize % WIDTH)
}
