//! Numbering of the elements of a list, for operations that look up many elements.

/// Maps an index to its position in a sorted list.
///
/// A table by index is fast, but takes time proportional to the mesh to build, so it is used only
/// for long lists; short lists are searched.
pub(super) enum Numbering {
    Searched(Vec<u32>),
    /// By index: the position, or `u32::MAX`.
    Table(Vec<u32>),
}

impl Numbering {
    /// A table has at most this many entries for each element of the list.
    const SPARSEST: usize = 32;

    /// The list holds ascending indices below `capacity`, each once.
    pub(super) fn new(sorted: &[u32], capacity: usize) -> Self {
        if sorted.len() * Self::SPARSEST < capacity {
            return Self::Searched(sorted.to_vec());
        }
        let mut table = vec![u32::MAX; capacity];
        for (number, &index) in (0..).zip(sorted) {
            table[index as usize] = number;
        }
        Self::Table(table)
    }

    /// The position of an index in the list; `None` if it is not in it.
    #[inline]
    pub(super) fn get(&self, index: u32) -> Option<usize> {
        match self {
            Self::Searched(sorted) => sorted.binary_search(&index).ok(),
            // An element added later is in no list.
            Self::Table(table) => {
                table.get(index as usize).filter(|&&number| number != u32::MAX).map(|&number| number as usize)
            }
        }
    }
}

/// Whether more than one of `parts` equal parts of all elements is worked on. From some part on, one pass over all
/// costs less than a step for each; the result is the same.
pub(super) fn is_more_than_one_of(parts: usize, count: usize, all: usize) -> bool {
    count > all / parts
}

/// Ascending, each once.
pub(super) fn sorted_once<T: Ord>(mut list: Vec<T>) -> Vec<T> {
    list.sort_unstable();
    list.dedup();
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_than_a_part_begins_after_it() {
        for (parts, all, most) in [(2, 8, 4), (8, 8, 1), (8, 64, 8), (8, 71, 8), (2, 1, 0), (2, 0, 0)] {
            assert!(!is_more_than_one_of(parts, most, all), "{most} of {all}");
            assert!(is_more_than_one_of(parts, most + 1, all), "{} of {all}", most + 1);
        }
    }

    #[test]
    fn a_search_and_a_table_give_the_same_places() {
        let list = [2, 3, 7];
        let (searched, table) = (Numbering::new(&list, 1000), Numbering::new(&list, 9));
        assert!(matches!((&searched, &table), (Numbering::Searched(_), Numbering::Table(_))), "one of each");
        for index in 0..12 {
            let expected = list.iter().position(|&other| other == index);
            assert_eq!([searched.get(index), table.get(index)], [expected; 2], "{index}");
        }
    }
}
