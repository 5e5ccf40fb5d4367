//! The engine's lines: exact, and the same from either end.

use super::Segment;
use crate::engine::{Corners, Engine, clip_position, field, target};
use trigon_classic::Field;
use trigon_math::DVec2;
use trigon_raster::{Output, Smoothing, Target};

/// Lines and what it takes to draw them again and again.
pub(super) struct LineDrawer {
    engine: Engine,
    target: Target<'static>,
    ends: Corners,
    smoothing: Smoothing,
}

impl LineDrawer {
    pub(super) fn new(segments: &[Segment], smoothing: Smoothing, size: [usize; 2]) -> Self {
        let pixel = |[x, y]: [i32; 2]| {
            let center = DVec2::new(x.into(), y.into()) + 0.5;
            clip_position(center, 0.5, size)
        };
        let ends = Corners::new(segments.as_flattened().iter().map(|&end| pixel(end)).collect());
        Self { engine: Engine::default(), target: target(size, &[Output::Linear]), ends, smoothing }
    }

    pub(super) fn draw(&mut self) {
        self.engine.draw_lines(&self.ends, self.smoothing, &mut self.target);
    }

    /// The covered fraction of each pixel.
    pub(super) fn coverage(&self) -> Field<f32> {
        let size = [self.target.width(), self.target.height()].map(|side| side as usize);
        field(size, self.target.linear()).map(|color| color.x)
    }
}
