//! A table of vertices by what tells them apart, such as their places. It holds their numbers alone, 8 to 16 bytes
//! for each; a `HashMap` with the places as keys would take several times as much, while a large file is read.

use std::hash::{BuildHasher, Hash};
use std::hint::black_box;

use foldhash::quality::RandomState;

/// The number of keys that are best hashed at once: their slots are fetched side by side, and are still in the cache when
/// they are used.
pub(crate) const AT_ONCE: usize = 64;

/// An empty slot. There are fewer vertices.
const EMPTY: u32 = u32::MAX;

/// The numbers of vertices, 0, 1, 2 and so on, in the order in which they came.
#[derive(Debug, Default)]
pub(crate) struct VertexTable {
    /// Has a random seed: a file must not choose which keys collide. Of its hashes the lowest bits are used, so that all
    /// bits must be good. It takes less time than the hash of the standard library.
    hasher: RandomState,
    /// A power of two of them, at most half of them filled: a number is in the first free slot from that of
    /// its hash on.
    slots: Vec<u32>,
    count: u32,
}

impl VertexTable {
    /// A table with room for so many vertices.
    pub(crate) fn with_capacity(vertices: usize) -> Self {
        Self::with_hasher(vertices, RandomState::default())
    }

    /// The same for hashes of a hasher with a random seed.
    pub(crate) fn with_hasher(vertices: usize, hasher: RandomState) -> Self {
        Self { hasher, slots: vec![EMPTY; slot_count(vertices)], count: 0 }
    }

    /// The hashes of some keys, at best [`AT_ONCE`] of them. Their slots are read, too: the processor fetches all of
    /// them at the same time, and not one after the other when each is needed.
    pub(crate) fn hash_all<K: Hash>(&self, keys: impl Iterator<Item = K>, hashes: &mut Vec<u64>) {
        hashes.clear();
        hashes.extend(keys.map(|key| self.hasher.hash_one(key)));
        self.fetch(hashes.iter().copied());
    }

    /// Reads the slots of some hashes, as above.
    pub(crate) fn fetch(&self, hashes: impl Iterator<Item = u64>) {
        let slots = hashes.filter_map(|hash| self.slots.get(self.first_slot(hash)));
        black_box(slots.fold(0, |all, slot| all ^ slot));
    }

    /// The number of the vertex with a key and its hash, or as an error that of a new one, which is in the table then.
    /// `key_of` returns the key of each number before.
    pub(crate) fn number<K: Hash + Eq>(
        &mut self,
        key: &K,
        hash: u64,
        key_of: impl Fn(u32) -> K,
    ) -> Result<u32, u32> {
        if 2 * self.count as usize >= self.slots.len() {
            self.grow(&key_of);
        }
        let slot = self.slot_of(hash, |number| key_of(number) == *key);
        match self.slots[slot] {
            EMPTY => {
                self.slots[slot] = self.count;
                self.count += 1;
                Err(self.count - 1)
            }
            number => Ok(number),
        }
    }

    fn first_slot(&self, hash: u64) -> usize {
        hash as usize & self.slots.len().wrapping_sub(1)
    }

    /// The slot of a key with a hash: that of its number, or an empty one.
    fn slot_of(&self, hash: u64, is_it: impl Fn(u32) -> bool) -> usize {
        let last = self.slots.len() - 1;
        let mut slot = self.first_slot(hash);
        while self.slots[slot] != EMPTY && !is_it(self.slots[slot]) {
            slot = (slot + 1) & last;
        }
        slot
    }

    fn grow<K: Hash>(&mut self, key_of: &impl Fn(u32) -> K) {
        // The old slots are not needed: the numbers are known.
        let length = slot_count(2 * self.count as usize);
        self.slots = Vec::new();
        self.slots = vec![EMPTY; length];
        for number in 0..self.count {
            let slot = self.slot_of(self.hasher.hash_one(key_of(number)), |_| false);
            self.slots[slot] = number;
        }
    }
}

/// Twice as many slots as vertices, or somewhat more.
fn slot_count(vertices: usize) -> usize {
    (2 * vertices.max(8)).next_power_of_two()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_key_has_the_same_number() {
        for room in [0, 5, 10_000] {
            let (mut table, mut keys) = (VertexTable::with_capacity(room), Vec::new());
            let mut hashes = Vec::new();
            for step in 0..5000_u32 {
                let key = step * 7919 % 1000;
                table.hash_all([key].into_iter(), &mut hashes);
                let expected = keys.iter().position(|known| *known == key).map(|number| number as u32);
                let found = table.number(&key, hashes[0], |number| keys[number as usize]);
                assert_eq!(found, expected.ok_or(keys.len() as u32), "step {step}");
                if found.is_err() {
                    keys.push(key);
                }
            }
            assert_eq!(keys.len(), 1000, "each once");
        }
        let mut table = VertexTable::default();
        let mut hashes = Vec::new();
        table.hash_all(["a"].into_iter(), &mut hashes);
        assert_eq!(table.number(&"a", hashes[0], |_| ""), Err(0), "the first, in a table without slots");
    }
}
