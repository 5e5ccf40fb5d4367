//! Lists of different lengths in one piece of memory.

use super::answer::byte_count;

/// For each key its values, in the order in which they were given.
pub(super) struct Groups {
    starts: Vec<u32>,
    values: Vec<u32>,
}

impl Groups {
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
        Self { starts, values }
    }

    pub(super) fn of(&self, key: u32) -> &[u32] {
        let [from, to] = [0, 1].map(|i| self.starts[key as usize + i] as usize);
        &self.values[from..to]
    }

    pub(super) fn bytes(&self) -> usize {
        byte_count(&self.starts) + byte_count(&self.values)
    }
}
