//! How long stages take, if that is asked for.

use std::ops::AddAssign;
use std::time::{Duration, Instant};

/// How long the stages of a frame took: of vertices and set-up the time that
/// passed, of those in tiles the sum over all threads. Zero unless
/// [`ExecuteSettings::timed`](crate::ExecuteSettings::timed) asks for it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StageTimes {
    /// Running vertices.
    pub vertices: Duration,
    /// Setting up triangles and sorting them into tiles.
    pub set_up: Duration,
    /// Coverage, depth and masks.
    pub visibility: Duration,
    /// Shading what is visible.
    pub shading: Duration,
    /// Shading and laying over what is translucent.
    pub blending: Duration,
    /// Averaging samples, encoding, and writing to the target.
    pub resolve: Duration,
}

impl AddAssign for StageTimes {
    fn add_assign(&mut self, other: Self) {
        self.vertices += other.vertices;
        self.set_up += other.set_up;
        self.visibility += other.visibility;
        self.shading += other.shading;
        self.blending += other.blending;
        self.resolve += other.resolve;
    }
}

/// Measures laps, or nothing.
pub(crate) struct Clock(Option<Instant>);

impl Clock {
    pub(crate) fn new(is_asked: bool) -> Self {
        Self(is_asked.then(Instant::now))
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
