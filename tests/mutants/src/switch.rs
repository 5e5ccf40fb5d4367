//! The switch: which mutant of this process is active, or a record of those that it reaches.
//!
//! This file is the crate `trigon-mutants-switch` of the mutated workspace.

use std::fs::OpenOptions;
use std::io::Write;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering::Relaxed};

/// No mutant is active, and those that are reached are written to a file.
const RECORDING: u32 = u32::MAX - 1;
const NOT_READ_YET: u32 = u32::MAX;

static ACTIVE: AtomicU32 = AtomicU32::new(NOT_READ_YET);
static REACHED: [AtomicBool; 4096] = [const { AtomicBool::new(false) }; 4096];

/// Whether `TRIGON_MUTANT` is this number. If `TRIGON_MUTANTS_REACHED` names a file instead, the number is added
/// to it.
// The compiler warns of every use, and so says which mutants are compiled at all.
#[deprecated]
#[inline]
pub fn active(number: u32) -> bool {
    let active = ACTIVE.load(Relaxed);
    if active < RECORDING { active == number } else { read(number) }
}

#[cold]
fn read(number: u32) -> bool {
    if ACTIVE.load(Relaxed) == NOT_READ_YET {
        let recording = std::env::var_os("TRIGON_MUTANTS_REACHED").map(|_| RECORDING);
        let chosen = || std::env::var("TRIGON_MUTANT").ok()?.parse().ok();
        ACTIVE.store(recording.or_else(chosen).unwrap_or(0), Relaxed);
    }
    let active = ACTIVE.load(Relaxed);
    if active == RECORDING && !REACHED[number as usize].swap(true, Relaxed) {
        record(number);
    }
    active == number
}

fn record(number: u32) {
    let path = std::env::var_os("TRIGON_MUTANTS_REACHED").expect("it is set while mutants are recorded");
    let file = OpenOptions::new().create(true).append(true).open(path);
    let written = file.and_then(|mut file| file.write_all(format!("{number}\n").as_bytes()));
    written.expect("a file for the mutants that are reached");
}

#[cfg(test)]
mod tests {
    #[test]
    #[expect(deprecated, reason = "deprecated so that the compiler lists its uses")]
    fn no_mutant_is_active_by_default() {
        assert!(!super::active(1), "unless the variables of this test's process say so");
        assert!(!super::active(2), "nor when they have been read");
    }
}
