//! Whether the outline of a triangle matches its fill (source row B3).

use super::{Line, Segment, dda};
use crate::engine::{Corners, Engine};
use crate::fill::{Canvas, Fill};
use std::ops::AddAssign;
use trigon_classic::Field;
use trigon_math::Vec2;

/// A method of filling a triangle and drawing its outline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Outline {
    /// As the source does: scanlines, and lines along the longer side.
    Source,
    /// The renderer's triangle, and the renderer's lines on it.
    EngineLines,
    /// The renderer's triangle, which paints its own edges.
    EngineFaces,
}

/// Counts the pixels of outlines that lie outside their triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OutlineErrors {
    /// Pixels of outlines.
    pub outline: usize,
    /// Pixels of outlines that the fill does not cover.
    pub outside: usize,
}

impl OutlineErrors {
    /// Pixels beside the fill for a thousand of the outline.
    #[must_use]
    pub fn per_mille(&self) -> f64 {
        1e3 * self.outside as f64 / self.outline as f64
    }
}

impl AddAssign for OutlineErrors {
    fn add_assign(&mut self, other: Self) {
        self.outline += other.outline;
        self.outside += other.outside;
    }
}

impl Outline {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Source, Self::EngineLines, Self::EngineFaces];

    /// The name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Source => "scanlines and DDA",
            Self::EngineLines => "engine, lines over faces",
            Self::EngineFaces => "engine, faces with edges",
        }
    }

    /// Draws a triangle between the centres of pixels with its outline, and compares.
    #[must_use]
    pub fn errors(self, corners: [[i32; 2]; 3], size: [usize; 2]) -> OutlineErrors {
        let (fill, outline) = self.draw(corners, size);
        let pixels = || outline.pixels().filter(|(_, is_outline)| **is_outline);
        OutlineErrors {
            outline: pixels().count(),
            outside: pixels().filter(|(place, _)| !fill[*place]).count(),
        }
    }

    /// The pixels of the fill and of the outline.
    #[must_use]
    pub fn draw(self, corners: [[i32; 2]; 3], size: [usize; 2]) -> (Field<bool>, Field<bool>) {
        let triangle = corners.map(|[x, y]| Vec2::new(x as f32 + 0.5, y as f32 + 0.5));
        let sides = [0, 1, 2].map(|i| [corners[i], corners[(i + 1) % 3]]);
        let filled = |fill: Fill| {
            let mut canvas = Canvas::new(size);
            fill.paint(&[triangle], &mut canvas);
            canvas.pixels().map(|pixel| pixel.count > 0)
        };
        match self {
            Self::Source => (filled(Fill::Scanlines), walked(&sides, size)),
            Self::EngineLines => {
                let mut ink = Field::new(size, 0.0);
                Line::Engine.paint(&sides, &mut ink);
                (filled(Fill::Engine), ink.map(|&ink| ink > 0.0))
            }
            Self::EngineFaces => {
                let seen = Engine::default().edges(&Corners::flat(&[triangle], size), size);
                (seen.map(|color| color.x > 0.0), seen.map(|color| color.y > 0.0))
            }
        }
    }
}

fn walked(sides: &[Segment], size: [usize; 2]) -> Field<bool> {
    let mut outline = Field::new(size, false);
    for pixel in sides.iter().flat_map(|&side| dda::pixels(side)) {
        if let Some(is_outline) = outline.get_mut(pixel) {
            *is_outline = true;
        }
    }
    outline
}
