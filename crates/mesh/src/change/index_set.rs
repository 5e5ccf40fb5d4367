//! A set of few of many elements.

/// A bit for each element.
pub(super) struct IndexSet(Vec<u64>);

impl IndexSet {
    pub(super) fn new(elements: usize) -> Self {
        Self(vec![0; elements.div_ceil(64)])
    }

    pub(super) fn insert(&mut self, element: u32) {
        self.0[element as usize / 64] |= 1 << (element % 64);
    }

    /// The elements, increasing: whoever follows them through the lists of a mesh finds them
    /// in the order in which they lie in memory.
    pub(super) fn into_sorted(self) -> Vec<u32> {
        let mut sorted = Vec::with_capacity(self.0.iter().map(|word| word.count_ones() as usize).sum());
        for (mut word, first) in self.0.into_iter().zip((0..).step_by(64)) {
            while word != 0 {
                sorted.push(first + word.trailing_zeros());
                word &= word - 1;
            }
        }
        sorted
    }
}

#[cfg(test)]
mod tests {
    use super::IndexSet;

    #[test]
    fn elements_are_listed_once_and_in_order() {
        let mut set = IndexSet::new(130);
        [129, 64, 0, 63, 64].into_iter().for_each(|element| set.insert(element));
        assert_eq!(set.into_sorted(), [0, 63, 64, 129]);
        assert_eq!(IndexSet::new(0).into_sorted(), [0_u32; 0], "of nothing");
    }
}
