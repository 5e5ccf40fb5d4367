//! Image readers: PNG, JPEG and WebP to 8-bit RGBA, within limits.
//!
//! The format follows from the first bytes, never from the file name or the model's claims.
//!
//! The JPEG decoder has an AVX2 path in addition to the scalar one. Both gave the same bytes for
//! 1,000 random and 4 real files (zune-jpeg 0.5.15); its NEON path has not been compared yet.

use std::io::Cursor;
use std::path::Path;

use image::{ImageDecoder, ImageError, ImageFormat, ImageReader};

use super::options::Limits;
use crate::error::{LoadError, LoadErrorKind};
use crate::folder::{Folder, to_the_end};

/// An image in memory: sRGB colours with straight alpha.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RgbaImage {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Four bytes per pixel (red, green, blue, alpha), rows from the top.
    pub rgba: Vec<u8>,
}

/// Reads a PNG, JPEG or WebP file. 16-bit channels are rounded to 8, grey is expanded to three
/// channels, missing alpha is opaque.
///
/// # Errors
/// The file cannot be read, has another format, is broken, or is larger than the limits.
pub fn load_image(path: impl AsRef<Path>, limits: &Limits) -> Result<RgbaImage, LoadError> {
    let path = path.as_ref();
    let bytes = Folder::none(limits).read_model(path, &to_the_end)?;
    decode_image(&bytes, limits)
        .map_err(|why| LoadError::new(LoadErrorKind::Unsupported, path, why, "save it as PNG, JPEG or WebP"))
}

/// Width and height according to the image's header, if within the limits. Reads only the header.
pub(crate) fn image_size(bytes: &[u8], limits: &Limits) -> Result<(u32, u32), String> {
    let format = image_format(bytes)?;
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader.limits(decoder_limits(limits));
    let (width, height) = reader.into_dimensions().map_err(|error| reason(&error))?;
    check_claim(width, height, limits)?;
    Ok((width, height))
}

/// Whether an image of that width and height is within the limits, and has pixels.
pub(crate) fn check_claim(width: u32, height: u32, limits: &Limits) -> Result<(), String> {
    let pixels = u64::from(width) * u64::from(height);
    if width == 0 || height == 0 {
        return Err(format!("the image has no pixels ({width}×{height})"));
    }
    if width.max(height) > limits.image_side || pixels > limits.image_pixels {
        let (side, most) = (limits.image_side, limits.image_pixels);
        return Err(format!(
            "the image claims {width}×{height} pixels; the limit is {side} a side and {most} in all"
        ));
    }
    Ok(())
}

/// Decodes an image, or returns why it cannot be decoded.
pub(crate) fn decode_image(bytes: &[u8], limits: &Limits) -> Result<RgbaImage, String> {
    let (width, height) = image_size(bytes, limits)?;
    let mut reader = ImageReader::with_format(Cursor::new(bytes), image_format(bytes)?);
    reader.limits(decoder_limits(limits));
    let decoder = reader.into_decoder().map_err(|error| reason(&error))?;
    let color = decoder.color_type();
    // The size is within the limits.
    let mut bytes = vec![0; decoder.total_bytes() as usize];
    decoder.read_image(&mut bytes).map_err(|error| reason(&error))?;
    let is_wide = color.bytes_per_pixel() == 2 * color.channel_count();
    let channels = if is_wide { rounded(&bytes) } else { bytes };
    Ok(RgbaImage { width, height, rgba: spread(channels, color.channel_count()) })
}

/// 16-bit channels, in native byte order, rounded to 8.
///
/// Implemented here, like [`spread`], and not by the `image` crate, which is compiled without
/// optimization except for generic code (`Cargo.toml` of the workspace).
fn rounded(bytes: &[u8]) -> Vec<u8> {
    let (pairs, _) = bytes.as_chunks::<2>();
    pairs.iter().map(|&pair| ((u32::from(u16::from_ne_bytes(pair)) + 128) / 257) as u8).collect()
}

/// Grey, grey with alpha, or colours, to colours with alpha.
fn spread(channels: Vec<u8>, count: u8) -> Vec<u8> {
    match count {
        1 => channels.iter().flat_map(|&grey| [grey, grey, grey, 255]).collect(),
        2 => channels.as_chunks::<2>().0.iter().flat_map(|&[grey, a]| [grey, grey, grey, a]).collect(),
        3 => channels.as_chunks::<3>().0.iter().flat_map(|&[r, g, b]| [r, g, b, 255]).collect(),
        _ => channels,
    }
}

/// A conspicuous placeholder for an image that cannot be decoded: magenta and grey squares.
pub(crate) fn placeholder() -> RgbaImage {
    const SIDE: u32 = 16;
    const SQUARE: u32 = 4;
    let pixel = |index: u32| {
        let (x, y) = (index % SIDE / SQUARE, index / SIDE / SQUARE);
        if (x + y) % 2 == 0 { [255, 0, 255, 255] } else { [96, 96, 96, 255] }
    };
    RgbaImage { width: SIDE, height: SIDE, rgba: (0..SIDE * SIDE).flat_map(pixel).collect() }
}

