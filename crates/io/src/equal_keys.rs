//! Finds out which of many keys, such as the places of corners, are equal. All threads take part.

use std::hash::{BuildHasher, Hash};
use std::sync::atomic::{AtomicU32, Ordering};

use foldhash::quality::RandomState;
use rayon::prelude::*;

use crate::vertex_table::{AT_ONCE, VertexTable};

/// Keys in the order in which they came, and for each the first one that is equal.
pub(crate) struct EqualKeys<K> {
    /// Has a random seed, as in [`VertexTable`].
    hasher: RandomState,
    /// As many as there are threads: each has the keys whose hashes have its number in their uppermost bits.
    parts: Vec<Part<K>>,
    /// The number of keys so far.
    count: u32,
}

/// The different keys with some hashes.
struct Part<K> {
    table: VertexTable,
    keys: Vec<K>,
    /// The number of each of them among all keys.
    numbers: Vec<u32>,
}

impl<K: Copy + Eq + Hash + Send + Sync> EqualKeys<K> {
    /// No keys, and room for so many different ones.
    pub(crate) fn with_capacity(different: usize) -> Self {
        let (hasher, parts) = (RandomState::default(), rayon::current_num_threads().max(1));
        let part = |_| Part {
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

impl<K: Copy + Eq + Hash> Part<K> {
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
