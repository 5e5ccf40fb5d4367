//! Sets of numbers, a bit for each.

/// Whether the bit of a number is set.
#[inline(always)]
pub(super) fn is_set(bits: &[u64], number: usize) -> bool {
    bits.get(number / 64).is_some_and(|word| word >> (number % 64) & 1 != 0)
}

/// Sets the bit of a number.
#[inline(always)]
pub(super) fn set(bits: &mut [u64], number: usize) {
    bits[number / 64] |= 1 << (number % 64);
}

/// Empties a set, and makes room for numbers below `count`.
pub(super) fn reset(bits: &mut Vec<u64>, count: usize) {
    bits.clear();
    bits.resize(count.div_ceil(64), 0);
}

/// Whether all of one set are in another.
pub(super) fn are_among(some: &[u64], all: &[u64]) -> bool {
    some.len() == all.len() && some.iter().zip(all).all(|(some, all)| some & !all == 0)
}
