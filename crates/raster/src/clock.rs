//! Measures how long stages take, if that is requested.

use std::time::{Duration, Instant};

/// Measures laps, or nothing.
pub(crate) struct Clock(Option<Instant>);

impl Clock {
    pub(crate) fn new(is_timed: bool) -> Self {
        Self(is_timed.then(Instant::now))
    }

    /// The time since the last lap.
    pub(crate) fn lap(&mut self) -> Duration {
        let Some(last) = &mut self.0 else {
            return Duration::ZERO;
        };
        let now = Instant::now();
        now - std::mem::replace(last, now)
    }
}
