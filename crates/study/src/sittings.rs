//! Sittings: runs of the whole program, of which the last one pools the times of all. Where a process has its memory, and what
//! else the machine did in those minutes, changes times more than anything within one run.
//!
//! A sitting measures the same variants in the same order of chapters. So the times of one call of
//! [`interleaved`](crate::interleaved) are found in the file of another sitting by the number of the call.

use std::fs;
use std::io;
use std::path::Path;
use std::sync::Mutex;

/// The times of one call: of each candidate, nanoseconds.
type Call = Vec<Vec<f64>>;

/// What this process measured, and what earlier ones did.
struct Sittings {
    random: u64,
    own: Vec<Call>,
    earlier: Vec<Vec<Call>>,
    is_last: bool,
}

static SITTINGS: Mutex<Sittings> =
    Mutex::new(Sittings { random: 1, own: Vec::new(), earlier: Vec::new(), is_last: true });

/// Runs a function on the state; one that panicked has left it whole.
fn with<T>(run: impl FnOnce(&mut Sittings) -> T) -> T {
    run(&mut SITTINGS.lock().unwrap_or_else(std::sync::PoisonError::into_inner))
}

/// Begins the last sitting: the order of all runs follows from the seed, and the times in these files count, too.
///
/// # Errors
/// A file cannot be read, or is not one of times.
pub fn begin_last(seed: u64, earlier: &[impl AsRef<Path>]) -> io::Result<()> {
    let earlier = earlier.iter().map(|path| parsed(&fs::read_to_string(path)?)).collect::<io::Result<_>>()?;
    // Xorshift never leaves 0.
    with(|sittings| *sittings = Sittings { random: seed | 1, own: Vec::new(), earlier, is_last: true });
    Ok(())
}

/// Begins an earlier one, whose times alone count.
pub fn begin(seed: u64) {
    let (own, earlier) = (Vec::new(), Vec::new());
    with(|sittings| *sittings = Sittings { random: seed | 1, own, earlier, is_last: false });
}

/// Whether this is the last sitting, which measures what is not a time, too.
pub(crate) fn is_last() -> bool {
    with(|sittings| sittings.is_last)
}

/// Writes the times that were measured in this sitting.
///
/// # Errors
/// What the file system says.
pub fn write(path: &Path) -> io::Result<()> {
    let line = |call: &Call| {
        let candidates =
            call.iter().map(|times| times.iter().map(f64::to_string).collect::<Vec<_>>().join(" "));
        candidates.collect::<Vec<_>>().join(",") + "\n"
    };
    fs::write(path, with(|sittings| sittings.own.iter().map(line).collect::<String>()))
}

fn parsed(text: &str) -> io::Result<Vec<Call>> {
    let number = |word: &str| word.parse::<f64>().map_err(io::Error::other);
    let candidate = |times: &str| times.split_whitespace().map(number).collect::<io::Result<Vec<f64>>>();
    text.lines().map(|line| line.split(',').map(candidate).collect()).collect()
}

/// The numbers below `count` in the next random order (R. Fisher and F. Yates, 1938; R. Durstenfeld, 1964).
pub(crate) fn order(count: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    with(|sittings| {
        for last in (1..count).rev() {
            order.swap(last, (sittings.next() % (last as u64 + 1)) as usize);
        }
    });
    order
}

/// The times of a call, with those of the same call in earlier sittings.
pub(crate) fn pooled(mut times: Call) -> Call {
    with(|sittings| {
        let number = sittings.own.len();
        sittings.own.push(times.clone());
        for earlier in sittings.earlier.iter().filter_map(|calls| calls.get(number)) {
            for (times, earlier) in times.iter_mut().zip(earlier) {
                times.extend(earlier);
            }
        }
    });
    times
}

impl Sittings {
    /// Xorshift (G. Marsaglia, 2003).
    fn next(&mut self) -> u64 {
        self.random ^= self.random << 13;
        self.random ^= self.random >> 7;
        self.random ^= self.random << 17;
        self.random
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_read_as_they_were_written() {
        let calls = parsed("1 2.5,3 4\n7\n").unwrap();
        assert_eq!(calls, [vec![vec![1.0, 2.5], vec![3.0, 4.0]], vec![vec![7.0]]]);
        assert!(parsed("1 2,x\n").is_err(), "no number");
    }

    #[test]
    fn orders_have_all_numbers_and_differ() {
        let orders: Vec<Vec<usize>> = (0..20).map(|_| order(6)).collect();
        for order in &orders {
            let mut sorted = order.clone();
            sorted.sort_unstable();
            assert_eq!(sorted, [0, 1, 2, 3, 4, 5], "{order:?}");
        }
        assert!(orders.iter().any(|order| *order != orders[0]), "not always the same");
    }
}
