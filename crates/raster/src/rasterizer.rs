//! The rasterizer: draws passes, and keeps threads and memory between them.
//!
//! [`ExecuteSettings`] say how a pass is executed. No setting changes a byte of the result.

use crate::frame::{Arena, DrawChange, FrameOptions, Redraw, draw, prepare, redraw};
use crate::point_shader::PointShader;
use crate::pool::Workers;
use crate::simd::{SimdLevel, SimdLevelError, Token};
use crate::view::FrameView;
use crate::{Cancel, Pass, Stats, Target};
use std::num::NonZeroUsize;
use std::sync::Arc;

/// Draws passes, and keeps its threads and memory from frame to frame.
///
/// A frame no larger than earlier ones allocates nothing, except what it takes to
/// hand work to several threads.
pub struct Rasterizer {
    execution: Execution,
    arena: Arena,
}

/// How and by which threads passes are drawn.
struct Execution {
    settings: ExecuteSettings,
    token: Token,
    workers: Arc<Workers>,
    cancel: Option<Cancel>,
}

/// The threads of a [`Rasterizer`].
#[derive(Clone)]
pub struct Threads(Arc<Workers>);

impl Threads {
    /// Runs `work` on one of the threads, and waits for it; on the calling thread if the rasterizer has only one, or if that
    /// is a thread of another rayon pool.
    ///
    /// The threads stay awake meanwhile, so the stages of frames that are drawn in `work` start at once. Parallel iterators
    /// of rayon in it run on the same threads.
    pub fn install<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        self.0.install(work)
    }
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
        let workers = Arc::new(Workers::new(settings.threads));
        let execution = Execution { settings, token, workers, cancel: None };
        Ok(Self { execution, arena: Arena::default() })
    }

    /// How it draws.
    #[must_use]
    pub fn settings(&self) -> &ExecuteSettings {
        &self.execution.settings
    }

    /// The threads on which it draws.
    #[must_use]
    pub fn threads(&self) -> Threads {
        Threads(Arc::clone(&self.execution.workers))
    }

    /// Sets a token that cancels the current and all later drawings; `None` removes it.
    /// After a cancelled drawing the target's content is unusable, so check the token
    /// when [`draw`](Self::draw) has returned.
    pub fn set_cancel(&mut self, cancel: Option<Cancel>) {
        self.execution.cancel = cancel;
    }

    /// Tells the token, if there is one, that the drawing under way has so many passes more than was known when it began.
    pub fn expect_passes(&self, more: u32) {
        if let Some(cancel) = &self.execution.cancel {
            cancel.expect_passes(more);
        }
    }

    /// Everything up to the tiles of what [`draw`](Self::draw) would do.
    pub(crate) fn prepare<'f>(&'f mut self, pass: &'f Pass<'_>, target: &Target<'_>) -> FrameView<'f> {
        let Execution { settings, token, workers, .. } = &self.execution;
        let tile_size = settings.tile_size.pixels(target.samples());
        let options = FrameOptions {
            token: *token,
            workers,
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
        let Self { execution, arena } = self;
        let options = execution.options(pass, target);
        options.workers.install(|| draw(arena, pass, target, options))
    }

    /// Like [`draw`](Self::draw), for passes that are drawn repeatedly with few changes: it
    /// runs only the changed vertices, and draws only the tiles that their triangles lie in or
    /// lay in before.
    ///
    /// `changes` lists, draw by draw in the order of recording, how the pass differs from that of
    /// the last call. Everything else must be the same: the background, the painting of edges,
    /// the colours of marks, the numbers of draws, vertices and triangles, and whatever else the
    /// pipelines' results depend on. The target must hold what the last call left in its target.
    /// If any of this is violated, the image is a mixture of both passes; nothing worse happens.
    ///
    /// While the same vertices change from call to call, as in a drag, only pixels that may look different
    /// are shaded. This holds if a pixel has one sample and only opaque triangles, sharp points of one colour
    /// and overlays move. What is kept for that takes up to about 25 bytes for each pixel of the tiles, until
    /// other vertices change.
    ///
    /// The whole pass is drawn with `None`, for a target of another size or with other outputs, with a
    /// [`scissor`](Pass::scissor), after a call of any other function, and after a cancelled drawing.
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
        let Self { execution, arena } = self;
        let options = execution.options(pass, target);
        options.workers.install(|| redraw(arena, pass, target, changes, options))
    }

    /// Runs the vertices of a pass, to shade its triangles wherever something other than this rasterizer finds them, such
    /// as rays. `samples_per_axis` says how much finer the grid is on which samples are numbered.
    ///
    /// ```
    /// # use trigon_raster::{*, math::Vec4, simd::*};
    /// # use trigon_raster::simd::prelude::*;
    /// /// A triangle with a brightness at each corner.
    /// struct Triangle;
    ///
    /// impl LanePipeline for Triangle {
    ///     const VARYINGS: usize = 1;
    ///
    ///     fn vertex_count(&self) -> usize {
    ///         3
    ///     }
    ///
    ///     fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
    ///         let brightness = vertices.load(simd, &[0.0, 1.0, 4.0]);
    ///         vertices.set(0, brightness);
    ///         [F32::splat(simd, 1.0); 4]
    ///     }
    ///
    ///     fn fragments<S: Simd>(&self, _: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
    ///         [fragments.varying(0); 4]
    ///     }
    /// }
    ///
    /// let mut pass = Pass::new();
    /// pass.triangles(Draw::new(&Triangle, &[[0, 1, 2]]));
    /// let rasterizer = Rasterizer::default();
    /// let shader = rasterizer.point_shader(&pass, 1);
    /// let point = SurfacePoint {
    ///     triangle: 0,
    ///     front_facing: true,
    ///     weights: [0.5, 0.25, 0.25],
    ///     slopes: [[0.0; 2]; 2],
    ///     sample: [0, 0],
    /// };
    /// let mut color = [[0.0; 4]];
    /// shader.shade(0, &[point], &mut PointScratch::default(), &mut color);
    /// assert_eq!(color, [[1.25; 4]]);
    /// ```
    #[must_use]
    pub fn point_shader<'p>(&self, pass: &'p Pass<'p>, samples_per_axis: u32) -> PointShader<'p> {
        PointShader::new(pass, self.execution.token, &self.execution.workers, samples_per_axis)
    }

    /// Processes items of any kind on the rasterizer's threads; each item goes to the first
    /// free thread. Work beside a frame therefore needs no threads of its own. Returns when all
    /// items are done.
    pub fn share<I>(&self, items: I, work: impl Fn(I::Item) + Sync)
    where
        I: Iterator + Send,
    {
        self.execution.workers.share(items, work);
    }
}

