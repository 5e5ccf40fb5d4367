//! When to draw, and how well. A plain state machine over a clock that the
//! caller reads: the heart of "nothing runs when nothing changes".
//!
//! - Something moves: draft pictures, at most 60 a second, as small as the time allows.
//! - It has come to rest: a full picture, then the further steps that are wanted, each
//!   better than the one before, and then nothing. Where the first takes long, there is
//!   a draft before it; where that was not to be foreseen, it is given up for the draft.
//! - Pictures are drawn beside the window. One at a time: a draft is always finished,
//!   so that a movement shows; any other that nobody will see is cancelled.
//! - What is written over the picture waits for none.

mod budget;

pub(crate) use budget::USUAL as USUAL_BUDGET;

use std::time::Duration;

use budget::Budget;

/// Between the beginnings of two frames, and of two pictures: 60 a second.
const FRAME: Duration = Duration::from_micros(16_667);

/// After this long without a movement, the picture is refined.
const REST: Duration = Duration::from_millis(150);

/// Where a full picture takes longer than this, a draft goes before it.
const PATIENCE: Duration = Duration::from_millis(100);

/// And where it was expected sooner, it is given up after this long.
const OVERDUE: Duration = Duration::from_millis(200);

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
    /// In full: step 0 is as the settings say, later ones are better.
    Full(usize),
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
    /// The right one, up to this step.
    Full(usize),
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
    /// Since when pictures have to wait for something else.
    occupied: Option<Duration>,
    /// Whether what is written over the picture has changed.
    overlay: bool,
    /// When something last moved; `None` after a change that is no movement.
    moved: Option<Duration>,
    /// When the last frame began.
    drawn: Option<Duration>,
    /// When the last picture was begun. Frames between two of them, for what is written
    /// over them, do not put off the next.
    begun: Option<Duration>,
    budget: Budget,
    /// What a picture as the settings say takes, as far as is known.
    full: Option<Duration>,
    /// The steps to be done at rest, upwards from 0.
    wanted: Vec<usize>,
}

/// What is being drawn, and for how many whole seconds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Progress {
    /// The picture that the settings give, for a second or more.
    Drawing { seconds: u64 },
    /// A better one than is shown: of so many steps the one of this number, counted from 1.
    Refining { step: usize, of: usize, seconds: u64 },
    /// One that is not for the window, for a second or more.
    Picture { seconds: u64 },
}

impl Pacing {
    pub(crate) fn new() -> Self {
        Self {
            shown: Shown::Old,
            under_way: None,
            occupied: None,
            overlay: true,
            moved: None,
            drawn: None,
            begun: None,
            budget: Budget::default(),
            full: None,
            wanted: vec![0],
        }
    }

    /// What is to be done at rest, upwards from 0. Steps keep their numbers for as long as
    /// the picture is the right one.
    pub(crate) fn want(&mut self, steps: Vec<usize>) {
        self.wanted = steps;
    }

    /// What a draft may take.
    pub(crate) fn allow(&mut self, budget: Duration) {
        self.budget.set(budget);
    }

    /// What is being drawn at rest; `None` if that is nothing, or hardly takes time.
    pub(crate) fn progress(&self, now: Duration) -> Option<Progress> {
        let seconds = self.work_begun().map_or(0, |begun| now.saturating_sub(begun).as_secs());
        if self.occupied.is_some() {
            return (seconds > 0).then_some(Progress::Picture { seconds });
        }
        match self.wanted.iter().position(|&step| Some(step) == self.next_step()) {
            Some(next) => Some(Progress::Refining { step: next + 1, of: self.wanted.len(), seconds }),
            None => (seconds > 0).then_some(Progress::Drawing { seconds }),
        }
    }

    /// When what is drawn at rest was begun.
    fn work_begun(&self) -> Option<Duration> {
        let is_full = |picture: &UnderWay| matches!(picture.quality, Quality::Full(_));
        self.occupied.or_else(|| self.under_way.as_ref().filter(|picture| is_full(picture)).and(self.begun))
    }

    /// When what is drawn has taken another second since the last frame, which is then told.
    fn next_second(&self) -> Option<Duration> {
        let begun = self.work_begun()?;
        let told = self.drawn.map_or(0, |drawn| drawn.saturating_sub(begun).as_secs());
        Some(begun + Duration::from_secs(told + 1))
    }

    /// Whether the right picture is shown, as the settings say.
    #[cfg(any(test, feature = "kittest"))]
    pub(crate) fn shows_full(&self) -> bool {
        matches!(self.shown, Shown::Full(_))
    }

    /// Whether the picture under way is only better than the one that is shown.
    pub(crate) fn is_refining(&self) -> bool {
        self.under_way.is_some_and(|picture| matches!(picture.quality, Quality::Full(1..)))
    }

