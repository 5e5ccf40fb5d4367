//! What is proven of each pixel ([`Certificate`]), and the bounds that the proof allows: by how much positions, depths
//! and colours may be off ([`Tolerance`]), and whether a colour that is off has the same bytes ([`TargetCodes`]).

use super::tile::TileCertainty;
use crate::Target;
use crate::fragments::Encoding;
use crate::tile_buffer::TileArea;
use crate::view::FrameView;
use trigon_math::{Vec4, color};

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

/// The encodings of a target, and by how much colours may be off.
pub(super) struct TargetCodes {
    srgb8: bool,
    unorm8: bool,
    bound: f32,
}

impl TargetCodes {
    pub(super) fn of(target: &Target<'_>, bound: f32) -> Self {
        Self { srgb8: target.srgb8().is_some(), unorm8: target.unorm8().is_some(), bound }
    }

    /// Whether there are any bytes.
    pub(super) fn is_requested(&self) -> bool {
        self.srgb8 || self.unorm8
    }

    /// Whether all colours within the bound have the same bytes.
    fn are_settled(&self, value: Vec4) -> bool {
        let [low, high] = [-self.bound, self.bound].map(|by| (value + by).to_array());
        let low = low.map(f32::next_down);
        let high = high.map(f32::next_up);
        (!self.unorm8 || unorm8_agrees(low, high)) && (!self.srgb8 || srgb8_agrees(low, high))
    }
}

/// Each component separately; none decreases as its colour increases.
fn unorm8_agrees(low: [f32; 4], high: [f32; 4]) -> bool {
    let encode = |color| Encoding::Unorm8.encode(Vec4::from_array(color));
    encode(low) == encode(high)
}

/// The same after the division by alpha, which is least and greatest at the ends
/// of both ranges. Where alpha may be 0, nothing is known of the quotient.
fn srgb8_agrees(low: [f32; 4], high: [f32; 4]) -> bool {
    let alpha = [low[3], high[3]];
    if alpha[0] <= 0.0 {
        return alpha[1] <= 0.0;
    }
    let settled = |i: usize| {
        let least = low[i] / if low[i] < 0.0 { alpha[0] } else { alpha[1] };
        let greatest = high[i] / if high[i] < 0.0 { alpha[1] } else { alpha[0] };
        color::linear_to_srgb8(least.next_down()) == color::linear_to_srgb8(greatest.next_up())
    };
    (0..3).all(settled) && color::unit_to_u8(alpha[0]) == color::unit_to_u8(alpha[1])
}

/// The most that a position may be off, in pixels: far less than the range of
/// the grid, so that sums with it cannot overflow.
const POSITION_MAX: f64 = 256.0;

/// By how much what an image is made from may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    position: f64,
    depth_ulps: u32,
    color: f32,
}

impl Tolerance {
    /// Bounds on positions in pixels of the target (0 to 256), on depths in units
    /// in the last place, and on linear colours in each component (0 or more);
    /// `None` for numbers out of range.
    #[must_use]
    pub fn new(position: f64, depth_ulps: u32, color: f32) -> Option<Self> {
        let valid = (0.0..=POSITION_MAX).contains(&position) && (0.0..=f32::MAX).contains(&color);
        valid.then_some(Self { position, depth_ulps, color })
    }

    /// By how much a vertex may be off on the screen on each axis, in pixels.
    #[must_use]
    pub fn position(&self) -> f64 {
        self.position
    }

    /// By how many units in the last place a vertex's depth may be off.
    #[must_use]
    pub fn depth_ulps(&self) -> u32 {
        self.depth_ulps
    }

    /// By how much each component of a pixel's linear colour may be off.
    #[must_use]
    pub fn color(&self) -> f32 {
        self.color
    }
}

impl Default for Tolerance {
    /// What other arithmetic may change: 1/512 pixel, as much as snapping does; 4
    /// units in the last place of depths; 2^-16 in colours.
    fn default() -> Self {
        Self { position: 1.0 / 512.0, depth_ulps: 4, color: 1.0 / 65536.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn settled_colours_keep_their_bytes(
            value: [f32; 4],
            unit in [0.0_f32..1.0, 0.0..1.0, 0.0..1.0, 0.0..1.0],
            share in [-1.0_f32..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0],
            bound in 0.0_f32..0.002,
        ) {
            let codes = TargetCodes { srgb8: true, unorm8: true, bound };
            for value in [Vec4::from_array(value), Vec4::from_array(unit)] {
                prop_assume!(value.is_finite());
                let moved = value + Vec4::from_array(share) * bound;
                let agrees = |e: Encoding| e.encode(value) == e.encode(moved);
                let same = agrees(Encoding::Srgb8) && agrees(Encoding::Unorm8);
                prop_assert!(same || !codes.are_settled(value), "{value} and {moved}");
            }
        }
    }

    #[test]
    fn only_colours_near_a_threshold_are_unsettled() {
        let codes = TargetCodes { srgb8: true, unorm8: true, bound: 1e-5 };
        let grays = (0..1000).map(|i| Vec4::splat(i as f32 / 1000.0).with_w(1.0));
        let settled = grays.filter(|&gray| codes.are_settled(gray)).count();
        assert!(settled > 950, "{settled} of 1000");
    }
}
