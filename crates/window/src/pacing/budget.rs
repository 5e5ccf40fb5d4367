//! The size of drafts: as large as the frame budget allows.

use std::time::Duration;

/// The default budget of a draft: 30 frames a second.
pub(crate) const USUAL: Duration = Duration::from_millis(33);

/// The largest reduction of drafts in each direction.
const MOST_SHRINK: f64 = 4.0;

/// A draft aims for this fraction of the budget, so that the next one, which shows something else,
/// is likely to fit, too.
const AIM: f64 = 0.8;

/// Learns from each draft how large the next one may be.
#[derive(Debug)]
pub(super) struct Budget {
    time: Duration,
    shrink: f64,
    /// The fraction of the budget that the last draft of this size took.
    last: Option<f64>,
}

impl Default for Budget {
    fn default() -> Self {
        Self { time: USUAL, shrink: 1.0, last: None }
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
            self.last = None;
        }
    }

    /// Reports the time of a draft of the current size. The time is assumed to be proportional to
    /// the number of pixels. Where it is not, because of work before the pixels, the size decreases
    /// until it does not matter any more.
    ///
    /// A single draft changes nothing: it may have had to wait for other programs.
    pub(super) fn took(&mut self, time: Duration) {
        let share = time.as_secs_f64() / self.time.as_secs_f64();
        let Some(last) = self.last.replace(share) else { return };
        let (least, most) = if last < share { (last, share) } else { (share, last) };
        // Between half and all of the budget the size is kept: changing sizes flicker.
        let factor = if least > 1.0 {
            (least / AIM).sqrt()
        } else if most < 0.5 {
            // At most twice the size at once.
            (most / AIM).sqrt().max(0.5)
        } else {
            return;
        };
        self.shrink = (self.shrink * factor).clamp(1.0, MOST_SHRINK);
        self.last = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Drafts that take this long at full size, until the size is stable.
    fn settled(milliseconds: f64) -> f64 {
        let mut budget = Budget::default();
        for _ in 0..20 {
            budget.took(Duration::from_secs_f64(milliseconds / 1e3 / (budget.shrink() * budget.shrink())));
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
        (0..9).for_each(|_| budget.took(Duration::from_millis(90)));
        assert_eq!(budget.shrink(), 1.0, "they fit");
        budget.set(Duration::from_millis(16));
        (0..9).for_each(|_| budget.took(Duration::from_millis(90)));
        assert_eq!(budget.shrink(), MOST_SHRINK, "and now they do not");
    }

    #[test]
    fn quick_drafts_grow_back() {
        let mut budget = Budget::default();
        (0..9).for_each(|_| budget.took(Duration::from_secs(1)));
        assert_eq!(budget.shrink(), MOST_SHRINK, "it was slow");
        (0..9).for_each(|_| budget.took(Duration::from_millis(1)));
        assert_eq!(budget.shrink(), 1.0, "and is quick now");
    }
}
