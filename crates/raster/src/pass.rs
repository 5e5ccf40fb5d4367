//! A recorded pass: what is to be drawn, and then the frame in one go.

use crate::bin::Grid;
use crate::frame::{Frame, FrameSettings};
use crate::geometry::{Geometry, Shape};
use crate::pool::Workers;
use crate::shade::AnyPipeline;
use crate::target::split_into_tiles;
use crate::tile::{Scratch, draw_tile};
use crate::viewport::Viewport;
use crate::{Draw, ExecuteSettings, Lines, Pipeline, Points, Stats, Target};
use std::num::NonZeroU32;
use trigon_math::{UVec2, Vec4};

/// What a pass is drawn on.
#[derive(Clone, Copy)]
pub enum Background<'a> {
    /// One colour, linear light, premultiplied.
    Color(Vec4),
    /// A colour for each pixel, linear light, premultiplied. Called on any
    /// thread, for those pixels that show it.
    PerPixel(&'a (dyn Fn(UVec2) -> Vec4 + Sync)),
}

/// One draw as the pass keeps it.
pub(crate) struct Recorded<'a> {
    pub(crate) geometry: Geometry<'a>,
    pub(crate) pipeline: Box<dyn AnyPipeline + 'a>,
}

/// A recorded frame: draws, each with its own pipeline, in any order.
///
/// The order in which draws are recorded does not matter: the nearest sample
/// wins, and of equally near ones that with the smaller (object, face).
pub struct Pass<'a> {
    background: Background<'a>,
    draws: Vec<Recorded<'a>>,
}

impl Default for Pass<'_> {
    fn default() -> Self {
        Self::new()
    }
}

impl<'a> Pass<'a> {
    /// An empty pass on transparent black.
    pub fn new() -> Self {
        Self { background: Background::Color(Vec4::ZERO), draws: Vec::new() }
    }

    /// Draws on `background` instead.
    pub fn background(&mut self, background: Background<'a>) -> &mut Self {
        self.background = background;
        self
    }

    /// Records triangles.
    pub fn triangles<P: Pipeline>(&mut self, draw: Draw<'a, P>) -> &mut Self {
        let Draw { pipeline, triangles, faces, edge_flags, object, culling, surface } = draw;
        let shape = Shape::Triangles { triangles, edge_flags, culling };
        self.record(pipeline, Geometry { shape, faces, object, surface })
    }

    /// Records lines.
    pub fn lines<P: Pipeline>(&mut self, lines: Lines<'a, P>) -> &mut Self {
        let Lines { pipeline, segments, ids, object, width, toward_eye, surface } = lines;
        let shape = Shape::Lines { segments, width, toward_eye };
        self.record(pipeline, Geometry { shape, faces: ids, object, surface })
    }

    /// Records points.
    pub fn points<P: Pipeline>(&mut self, points: Points<'a, P>) -> &mut Self {
        let Points { pipeline, points, ids, object, size, shape, toward_eye, surface } = points;
        let shape = Shape::Points { points, size, shape, toward_eye };
        self.record(pipeline, Geometry { shape, faces: ids, object, surface })
    }

    fn record<P: Pipeline>(&mut self, pipeline: &'a P, geometry: Geometry<'a>) -> &mut Self {
        self.draws.push(Recorded { geometry, pipeline: Box::new(pipeline) });
        self
    }

    /// Draws everything that was recorded, over the whole of the target.
    ///
    /// The result is a function of the pass and the target's size, samples and
    /// outputs alone: the settings change no byte.
    pub fn execute(&self, target: &mut Target, settings: &ExecuteSettings) -> Stats {
        let workers = self.workers(target, settings);
        let samples = NonZeroU32::new(target.samples_per_axis()).unwrap_or(NonZeroU32::MIN);
        let viewport =
            Viewport { width: target.width() * samples.get(), height: target.height() * samples.get() };
        let tile_size = settings.tile_size.samples() / samples;
        let frame_settings = FrameSettings {
            background: self.background,
            samples_per_axis: samples,
            wants_color: target.srgb8().is_some() || target.linear().is_some(),
            grid: Grid::new(viewport, tile_size * samples.get()),
        };
        let (frame, mut stats) = Frame::new(frame_settings, &self.draws, &workers);
        let tiles = split_into_tiles(target, tile_size).into_iter().enumerate().collect();
        let draw = |scratch: &mut Scratch, tile: (usize, _)| draw_tile(&frame, scratch, tile);
        for scratch in workers.consume(tiles, Scratch::new, draw) {
            stats += scratch.stats;
        }
        stats
    }

    /// The calling thread alone if the frame is too small to share: waking
    /// others costs a fraction of a millisecond.
    fn workers(&self, target: &Target, settings: &ExecuteSettings) -> Workers {
        // Measured roughly: nanoseconds for a sample and for a primitive.
        const SAMPLE: u64 = 2;
        const PRIMITIVE: u64 = 100;
        const WORTH_SHARING: u64 = 400_000;
        let axis = u64::from(target.samples_per_axis());
        let samples = u64::from(target.width()) * u64::from(target.height()) * axis * axis;
        let primitives: usize = self.draws.iter().map(|draw| draw.geometry.len()).sum();
        if samples * SAMPLE + primitives as u64 * PRIMITIVE < WORTH_SHARING {
            return Workers::alone();
        }
        Workers::new(settings)
    }
}
