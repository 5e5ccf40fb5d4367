//! Measures the times of programs that are compared with each other, in turns.

use std::time::Instant;

/// The results of repeated runs, in the caller's unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// A quarter of the runs was shorter.
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

    /// The same in another unit.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        let Self { low, median, high } = self;
        Self { low: low * factor, median: median * factor, high: high * factor }
    }
}

/// The nanoseconds of each candidate. All run once in each round, so that other load on the machine affects
/// all of them alike. An uncounted first round fills caches.
pub fn interleaved(rounds: usize, candidates: &mut [Box<dyn FnMut() + '_>]) -> Vec<Spread> {
    let mut times = vec![Vec::new(); candidates.len()];
    for round in 0..=rounds.max(1) {
        for (times, candidate) in times.iter_mut().zip(&mut *candidates) {
            let start = Instant::now();
            candidate();
            if round > 0 {
                times.push(start.elapsed().as_secs_f64() * 1e9);
            }
        }
    }
    times.into_iter().map(Spread::of).collect()
}

/// The nanoseconds that each variant takes, in turn.
pub(crate) fn nanoseconds<'a, V: Copy>(
    rounds: usize,
    variants: &[V],
    mut run: impl FnMut(V) -> Box<dyn FnMut() + 'a>,
) -> Vec<Spread> {
    let mut candidates: Vec<Box<dyn FnMut() + 'a>> = variants.iter().map(|&variant| run(variant)).collect();
    interleaved(rounds, &mut candidates)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarters_of_the_runs_are_shorter_and_longer() {
        let spread = Spread::of(vec![5.0, 1.0, 4.0, 2.0, 3.0]);
        assert_eq!(spread, Spread { low: 2.0, median: 3.0, high: 4.0 }, "of five values");
    }

    #[test]
    fn all_candidates_run_in_each_round() {
        let (mut first, mut second) = (0, 0);
        let spreads = interleaved(4, &mut [Box::new(|| first += 1), Box::new(|| second += 1)]);
        assert_eq!((first, second, spreads.len()), (5, 5, 2), "one round to warm up, four to count");
    }
}
