//! The image into which triangles are painted. It counts how often each pixel is painted.

use super::Triangle;
use trigon_classic::Field;

/// The history of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Painted {
    /// How often it was painted.
    pub count: u32,
    /// The number of the triangle that painted it last, `u32::MAX` if none did.
    pub last: u32,
}

impl Painted {
    /// Not painted.
    pub const NEVER: Self = Self { count: 0, last: u32::MAX };
}

/// An image that counts how often each pixel is painted.
#[derive(Clone, Debug, PartialEq)]
pub struct Canvas {
    pub(super) pixels: Field<Painted>,
    brush: u32,
}

impl Canvas {
    /// An empty image.
    #[must_use]
    pub fn new(size: [usize; 2]) -> Self {
        Self { pixels: Field::new(size, Painted::NEVER), brush: 0 }
    }

    /// What was painted.
    #[must_use]
    pub fn pixels(&self) -> &Field<Painted> {
        &self.pixels
    }

    /// Width and height, in the type of coordinates.
    pub(crate) fn limits(&self) -> [i32; 2] {
        self.pixels.size().map(|side| side as i32)
    }

    /// Paints a pixel, if it is in the image.
    #[inline]
    pub(crate) fn paint(&mut self, x: i32, y: i32) {
        if let Some(pixel) = self.pixels.get_mut([x, y]) {
            *pixel = Painted { count: pixel.count + 1, last: self.brush };
        }
    }

    /// Fills triangles, each with its own brush.
    #[inline(always)]
    pub(super) fn each(&mut self, triangles: &[Triangle], fill: impl Fn(&Triangle, &mut Self)) {
        for (brush, triangle) in (0..).zip(triangles) {
            self.brush = brush;
            fill(triangle, self);
        }
    }
}