    /// The first step that is wanted and not done.
    fn next_step(&self) -> Option<usize> {
        let Shown::Full(done) = self.shown else { return None };
        self.wanted.iter().copied().find(|&step| step > done)
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

    /// When a picture under way is to be given up for a draft, as what it takes was
    /// known of another scene or from another place.
    fn overdue(&self) -> Option<Duration> {
        let Some(UnderWay { quality: Quality::Full(0), outdated: false }) = self.under_way else {
            return None;
        };
        self.begun.filter(|_| self.shown == Shown::Old).map(|begun| begun + OVERDUE)
    }

    /// Time has passed: a picture that it takes too long to wait for is useless from now on.
    pub(crate) fn lose_patience(&mut self, now: Duration) {
        if self.overdue().is_some_and(|due| due <= now) {
            self.full = Some(OVERDUE);
            self.under_way = self.under_way.map(|picture| UnderWay { outdated: true, ..picture });
        }
    }

    /// Whether nobody will look at the picture under way.
    pub(crate) fn is_useless(&self) -> bool {
        self.under_way.is_some_and(|UnderWay { quality, outdated }| match quality {
            Quality::Draft { .. } => false,
            Quality::Full(step) => outdated || !self.wanted.contains(&step),
        })
    }

    /// Whether the next step of what moves by itself can be shown.
    pub(crate) fn can_step(&self) -> bool {
        self.under_way.is_none_or(|picture| matches!(picture.quality, Quality::Full(_)))
    }

    /// When to draw next. `animated`: the program itself asks for pictures; `expiry`:
    /// when what is written over them changes by itself.
    pub(crate) fn next(&self, now: Duration, animated: Frames, expiry: Option<Duration>) -> Wake {
        let after = |last: Option<Duration>| last.map_or(now, |last| last + FRAME);
        let (frame, paced) = (after(self.drawn), after(self.begun));
        let overlay = self.overlay.then_some(frame);
        let picture = match (self.under_way, self.shown, animated) {
            // Its end will be told.
            (Some(UnderWay { quality: Quality::Draft { .. }, .. }), ..) => None,
            _ if self.occupied.is_some() => None,
            // It is about to be given up, which takes a moment.
            (Some(_), _, Frames::Wanted) => Some(frame),
            (None, _, Frames::Wanted) => Some(paced),
            (Some(_), ..) => self.overdue(),
            (None, Shown::Old, Frames::None) => Some(paced),
            (None, Shown::Draft, Frames::None) => Some(self.moved.map_or(now, |moved| moved + REST)),
            (None, Shown::Full(_), Frames::None) => self.next_step().map(|_| paced),
        };
        let expiry = expiry.map(|due| due.max(frame));
        match [overlay, picture, expiry, self.next_second()].into_iter().flatten().min() {
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
            _ if self.under_way.is_some() || self.occupied.is_some() => return None,
            // It will be refined when it rests.
            Shown::Full(_) | Shown::Draft if moving => return None,
            Shown::Full(_) => Quality::Full(self.next_step()?),
            _ if draft => Quality::Draft { shrink: self.budget.shrink() },
            _ => Quality::Full(0),
        };
        self.begun = Some(now);
        self.under_way = Some(UnderWay { quality, outdated: false });
        Some(quality)
    }

    /// What is written over the picture is up to date.
    pub(crate) fn composed(&mut self) {
        self.overlay = false;
    }

    /// Since when whoever draws is at something else, and no picture can be begun; `None` if nothing is.
    pub(crate) fn occupy(&mut self, since: Option<Duration>) {
        self.occupied = since;
    }

    /// The picture under way is in the window, and took this long.
    pub(crate) fn finished(&mut self, took: Duration) {
        let Some(UnderWay { quality, outdated }) = self.under_way.take() else { return };
        self.overlay = true;
        self.shown = match quality {
            _ if outdated => Shown::Old,
            Quality::Full(step) => Shown::Full(step),
            Quality::Draft { .. } => Shown::Draft,
        };
        match quality {
            Quality::Full(0) => self.full = Some(took),
            Quality::Full(_) => {}
            Quality::Draft { .. } => self.budget.took(took),
        }
    }

    /// The picture under way was cancelled; if it is still wanted, it is begun again.
    pub(crate) fn cancelled(&mut self) {
        if self.under_way.take().is_some_and(|picture| picture.outdated) {
            self.shown = Shown::Old;
        }
        self.overlay = true;
    }

    /// The picture under way cannot be drawn. That and what would follow is not tried
    /// again before something changes.
    pub(crate) fn failed(&mut self) {
        let outdated = self.under_way.take().is_some_and(|picture| picture.outdated);
        self.shown = if outdated { Shown::Old } else { Shown::Full(usize::MAX) };
        self.overlay = true;
    }
}

#[cfg(test)]
mod tests;
