//! Decides when to draw, and in which quality. A plain state machine over a clock that the caller
//! reads; it ensures that nothing runs when nothing changes.
//!
//! - While something moves: drafts, at most 60 a second, as small as the frame budget requires.
//! - At rest: a full image, then the further steps of refinement, each better than the one before, and then
//!   nothing. If the full image is expected to take long, a draft is drawn first, and then a preview if rays are what
//!   takes long. If it takes long unexpectedly, it is abandoned, and a draft is drawn.
//! - Images are drawn on a worker thread, one at a time. A draft is always finished, so that a
//!   movement shows; any other image that nobody will see is cancelled.
//! - The interface drawn over the image never waits for an image. Only movements of the pointer that a tool follows
//!   wait for a draft, for a tenth of a second at most ([`Pacing::expects_draft`]).

mod budget;

pub(crate) use budget::USUAL as USUAL_BUDGET;

use std::time::Duration;

use budget::Budget;

/// The minimum interval between two frames, and between two images: 60 a second.
const FRAME: Duration = Duration::from_micros(16_667);

/// After this long without movement, the image is refined.
pub(crate) const REST: Duration = Duration::from_millis(150);

/// If a full image takes longer than this, a draft comes first.
const PATIENCE: Duration = Duration::from_millis(100);

/// If it was predicted to be faster, it is abandoned after this long.
const OVERDUE: Duration = Duration::from_millis(200);

/// A change of the image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Change {
    /// It is moving; more movement is likely to follow.
    Moving,
    /// It has changed once.
    Settled,
    /// Only the interface over it changed.
    Overlay,
}

/// The quality of an image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Quality {
    /// One sample per pixel, and reduced by this factor in each direction, at least 1.
    Draft { shrink: f64 },
    /// As the settings define, but with rays that pixels share.
    Preview,
    /// In full: step 0 as the settings define, later ones better.
    Full(usize),
}

/// When to draw next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Wake {
    /// Now.
    Now,
    /// Not before this time.
    At(Duration),
    /// Not before something happens.
    Never,
}

/// Whether the program itself requests frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum AnimationFrames {
    /// An animation runs, or a key is held.
    Wanted,
    /// Nothing moves by itself.
    None,
}

/// The state of the image on the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ScreenImage {
    /// Up to date, refined to this step.
    Full(usize),
    /// A draft of the current image.
    Draft,
    /// A preview of the current image.
    Preview,
    /// Outdated, or no image.
    Old,
}

/// An image being drawn.
#[derive(Debug, Clone, Copy)]
struct ImageInProgress {
    quality: Quality,
    /// Whether something has changed since it was begun.
    outdated: bool,
}

impl ImageInProgress {
    fn is_draft(&self) -> bool {
        matches!(self.quality, Quality::Draft { .. })
    }
}

/// Decides when to draw. All times are measured from the same moment.
#[derive(Debug)]
pub(crate) struct Pacing {
    shown: ScreenImage,
    under_way: Option<ImageInProgress>,
    /// Since when images have to wait for something else.
    occupied: Option<Duration>,
    /// Whether the interface over the image has changed.
    overlay: bool,
    /// The time of the last movement; `None` after a change without movement.
    moved: Option<Duration>,
    /// The start of the last frame.
    drawn: Option<Duration>,
    /// The start of the last image. Frames of the interface between two images do not delay the
    /// next.
    begun: Option<Duration>,
    budget: Budget,
    /// The time of a full image, as far as it is known.
    full: Option<Duration>,
    /// The steps to do at rest, from 0.
    wanted: Vec<usize>,
}

/// What is being drawn, and for how many whole seconds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Progress {
    /// The image that the settings define, for a second or more.
    Drawing { seconds: u64 },
    /// A refinement of the image on screen: the step, counted from 1, and the number of steps.
    Refining { step: usize, of: usize, seconds: u64 },
    /// An image for a file, for a second or more.
    Image { seconds: u64 },
}

impl Progress {
    pub(crate) fn seconds(self) -> u64 {
        let (Self::Drawing { seconds } | Self::Refining { seconds, .. } | Self::Image { seconds }) = self;
        seconds
    }
}