impl Execution {
    /// How a pass is drawn.
    fn options(&self, pass: &Pass<'_>, target: &Target<'_>) -> FrameOptions<'_> {
        let Self { settings, token, workers, cancel } = self;
        FrameOptions {
            token: *token,
            workers: if pass.is_worth_sharing(target) { workers } else { &Workers::ALONE },
            tile_size: settings.tile_size.pixels(target.samples()),
            hierarchical: settings.depth_test == DepthTest::Hierarchical,
            timed: settings.timed,
            finds_colors: false,
            cancel: cancel.as_ref(),
        }
    }
}

impl Default for Rasterizer {
    /// As many threads as the machine runs at once, and its best SIMD level.
    fn default() -> Self {
        Self::new(ExecuteSettings::default()).expect("the best level is supported")
    }
}

/// How a pass is executed: what it costs, never what it draws.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ExecuteSettings {
    /// How many threads may work; `None` for as many as the machine runs at
    /// once. Small frames stay on the calling thread regardless.
    pub threads: Option<NonZeroUsize>,
    /// Which vector instructions are used; `None` for the best that the
    /// processor has.
    pub simd: Option<SimdLevel>,
    /// The size of the squares that the frame is cut into.
    pub tile_size: TileSize,
    /// Whether hidden blocks are rejected by bounds of their depths.
    pub depth_test: DepthTest,
    /// Whether [`Stats::times`](crate::Stats::times) are measured, a few calls of a
    /// clock for each tile, and [`Stats::samples_visible`](crate::Stats::samples_visible)
    /// counted.
    pub timed: bool,
}

/// When depth is tested.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DepthTest {
    /// Bounds of blocks and tiles first, so that hidden ones are skipped as a whole.
    #[default]
    Hierarchical,
    /// At every sample: for comparison.
    Late,
}

/// The edge of a tile in pixels; with supersampling, of the finer grid, and the
/// tile is the largest whole number of pixels that fits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TileSize {
    /// 64 by 64, and 32 by 32 from eight samples on: what a worker keeps of a tile
    /// fits into the caches nearest to it.
    #[default]
    Automatic,
    /// 8 by 8: for tests.
    Pixels8,
    /// 16 by 16.
    Pixels16,
    /// 32 by 32.
    Pixels32,
    /// 64 by 64.
    Pixels64,
}

impl TileSize {
    pub(crate) fn pixels(self, samples: u32) -> u32 {
        match self {
            Self::Automatic if samples >= 8 => 32,
            Self::Automatic | Self::Pixels64 => 64,
            Self::Pixels8 => 8,
            Self::Pixels16 => 16,
            Self::Pixels32 => 32,
        }
    }
}
