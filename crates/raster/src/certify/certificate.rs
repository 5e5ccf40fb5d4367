//! The result: what is proven of each pixel.

use super::codes::TargetCodes;
use super::tile::TileCertainty;
use crate::tile_buffer::TileArea;
use crate::view::FrameView;
use trigon_math::Vec4;

/// What is proven of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Certainty {
    /// The visible triangle, coverage and bytes stay the same.
    Certified,
    /// It may come to see something else, or in another order.
    Visibility,
    /// The visible triangle stays the same, but one of the bytes may change.
    Color,
}

/// What is proven of the pixels of an image; see
/// [`Rasterizer::certify`](crate::Rasterizer::certify).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Certificate {
    size: [u32; 2],
    pixels: Vec<Certainty>,
    /// Whether anything but the background is visible.
    drawn: Vec<bool>,
}

impl Certificate {
    /// Nothing but background.
    pub(super) fn new(size: [u32; 2]) -> Self {
        let pixels = size[0] as usize * size[1] as usize;
        Self { size, pixels: vec![Certainty::Certified; pixels], drawn: vec![false; pixels] }
    }

    /// All pixels, row by row from the top left.
    #[must_use]
    pub fn pixels(&self) -> &[Certainty] {
        &self.pixels
    }

    /// What is proven of the pixel in column `x` and row `y`.
    ///
    /// # Panics
    /// Outside of the image.
    #[must_use]
    pub fn certainty(&self, x: u32, y: u32) -> Certainty {
        let [width, height] = self.size;
        assert!(x < width && y < height, "({x}, {y}) in an image of {width} by {height}");
        self.pixels[(y * width + x) as usize]
    }

    /// How many pixels have this certainty.
    #[must_use]
    pub fn count(&self, certainty: Certainty) -> usize {
        self.pixels.iter().filter(|&&pixel| pixel == certainty).count()
    }

    /// Takes over what is known of a tile.
    pub(super) fn note(&mut self, frame: &FrameView<'_>, area: &TileArea, tile: &TileCertainty) {
        let axis = frame.supersampling as usize;
        let [left, top] = area.own_origin().map(|v| v as usize / axis);
        let margin = area.margin;
        let reach = frame.ink.as_ref().map_or(0, |ink| ink.reach() as usize);
        let [columns, rows] = frame.drawn_part(area);
        for (x, y) in rows.flat_map(|y| columns.clone().map(move |x| (x, y))) {
            let index = (top + y) * self.size[0] as usize + left + x;
            let cell = |i: usize| [margin[0] + x * axis + i % axis, margin[1] + y * axis + i / axis];
            let cells = || (0..axis * axis).map(cell);
            self.drawn[index] = cells().any(|cell| tile.is_drawn(cell));
            if cells().any(|cell| tile.is_doubtful_around(cell, reach)) {
                self.pixels[index] = Certainty::Visibility;
            }
        }
    }

    /// Doubts certified pixels whose bytes may change.
    pub(super) fn doubt_colors(&mut self, colors: &[Vec4], codes: &TargetCodes) {
        for ((pixel, drawn), &color) in self.pixels.iter_mut().zip(&self.drawn).zip(colors) {
            if *pixel == Certainty::Certified && *drawn && !codes.are_settled(color) {
                *pixel = Certainty::Color;
            }
        }
    }
}
