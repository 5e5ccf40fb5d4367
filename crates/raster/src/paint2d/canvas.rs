//! The canvas: the caller's pixels.

use super::Rect;
use std::ops::Range;
use thiserror::Error;

/// The largest width and height of a canvas and of an image in pixels.
pub const MAX_SIZE: u32 = 16384;

/// An image's sides and its number of pixels do not go together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error(
    "{width}x{height} with {pixels} pixels: sides must be 1 to {MAX_SIZE} and within the image, pixels their product"
)]
pub struct SizeError {
    /// The requested width.
    pub width: u32,
    /// The requested height.
    pub height: u32,
    /// The number of pixels given.
    pub pixels: usize,
}

impl SizeError {
    pub(super) fn check(width: u32, height: u32, pixels: usize) -> Result<[i32; 2], Self> {
        let sides = 1..=MAX_SIZE;
        let fits = sides.contains(&width) && sides.contains(&height);
        if fits && width as usize * height as usize == pixels {
            Ok([width as i32, height as i32])
        } else {
            Err(Self { width, height, pixels })
        }
    }
}

/// The caller's image: row-major from the top left, four bytes a pixel,
/// premultiplied by alpha, which comes last, in gamma space.
///
/// The painter treats the three other channels alike. So their order is that of
/// vertices and images: usually red, green, blue; but a window whose pixels are
/// blue, green, red in memory may give all three in that order.
#[derive(Debug)]
pub struct Canvas<'a> {
    pixels: &'a mut [[u8; 4]],
    size: [i32; 2],
}

impl<'a> Canvas<'a> {
    /// Borrows the pixels to paint over them.
    ///
    /// # Errors
    /// If a side is 0 or above [`MAX_SIZE`], or the number of pixels is not
    /// `width * height`.
    pub fn new(width: u32, height: u32, pixels: &'a mut [[u8; 4]]) -> Result<Self, SizeError> {
        let size = SizeError::check(width, height, pixels.len())?;
        Ok(Self { pixels, size })
    }

    /// All pixels' places.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        Rect::new([0, 0], self.size)
    }

    /// From pixel (x, y), which is inside, to the end of the image.
    #[inline(always)]
    pub(super) fn pixels_from(&mut self, x: i32, y: i32) -> &mut [[u8; 4]] {
        let start = y as usize * self.size[0] as usize + x as usize;
        &mut self.pixels[start..]
    }

    /// These columns of row y, which are inside.
    #[inline(always)]
    pub(super) fn span(&mut self, y: i32, columns: Range<i32>) -> &mut [[u8; 4]] {
        let row = y as usize * self.size[0] as usize;
        &mut self.pixels[row + columns.start as usize..row + columns.end as usize]
    }
}
