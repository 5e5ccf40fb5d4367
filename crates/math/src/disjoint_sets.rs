//! Disjoint sets of numbers: union and find.

/// Disjoint sets of the numbers from 0 on. The least number of a set stands for it, in whatever order sets were
/// joined.
///
/// Tarjan and van Leeuwen, *Worst-Case Analysis of Set Union Algorithms*, 1984, with their path halving.
///
/// ```
/// use trigon_math::DisjointSets;
///
/// let mut sets = DisjointSets::new(4);
/// sets.join(3, 1);
/// assert_eq!([0, 1, 2, 3].map(|number| sets.root(number)), [0, 1, 2, 1]);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DisjointSets(Vec<u32>);

impl DisjointSets {
    /// The numbers below a count, each in a set of its own.
    #[must_use]
    pub fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    /// The least number of the set of a number.
    ///
    /// # Panics
    /// If there is no such number.
    pub fn root(&mut self, mut number: u32) -> u32 {
        while self.0[number as usize] != number {
            // Halves the path for the next look-up.
            let above = self.0[self.0[number as usize] as usize];
            self.0[number as usize] = above;
            number = above;
        }
        number
    }

    /// Joins the sets of two numbers.
    ///
    /// # Panics
    /// If there are no such numbers.
    pub fn join(&mut self, a: u32, b: u32) {
        let [a, b] = [self.root(a), self.root(b)];
        self.0[a.max(b) as usize] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// Against labels that are changed one by one.
        #[test]
        fn sets_are_those_that_were_joined(pairs in prop::collection::vec((0u32..40, 0u32..40), 0..60)) {
            let mut sets = DisjointSets::new(40);
            let mut labels: Vec<u32> = (0..40).collect();
            for (a, b) in pairs {
                sets.join(a, b);
                let [a, b] = [labels[a as usize], labels[b as usize]];
                labels.iter_mut().filter(|label| **label == a.max(b)).for_each(|label| *label = a.min(b));
            }
            for number in 0..40 {
                prop_assert_eq!(sets.root(number), labels[number as usize]);
            }
        }
    }
}
