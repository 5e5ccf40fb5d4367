//! When to draw, and how well. A plain state machine over a clock that the
//! caller reads: the heart of "nothing runs when nothing changes".
//!
//! - Something moves: draft frames, at most 60 a second.
//! - It has come to rest: one full frame, and then nothing.
//! - Drafts that take too long are drawn smaller.

use std::time::Duration;

/// Between the beginnings of two frames: 60 a second.
const FRAME: Duration = Duration::from_micros(16_667);

/// After this long without a movement, the picture is refined.
const REST: Duration = Duration::from_millis(150);

/// Where a full frame takes long, it waits for as long as it will take, so that
/// a hand that only pauses is not held up; but no longer than this.
const LONGEST_REST: Duration = Duration::from_millis(600);

/// A draft that takes longer than this makes the next one smaller: below 25
/// frames a second a hand notices.
const SLOW: Duration = Duration::from_millis(40);

/// A draft that takes less than this can be larger again: four times as many
/// pixels still stay below [`SLOW`].
const QUICK: Duration = Duration::from_millis(8);

/// Drafts are not drawn smaller than by this factor in each direction.
const MOST_SHRINK: u32 = 4;

/// What has happened to the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Change {
    /// It is moving; more of that is likely to follow.
    Moving,
    /// It has changed once.
    Settled,
    /// Only what is written over it.
    Overlay,
}

/// How to draw a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Quality {
    /// One sample per pixel, and fewer pixels in each direction by this factor.
    Draft { shrink: u32 },
    /// As the settings say.
    Full,
}

/// What the next frame has to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Work {
    /// Draw the scene.
    Render(Quality),
    /// Only the overlay; the picture under it is still good.
    Compose,
}

/// When to draw next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Wake {
    /// Now.
    Now,
    /// Not before then.
    At(Duration),
    /// Not before something happens.
    Never,
}

/// What is on the screen, compared to what should be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Shown {
    Full,
    /// Good, but for what is written over it.
    OldOverlay,
    /// A draft of the right picture.
    Draft,
    /// The wrong picture.
    Old,
}

/// Decides when to draw. All times count from the same moment.
#[derive(Debug)]
pub(crate) struct Pacing {
    shown: Shown,
    /// When something last moved; `None` after a change that is no movement.
    moved: Option<Duration>,
    /// When the last frame began.
    drawn: Option<Duration>,
    shrink: u32,
    rest: Duration,
}

impl Pacing {
    pub(crate) fn new() -> Self {
        Self { shown: Shown::Old, moved: None, drawn: None, shrink: 1, rest: REST }
    }

    /// Something has changed.
    pub(crate) fn changed(&mut self, change: Change, now: Duration) {
        match change {
            Change::Moving => {
                self.moved = Some(now);
                self.shown = Shown::Old;
            }
            Change::Settled => self.shown = Shown::Old,
            Change::Overlay if self.shown == Shown::Full => self.shown = Shown::OldOverlay,
            // Whatever is drawn next comes with its overlay.
            Change::Overlay => {
                if self.shown == Shown::Draft {
                    self.shown = Shown::Old;
                }
            }
        }
    }

    /// When to draw next. `animated`: the program itself asks for frames;
    /// `expiry`: when a message on the screen ends.
    pub(crate) fn next(&self, now: Duration, animated: Frames, expiry: Option<Duration>) -> Wake {
        let paced = self.drawn.map_or(now, |drawn| drawn + FRAME);
        let due = match (self.shown, animated) {
            (Shown::Old | Shown::OldOverlay, _) | (_, Frames::Wanted) => Some(paced),
            (Shown::Draft, Frames::None) => Some(self.moved.map_or(now, |moved| moved + self.rest)),
            (Shown::Full, Frames::None) => None,
        };
        let due = match (due, expiry) {
            (Some(due), Some(expiry)) => Some(due.min(expiry)),
            (due, expiry) => due.or(expiry),
        };
        match due {
            Some(due) if due <= now => Wake::Now,
            Some(due) => Wake::At(due),
            None => Wake::Never,
        }
    }

    /// A frame begins: what it has to do.
    pub(crate) fn begin(&mut self, now: Duration, animated: Frames) -> Work {
        self.drawn = Some(now);
        let moving = animated == Frames::Wanted || self.moved.is_some_and(|moved| now < moved + self.rest);
        let work = match self.shown {
            Shown::Full | Shown::OldOverlay if animated == Frames::None => Work::Compose,
            _ if moving => Work::Render(Quality::Draft { shrink: self.shrink }),
            _ => Work::Render(Quality::Full),
        };
        self.shown = if moving && work != Work::Compose { Shown::Draft } else { Shown::Full };
        work
    }

    /// The frame took this long: what that means for the ones to come.
    pub(crate) fn took(&mut self, quality: Quality, time: Duration) {
        match quality {
            Quality::Full => self.rest = time.clamp(REST, LONGEST_REST),
            Quality::Draft { .. } if time > SLOW => self.shrink = (self.shrink * 2).min(MOST_SHRINK),
            Quality::Draft { .. } if time < QUICK => self.shrink = (self.shrink / 2).max(1),
            Quality::Draft { .. } => {}
        }
    }
}

