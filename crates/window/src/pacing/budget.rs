//! The size of drafts: as large as the frame budget allows.

use std::time::Duration;

/// The default budget of a draft: 30 frames a second.
pub(crate) const USUAL: Duration = Duration::from_millis(33);

/// The largest reduction of drafts in each direction.
const MOST_SHRINK: f64 = 4.0;

/// A draft aims for this fraction of the budget, so that the next one, which shows something else,
/// is likely to fit, too.
const AIM: f64 = 0.8;

/// A smaller size has to save this fraction of a draft's time.
const LEAST_SAVED: f64 = 0.25;

/// Drafts become larger if this fraction of the pixels that fit would be more than they have.
const ROOMY: f64 = 0.6;

/// Learns from each draft how large the next one may be.
#[derive(Debug)]
pub(super) struct Budget {
    time: Duration,
    shrink: f64,
    /// The last drafts of this size, the last one first.
    last: [Option<Draft>; 2],
}

/// What one draft says about the size of the next ones.
#[derive(Debug, Clone, Copy)]
struct Draft {
    /// The fraction of the budget that it took.
    share: f64,
    /// How many times fewer pixels would have fitted.
    excess: f64,
    /// The fraction of the draft's time that those would have saved.
    saved: f64,
}

impl Default for Budget {
    fn default() -> Self {
        Self { time: USUAL, shrink: 1.0, last: [None; 2] }
    }
}

impl Budget {
    /// The reduction factor of the next draft in each direction, 1 to 4.
    pub(super) fn shrink(&self) -> f64 {
        self.shrink
    }

    /// The budget of a draft.
    pub(super) fn set(&mut self, time: Duration) {
        // The learned value is a fraction of the previous budget.
        if std::mem::replace(&mut self.time, time) != time {
            self.last = [None; 2];
        }
    }

    /// Reports the time of a draft of the current size, and which part of it is proportional to the number of
    /// pixels. Where the rest does not fit, drafts become no smaller than helps: their pixels take a quarter of the
    /// rest.
    ///
    /// The size changes after three drafts that agree: one may have had to wait for other programs, and the first
    /// two of a movement may prepare what the following ones use.
    pub(super) fn took(&mut self, time: Duration, pixels: Duration) {
        let budget = self.time.as_secs_f64();
        let rest = time.saturating_sub(pixels).as_secs_f64();
        let available = (AIM * budget - rest).max(rest / 4.0);
        let (time, pixels) = (time.as_secs_f64(), pixels.as_secs_f64());
        let draft =
            Draft { share: time / budget, excess: pixels / available, saved: (pixels - available) / time };
        let [Some(last), Some(before)] = self.last else {
            self.last = [Some(draft), self.last[0]];
            return;
        };
        self.last = [Some(draft), Some(last)];
        let drafts = [draft, last, before];
        let least = drafts.iter().fold(f64::INFINITY, |least, draft| least.min(draft.excess));
        let most = drafts.iter().fold(0.0, |most: f64, draft| most.max(draft.excess));
        // In between the size is kept: changing sizes flicker, and the first images of another size take longer.
        let are_slow = drafts.iter().all(|draft| draft.share > 1.0 && draft.saved > LEAST_SAVED);
        let factor = if are_slow {
            least.sqrt()
        } else if most < ROOMY {
            // At most twice the size at once.
            most.sqrt().max(0.5)
        } else {
            return;
        };
        let shrink = (self.shrink * factor).clamp(1.0, MOST_SHRINK);
        if std::mem::replace(&mut self.shrink, shrink) != shrink {
            self.last = [None; 2];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A draft whose time is that of its pixels.
    fn took(budget: &mut Budget, milliseconds: f64) {
        let time = Duration::from_secs_f64(milliseconds / 1e3);
        budget.took(time, time);
    }

    /// Drafts that take this long at full size, until the size is stable.
    fn settled(milliseconds: f64) -> f64 {
        let mut budget = Budget::default();
        for _ in 0..20 {
            let shrink = budget.shrink();
            took(&mut budget, milliseconds / (shrink * shrink));
        }
        budget.shrink()
    }

    #[test]
    fn drafts_are_as_large_as_the_budget_allows() {
        assert_eq!(settled(5.0), 1.0, "quick ones are whole");
        assert_eq!(settled(33.0), 1.0, "so are those that just fit");
        let shrink = settled(330.0);
        let took = 330.0 / (shrink * shrink);
        assert!((16.5..=33.0).contains(&took), "ten times too slow: {shrink}, {took} ms");
        assert_eq!(settled(1e6), MOST_SHRINK, "no smaller than that");
    }

    #[test]
    fn another_budget_gives_another_size() {
        let mut budget = Budget::default();
        budget.set(Duration::from_millis(100));
        (0..9).for_each(|_| took(&mut budget, 90.0));
        assert_eq!(budget.shrink(), 1.0, "they fit");
        budget.set(Duration::from_millis(16));
        (0..9).for_each(|_| took(&mut budget, 90.0));
        assert_eq!(budget.shrink(), MOST_SHRINK, "and now they do not");
    }

    /// The first images of a drag find out what moves. Once they made all of the drag coarse.
    #[test]
    fn two_slow_drafts_change_nothing() {
        let mut budget = Budget::default();
        for milliseconds in [300.0, 60.0, 30.0, 31.0, 29.0, 90.0, 50.0, 30.0] {
            took(&mut budget, milliseconds);
            assert_eq!(budget.shrink(), 1.0, "after {milliseconds} ms");
        }
    }

    /// Once drafts of large meshes became ever smaller because of what they take before their pixels.
    #[test]
    fn what_takes_no_time_for_pixels_is_not_made_coarse() {
        /// Drafts of which a part takes this long in full size, and the rest in every size.
        fn settled_with(pixels: f64, rest: f64, mut budget: Budget) -> f64 {
            for _ in 0..30 {
                let pixels = pixels / (budget.shrink() * budget.shrink());
                let [time, pixels] = [pixels + rest, pixels].map(|time| Duration::from_secs_f64(time / 1e3));
                budget.took(time, pixels);
            }
            budget.shrink()
        }
        assert_eq!(settled_with(20.0, 300.0, Budget::default()), 1.0, "the pixels are not to blame");
        let shrink = settled_with(100.0, 100.0, Budget::default());
        assert!((1.5..=2.5).contains(&shrink), "pixels of a quarter of the time: {shrink}");
        let shrink = settled_with(40.0, 15.0, Budget::default());
        assert!(40.0 / (shrink * shrink) + 15.0 <= 33.0, "it fits: {shrink}");
        let small = || Budget { shrink: MOST_SHRINK, ..Budget::default() };
        assert_eq!(settled_with(5.0, 22.0, small()), 1.0, "although most of the budget is used");
        assert!(settled_with(300.0, 22.0, small()) > 3.0, "but not if it would not fit");
    }

    #[test]
    fn quick_drafts_grow_back() {
        let mut budget = Budget::default();
        (0..9).for_each(|_| took(&mut budget, 1000.0));
        assert_eq!(budget.shrink(), MOST_SHRINK, "it was slow");
        (0..9).for_each(|_| took(&mut budget, 1.0));
        assert_eq!(budget.shrink(), 1.0, "and is quick now");
    }
}
