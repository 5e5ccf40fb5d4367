//! The canvas: the caller's pixels, and rectangles of whole pixels.

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
    bounds: Rect,
}

impl<'a> Canvas<'a> {
    /// Borrows the pixels to paint over them.
    ///
    /// # Errors
    /// If a side is 0 or above [`MAX_SIZE`], or the number of pixels is not
    /// `width * height`.
    pub fn new(width: u32, height: u32, pixels: &'a mut [[u8; 4]]) -> Result<Self, SizeError> {
        Self::of_rows(width, 0..height, pixels)
    }

    /// Borrows some rows of an image. Painting each row in one of several such canvases is painting the whole
    /// image, and several threads can do so.
    ///
    /// # Errors
    /// If a side is 0 or above [`MAX_SIZE`], if the last row is, or if the number of pixels is not that of the rows.
    pub fn of_rows(width: u32, rows: Range<u32>, pixels: &'a mut [[u8; 4]]) -> Result<Self, SizeError> {
        let height = rows.end.saturating_sub(rows.start);
        let [right, _] = SizeError::check(width, height, pixels.len())?;
        if rows.end > MAX_SIZE {
            return Err(SizeError { width, height: rows.end, pixels: pixels.len() });
        }
        let [top, bottom] = [rows.start, rows.end].map(u32::cast_signed);
        Ok(Self { pixels, bounds: Rect::new([0, top], [right, bottom]) })
    }

    /// All pixels' positions.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        self.bounds
    }

    /// Where row y, which is inside, begins. All rows begin in column 0.
    #[inline(always)]
    fn row(&self, y: i32) -> usize {
        (y - self.bounds.min[1]) as usize * self.bounds.max[0] as usize
    }

    /// From pixel (x, y), which is inside, to the end of the image.
    #[inline(always)]
    pub(super) fn pixels_from(&mut self, x: i32, y: i32) -> &mut [[u8; 4]] {
        let start = self.row(y) + x as usize;
        &mut self.pixels[start..]
    }

    /// These columns of row y, which are inside.
    #[inline(always)]
    pub(super) fn span(&mut self, y: i32, columns: Range<i32>) -> &mut [[u8; 4]] {
        let row = self.row(y);
        &mut self.pixels[row + columns.start as usize..row + columns.end as usize]
    }
}

/// Pixels from `min` to before `max`: origin top-left, y down. Empty if `max`
/// is not beyond `min` on both axes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Rect {
    /// The first column and row inside.
    pub min: [i32; 2],
    /// The first column and row beyond.
    pub max: [i32; 2],
}

impl Rect {
    /// From the first column and row inside to the first ones beyond.
    #[must_use]
    pub const fn new(min: [i32; 2], max: [i32; 2]) -> Self {
        Self { min, max }
    }

    /// The pixels of both.
    #[must_use]
    pub fn intersection(self, other: Self) -> Self {
        let [a, b] = [self, other];
        Self {
            min: [a.min[0].max(b.min[0]), a.min[1].max(b.min[1])],
            max: [a.max[0].min(b.max[0]), a.max[1].min(b.max[1])],
        }
    }

    /// Whether no pixel is inside.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.min[0] >= self.max[0] || self.min[1] >= self.max[1]
    }

    /// Whether all pixels of `other` are inside.
    #[must_use]
    pub fn contains(self, other: Self) -> bool {
        other.is_empty() || self.intersection(other) == other
    }
}
