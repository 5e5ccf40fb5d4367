//! Measures the times of programs that are compared with each other, in turns.

use std::time::Instant;

use crate::sittings;

/// The results of repeated runs, in the caller's unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// A quarter of the runs was shorter. Those of all sittings count.
    pub low: f64,
    /// The run in the middle.
    pub median: f64,
    /// A quarter of the runs was longer.
    pub high: f64,
}

impl Spread {
    /// Of at least one value.
    fn of(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let last = values.len() - 1;
        let [low, median, high] = [1, 2, 3].map(|quarters| values[last * quarters / 4]);
        Self { low, median, high }
    }

    /// For one of so many things that were done in each run.
    #[must_use]
    pub fn per(self, count: usize) -> Self {
        let Self { low, median, high } = self;
        let share = |whole: f64| whole / count as f64;
        Self { low: share(low), median: share(median), high: share(high) }
    }

    /// The same in another unit.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        let Self { low, median, high } = self;
        Self { low: low * factor, median: median * factor, high: high * factor }
    }
}

/// Rounds in a row for the same memory.
const SITTING: usize = 4;

/// The most that memory is allocated anew.
const MOST_SITTINGS: usize = 3;

/// The nanoseconds of each candidate. All run once in each round, in an order that changes from round to round, so that other
/// load on the machine affects all of them alike, and none always follows the same one. An uncounted first round fills caches.
pub fn interleaved(rounds: usize, candidates: &mut [Box<dyn FnMut() + '_>]) -> Vec<Spread> {
    let mut times = vec![Vec::new(); candidates.len()];
    run_rounds(rounds, candidates, &mut times);
    spreads(times)
}

/// Appends the nanoseconds of each candidate in each round but the first.
fn run_rounds(rounds: usize, candidates: &mut [Box<dyn FnMut() + '_>], times: &mut [Vec<f64>]) {
    for round in 0..=rounds.max(1) {
        for index in sittings::order(candidates.len()) {
            let start = Instant::now();
            candidates[index]();
            if round > 0 {
                times[index].push(start.elapsed().as_nanos() as f64);
            }
        }
    }
}

/// The spreads of the times of each candidate, with those of earlier sittings.
fn spreads(times: Vec<Vec<f64>>) -> Vec<Spread> {
    sittings::pooled(times).into_iter().map(Spread::of).collect()
}

/// The nanoseconds that each variant takes, in turn.
///
/// Where a variant's memory lies changes its time by up to a third, from one run of the program to the next. So many
/// rounds are shared among variants that are made two or three times, in other memory each time.
pub(crate) fn nanoseconds<'a, V: Copy>(
    rounds: usize,
    variants: &[V],
    mut run: impl FnMut(V) -> Box<dyn FnMut() + 'a>,
) -> Vec<Spread> {
    let makings = (rounds / SITTING).clamp(1, MOST_SITTINGS);
    let mut times = vec![Vec::new(); variants.len()];
    // Those of the last time still hold their memory while the next ones are made.
    let mut candidates: Vec<Box<dyn FnMut() + 'a>> = Vec::new();
    for _ in 0..makings {
        candidates = {
            let next = variants.iter().map(|&variant| run(variant)).collect();
            drop(candidates);
            next
        };
        run_rounds(rounds.div_ceil(makings), &mut candidates, &mut times);
    }
    spreads(times)
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    #[test]
    fn quarters_of_the_runs_are_shorter_and_longer() {
        let spread = Spread::of(vec![5.0, 1.0, 4.0, 2.0, 3.0]);
        assert_eq!(spread, Spread { low: 2.0, median: 3.0, high: 4.0 }, "of five values");
    }

    #[test]
    fn many_rounds_are_shared_among_variants_made_anew() {
        for (rounds, made, counted) in [(1, 1, 1), (5, 1, 5), (8, 2, 8), (15, 3, 15)] {
            let (sittings, runs) = (Cell::new(0), Cell::new(0));
            nanoseconds(rounds, &[()], |()| {
                sittings.set(sittings.get() + 1);
                Box::new(|| runs.set(runs.get() + 1))
            });
            assert_eq!((sittings.get(), runs.get()), (made, counted + made), "of {rounds} rounds");
        }
    }

    #[test]
    fn times_are_told_for_each_thing_and_in_other_units() {
        let spread = Spread { low: 2e3, median: 4e3, high: 7e3 };
        assert_eq!(spread.per(1000), Spread { low: 2.0, median: 4.0, high: 7.0 }, "of a thousand");
        assert_eq!(spread.scaled(0.5), Spread { low: 1e3, median: 2e3, high: 3.5e3 }, "in another unit");
    }

    #[test]
    fn all_candidates_run_in_each_round() {
        let (mut first, mut second) = (0, 0);
        let spreads = interleaved(4, &mut [Box::new(|| first += 1), Box::new(|| second += 1)]);
        assert_eq!((first, second, spreads.len()), (5, 5, 2), "one round to warm up, four to count");
    }
}