impl Pacing {
    pub(crate) fn new() -> Self {
        Self {
            shown: ScreenImage::Old,
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

    /// The steps to do at rest, from 0. Steps keep their numbers as long as the image is up to
    /// date.
    pub(crate) fn want(&mut self, steps: Vec<usize>) {
        self.wanted = steps;
    }

    /// The time budget of a draft.
    pub(crate) fn allow(&mut self, budget: Duration) {
        self.budget.set(budget);
    }

    /// What is being drawn at rest; `None` if nothing is, or if it took less than a second.
    pub(crate) fn progress(&self, now: Duration) -> Option<Progress> {
        let seconds = self.work_begun().map_or(0, |begun| now.saturating_sub(begun).as_secs());
        if self.occupied.is_some() {
            return (seconds > 0).then_some(Progress::Image { seconds });
        }
        match self.wanted.iter().position(|&step| Some(step) == self.next_step()) {
            Some(next) => Some(Progress::Refining { step: next + 1, of: self.wanted.len(), seconds }),
            None => (seconds > 0).then_some(Progress::Drawing { seconds }),
        }
    }

    /// When the drawing at rest began. An outdated image does not count.
    fn work_begun(&self) -> Option<Duration> {
        let is_at_rest = |image: &ImageInProgress| !image.is_draft() && !image.outdated;
        self.occupied.or_else(|| self.under_way.as_ref().filter(|image| is_at_rest(image)).and(self.begun))
    }

    /// When another whole second of drawing has passed since the last frame: then the badge changes.
    fn next_second(&self) -> Option<Duration> {
        let begun = self.work_begun()?;
        let reported_seconds = self.drawn.map_or(0, |drawn| drawn.saturating_sub(begun).as_secs());
        Some(begun + Duration::from_secs(reported_seconds + 1))
    }

    /// Whether the image on screen is the one that the settings define.
    #[cfg(any(test, feature = "kittest"))]
    pub(crate) fn shows_full(&self) -> bool {
        matches!(self.shown, ScreenImage::Full(_))
    }

    /// Whether the image being drawn only improves the one on screen.
    pub(crate) fn is_refining(&self) -> bool {
        self.under_way.is_some_and(|image| matches!(image.quality, Quality::Full(1..)))
    }

    /// The first step that is wanted and not done.
    fn next_step(&self) -> Option<usize> {
        let ScreenImage::Full(done) = self.shown else { return None };
        self.wanted.iter().copied().find(|&step| step > done)
    }

    /// Something has changed.
    pub(crate) fn changed(&mut self, change: Change, now: Duration) {
        self.overlay = true;
        if change == Change::Overlay {
            return;
        }
        self.shown = ScreenImage::Old;
        if let Some(under_way) = &mut self.under_way {
            under_way.outdated = true;
        }
        if change == Change::Moving {
            self.moved = Some(now);
        }
    }

    /// When an image in progress is to be abandoned for a draft, because its time was predicted for
    /// another scene or view.
    fn overdue(&self) -> Option<Duration> {
        let Some(ImageInProgress { quality: Quality::Full(0), outdated: false }) = self.under_way else {
            return None;
        };
        self.begun.filter(|_| self.shown == ScreenImage::Old).map(|begun| begun + OVERDUE)
    }

    /// Time has passed: an image that takes too long is useless from now on.
    pub(crate) fn lose_patience(&mut self, now: Duration) {
        if self.overdue().is_some_and(|due| due <= now) {
            self.full = Some(OVERDUE);
            self.under_way = self.under_way.map(|image| ImageInProgress { outdated: true, ..image });
        }
    }

    /// Whether nobody will see the image in progress.
    pub(crate) fn is_useless(&self) -> bool {
        self.under_way.is_some_and(|ImageInProgress { quality, outdated }| match quality {
            Quality::Draft { .. } => false,
            Quality::Preview => outdated,
            Quality::Full(step) => outdated || !self.wanted.contains(&step),
        })
    }

    /// Whether a draft is being drawn that was begun a moment ago.
    pub(crate) fn expects_draft(&self, now: Duration) -> bool {
        self.under_way.is_some_and(|image| image.is_draft())
            && self.begun.is_some_and(|begun| now < begun + PATIENCE)
    }

    /// Whether the next step of an animation can be shown.
    pub(crate) fn can_step(&self) -> bool {
        self.under_way.is_none_or(|image| !image.is_draft())
    }

    /// When to draw next. `animated`: the program itself requests images; `expiry`: when the
    /// interface changes by itself.
    pub(crate) fn next(&self, now: Duration, animated: AnimationFrames, expiry: Option<Duration>) -> Wake {
        let after = |last: Option<Duration>| last.map_or(now, |last| last + FRAME);
        let (frame, paced) = (after(self.drawn), after(self.begun));
        let overlay = self.overlay.then_some(frame);
        let image = match (self.under_way, self.shown, animated) {
            // Completion arrives as an event.
            (Some(ImageInProgress { quality: Quality::Draft { .. }, .. }), ..) => None,
            _ if self.occupied.is_some() => None,
            // It is about to be given up, which takes a moment.
            (Some(_), _, AnimationFrames::Wanted) => Some(frame),
            (None, _, AnimationFrames::Wanted) => Some(paced),
            (Some(_), ..) => self.overdue(),
            (None, ScreenImage::Old, AnimationFrames::None) => Some(paced),
            (None, ScreenImage::Draft, AnimationFrames::None) => {
                Some(self.moved.map_or(now, |moved| moved + REST))
            }
            (None, ScreenImage::Preview, AnimationFrames::None) => Some(paced),
            (None, ScreenImage::Full(_), AnimationFrames::None) => self.next_step().map(|_| paced),
        };
        let expiry = expiry.map(|due| due.max(frame));
        match [overlay, image, expiry, self.next_second()].into_iter().flatten().min() {
            Some(due) if due <= now => Wake::Now,
            Some(due) => Wake::At(due),
            None => Wake::Never,
        }
    }

    /// Whether images follow one another.
    pub(crate) fn is_moving(&self, now: Duration, animated: AnimationFrames) -> bool {
        animated == AnimationFrames::Wanted || self.moved.is_some_and(|moved| now < moved + REST)
    }

    /// Whether no image is under way or due.
    pub(crate) fn is_resting(&self, now: Duration, animated: AnimationFrames) -> bool {
        let is_idle = self.under_way.is_none() && self.occupied.is_none();
        let is_final = matches!(self.shown, ScreenImage::Full(_)) && self.next_step().is_none();
        is_idle && is_final && !self.is_moving(now, animated)
    }

    /// A frame begins: the image to be begun for it, if any. `has_preview`: whether a preview differs from the full image.
    pub(crate) fn begin(
        &mut self,
        now: Duration,
        animated: AnimationFrames,
        has_preview: impl FnOnce() -> bool,
    ) -> Option<Quality> {
        self.drawn = Some(now);
        let moving = self.is_moving(now, animated);
        let is_slow = self.full.is_none_or(|full| full > PATIENCE);
        let draft = moving || (self.shown == ScreenImage::Old && is_slow);
        let quality = match self.shown {
            _ if self.under_way.is_some() || self.occupied.is_some() => return None,
            // It will be refined when it rests.
            ScreenImage::Full(_) | ScreenImage::Preview | ScreenImage::Draft if moving => return None,
            ScreenImage::Full(_) => Quality::Full(self.next_step()?),
            _ if draft => Quality::Draft { shrink: self.budget.shrink() },
            ScreenImage::Draft if is_slow && has_preview() => Quality::Preview,
            _ => Quality::Full(0),
        };
        self.begun = Some(now);
        self.under_way = Some(ImageInProgress { quality, outdated: false });
        Some(quality)
    }

    /// What is written over the image is up to date.
    pub(crate) fn composed(&mut self) {
        self.overlay = false;
    }

    /// Since when whoever draws is at something else, and no image can be begun; `None` if nothing is.
    pub(crate) fn occupy(&mut self, since: Option<Duration>) {
        self.occupied = since;
    }

    /// The image under way is in the window, and took this long; `pixels` is the part that is proportional to their
    /// number.
    pub(crate) fn finished(&mut self, took: Duration, pixels: Duration) {
        let Some(ImageInProgress { quality, outdated }) = self.under_way.take() else { return };
        self.overlay = true;
        self.shown = match quality {
            _ if outdated => ScreenImage::Old,
            Quality::Full(step) => ScreenImage::Full(step),
            Quality::Preview => ScreenImage::Preview,
            Quality::Draft { .. } => ScreenImage::Draft,
        };
        match quality {
            Quality::Full(0) => self.full = Some(took),
            Quality::Full(_) | Quality::Preview => {}
            Quality::Draft { .. } => self.budget.took(took, pixels),
        }
    }

    /// The image under way was cancelled; if it is still wanted, it is begun again.
    pub(crate) fn cancelled(&mut self) {
        if self.under_way.take().is_some_and(|image| image.outdated) {
            self.shown = ScreenImage::Old;
        }
        self.overlay = true;
    }

    /// The image under way cannot be drawn. That and what would follow is not tried
    /// again before something changes.
    pub(crate) fn failed(&mut self) {
        let outdated = self.under_way.take().is_some_and(|image| image.outdated);
        self.shown = if outdated { ScreenImage::Old } else { ScreenImage::Full(usize::MAX) };
        self.overlay = true;
    }
}

#[cfg(test)]
mod tests;
