//! The times of frames.

use std::time::Instant;

/// The times of repeated frames in milliseconds, shortest first; never empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Timings {
    milliseconds: Vec<f64>,
}

impl Timings {
    /// Times `frame`, which returns when the image is complete, `repetitions`
    /// times (at least once), after three frames that fill caches and arenas.
    ///
    /// A frame of more than 1.5 s is warmed up twice and repeated five times at most. The other renderers
    /// were timed by the same rules.
    pub fn of_frames<R>(repetitions: usize, frame: impl FnMut() -> R) -> Self {
        Self::of_times(repetitions, timed(frame))
    }

    /// Times `frame` after exactly `warm_up` frames, so that two runs do the same work
    /// whatever the clock says: for tools that count instructions.
    pub fn of_frames_after<R>(warm_up: usize, repetitions: usize, mut frame: impl FnMut() -> R) -> Self {
        (0..warm_up).for_each(|_| drop(frame()));
        Self::repeated(repetitions, timed(frame))
    }

    /// The same where `time` draws a frame and tells how long it took.
    fn of_times(repetitions: usize, mut time: impl FnMut() -> f64) -> Self {
        const LONG: f64 = 1500.0;
        const ENOUGH_OF_LONG: usize = 5;
        time();
        let mut repetitions = repetitions.max(1);
        if time() > LONG {
            repetitions = repetitions.min(ENOUGH_OF_LONG);
        } else {
            time();
        }
        Self::repeated(repetitions, time)
    }

    fn repeated(repetitions: usize, mut time: impl FnMut() -> f64) -> Self {
        let mut milliseconds: Vec<f64> = (0..repetitions.max(1)).map(|_| time()).collect();
        milliseconds.sort_by(f64::total_cmp);
        Self { milliseconds }
    }

    /// All times, shortest first.
    #[must_use]
    pub fn milliseconds(&self) -> &[f64] {
        &self.milliseconds
    }

    /// The shortest time.
    #[must_use]
    pub fn min(&self) -> f64 {
        self.milliseconds[0]
    }

    /// The longest time.
    #[must_use]
    pub fn max(&self) -> f64 {
        self.milliseconds[self.milliseconds.len() - 1]
    }

    /// The time in the middle, or the mean of the two there.
    #[must_use]
    pub fn median(&self) -> f64 {
        let count = self.milliseconds.len();
        (self.milliseconds[(count - 1) / 2] + self.milliseconds[count / 2]) / 2.0
    }
}

/// What draws a frame and returns how many milliseconds it took.
fn timed<R>(mut frame: impl FnMut() -> R) -> impl FnMut() -> f64 {
    move || {
        let start = Instant::now();
        frame();
        start.elapsed().as_secs_f64() * 1e3
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn timings(milliseconds: &[f64]) -> Timings {
        Timings { milliseconds: milliseconds.to_vec() }
    }

    #[test]
    fn the_median_is_in_the_middle() {
        assert_eq!(timings(&[1.0, 2.0, 9.0]).median(), 2.0, "of an odd number");
        assert_eq!(timings(&[1.0, 2.0, 4.0, 9.0]).median(), 3.0, "of an even number");
    }

    /// How many frames are drawn, and how many count, if each takes so long.
    fn counts(repetitions: usize, milliseconds: f64) -> (usize, usize) {
        let mut frames = 0;
        let timings = Timings::of_times(repetitions, || {
            frames += 1;
            milliseconds
        });
        (frames, timings.milliseconds().len())
    }

    #[test]
    fn three_frames_warm_up_and_two_where_they_take_long() {
        assert_eq!(counts(4, 20.0), (7, 4), "all are asked for");
        assert_eq!(counts(9, 20.0), (12, 9), "all are asked for");
        assert_eq!(counts(9, 2000.0), (7, 5), "as many as anybody waits for");
        assert_eq!(counts(0, 2000.0), (3, 1), "one is measured in any case");
    }

    #[test]
    fn times_are_sorted() {
        let mut times = [9.0, 9.0, 9.0, 3.0, 1.0, 2.0].into_iter();
        let timings = Timings::of_times(3, || times.next().expect("six are asked for"));
        assert_eq!(timings.milliseconds(), [1.0, 2.0, 3.0], "without those that warm up");
    }

    #[test]
    fn a_frame_is_drawn_each_time() {
        let mut frames = 0;
        let timings = Timings::of_frames(1, || frames += 1);
        assert!(frames > timings.milliseconds().len(), "{frames} frames, the first not counted");
    }

    #[test]
    fn a_fixed_warm_up_draws_as_many_frames_as_it_says() {
        let mut frames = 0;
        let timings = Timings::of_frames_after(1, 2, || frames += 1);
        assert_eq!((timings.milliseconds().len(), frames), (2, 3));
    }
}
