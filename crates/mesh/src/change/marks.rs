//! Sets that contain few of many elements.

/// A bit for each element.
pub(super) struct Marks(Vec<u64>);

impl Marks {
    pub(super) fn new(elements: usize) -> Self {
        Self(vec![0; elements.div_ceil(64)])
    }

    pub(super) fn insert(&mut self, element: u32) {
        self.0[element as usize / 64] |= 1 << (element % 64);
    }

    /// Those that are in one of two sets or in both, of equally many elements.
    pub(super) fn union(mut self, other: Self) -> Self {
        self.0.iter_mut().zip(other.0).for_each(|(own, other)| *own |= other);
        self
    }

    /// To find places in the list of these elements.
    pub(super) fn ranks(self) -> Ranks {
        let mut before = 0;
        let ranked = |word: u64| {
            let first = before;
            before += word.count_ones();
            (word, first)
        };
        Ranks(self.0.into_iter().map(ranked).collect())
    }

    /// The elements, increasing: whoever follows them through the lists of a mesh finds them
    /// in the order in which they lie in memory.
    pub(super) fn listed(self) -> Vec<u32> {
        let mut listed = Vec::with_capacity(self.0.iter().map(|word| word.count_ones() as usize).sum());
        for (mut word, first) in self.0.into_iter().zip((0..).step_by(64)) {
            while word != 0 {
                listed.push(first + word.trailing_zeros());
                word &= word - 1;
            }
        }
        listed
    }
}

/// The marks of 64 elements each, and how many elements are marked before them.
pub(super) struct Ranks(Vec<(u64, u32)>);

impl Ranks {
    /// How many elements are marked before an element that is marked, too.
    pub(super) fn get(&self, element: u32) -> Option<u32> {
        let (word, before) = self.0[element as usize / 64];
        let bit = 1 << (element % 64);
        (word & bit != 0).then(|| before + (word & (bit - 1)).count_ones())
    }
}

#[cfg(test)]
mod tests {
    use super::Marks;

    #[test]
    fn elements_are_listed_once_and_in_order() {
        let mut marks = Marks::new(130);
        [129, 64, 0, 63, 64].into_iter().for_each(|element| marks.insert(element));
        assert_eq!(marks.listed(), [0, 63, 64, 129]);
        let mut marks = Marks::new(130);
        [129, 64, 0, 63].into_iter().for_each(|element| marks.insert(element));
        let ranks = marks.ranks();
        assert_eq!([0, 63, 64, 129].map(|element| ranks.get(element)), [0, 1, 2, 3].map(Some), "of elements");
        assert_eq!([1, 62, 65, 128].map(|element| ranks.get(element)), [None; 4], "of others");
        let [mut one, mut other] = [Marks::new(70), Marks::new(70)];
        [3, 69].into_iter().for_each(|element| one.insert(element));
        [0, 69].into_iter().for_each(|element| other.insert(element));
        assert_eq!(one.union(other).listed(), [0, 3, 69], "of two sets");
        assert_eq!(Marks::new(0).listed(), [0_u32; 0], "of nothing");
    }
}
