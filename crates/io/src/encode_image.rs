//! Writes images as PNG, and as JPEG and WebP, which are smaller, for web pages and e-mail.

use std::io;
use std::io::{BufWriter, Write};
use std::path::Path;

use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::codecs::webp::WebPEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageError};

use super::write::{WriteError, write_atomically};

/// The pixels of an image to write, rows from the top.
#[derive(Clone, Copy, Debug)]
pub enum Pixels<'a> {
    /// Red, green, blue, straight alpha; sRGB.
    Rgba8(&'a [u8]),
    /// Red, green, blue; sRGB.
    Rgb8(&'a [u8]),
    /// One value per pixel, such as a depth; 65535 is white.
    Gray16(&'a [u16]),
    /// Three values per pixel, such as a direction.
    Rgb16(&'a [u16]),
}

/// Writes a PNG file atomically: the bytes go to a temporary file in the same folder, which is synced to disk
/// and renamed. So the path always refers to the complete old or new file.
///
/// # Errors
/// The sizes do not match, or the file cannot be written; an existing file of that name is then
/// unchanged.
pub fn write_png(
    path: impl AsRef<Path>,
    width: u32,
    height: u32,
    pixels: Pixels<'_>,
) -> Result<(), WriteError> {
    check_size(width, height, pixels)?;
    write_atomically(path.as_ref(), |file| encode(file, width, height, pixels))
}

/// Writes a PNG to a writer, such as standard output.
///
/// # Errors
/// The sizes do not match, or the writer fails.
pub fn encode_png(writer: impl Write, width: u32, height: u32, pixels: Pixels<'_>) -> Result<(), WriteError> {
    check_size(width, height, pixels)?;
    let mut writer = BufWriter::new(writer);
    encode(&mut writer, width, height, pixels)?;
    Ok(writer.flush()?)
}

fn check_size(width: u32, height: u32, pixels: Pixels<'_>) -> Result<(), WriteError> {
    let (length, per_pixel) = match pixels {
        Pixels::Rgba8(values) => (values.len(), 4),
        Pixels::Rgb8(values) => (values.len(), 3),
        Pixels::Gray16(values) => (values.len(), 1),
        Pixels::Rgb16(values) => (values.len(), 3),
    };
    let fits = u128::from(width) * u128::from(height) * per_pixel == length as u128;
    if fits && length > 0 { Ok(()) } else { Err(WriteError::Size { width, height, length }) }
}

fn encode(writer: &mut dyn Write, width: u32, height: u32, pixels: Pixels<'_>) -> io::Result<()> {
    let encoder = PngEncoder::new_with_quality(writer, CompressionType::Fast, FilterType::Adaptive);
    let written = match pixels {
        Pixels::Rgba8(values) => encoder.write_image(values, width, height, ExtendedColorType::Rgba8),
        Pixels::Rgb8(values) => encoder.write_image(values, width, height, ExtendedColorType::Rgb8),
        Pixels::Gray16(values) => encoder.write_image(&bytes(values), width, height, ExtendedColorType::L16),
        Pixels::Rgb16(values) => encoder.write_image(&bytes(values), width, height, ExtendedColorType::Rgb16),
    };
    written.map_err(|error| match error {
        ImageError::IoError(error) => error,
        other => io::Error::other(other),
    })
}

/// In native byte order: the encoder swaps them.
fn bytes(values: &[u16]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_ne_bytes()).collect()
}

/// The quality that most programs use: differences are hardly visible.
const JPEG_QUALITY: u8 = 90;

/// JPEG stores sides in 16 bits.
const MOST_JPEG: u32 = 65_535;

/// WebP stores sides in 14 bits.
const MOST_WEBP: u32 = 16_384;

/// Writes a JPEG file of quality 90; `rgba` is sRGB with straight alpha, rows from the top. The
/// file is written atomically, as with [`write_png`].
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
/// written atomically, as with [`write_png`].
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
    use std::fs;

    #[test]
    fn a_file_is_written_whole_and_nothing_stays_beside_it() {
        let dir = tempfile::tempdir().expect("a temporary folder");
        let path = dir.path().join("a.png");
        fs::write(&path, "old").expect("a file");
        write_png(&path, 2, 1, Pixels::Rgb8(&[1, 2, 3, 4, 5, 6])).expect("written");
        let image = crate::load_image(&path, &Limits::default()).expect("an image");
        assert_eq!(image.rgba, [1, 2, 3, 255, 4, 5, 6, 255], "the pixels");
        assert_eq!(fs::read_dir(dir.path()).expect("a folder").count(), 1, "no temporary file");
    }

    #[test]
    fn sizes_must_fit() {
        for (width, height, length) in [(0, 0, 0), (2, 2, 15), (u32::MAX, u32::MAX, 4)] {
            let result = encode_png(Vec::new(), width, height, Pixels::Rgba8(&vec![0; length]));
            assert!(matches!(result, Err(WriteError::Size { .. })), "{width}×{height} with {length}");
        }
    }

    #[test]
    fn sixteen_bit_grey_keeps_its_values() {
        let mut bytes = Vec::new();
        encode_png(&mut bytes, 3, 1, Pixels::Gray16(&[0, 0x1234, 0xffff])).expect("memory takes it");
        let image = image::load_from_memory(&bytes).expect("a PNG").into_luma16();
        assert_eq!(image.into_raw(), [0, 0x1234, 0xffff], "every bit");
    }

    #[test]
    fn the_error_names_the_file() {
        let error =
            write_png("/nowhere/at/all.png", 1, 1, Pixels::Rgb8(&[0; 3])).expect_err("no such folder");
        assert!(error.to_string().starts_with("/nowhere/at/all.png: "), "{error}");
    }

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
    fn sizes_must_fit_for_lossy_formats() {
        for (width, height, length) in [(0, 0, 0), (2, 2, 15), (70_000, 1, 280_000)] {
            let rgba = vec![0; length];
            assert!(encode_jpeg(Vec::new(), width, height, &rgba).is_err(), "JPEG {width}×{height}");
            assert!(encode_webp(Vec::new(), width, height, &rgba).is_err(), "WebP {width}×{height}");
        }
    }
}
