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
    /// Compares two images of four bytes per pixel and a width each.
    pub(super) fn between(captured: (u32, &[u8]), drawn: (u32, &[u8])) -> Option<Self> {
        if captured == drawn {
            return None;
        }
        let same_size = captured.0 == drawn.0 && captured.1.len() == drawn.1.len();
        let pixels = same_size.then(|| PixelMismatch::between(captured.0, captured.1, drawn.1)).flatten();
        Some(Self { captured_hash: fnv1a(captured.1), drawn_hash: fnv1a(drawn.1), pixels })
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
