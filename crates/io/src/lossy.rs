//! JPEG and WebP writers: smaller than PNG, for web pages and e-mail.
//!
//! WebP is lossless. JPEG has no alpha: transparent areas become white.

use std::io::{self, Write};
use std::path::Path;

use image::codecs::jpeg::JpegEncoder;
use image::codecs::webp::WebPEncoder;
use image::{ExtendedColorType, ImageError};

use crate::write::{WriteError, write_atomically};

/// The quality that most programs use: differences are hardly visible.
const JPEG_QUALITY: u8 = 90;

/// JPEG stores sides in 16 bits.
const MOST_JPEG: u32 = 65_535;

/// WebP stores sides in 14 bits.
const MOST_WEBP: u32 = 16_384;

/// Writes a JPEG file of quality 90; `rgba` is sRGB with straight alpha, rows from the top. The
/// file is written atomically, as with [`write_png`](crate::write_png).
///
/// # Errors
/// The sizes do not match, or the file cannot be written.
pub fn write_jpeg(path: impl AsRef<Path>, width: u32, height: u32, rgba: &[u8]) -> Result<(), WriteError> {
    check(width, height, MOST_JPEG, rgba)?;
    write_atomically(path.as_ref(), |file| jpeg(file, width, height, rgba))
}

/// Writes a JPEG of quality 90 to a writer.
///
/// # Errors
/// The sizes do not match, or the writer fails.
pub fn encode_jpeg(writer: impl Write, width: u32, height: u32, rgba: &[u8]) -> Result<(), WriteError> {
    check(width, height, MOST_JPEG, rgba)?;
    Ok(jpeg(writer, width, height, rgba)?)
}

/// Writes a lossless WebP file; `rgba` is sRGB with straight alpha, rows from the top. The file is
/// written atomically, as with [`write_png`](crate::write_png).
///
/// # Errors
/// The sizes do not match, or the file cannot be written.
pub fn write_webp(path: impl AsRef<Path>, width: u32, height: u32, rgba: &[u8]) -> Result<(), WriteError> {
    check(width, height, MOST_WEBP, rgba)?;
    write_atomically(path.as_ref(), |file| webp(file, width, height, rgba))
}

/// Writes a lossless WebP to a writer.
///
/// # Errors
/// The sizes do not match, or the writer fails.
pub fn encode_webp(writer: impl Write, width: u32, height: u32, rgba: &[u8]) -> Result<(), WriteError> {
    check(width, height, MOST_WEBP, rgba)?;
    Ok(webp(writer, width, height, rgba)?)
}

fn check(width: u32, height: u32, most: u32, rgba: &[u8]) -> Result<(), WriteError> {
    let needed = 4 * u128::from(width) * u128::from(height);
    let fits = needed == rgba.len() as u128 && needed > 0 && width.max(height) <= most;
    if fits { Ok(()) } else { Err(WriteError::Size { width, height, length: rgba.len() }) }
}

fn jpeg(writer: impl Write, width: u32, height: u32, rgba: &[u8]) -> io::Result<()> {
    let (pixels, _) = rgba.as_chunks::<4>();
    let rgb: Vec<u8> = pixels.iter().flat_map(|&pixel| on_white(pixel)).collect();
    let mut encoder = JpegEncoder::new_with_quality(writer, JPEG_QUALITY);
    encoder.encode(&rgb, width, height, ExtendedColorType::Rgb8).map_err(into_io)
}

fn webp(writer: impl Write, width: u32, height: u32, rgba: &[u8]) -> io::Result<()> {
    let encoder = WebPEncoder::new_lossless(writer);
    encoder.encode(rgba, width, height, ExtendedColorType::Rgba8).map_err(into_io)
}

/// A pixel composited over white, rounded; mixed in sRGB, as programs display such images.
pub(crate) fn on_white([r, g, b, alpha]: [u8; 4]) -> [u8; 3] {
    let alpha = u32::from(alpha);
    [r, g, b].map(|channel| ((u32::from(channel) * alpha + 255 * (255 - alpha) + 127) / 255) as u8)
}

pub(crate) fn into_io(error: ImageError) -> io::Error {
    match error {
        ImageError::IoError(error) => error,
        other => io::Error::other(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Limits;
    use crate::rgba_image::decode_image;

    /// A field of red with a transparent half.
    fn half_red() -> Vec<u8> {
        (0..64).flat_map(|index| if index % 8 < 4 { [200, 0, 0, 255] } else { [0, 0, 0, 0] }).collect()
    }

    #[test]
    fn webp_keeps_every_byte() {
        let mut bytes = Vec::new();
        encode_webp(&mut bytes, 8, 8, &half_red()).expect("memory takes it");
        let image = decode_image(&bytes, &Limits::default()).expect("a WebP");
        assert_eq!(image.rgba, half_red(), "the same pixels");
    }

    #[test]
    fn jpeg_puts_transparency_on_white() {
        let mut bytes = Vec::new();
        encode_jpeg(&mut bytes, 8, 8, &half_red()).expect("memory takes it");
        let image = decode_image(&bytes, &Limits::default()).expect("a JPEG");
        // Quality 90 quantizes frequencies by up to 24 levels, of which an edge has some.
        let near = |pixel: &[u8], wanted: [u8; 3]| (0..3).all(|i| pixel[i].abs_diff(wanted[i]) < 40);
        assert!(near(&image.rgba[..3], [200, 0, 0]), "red: {:?}", &image.rgba[..3]);
        assert!(near(&image.rgba[28..31], [255; 3]), "white: {:?}", &image.rgba[28..31]);
    }

    #[test]
    fn sizes_must_fit() {
        for (width, height, length) in [(0, 0, 0), (2, 2, 15), (70_000, 1, 280_000)] {
            let rgba = vec![0; length];
            assert!(encode_jpeg(Vec::new(), width, height, &rgba).is_err(), "JPEG {width}×{height}");
            assert!(encode_webp(Vec::new(), width, height, &rgba).is_err(), "WebP {width}×{height}");
        }
    }
}
