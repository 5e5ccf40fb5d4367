//! Sets of numbers as bits.

use fixedbitset::FixedBitSet;
use rayon::prelude::*;

/// Bits in a word of a set.
const WORD: usize = usize::BITS as usize;

/// Words that a thread takes at a time, at least.
const WORDS: usize = 256;

/// So many bits that are set.
pub(super) fn all(count: usize) -> FixedBitSet {
    let mut all = FixedBitSet::with_capacity(count);
    all.insert_range(..);
    all
}

/// So many bits, of which some are set.
pub(super) fn bits(count: usize, numbers: impl Iterator<Item = u32>) -> FixedBitSet {
    let mut bits = FixedBitSet::with_capacity(count);
    numbers.for_each(|number| bits.insert(number as usize));
    bits
}

/// So many bits, of which those are set whose numbers pass a test: word by word, on all threads.
pub(super) fn bits_where(count: usize, is_set: impl Fn(usize) -> bool + Sync) -> FixedBitSet {
    let words = (0..count.div_ceil(WORD)).into_par_iter().with_min_len(WORDS);
    let word = |number: usize| {
        let first = number * WORD;
        let bits = first..count.min(first + WORD);
        bits.fold(0, |word, bit| word | usize::from(is_set(bit)) << (bit - first))
    };
    FixedBitSet::with_capacity_and_blocks(count, words.map(word).collect::<Vec<usize>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_those_that_pass_however_many_there_are() {
        for count in [0, 1, 63, 64, 65, 127, 128, 100_000] {
            let is_set = |number: usize| number % 3 == 1 || number % 64 == 63;
            let expected =
                bits(count, (0..count).filter(|&number| is_set(number)).map(|number| number as u32));
            assert_eq!(bits_where(count, is_set), expected, "of {count}");
            assert_eq!(bits_where(count, |_| true), all(count), "all {count}");
        }
    }
}
