//! Which pixels make a straight line one pixel wide (source row B1)? And does the outline of a triangle match
//! its fill (B3)?
//!
//! Lines end at pixel centres, as in the classical algorithms.

mod algorithms;
mod engine;
mod errors;

#[cfg(test)]
mod tests;

pub use algorithms::Segment;
pub use errors::{LineErrors, Outline, OutlineErrors};

use trigon_classic::Field;

/// A method of drawing lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Line {
    /// y = a x + b for each column, whatever the slope.
    Naive,
    /// A slope added in each step, along the longer side.
    Dda,
    /// The same in whole numbers.
    Bresenham,
    /// Two pixels in each step that share the ink.
    Wu,
    /// The renderer, sharp.
    Engine,
    /// The renderer, anti-aliased.
    EngineSmooth,
}

impl Line {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Naive, Self::Dda, Self::Bresenham, Self::Wu, Self::Engine, Self::EngineSmooth];

    /// The name in tables and plots.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Naive => "naive",
            Self::Dda => "DDA",
            Self::Bresenham => "Bresenham",
            Self::Wu => "Wu, anti-aliased",
            Self::Engine => "engine",
            Self::EngineSmooth => "engine, anti-aliased",
        }
    }

    /// Draws segments; each adds how much of a pixel it covers.
    pub fn paint(self, segments: &[Segment], coverage: &mut Field<f32>) {
        if let Some(smoothing) = self.smoothing() {
            let mut drawer = engine::LineDrawer::new(segments, smoothing, coverage.size());
            drawer.draw();
            *coverage = drawer.coverage();
        } else if let Some(draw) = self.classical() {
            segments.iter().for_each(|&segment| draw(segment, coverage));
        }
    }

    /// Returns a closure that draws segments repeatedly and keeps everything that can be kept.
    #[must_use]
    pub fn repeated<'a>(self, segments: &'a [Segment], size: [usize; 2]) -> Box<dyn FnMut() + 'a> {
        if let Some(smoothing) = self.smoothing() {
            let mut drawer = engine::LineDrawer::new(segments, smoothing, size);
            return Box::new(move || drawer.draw());
        }
        let mut coverage = Field::new(size, 0.0);
        Box::new(move || self.paint(segments, &mut coverage))
    }

    /// The function of a classical algorithm.
    fn classical(self) -> Option<fn(Segment, &mut Field<f32>)> {
        match self {
            Self::Naive => Some(algorithms::draw_naive),
            Self::Dda => Some(algorithms::draw_dda),
            Self::Bresenham => Some(algorithms::draw_bresenham),
            Self::Wu => Some(algorithms::draw_wu),
            Self::Engine | Self::EngineSmooth => None,
        }
    }

    /// How the renderer smooths the lines.
    fn smoothing(self) -> Option<trigon_raster::Smoothing> {
        match self {
            Self::Engine => Some(trigon_raster::Smoothing::Sharp),
            Self::EngineSmooth => Some(trigon_raster::Smoothing::AntiAliased),
            _ => None,
        }
    }
}

/// Segments of `radius` pixels, and their reverse, from the middle of a square image in all directions.
#[must_use]
pub fn star(side: usize, radius: i32) -> Vec<Segment> {
    let middle = side as i32 / 2;
    let ring = (-radius..radius).step_by(7);
    let ends = ring.flat_map(|along| [[along, radius], [radius, along], [along, -radius], [-radius, along]]);
    ends.map(|[x, y]| [[middle, middle], [middle + x, middle + y]]).collect()
}
