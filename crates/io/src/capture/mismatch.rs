//! The difference between an image and the captured one.

use std::fmt;

use super::hash::fnv1a;

/// The difference between an image and the captured one. Its `Display` is one line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Mismatch {
    /// The hash of the captured image.
    pub captured_hash: u64,
    /// The hash of the new image.
    pub drawn_hash: u64,
    /// Where they differ; `None` if their sizes do.
    pub pixels: Option<PixelMismatch>,
}

/// The pixels that differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct PixelMismatch {
    /// How many.
    pub count: usize,
    /// Out of this many.
    pub total: usize,
    /// The position of the first one, in rows from the top: x and y.
    pub first: [u32; 2],
    /// Red, green, blue and alpha of the first one in the captured image.
    pub captured: [u8; 4],
    /// And in the new image.
    pub drawn: [u8; 4],
}

impl Mismatch {
    /// Compares two images of four bytes per pixel, each with its width.
    pub(super) fn between(widths: [u32; 2], captured: &[u8], drawn: &[u8]) -> Option<Self> {
        let has_one_width = widths[0] == widths[1];
        if has_one_width && captured == drawn {
            return None;
        }
        let has_one_size = has_one_width && captured.len() == drawn.len();
        let pixels = has_one_size.then(|| PixelMismatch::between(widths[0], captured, drawn)).flatten();
        Some(Self { captured_hash: fnv1a(captured), drawn_hash: fnv1a(drawn), pixels })
    }
}

impl PixelMismatch {
    fn between(width: u32, captured: &[u8], drawn: &[u8]) -> Option<Self> {
        let (captured, drawn) = (captured.as_chunks().0, drawn.as_chunks().0);
        let differs = |&index: &usize| captured[index] != drawn[index];
        let mut different = (0..captured.len()).filter(differs);
        let first = different.next()?;
        Some(Self {
            count: 1 + different.count(),
            total: captured.len(),
            first: [first as u32 % width, first as u32 / width],
            captured: captured[first],
            drawn: drawn[first],
        })
    }
}

impl fmt::Display for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { captured_hash, drawn_hash, pixels } = self;
        write!(f, "the image differs from the captured one: ")?;
        match pixels {
            Some(PixelMismatch { count, total, first: [x, y], captured, drawn }) => write!(
                f,
                "{count} of {total} pixels, the first at ({x}, {y}), which was {captured:?} and is {drawn:?}"
            )?,
            None => write!(f, "it has another size")?,
        }
        write!(f, "; its hash was {captured_hash:016x} and is {drawn_hash:016x}")
    }
}
