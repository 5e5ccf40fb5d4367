//! Lists of different lengths in one allocation.

use super::answer::byte_count;
use super::reads::Reads;

/// For each key its values, in the order in which they were given.
pub(super) struct Groups<const COUNTED: bool> {
    starts: Vec<u32>,
    values: Vec<u32>,
    reads: Reads<COUNTED>,
}

impl<const COUNTED: bool> Groups<COUNTED> {
    /// Of pairs of a key below `count` and a value.
    pub(super) fn new(count: usize, pairs: impl Iterator<Item = [u32; 2]> + Clone) -> Self {
        let mut starts = vec![0; count + 1];
        for [key, _] in pairs.clone() {
            starts[key as usize + 1] += 1;
        }
        for key in 0..count {
            starts[key + 1] += starts[key];
        }
        let mut next = starts.clone();
        let mut values = vec![0; starts[count] as usize];
        for [key, value] in pairs {
            values[next[key as usize] as usize] = value;
            next[key as usize] += 1;
        }
        Self { starts, values, reads: Reads::default() }
    }

    /// The values of a key. Each counts as read when the iterator reaches it; where they begin and end does not count.
    #[inline]
    pub(super) fn of(&self, key: u32) -> impl Iterator<Item = u32> + Clone + '_ {
        let [from, to] = [0, 1].map(|i| self.starts[key as usize + i] as usize);
        self.values[from..to].iter().map(|&value| self.reads.note(value))
    }

    pub(super) fn reads(&self) -> u64 {
        self.reads.count()
    }

    pub(super) fn bytes(&self) -> usize {
        byte_count(&self.starts) + byte_count(&self.values)
    }
}
