//! The sample: which mutants of the list are tested.
//!
//! Every mutant has a place in the drawing order, by a hash of the seed and its identity. The sample is the first
//! of a crate that can be tested at all. So a change of one function leaves the mutants of others in the sample.

use crate::error::{Error, Result, at};
use crate::list::Mutant;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Of the drawing order.
pub(crate) const SEED: u64 = 20_261_123;

/// Why a mutant was drawn but is not tested; the next in order takes its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(crate) enum Dropped {
    /// The mutated code is no valid Rust: cargo-mutants calls this unviable.
    DoesNotCompile,
    /// In constants, `const fn`, chains of `let` and functions whose return type is `impl Trait`.
    CannotBeSwitched,
    /// For other processors or features.
    NotCompiledHere,
}

/// A mutant that is built in; its number is its place in the list plus 1.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Drawn {
    pub(crate) identity: String,
    /// The name of the crate, without `trigon-`.
    pub(crate) krate: String,
}

/// What was drawn, kept between runs of the program.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(crate) struct Sample {
    /// Of the workspace when it was copied.
    pub(crate) commit: String,
    /// How many mutants cargo-mutants lists, by crate.
    pub(crate) listed: BTreeMap<String, usize>,
    pub(crate) drawn: Vec<Drawn>,
    /// By identity.
    pub(crate) dropped: BTreeMap<String, Dropped>,
}

impl Sample {
    /// The sample of an earlier run, or an empty one.
    pub(crate) fn load(path: &Path) -> Result<Self> {
        if !path.exists() {
            return Ok(Self::default());
        }
        let text = at(path, fs::read_to_string(path))?;
        serde_json::from_str(&text).map_err(|error| Error::Json { path: path.to_owned(), error })
    }

    pub(crate) fn save(&self, path: &Path) -> Result<()> {
        let text = serde_json::to_string_pretty(self)
            .map_err(|error| Error::Json { path: path.to_owned(), error })?;
        at(path, fs::write(path, text))
    }

    /// The mutants of a crate, with their numbers.
    pub(crate) fn of<'a>(&'a self, krate: &'a str) -> impl Iterator<Item = (u32, &'a Drawn)> {
        (1..).zip(&self.drawn).filter(move |(_, drawn)| drawn.krate == krate)
    }
}

/// FNV-1a over the seed and the text, and SplitMix64's last steps, after which every bit depends on all others.
fn place(seed: u64, identity: &str) -> u64 {
    let bytes = seed.to_le_bytes().into_iter().chain(identity.bytes());
    let hash = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    let hash = (hash ^ (hash >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let hash = (hash ^ (hash >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    hash ^ (hash >> 31)
}

/// Sorts the mutants of a crate into the drawing order.
pub(crate) fn shuffle(mutants: &mut [Mutant]) {
    mutants.sort_by_cached_key(|mutant| place(SEED, &mutant.identity));
}

/// The first `size` mutants of a shuffled list that are not dropped.
pub(crate) fn draw<'a>(
    shuffled: &'a [Mutant],
    size: usize,
    dropped: &'a BTreeMap<String, Dropped>,
) -> impl Iterator<Item = &'a Mutant> {
    shuffled.iter().filter(|mutant| !dropped.contains_key(&mutant.identity)).take(size)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_spread_evenly() {
        let mut counts = [0; 16];
        for number in 0..16_000 {
            let place = place(SEED, &format!("src/a.rs: replace + with - in f ({number})"));
            counts[(place >> 60) as usize] += 1;
        }
        // 1000 on average, with a standard deviation of 31.
        assert!(counts.iter().all(|count| (850..1150).contains(count)), "{counts:?}");
    }
}
