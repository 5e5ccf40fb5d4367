//! PNG writer: to any writer, or to a file.

use std::io::{self, BufWriter, Write};
use std::path::Path;

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};

use crate::write::{WriteError, write_atomically};

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
        image::ImageError::IoError(error) => error,
        other => io::Error::other(other),
    })
}

/// In native byte order: the encoder swaps them.
fn bytes(values: &[u16]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_ne_bytes()).collect()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn a_file_is_written_whole_and_nothing_stays_beside_it() {
        let dir = tempfile::tempdir().expect("a temporary folder");
        let path = dir.path().join("a.png");
        fs::write(&path, "old").expect("a file");
        write_png(&path, 2, 1, Pixels::Rgb8(&[1, 2, 3, 4, 5, 6])).expect("written");
        let image = crate::load_image(&path, &crate::Limits::default()).expect("an image");
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
}