/// Whether the program itself asks for frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Frames {
    /// An animation runs, or a key is held.
    Wanted,
    /// Nothing moves by itself.
    None,
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn ms(ms: u64) -> Duration {
        Duration::from_millis(ms)
    }

    const FULL: Work = Work::Render(Quality::Full);
    const DRAFT: Work = Work::Render(Quality::Draft { shrink: 1 });

    /// Draws whenever it is time to, from 0 to `end`; returns what was drawn
    /// when. Wakes are as exact as the clock.
    fn run(pacing: &mut Pacing, start: Duration, end: Duration, frames: Frames) -> Vec<(Duration, Work)> {
        let (mut now, mut drawn) = (start, Vec::new());
        loop {
            match pacing.next(now, frames, None) {
                Wake::Now => drawn.push((now, pacing.begin(now, frames))),
                Wake::At(later) if later < end => now = later,
                _ => return drawn,
            }
        }
    }

    #[test]
    fn the_first_frame_is_full_and_then_nothing_runs() {
        let mut pacing = Pacing::new();
        assert_eq!(run(&mut pacing, ms(0), ms(100_000), Frames::None), [(ms(0), FULL)], "one frame");
        assert_eq!(pacing.next(ms(20), Frames::None, None), Wake::Never, "no wake is asked for");
    }

    #[test]
    fn a_movement_is_drawn_as_a_draft_and_refined_once() {
        let mut pacing = Pacing::new();
        pacing.begin(ms(0), Frames::None);
        pacing.changed(Change::Moving, ms(1000));
        let drawn = run(&mut pacing, ms(1000), ms(100_000), Frames::None);
        assert_eq!(drawn, [(ms(1000), DRAFT), (ms(1150), FULL)], "a draft at once, refined at rest");
    }

    #[test]
    fn events_faster_than_frames_are_gathered() {
        let mut pacing = Pacing::new();
        let mut frames = 0;
        for now in (0..1000).map(ms) {
            pacing.changed(Change::Moving, now);
            if pacing.next(now, Frames::None, None) == Wake::Now {
                pacing.begin(now, Frames::None);
                frames += 1;
            }
        }
        assert!((55..=61).contains(&frames), "1000 movements in a second gave {frames} frames");
    }

    #[test]
    fn an_animation_is_paced_to_sixty_frames() {
        let mut pacing = Pacing::new();
        let drawn = run(&mut pacing, ms(0), ms(1000), Frames::Wanted);
        assert!((59..=61).contains(&drawn.len()), "{} frames in a second", drawn.len());
        assert!(drawn.iter().all(|&(_, work)| work == DRAFT), "all of them drafts");
        let after = run(&mut pacing, ms(1000), ms(9000), Frames::None);
        assert_eq!(after, [(ms(1000), FULL)], "when it ends, its last picture is refined");
    }

    #[test]
    fn a_single_change_is_drawn_in_full() {
        let mut pacing = Pacing::new();
        pacing.begin(ms(0), Frames::None);
        pacing.changed(Change::Settled, ms(500));
        assert_eq!(run(&mut pacing, ms(500), ms(9000), Frames::None), [(ms(500), FULL)], "no draft before");
        pacing.changed(Change::Overlay, ms(9000));
        let drawn = run(&mut pacing, ms(9000), ms(20_000), Frames::None);
        assert_eq!(drawn, [(ms(9000), Work::Compose)], "writing over it renders nothing");
    }

    #[test]
    fn writing_over_a_draft_does_not_pass_for_refining_it() {
        let mut pacing = Pacing::new();
        pacing.changed(Change::Moving, ms(0));
        pacing.begin(ms(0), Frames::None);
        pacing.changed(Change::Overlay, ms(20));
        let drawn = run(&mut pacing, ms(20), ms(9000), Frames::None);
        assert_eq!(drawn, [(ms(20), DRAFT), (ms(150), FULL)], "the full picture still comes");
    }

    #[test]
    fn a_message_is_taken_away_in_time() {
        let mut pacing = Pacing::new();
        pacing.begin(ms(0), Frames::None);
        assert_eq!(pacing.next(ms(10), Frames::None, Some(ms(3000))), Wake::At(ms(3000)), "wakes for it");
        assert_eq!(pacing.next(ms(3000), Frames::None, Some(ms(3000))), Wake::Now, "and draws");
        assert_eq!(pacing.begin(ms(3000), Frames::None), Work::Compose, "without rendering");
        assert_eq!(pacing.next(ms(3000), Frames::None, None), Wake::Never, "once");
    }

    #[test]
    fn slow_drafts_shrink_and_quick_ones_grow_back() {
        let mut pacing = Pacing::new();
        let draft = Quality::Draft { shrink: 1 };
        for expected in [2, 4, 4] {
            pacing.took(draft, ms(100));
            assert_eq!(pacing.shrink, expected, "too slow");
        }
        pacing.took(draft, ms(20));
        assert_eq!(pacing.shrink, 4, "neither slow nor quick");
        for expected in [2, 1, 1] {
            pacing.took(draft, ms(2));
            assert_eq!(pacing.shrink, expected, "quick");
        }
        pacing.took(Quality::Full, ms(900));
        assert_eq!(pacing.shrink, 1, "full frames may take their time");
    }

    #[test]
    fn an_expensive_refinement_waits_longer() {
        for (took, rest) in [(5, 150), (400, 400), (5000, 600)] {
            let mut pacing = Pacing::new();
            pacing.begin(ms(0), Frames::None);
            pacing.took(Quality::Full, ms(took));
            pacing.changed(Change::Moving, ms(1000));
            let drawn = run(&mut pacing, ms(1000), ms(9000), Frames::None);
            assert_eq!(drawn, [(ms(1000), DRAFT), (ms(1000 + rest), FULL)], "a full frame takes {took} ms");
        }
    }
}
