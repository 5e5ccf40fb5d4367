//! Lists of numbers that lie one after the other in memory.

/// A list of numbers for each index: each number once, in ascending order.
#[derive(Debug)]
pub(super) struct SortedLists {
    /// By list: where it begins; one entry more.
    starts: Vec<usize>,
    numbers: Vec<u32>,
}

impl SortedLists {
    /// From pairs of the index of a list and a number in it, in any order and any number of times.
    pub(super) fn new(lists: usize, pairs: impl Iterator<Item = [u32; 2]> + Clone) -> Self {
        let mut starts = vec![0; lists + 1];
        pairs.clone().for_each(|[list, _]| starts[list as usize + 1] += 1);
        for list in 0..lists {
            starts[list + 1] += starts[list];
        }
        let mut ends = starts.clone();
        let mut given = vec![0; starts[lists]];
        for [list, number] in pairs {
            given[ends[list as usize]] = number;
            ends[list as usize] += 1;
        }
        let mut numbers: Vec<u32> = Vec::with_capacity(given.len());
        for list in 0..lists {
            let own = &mut given[starts[list]..starts[list + 1]];
            own.sort_unstable();
            starts[list] = numbers.len();
            let start = starts[list];
            for &number in own.iter() {
                if numbers[start..].last() != Some(&number) {
                    numbers.push(number);
                }
            }
        }
        starts[lists] = numbers.len();
        Self { starts, numbers }
    }

    pub(super) fn list(&self, index: usize) -> &[u32] {
        &self.numbers[self.start(index)..self.start(index + 1)]
    }

    /// How many numbers come before those of a list.
    pub(super) fn start(&self, index: usize) -> usize {
        self.starts[index]
    }

    /// How many lists there are.
    pub(super) fn count(&self) -> usize {
        self.starts.len() - 1
    }

    /// How many numbers all lists have.
    pub(super) fn total(&self) -> usize {
        self.numbers.len()
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use trigon_math::SplitMix64;

    use super::*;

    #[test]
    fn lists_are_sets_of_their_numbers() {
        let mut numbers = SplitMix64::new(7);
        for (lists, count) in [(0, 0), (1, 0), (5, 100), (40, 60)] {
            let pairs: Vec<[u32; 2]> =
                (0..count).map(|_| [numbers.below(lists) as u32, numbers.below(9) as u32]).collect();
            let made = SortedLists::new(lists, pairs.iter().copied());
            let sets: Vec<BTreeSet<u32>> = (0..lists as u32)
                .map(|list| pairs.iter().filter(|pair| pair[0] == list).map(|pair| pair[1]).collect())
                .collect();
            assert_eq!(made.count(), lists);
            assert_eq!(made.total(), sets.iter().map(BTreeSet::len).sum::<usize>());
            for (index, set) in sets.iter().enumerate() {
                assert!(made.list(index).iter().eq(set), "{:?} of {set:?}", made.list(index));
            }
        }
    }
}
