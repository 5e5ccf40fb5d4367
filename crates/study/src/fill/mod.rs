//! Which pixels does a triangle cover, and what does it cost to know exactly?
//!
//! All algorithms take triangles in pixel coordinates and paint into a [`FillCanvas`] that counts. A pixel
//! belongs to a triangle if its centre lies inside; every pixel on an edge that two triangles share should be
//! painted once.

mod canvas;
mod cases;
mod edges;
mod fixed;
mod float;
mod lanes;
mod scanlines;
mod strips;

use trigon_classic::Field;

use super::engine::{Corners, Engine};

pub(crate) use canvas::range;
pub use canvas::{FillCanvas, FillErrors, Painted, Triangle, owners};
pub use cases::{Tiling, tiles};
pub(crate) use scanlines::interpolate;

/// A method of filling triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Fill {
    /// Vertical strips between two sides (source row A9).
    Strips,
    /// Horizontal lines between interpolated sides (B2).
    Scanlines,
    /// Inclusive edge functions, evaluated at every pixel of the screen (C1).
    EdgesOnScreen,
    /// The same within the bounding box (C3).
    EdgesInBox,
    /// The same at the middle of the pixel instead of its corner.
    EdgesAtCenters,
    /// Edge functions in `f32` with the top-left rule, from their corners in each pixel.
    FloatFromCorners,
    /// The same as linear functions, set up once per triangle.
    FloatHoisted,
    /// The same for eight pixels at a time.
    FloatLanes,
    /// Corners on a grid of 1/16 pixel, then exact integers.
    Fixed4,
    /// Corners on a grid of 1/256 pixel.
    Fixed8,
    /// Corners on a grid of 1/4096 pixel.
    Fixed12,
    /// [`Fixed8`](Self::Fixed8) for eight pixels at a time.
    Fixed8Lanes,
    /// The renderer: a grid of 1/256 pixel.
    Engine,
}

impl Fill {
    /// All of them, the oldest ideas first.
    pub const ALL: [Self; 13] = [
        Self::Strips,
        Self::Scanlines,
        Self::EdgesOnScreen,
        Self::EdgesInBox,
        Self::EdgesAtCenters,
        Self::FloatFromCorners,
        Self::FloatHoisted,
        Self::FloatLanes,
        Self::Fixed4,
        Self::Fixed8,
        Self::Fixed12,
        Self::Fixed8Lanes,
        Self::Engine,
    ];

    /// The name in tables and plots.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Strips => "vertical strips",
            Self::Scanlines => "scanlines",
            Self::EdgesOnScreen => "inclusive edges, screen",
            Self::EdgesInBox => "inclusive edges, box",
            Self::EdgesAtCenters => "inclusive edges, centres",
            Self::FloatFromCorners => "float edges from corners",
            Self::FloatHoisted => "float edges",
            Self::FloatLanes => "float edges, eight lanes",
            Self::Fixed4 => "fixed point, 4 bits",
            Self::Fixed8 => "fixed point, 8 bits",
            Self::Fixed12 => "fixed point, 12 bits",
            Self::Fixed8Lanes => "fixed point, 8 bits, eight lanes",
            Self::Engine => "engine",
        }
    }

    /// Paints triangles one after the other; each is told by its number.
    pub fn paint(self, triangles: &[Triangle], canvas: &mut FillCanvas) {
        match self {
            Self::Strips => canvas.each(triangles, strips::fill),
            Self::Scanlines => canvas.each(triangles, scanlines::fill),
            Self::EdgesOnScreen => canvas.each(triangles, edges::fill_on_screen),
            Self::EdgesInBox => canvas.each(triangles, edges::fill_in_box),
            Self::EdgesAtCenters => canvas.each(triangles, edges::fill_at_centers),
            Self::FloatFromCorners => canvas.each(triangles, float::fill_from_corners),
            Self::FloatHoisted => canvas.each(triangles, float::fill_hoisted),
            Self::FloatLanes => lanes::fill_float(triangles, canvas),
            Self::Fixed4 => canvas.each(triangles, fixed::fill::<4>),
            Self::Fixed8 => canvas.each(triangles, fixed::fill::<8>),
            Self::Fixed12 => canvas.each(triangles, fixed::fill::<12>),
            Self::Fixed8Lanes => lanes::fill_fixed(triangles, canvas),
            Self::Engine => fill_by_engine(triangles, canvas),
        }
    }
}

/// The engine behind the canvas: one pass counts how many triangles cover each pixel, another stores which
/// one is visible. The two agree wherever only one triangle covers a pixel.
fn fill_by_engine(triangles: &[Triangle], canvas: &mut FillCanvas) {
    let size = canvas.pixels.size();
    let shape = Corners::flat(triangles, size);
    let mut engine = Engine::default();
    let (counts, visible) = (engine.counts(&shape, size), engine.visible(&shape, size));
    canvas.pixels = Field::from_fn(size, |pixel| Painted { count: counts[pixel], last: visible[pixel] });
}

#[cfg(test)]
mod tests;
