//! A table of vertices by what tells them apart, such as their places. It holds their numbers alone, 8 to 16
//! bytes for each; a `HashMap` with the places as keys would take several times as much, while a large file
//! is read. Equal keys among many, such as the positions of corners, are found by all threads.

use std::hash::{BuildHasher, Hash};
use std::hint::black_box;
use std::sync::atomic::{AtomicU32, Ordering};

use foldhash::quality::RandomState;
use rayon::prelude::*;

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

/// Keys in the order in which they came, and for each the first one that is equal.
pub(crate) struct EqualKeys<K> {
    /// Has a random seed, as in [`VertexTable`].
    hasher: RandomState,
    /// As many as there are threads: each has the keys whose hashes have its number in their uppermost bits.
    parts: Vec<TablePart<K>>,
    /// The number of keys so far.
    count: u32,
}

/// The different keys with some hashes.
struct TablePart<K> {
    table: VertexTable,
    keys: Vec<K>,
    /// The number of each of them among all keys.
    numbers: Vec<u32>,
}

impl<K: Copy + Eq + Hash + Send + Sync> EqualKeys<K> {
    /// No keys, and room for so many different ones.
    pub(crate) fn with_capacity(different: usize) -> Self {
        let (hasher, parts) = (RandomState::default(), rayon::current_num_threads().max(1));
        let part = |_| TablePart {
            table: VertexTable::with_hasher(different / parts, hasher.clone()),
            keys: Vec::new(),
            numbers: Vec::new(),
        };
        Self { parts: (0..parts).map(part).collect(), hasher, count: 0 }
    }

    /// Adds keys, at best tens of thousands at once; fewer than `u32::MAX` in all. Returns for each the number of the first
    /// key that is equal, which is its own if it is new.
    pub(crate) fn add(&mut self, keys: &[K]) -> Vec<u32> {
        let hashes: Vec<u64> = keys.par_iter().map(|key| self.hasher.hash_one(key)).collect();
        // Each part writes those of its own keys.
        let firsts: Vec<AtomicU32> = keys.iter().map(|_| AtomicU32::new(0)).collect();
        let (before, parts) = (self.count, self.parts.len());
        self.parts.par_iter_mut().enumerate().for_each(|(number, part)| {
            let is_own = |hash: u64| part_of(hash, parts) == number;
            part.add(before, keys, &hashes, is_own, &firsts);
        });
        self.count += keys.len() as u32;
        firsts.into_iter().map(AtomicU32::into_inner).collect()
    }
}

/// The part of a hash.
fn part_of(hash: u64, parts: usize) -> usize {
    (((hash >> 32) * parts as u64) >> 32) as usize
}

impl<K: Copy + Eq + Hash> TablePart<K> {
    /// Adds those of some keys that are its own.
    fn add(
        &mut self,
        before: u32,
        keys: &[K],
        hashes: &[u64],
        is_own: impl Fn(u64) -> bool,
        firsts: &[AtomicU32],
    ) {
        // Without a branch: no processor can predict whose a key is.
        let (mut own, mut count) = (vec![0; keys.len() + 1], 0);
        for (index, &hash) in hashes.iter().enumerate() {
            own[count] = index;
            count += usize::from(is_own(hash));
        }
        for some in own[..count].chunks(AT_ONCE) {
            self.table.fetch(some.iter().map(|&index| hashes[index]));
            for &index in some {
                let first = self.first(before + index as u32, keys[index], hashes[index]);
                firsts[index].store(first, Ordering::Relaxed);
            }
        }
    }

    /// The first of all keys that equals one, whose number and hash these are.
    fn first(&mut self, number: u32, key: K, hash: u64) -> u32 {
        match self.table.number(&key, hash, |known| self.keys[known as usize]) {
            Ok(known) => self.numbers[known as usize],
            Err(_) => {
                self.keys.push(key);
                self.numbers.push(number);
                number
            }
        }
    }
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

    #[test]
    fn the_first_of_equal_keys_is_found_whatever_the_threads() {
        for threads in [1, 2, 3, 8] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            let all: Vec<u32> = (0..20_000_u32).map(|step| step * 7919 % 3001).collect();
            let mut equal = EqualKeys::with_capacity(10);
            let found: Vec<u32> =
                pool.install(|| all.chunks(4500).flat_map(|keys| equal.add(keys)).collect());
            for (number, key) in all.iter().enumerate() {
                let expected = all.iter().position(|other| other == key).expect("itself");
                assert_eq!(found[number] as usize, expected, "key {number} with {threads} threads");
            }
        }
    }

    #[test]
    fn every_hash_has_a_part() {
        for parts in 1..20 {
            assert_eq!(part_of(0, parts), 0, "the first of {parts}");
            assert_eq!(part_of(u64::MAX, parts), parts - 1, "the last of {parts}");
        }
    }
}
