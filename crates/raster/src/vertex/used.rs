//! Which of a pipeline's vertices a draw runs.

use std::ops::Range;

/// The vertices that a draw uses, each with a slot: its index among them.
#[derive(Debug, PartialEq)]
pub(crate) enum UsedVertices {
    /// All from the least to the greatest index.
    Range(Range<usize>),
    /// Few of many, ascending: this part of the frame's list.
    Listed(Range<usize>),
}

impl UsedVertices {
    /// The vertices that `indices` name, of those below `count`; a list of them is
    /// appended to that of the frame.
    ///
    /// A range costs nothing to look up, but may hold vertices that no index names;
    /// it is used if it is not much longer than the indices.
    pub(crate) fn new(indices: &[u32], count: usize, listed: &mut Vec<u32>) -> Self {
        // Running a vertex costs about as much as a few look-ups in a list.
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
        let start = listed.len();
        listed.extend(indices.iter().copied().filter(exists));
        sort_and_dedup(listed, start);
        Self::Listed(start..listed.len())
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Range(range) | Self::Listed(range) => range.len(),
        }
    }

    /// How slots are looked up, with the frame's list.
    pub(crate) fn slots<'a>(&self, listed: &'a [u32]) -> Slots<'a> {
        match self {
            Self::Range(range) => Slots { start: range.start as u32, listed: None },
            Self::Listed(part) => Slots { start: 0, listed: Some(&listed[part.clone()]) },
        }
    }
}

/// Sorts a list from `start` on, and keeps one of equal entries.
fn sort_and_dedup(list: &mut Vec<u32>, start: usize) {
    list[start..].sort_unstable();
    let mut end = start;
    for at in start..list.len() {
        if end == start || list[end - 1] != list[at] {
            list[end] = list[at];
            end += 1;
        }
    }
    list.truncate(end);
}

/// Looks up the slots of vertices, and the vertices of slots.
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

    /// The vertex of a slot.
    #[inline]
    pub(crate) fn index(self, slot: usize) -> usize {
        match self.listed {
            None => self.start as usize + slot,
            Some(listed) => listed[slot] as usize,
        }
    }

    /// Whether vertices of neighbouring slots are neighbours.
    #[inline]
    pub(crate) fn are_consecutive(self) -> bool {
        self.listed.is_none()
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
            // Of another draw.
            let mut listed = vec![7, 90];
            let used = UsedVertices::new(&indices, count, &mut listed);
            let slots = used.slots(&listed);
            for &index in &indices {
                let slot = slots.of(index);
                let exists = (index as usize) < count;
                assert_eq!(slot < used.len(), exists, "vertex {index} of {count} in {used:?}");
                assert!(!exists || slots.index(slot) == index as usize, "slot of {index}");
            }
        }
    }

    #[test]
    fn few_of_many_are_listed() {
        let mut listed = vec![9];
        let mut used = |indices: &[u32], count| UsedVertices::new(indices, count, &mut listed);
        assert_eq!(used(&[2, 9, 4], 10), UsedVertices::Range(2..10), "near each other");
        assert_eq!(used(&[900, 9, 9], 1000), UsedVertices::Listed(1..3), "far apart");
        assert_eq!(used(&[4, 5], 2), UsedVertices::Range(0..2), "not worth a look");
        assert_eq!(used(&[4, 5], 3).len(), 0, "none exists");
        assert_eq!(used(&[], 3).len(), 0, "none is asked for");
        assert_eq!(listed, [9, 9, 900], "each once, ascending, after what was there");
    }
}
