//! Which of a pipeline's vertices a draw runs.

use std::ops::Range;

/// The vertices that a draw uses, each with a slot: its place among them.
#[derive(Debug, PartialEq)]
pub(crate) enum UsedVertices {
    /// All from the least to the greatest index.
    Range(Range<usize>),
    /// Few of many: ascending.
    Listed(Vec<u32>),
}

impl UsedVertices {
    /// The vertices that `indices` name, of those below `count`.
    ///
    /// A range costs nothing to look up, but holds vertices that nobody asked
    /// for; it is taken if those are not many more than the indices.
    pub(crate) fn new(indices: &[u32], count: usize) -> Self {
        // A vertex is about as dear as a few look-ups in a list.
        const WORTH_LISTING: usize = 4;
        if count <= indices.len() {
            return Self::Range(0..count);
        }
        let exists = |index: &u32| (*index as usize) < count;
        let (mut least, mut beyond) = (usize::MAX, 0);
        for &index in indices.iter().filter(|index| exists(index)) {
            least = least.min(index as usize);
            beyond = beyond.max(index as usize + 1);
        }
        let range = least.min(beyond)..beyond;
        if range.len() <= indices.len().saturating_mul(WORTH_LISTING) {
            return Self::Range(range);
        }
        let mut listed: Vec<u32> = indices.iter().copied().filter(exists).collect();
        listed.sort_unstable();
        listed.dedup();
        Self::Listed(listed)
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Range(range) => range.len(),
            Self::Listed(indices) => indices.len(),
        }
    }

    /// The vertex of a slot.
    #[inline]
    pub(crate) fn index(&self, slot: usize) -> usize {
        match self {
            Self::Range(range) => range.start + slot,
            Self::Listed(indices) => indices[slot] as usize,
        }
    }

    /// How slots are looked up.
    pub(crate) fn slots(&self) -> Slots<'_> {
        match self {
            Self::Range(range) => Slots { start: range.start as u32, listed: None },
            Self::Listed(indices) => Slots { start: 0, listed: Some(indices) },
        }
    }
}

/// Looks up the slots of vertices.
#[derive(Clone, Copy)]
pub(crate) struct Slots<'a> {
    start: u32,
    listed: Option<&'a [u32]>,
}

impl Slots<'_> {
    /// The slot of a vertex; beyond the last slot if the draw has no such vertex.
    #[inline(always)]
    pub(crate) fn of(self, index: u32) -> usize {
        match self.listed {
            None => index.wrapping_sub(self.start) as usize,
            Some(listed) => search(listed, index),
        }
    }
}

#[cold]
fn search(listed: &[u32], index: u32) -> usize {
    listed.binary_search(&index).unwrap_or(usize::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slots_and_vertices_belong_together() {
        for (indices, count) in [
            (vec![5, 7, 6, 5], 100),
            (vec![5, 7, 6, 5], 3),
            (vec![90, 3, 50, 3], 100),
            (vec![0, u32::MAX, u32::MAX - 1], usize::MAX),
            (vec![99, 100, 101], 100),
        ] {
            let used = UsedVertices::new(&indices, count);
            for &index in &indices {
                let slot = used.slots().of(index);
                let exists = (index as usize) < count;
                assert_eq!(slot < used.len(), exists, "vertex {index} of {count} in {used:?}");
                assert!(!exists || used.index(slot) == index as usize, "slot of {index}");
            }
        }
    }

    #[test]
    fn few_of_many_are_listed() {
        assert_eq!(UsedVertices::new(&[2, 9, 4], 10), UsedVertices::Range(2..10), "near each other");
        assert_eq!(UsedVertices::new(&[9, 900, 9], 1000), UsedVertices::Listed(vec![9, 900]), "far apart");
        assert_eq!(UsedVertices::new(&[4, 5], 2), UsedVertices::Range(0..2), "not worth a look");
        assert_eq!(UsedVertices::new(&[4, 5], 3).len(), 0, "none exists");
        assert_eq!(UsedVertices::new(&[], 3).len(), 0, "none is asked for");
    }
}
