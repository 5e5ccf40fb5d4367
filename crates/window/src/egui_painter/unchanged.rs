//! Which elements two lists have in common in the same order. What a pass of the interface adds, removes or
//! moves is thereby told apart from what it keeps, wherever in the list that is.

use std::collections::HashMap;
use std::hash::Hash;

use foldhash::fast::FixedState;

/// Marks no place in a list.
const NONE: u32 = u32::MAX;

/// Whether each element of either list is one of a common subsequence: both lists without all others are equal.
/// It is the longest one if no element occurs twice. `key` is the same for equal elements.
///
/// Elements are paired by key, and of the pairs the longest sequence is chosen in which both lists have the same
/// order (the idea of patience diff). Linear time where few elements change their order, else n log n.
pub(super) fn unchanged<T: PartialEq, K: Hash + Eq>(
    lists: [&[T]; 2],
    key: impl Fn(&T) -> K,
) -> [Vec<bool>; 2] {
    let pairs = pairs(lists, key);
    let mut found = lists.map(|list| vec![false; list.len()]);
    for pair in increasing(&pairs) {
        let [before, after] = pairs[pair];
        (found[0][before as usize], found[1][after as usize]) = (true, true);
    }
    found
}

/// The places of equal elements in two lists, in the order of the second one. No place occurs twice.
fn pairs<T: PartialEq, K: Hash + Eq>([before, after]: [&[T]; 2], key: impl Fn(&T) -> K) -> Vec<[u32; 2]> {
    // The first place of each key, and after each place the next one of the same key.
    let mut first = HashMap::with_capacity_and_hasher(before.len(), FixedState::default());
    let mut next = vec![NONE; before.len()];
    for (index, element) in before.iter().enumerate().rev() {
        next[index] = first.insert(key(element), index as u32).unwrap_or(NONE);
    }
    let mut pairs = Vec::with_capacity(before.len().min(after.len()));
    for (index, element) in (0..).zip(after) {
        let Some(other) = first.get_mut(&key(element)).filter(|other| **other != NONE) else { continue };
        let found = std::mem::replace(other, next[*other as usize]);
        if before[found as usize] == *element {
            pairs.push([found, index]);
        }
    }
    pairs
}

/// The longest subsequence of pairs whose first numbers increase, by index and from its end (C. Schensted,
/// "Longest Increasing and Decreasing Subsequences", 1961, in the form with predecessors).
fn increasing(pairs: &[[u32; 2]]) -> impl Iterator<Item = usize> {
    // For each length, the last pair of the subsequence of that length with the smallest last number.
    let mut ends: Vec<usize> = Vec::new();
    let mut previous = Vec::with_capacity(pairs.len());
    for (index, [number, _]) in pairs.iter().enumerate() {
        let is_smaller = |end: &usize| pairs[*end][0] < *number;
        let length =
            if ends.last().is_none_or(is_smaller) { ends.len() } else { ends.partition_point(is_smaller) };
        previous.push(length.checked_sub(1).map(|shorter| ends[shorter]));
        if length == ends.len() { ends.push(index) } else { ends[length] = index }
    }
    std::iter::successors(ends.last().copied(), move |index| previous[*index])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The length of the longest common subsequence, by the textbook's table.
    fn longest(a: &[u8], b: &[u8]) -> usize {
        let mut row = vec![0; b.len() + 1];
        for x in a {
            let above = row.clone();
            for (i, y) in b.iter().enumerate() {
                row[i + 1] = if x == y { above[i] + 1 } else { above[i + 1].max(row[i]) };
            }
        }
        row[b.len()]
    }

    fn kept(list: &[u8], found: &[bool]) -> Vec<u8> {
        list.iter().zip(found).filter(|(_, found)| **found).map(|(element, _)| *element).collect()
    }

    proptest! {
        #[test]
        fn what_is_unchanged_is_the_same_in_both_lists(
            before in prop::collection::vec(0..12u8, 0..30),
            after in prop::collection::vec(0..12u8, 0..30),
            keys in 1..13u8,
        ) {
            // With few keys, different elements share them.
            let found = unchanged([&before, &after], |element| element % keys);
            prop_assert_eq!(kept(&before, &found[0]), kept(&after, &found[1]));
        }

        #[test]
        fn as_much_as_possible_is_unchanged_where_nothing_occurs_twice(
            before in Just((0..40u8).collect::<Vec<_>>()).prop_shuffle(),
            after in Just((10..50u8).collect::<Vec<_>>()).prop_shuffle(),
            lengths in [0..40usize, 0..40],
        ) {
            let [before, after] = [&before[..lengths[0]], &after[..lengths[1]]];
            let found = unchanged([before, after], |element| *element);
            prop_assert_eq!(kept(before, &found[0]).len(), longest(before, after));
        }
    }

    #[test]
    fn one_element_that_moved_far_leaves_all_others_unchanged() {
        let found = unchanged([&[9, 1, 2, 2, 3], &[1, 2, 2, 3, 9, 4]], |element| *element);
        assert_eq!(found[0], [false, true, true, true, true], "the one that moved");
        assert_eq!(found[1], [true, true, true, true, false, false], "where it is now, and the new one");
    }
}