/// The format by the first bytes.
fn image_format(bytes: &[u8]) -> Result<ImageFormat, String> {
    match image::guess_format(bytes) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg | ImageFormat::WebP)) => Ok(format),
        Ok(format) => {
            Err(format!("images of the format {format:?} are not supported, only PNG, JPEG and WebP are"))
        }
        Err(_) if bytes.is_empty() => Err("the image is an empty file".to_owned()),
        Err(_) if bytes.starts_with(b"\xabKTX 20\xbb\r\n\x1a\n") => {
            Err("KTX2 images are not supported, only PNG, JPEG and WebP are".to_owned())
        }
        Err(_) => Err("its first bytes match no known image format".to_owned()),
    }
}

pub(crate) fn decoder_limits(limits: &Limits) -> image::Limits {
    // . 16-bit RGBA is the widest that the decoders produce, plus one copy.
    const BYTES_PER_PIXEL: u64 = 16;
    let mut decoder = image::Limits::default();
    decoder.max_image_width = Some(limits.image_side);
    decoder.max_image_height = Some(limits.image_side);
    decoder.max_alloc = Some(limits.image_pixels.saturating_mul(BYTES_PER_PIXEL));
    decoder
}

pub(crate) fn reason(error: &ImageError) -> String {
    match error {
        ImageError::Limits(limit) => format!("the image is too large ({limit})"),
        ImageError::IoError(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            "the image ends too early".to_owned()
        }
        other => format!("the image is broken ({other})"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::encode_image::{Pixels, encode_png};

    #[test]
    fn a_png_comes_back_as_it_was() {
        let rgba: Vec<u8> = (0..4 * 6).collect();
        let mut bytes = Vec::new();
        encode_png(&mut bytes, 3, 2, Pixels::Rgba8(&rgba)).expect("memory takes it");
        let image = decode_image(&bytes, &Limits::default()).expect("it is a PNG");
        assert_eq!(image, RgbaImage { width: 3, height: 2, rgba }, "the same pixels");
    }

    /// The `image` crate's own conversion is the oracle.
    #[test]
    fn every_type_of_pixel_becomes_colours_with_alpha() {
        use image::{DynamicImage, ExtendedColorType as Type, ImageEncoder, codecs::png::PngEncoder};
        let types = [Type::L8, Type::La8, Type::Rgb8, Type::Rgba8];
        let wide = [Type::L16, Type::La16, Type::Rgb16, Type::Rgba16];
        for color in types.into_iter().chain(wide) {
            let size = usize::from(color.bits_per_pixel()) / 8 * 64 * 64;
            // Each pair of bytes is a different 16-bit number.
            let bytes: Vec<u8> = (0..size).map(|i| (i * 7 + i / 256 * 3) as u8).collect();
            let mut png = Vec::new();
            PngEncoder::new(&mut png).write_image(&bytes, 64, 64, color).expect("memory takes it");
            let theirs = image::load_from_memory(&png).map(DynamicImage::into_rgba8).expect("a PNG");
            let ours = decode_image(&png, &Limits::default()).expect("it is a PNG");
            assert_eq!(ours.rgba, theirs.into_raw(), "{color:?}");
        }
    }

    #[test]
    fn broken_and_foreign_images_say_why() {
        let mut png = Vec::new();
        encode_png(&mut png, 64, 64, Pixels::Rgba8(&[7; 64 * 64 * 4])).expect("memory takes it");
        let half = &png[..png.len() / 2];
        for (bytes, word) in [
            (&b""[..], "empty"),
            (b"hello, world", "no known"),
            (b"GIF89a\x01\0\x01\0", "Gif"),
            (half, "image"),
        ] {
            let why = decode_image(bytes, &Limits::default()).expect_err("no image");
            assert!(why.contains(word), "{why:?} names {word:?}");
        }
    }

    #[test]
    fn a_claim_beyond_the_limits_allocates_nothing() {
        let mut png = Vec::new();
        encode_png(&mut png, 64, 64, Pixels::Rgba8(&[7; 64 * 64 * 4])).expect("memory takes it");
        let limits = Limits { image_pixels: 64 * 63, ..Limits::default() };
        let why = decode_image(&png, &limits).expect_err("one row too many");
        assert!(why.contains("limit"), "{why}");
        // 60000 × 60000 pixels, none of which is there: if memory for them were allocated first, they would be missed.
        let bomb = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\xea`\0\0\xea`\x08\x06\0\0\0\x80\xd2uB\
            \0\0\0\x08IDATx\x9c\x03\0\0\0\0\x01H\x06\x89\xd2\0\0\0\0IEND\xaeB`\x82";
        let why = decode_image(bomb, &Limits::default()).expect_err("too large");
        assert!(why.contains("limit"), "{why}");
    }
}
