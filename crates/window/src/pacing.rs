//! When to draw, and how well. A plain state machine over a clock that the
//! caller reads: the heart of "nothing runs when nothing changes".
//!
//! - Something moves: draft pictures, at most 60 a second, as small as the time allows.
//! - It has come to rest: one full picture, and then nothing. Where that takes long,
//!   there is a draft before it.
//! - Pictures are drawn beside the window. One at a time: a draft is always finished,
//!   so that a movement shows; a full picture that nobody will see is cancelled.
//! - What is written over the picture waits for none.

mod budget;

use std::time::Duration;

use budget::Budget;

/// Between the beginnings of two frames: 60 a second.
const FRAME: Duration = Duration::from_micros(16_667);

/// After this long without a movement, the picture is refined.
const REST: Duration = Duration::from_millis(150);

/// Where a full picture takes longer than this, a draft goes before it.
const PATIENCE: Duration = Duration::from_millis(100);

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

/// How to draw a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Quality {
    /// One sample per pixel, and fewer pixels in each direction by this factor, at least 1.
    Draft { shrink: f64 },
    /// As the settings say.
    Full,
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

/// Whether the program itself asks for frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Frames {
    /// An animation runs, or a key is held.
    Wanted,
    /// Nothing moves by itself.
    None,
}

/// The picture on the screen, compared to what should be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shown {
    Full,
    /// A draft of the right picture.
    Draft,
    /// The wrong picture, or none.
    Old,
}

/// A picture under way.
#[derive(Debug, Clone, Copy)]
struct UnderWay {
    quality: Quality,
    /// Whether something has changed since it was begun.
    outdated: bool,
}

/// Decides when to draw. All times count from the same moment.
#[derive(Debug)]
pub(crate) struct Pacing {
    shown: Shown,
    under_way: Option<UnderWay>,
    /// Whether pictures have to wait for something else.
    occupied: bool,
    /// Whether what is written over the picture has changed.
    overlay: bool,
    /// When something last moved; `None` after a change that is no movement.
    moved: Option<Duration>,
    /// When the last frame began.
    drawn: Option<Duration>,
    budget: Budget,
    /// What a full picture takes, as far as is known.
    full: Option<Duration>,
}

impl Pacing {
    pub(crate) fn new() -> Self {
        Self {
            shown: Shown::Old,
            under_way: None,
            occupied: false,
            overlay: true,
            moved: None,
            drawn: None,
            budget: Budget::default(),
            full: None,
        }
    }

    /// Something has changed.
    pub(crate) fn changed(&mut self, change: Change, now: Duration) {
        self.overlay = true;
        if change == Change::Overlay {
            return;
        }
        self.shown = Shown::Old;
        if let Some(under_way) = &mut self.under_way {
            under_way.outdated = true;
        }
        if change == Change::Moving {
            self.moved = Some(now);
        }
    }

    /// Whether nobody will look at the picture under way.
    pub(crate) fn is_useless(&self) -> bool {
        self.under_way.is_some_and(|picture| picture.outdated && picture.quality == Quality::Full)
    }

    /// Whether the next step of what moves by itself can be shown.
    pub(crate) fn can_step(&self) -> bool {
        self.under_way.is_none_or(|picture| picture.quality == Quality::Full)
    }

    /// When to draw next. `animated`: the program itself asks for pictures; `expiry`:
    /// when what is written over them changes by itself.
    pub(crate) fn next(&self, now: Duration, animated: Frames, expiry: Option<Duration>) -> Wake {
        let paced = self.drawn.map_or(now, |drawn| drawn + FRAME);
        let overlay = self.overlay.then_some(paced);
        let picture = match (self.under_way, self.shown, animated) {
            // Its end will be told.
            (Some(UnderWay { quality: Quality::Draft { .. }, .. }), ..) => None,
            _ if self.occupied => None,
            (_, _, Frames::Wanted) => Some(paced),
            (Some(_), ..) => None,
            (None, Shown::Old, Frames::None) => Some(paced),
            (None, Shown::Draft, Frames::None) => Some(self.moved.map_or(now, |moved| moved + REST)),
            (None, Shown::Full, Frames::None) => None,
        };
        let expiry = expiry.map(|due| due.max(paced));
        match [overlay, picture, expiry].into_iter().flatten().min() {
            Some(due) if due <= now => Wake::Now,
            Some(due) => Wake::At(due),
            None => Wake::Never,
        }
    }

    /// A frame begins: the picture to be begun for it, if any.
    pub(crate) fn begin(&mut self, now: Duration, animated: Frames) -> Option<Quality> {
        self.drawn = Some(now);
        let moving = animated == Frames::Wanted || self.moved.is_some_and(|moved| now < moved + REST);
        let draft = moving || (self.shown == Shown::Old && self.full.is_none_or(|full| full > PATIENCE));
        let quality = match self.shown {
            _ if self.under_way.is_some() || self.occupied => return None,
            Shown::Full => return None,
            // It will be refined when it rests.
            Shown::Draft if moving => return None,
            _ if draft => Quality::Draft { shrink: self.budget.shrink() },
            _ => Quality::Full,
        };
        self.under_way = Some(UnderWay { quality, outdated: false });
        Some(quality)
    }

    /// What is written over the picture is up to date.
    pub(crate) fn composed(&mut self) {
        self.overlay = false;
    }

    /// Whether whoever draws is at something else, and no picture can be begun.
    pub(crate) fn occupy(&mut self, occupied: bool) {
        self.occupied = occupied;
    }

    /// The picture under way is in the window, and took this long.
    pub(crate) fn finished(&mut self, took: Duration) {
        let Some(UnderWay { quality, outdated }) = self.under_way.take() else { return };
        self.overlay = true;
        self.shown = match quality {
            _ if outdated => Shown::Old,
            Quality::Full => Shown::Full,
            Quality::Draft { .. } => Shown::Draft,
        };
        match quality {
            Quality::Full => self.full = Some(took),
            Quality::Draft { .. } => self.budget.took(took),
        }
    }

    /// The picture under way was cancelled, or cannot be drawn. `Shown` stays as it is:
    /// what cannot be drawn is not tried again before something changes.
    pub(crate) fn failed(&mut self) {
        let outdated = self.under_way.take().is_some_and(|picture| picture.outdated);
        self.shown = if outdated { Shown::Old } else { Shown::Full };
        self.overlay = true;
    }
}

#[cfg(test)]
mod tests;
