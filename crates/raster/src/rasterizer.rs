//! The object that draws passes and keeps what can be used again.

use crate::frame::{Arena, DrawChange, FrameOptions, FrameView, Redraw, draw, prepare, redraw};
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
        let options = FrameOptions {
            token: self.token,
            workers: &self.workers,
            tile_size,
            hierarchical: true,
            timed: false,
            finds_colors: true,
            cancel: None,
        };
        prepare(&mut self.arena, pass, target, options)
    }

    /// Draws everything that was recorded, over the whole of the target or of the
    /// pass's [`scissor`](Pass::scissor).
    ///
    /// The result is a function of the pass and the target's size, samples and
    /// outputs alone: the settings change no byte.
    pub fn draw(&mut self, pass: &Pass<'_>, target: &mut Target<'_>) -> Stats {
        let Self { settings, token, workers, cancel, arena } = self;
        draw(arena, pass, target, frame_options((settings, *token, workers), cancel.as_ref(), pass, target))
    }

    /// As [`draw`](Self::draw), for passes that are drawn again and again with few vertices
    /// moved: it runs these vertices alone, and draws the tiles alone that their triangles
    /// lie in, or lay in.
    ///
    /// `changes` tell, draw by draw in the order of recording, how the pass differs from the
    /// one of the last call. Everything else has to be the same: the background, how edges are
    /// painted and the colours of marks, the numbers of draws, vertices and triangles, and
    /// whatever else pipelines answer by. And the target has to hold the pictures that the last
    /// call has left in its target. Where that is not so the picture is a mixture of both
    /// passes; nothing worse happens. With `None` all is drawn. So it is in a target of another size or with other outputs, with a
    /// [`scissor`](Pass::scissor), after a call of any other function, and after a drawing
    /// that was cancelled.
    ///
    /// ```
    /// # use trigon_raster::{*, math::Vec4};
    /// struct Triangle([[f32; 2]; 3]);
    /// impl Pipeline for Triangle {
    ///     type Varyings = ();
    ///     fn vertex_count(&self) -> usize { 3 }
    ///     fn vertex(&self, index: usize) -> VertexOutput<()> {
    ///         let [x, y] = self.0[index];
    ///         VertexOutput { position: Vec4::new(x, y, 0.5, 1.0), varyings: () }
    ///     }
    ///     fn fragment(&self, _: &Fragment<()>) -> Vec4 { Vec4::ONE }
    /// }
    /// let mut rasterizer = Rasterizer::default();
    /// let mut target = Target::new(500, 400, &[Output::Srgb8])?;
    /// let before = Triangle([[-0.9, -0.9], [-0.8, -0.9], [-0.8, -0.8]]);
    /// let mut pass = Pass::new();
    /// pass.triangles(Draw::new(&before, &[[0, 1, 2]]));
    /// rasterizer.redraw(&pass, &mut target, None);
    ///
    /// let after = Triangle([[-0.9, -0.9], [-0.7, -0.9], [-0.8, -0.8]]);
    /// let mut pass = Pass::new();
    /// pass.triangles(Draw::new(&after, &[[0, 1, 2]]));
    /// let changes = [DrawChange { vertices: &[1], ..DrawChange::default() }];
    /// let redraw = rasterizer.redraw(&pass, &mut target, Some(&changes));
    /// assert!(redraw.parts.iter().all(|part| part.max[0] < 200), "the left part alone");
    ///
    /// let mut fresh = Target::new(500, 400, &[Output::Srgb8])?;
    /// Rasterizer::default().draw(&pass, &mut fresh);
    /// assert_eq!(target.srgb8(), fresh.srgb8());
    /// # Ok::<(), TargetError>(())
    /// ```
    pub fn redraw(
        &mut self,
        pass: &Pass<'_>,
        target: &mut Target<'_>,
        changes: Option<&[DrawChange<'_>]>,
    ) -> Redraw {
        let Self { settings, token, workers, cancel, arena } = self;
        let options = frame_options((settings, *token, workers), cancel.as_ref(), pass, target);
        redraw(arena, pass, (target, changes), options)
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

/// How a pass is drawn.
fn frame_options<'w>(
    (settings, token, workers): (&ExecuteSettings, Token, &'w Workers),
    cancel: Option<&'w Cancel>,
    pass: &Pass<'_>,
    target: &Target<'_>,
) -> FrameOptions<'w> {
    FrameOptions {
        token,
        workers: if pass.is_worth_sharing(target) { workers } else { &Workers::ALONE },
        tile_size: settings.tile_size.pixels(target.samples()),
        hierarchical: settings.depth_test == crate::DepthTest::Hierarchical,
        timed: settings.timed,
        finds_colors: false,
        cancel,
    }
}

impl Default for Rasterizer {
    /// As many threads as the machine runs at once, and its best SIMD level.
    fn default() -> Self {
        Self::new(ExecuteSettings::default()).expect("the best level is supported")
    }
}
