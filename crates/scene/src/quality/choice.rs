//! The qualities among which a time budget chooses, the chosen quality with the settings that were reduced, and how far
//! predicted times are trusted: a quality that was too slow is not tried again for a while.

use std::fmt;
use std::time::Duration;

use super::{Preset, Quality};
use crate::settings::ShadingModel;

/// A quality with the predicted time and error of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Prediction {
    /// The quality.
    pub quality: Quality,
    /// The predicted time.
    pub time: Duration,
    /// The predicted error relative to the reference, as [`rmse`](super::rmse) measures it; `None`
    /// until something was learnt.
    pub error: Option<f64>,
}

/// The choice of a budget for the next frame, and what it gave up.
///
/// Its `Display` is such a line: `2×2 samples, lighting per pixel: about 9.3 ms of 16.0 ms, error
/// about 0.0034 …`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// The most accurate quality that fits, or the fastest of all.
    pub chosen: Prediction,
    /// The available time.
    pub limit: Duration,
    /// Whether the choice is predicted to fit.
    pub fits: bool,
    /// The next more accurate quality, which was given up; `None` if there is none.
    pub given_up: Option<Prediction>,
    /// The quality that errors are relative to.
    pub reference: Quality,
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

/// An error with two significant digits.
fn write_error(f: &mut fmt::Formatter<'_>, error: Option<f64>) -> fmt::Result {
    match error {
        Some(error) => write!(f, ", error about {error:.4}"),
        None => Ok(()),
    }
}

impl fmt::Display for Prediction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} (about {:.1} ms", self.quality, milliseconds(self.time))?;
        write_error(f, self.error)?;
        f.write_str(")")
    }
}

impl fmt::Display for Choice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (time, limit) = (milliseconds(self.chosen.time), milliseconds(self.limit));
        if self.fits {
            write!(f, "{}: about {time:.1} ms of {limit:.1} ms", self.chosen.quality)?;
        } else {
            write!(f, "the fastest setting takes about {time:.1} ms, more than {limit:.1} ms: ")?;
            write!(f, "{}", self.chosen.quality)?;
        }
        write_error(f, self.chosen.error)?;
        match &self.given_up {
            Some(better) => write!(f, "; gave up {better}")?,
            None => f.write_str("; gave up nothing")?,
        }
        if self.chosen.error.is_some() {
            write!(f, "; errors are RMSE in linear light against {}", self.reference)?;
        }
        Ok(())
    }
}

/// The qualities that a budget chooses from; the presets are among them. Over the scenes of `docs/accuracy.md` no other one
/// beats them in both time and error, and a test compares. While errors are unknown a later one counts as more accurate.
pub fn candidates() -> [Quality; 16] {
    let [draft, standard, high, reference] = Preset::ALL.map(Preset::quality);
    let samples = |quality, samples| Quality { samples, ..quality };
    // Shadow maps save time while there are few samples; with more of them, their errors are the largest left.
    let four_by_rays = Quality { shadows: high.shadows, ..standard };
    let nine = Quality { samples_per_axis: 3, ..high };
    [
        // For times in which no preset fits.
        Quality { shading: ShadingModel::Gouraud, ..draft },
        draft,
        samples(draft, 2),
        samples(draft, 4),
        samples(draft, 8),
        standard,
        samples(standard, 2),
        samples(four_by_rays, 2),
        samples(four_by_rays, 4),
        nine,
        samples(nine, 2),
        samples(nine, 4),
        high,
        samples(high, 2),
        samples(high, 4),
        reference,
    ]
}

/// The smallest safety factor on predicted times.
const LEAST_MARGIN: f64 = 0.08;

/// The largest one.
const MOST_MARGIN: f64 = 0.5;

/// How many typical misses the margin allows for.
const MISSES: f64 = 2.5;

/// A quality that was too slow waits for this many frames, and twice as many the next time.
const FIRST_REST: u32 = 8;

/// The longest wait.
const LONGEST_REST: u32 = 256;

/// Learns how well times are predicted, and delays qualities that were too slow.
#[derive(Clone, Debug, Default)]
pub(super) struct Patience {
    /// The recent relative excess of times over predictions, on average.
    miss: f64,
    resting: Vec<Rest>,
}

/// A quality that was too slow.
#[derive(Clone, Copy, Debug)]
struct Rest {
    quality: Quality,
    /// Frames to wait.
    left: u32,
    /// Frames to wait the next time.
    next: u32,
}

impl Patience {
    /// Reports the time of a frame, its prediction, and its limit.
    pub(super) fn note(&mut self, quality: Quality, [time, predicted, limit]: [Duration; 3]) {
        /// The weight of the last frame.
        const NEW: f64 = 0.1;
        let miss = time.as_secs_f64() / predicted.as_secs_f64().max(1e-9) - 1.0;
        self.miss += NEW * (miss.clamp(0.0, MOST_MARGIN) - self.miss);
        self.resting.iter_mut().for_each(|rest| rest.left = rest.left.saturating_sub(1));
        if time > limit {
            self.rest(quality);
        }
    }

    fn rest(&mut self, quality: Quality) {
        match self.resting.iter_mut().find(|rest| rest.quality == quality) {
            Some(rest) => (rest.left, rest.next) = (rest.next, (2 * rest.next).min(LONGEST_REST)),
            None => self.resting.push(Rest { quality, left: FIRST_REST, next: 2 * FIRST_REST }),
        }
    }

    /// Whether a quality has to wait.
    pub(super) fn is_resting(&self, quality: Quality) -> bool {
        self.resting.iter().any(|rest| rest.quality == quality && rest.left > 0)
    }

    /// The time that may be needed for a prediction.
    pub(super) fn with_margin(&self, time: Duration) -> Duration {
        time.mul_f64(1.0 + (LEAST_MARGIN + MISSES * self.miss).min(MOST_MARGIN))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quality::Preset;

    const LIMIT: Duration = Duration::from_millis(16);

    fn ms(milliseconds: u64) -> Duration {
        Duration::from_millis(milliseconds)
    }

    #[test]
    fn what_was_too_slow_waits_longer_each_time() {
        let [draft, high] = [Preset::Draft, Preset::High].map(Preset::quality);
        let mut patience = Patience::default();
        for expected in [8, 16, 32] {
            patience.note(high, [ms(17), ms(12), LIMIT]);
            let mut waited = 0;
            while patience.is_resting(high) {
                patience.note(draft, [ms(2), ms(2), LIMIT]);
                waited += 1;
            }
            assert_eq!(waited, expected, "images");
        }
        assert!(!patience.is_resting(draft), "what is quick does not wait");
    }

    #[test]
    fn margins_follow_what_was_missed() {
        let (mut patience, quality) = (Patience::default(), Preset::Draft.quality());
        assert_eq!(patience.with_margin(ms(100)), ms(108), "to begin with");
        (0..50).for_each(|_| patience.note(quality, [ms(11), ms(10), LIMIT]));
        let margin = patience.with_margin(ms(100));
        // A tenth too long each time: 0.08 + 2.5 · 0.1, reached up to 0.9^50 = 0.5 %.
        assert!((ms(132)..=ms(133)).contains(&margin), "{margin:?}");
        (0..50).for_each(|_| patience.note(quality, [ms(99), ms(10), LIMIT]));
        assert_eq!(patience.with_margin(ms(100)), ms(150), "and have an end");
    }
}
