//! The object that draws passes and keeps what can be used again.

use crate::frame::{Arena, FrameView, How, draw, prepare};
use crate::pool::Workers;
use crate::simd::{SimdLevel, SimdLevelError, Token};
use crate::{Cancel, ExecuteSettings, Pass, Stats, Target};

/// Draws passes: threads and memory that are kept from frame to frame.
///
/// A frame that is no larger than the last ones allocates nothing, but for what
/// several threads take to be told of their work.
pub struct Rasterizer {
    settings: ExecuteSettings,
    token: Token,
    workers: Workers,
    arena: Arena,
    cancel: Option<Cancel>,
}

impl Rasterizer {
    /// A rasterizer with its own threads.
    ///
    /// # Errors
    /// [`SimdLevelError::Unsupported`] if the settings ask for a level that the
    /// processor lacks.
    pub fn new(settings: ExecuteSettings) -> Result<Self, SimdLevelError> {
        let level = settings.simd.unwrap_or_else(SimdLevel::best);
        let token = level.token().ok_or(SimdLevelError::Unsupported(level))?;
        Ok(Self {
            settings,
            token,
            workers: Workers::new(settings.threads),
            arena: Arena::default(),
            cancel: None,
        })
    }

    /// How it draws.
    pub fn settings(&self) -> &ExecuteSettings {
        &self.settings
    }

    /// Ends drawings that are under way when the token is cancelled, and those that
    /// follow; `None` to let them be. What the target of such a drawing holds is of
    /// no use: ask the token when [`draw`](Self::draw) has returned.
    pub fn set_cancel(&mut self, cancel: Option<Cancel>) {
        self.cancel = cancel;
    }

    /// Everything up to the tiles of what [`draw`](Self::draw) would do.
    pub(crate) fn prepare<'f>(&'f mut self, pass: &'f Pass<'_>, target: &Target<'_>) -> FrameView<'f> {
        let tile_size = self.settings.tile_size.pixels(target.samples());
        let how = How {
            token: self.token,
            workers: &self.workers,
            tile_size,
            hierarchical: true,
            timed: false,
            finds_colors: true,
            cancel: None,
        };
        prepare(&mut self.arena, pass, target, how)
    }

    /// Draws everything that was recorded, over the whole of the target or of the
    /// pass's [`scissor`](Pass::scissor).
    ///
    /// The result is a function of the pass and the target's size, samples and
    /// outputs alone: the settings change no byte.
    pub fn draw(&mut self, pass: &Pass<'_>, target: &mut Target<'_>) -> Stats {
        let tile_size = self.settings.tile_size.pixels(target.samples());
        let workers = if pass.is_worth_sharing(target) { &self.workers } else { &Workers::ALONE };
        let hierarchical = self.settings.depth_test == crate::DepthTest::Hierarchical;
        let timed = self.settings.timed;
        let cancel = self.cancel.as_ref();
        let finds_colors = false;
        let how = How { token: self.token, workers, tile_size, hierarchical, timed, finds_colors, cancel };
        draw(&mut self.arena, pass, target, how)
    }

    /// Works through items of any kind on the threads that draw, each item taken by the
    /// thread that is free first: what is to be done beside a frame needs no threads of
    /// its own. Returns when all is done.
    pub fn share<I>(&self, items: I, work: impl Fn(I::Item) + Sync)
    where
        I: Iterator + Send,
    {
        self.workers.share(items, work);
    }
}

impl Default for Rasterizer {
    /// As many threads as the machine runs at once, and its best SIMD level.
    fn default() -> Self {
        Self::new(ExecuteSettings::default()).expect("the best level is supported")
    }
}
