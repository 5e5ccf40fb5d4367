//! Environment images (Radiance, `.hdr`).

use std::io::Cursor;
use std::path::Path;

use image::{ImageFormat, ImageReader};
use trigon_scene::Environment;

use super::options::Limits;
use crate::error::{LoadError, LoadErrorKind, Location};
use crate::folder::{Folder, to_the_end};
use crate::rgba_image::{check_claim, decoder_limits, reason};
use crate::warning::{Warning, Warnings};

/// The largest value of a pixel. The sun of a clear sky has a hundred thousand; the format allows
/// 10³⁸, whose sums are infinite.
const BRIGHTEST: f32 = 1e9;

/// Reads an environment image (Radiance, `.hdr`), usually twice as wide as high. The middle looks along −Z,
/// the right half to +X, and the upper edge is +Y. The result for
/// [`EffectSettings`](trigon_scene::EffectSettings) is light as stored in the file; a line `EXPOSURE` in it
/// is ignored.
///
/// Pixels above 10⁹ are clamped to it, with a warning. The format cannot represent infinity.
///
/// # Errors
/// The file cannot be read, is of another format, is broken, or is larger than the limits.
pub fn load_environment(
    path: impl AsRef<Path>,
    limits: &Limits,
) -> Result<(Environment, Vec<Warning>), LoadError> {
    let path = path.as_ref();
    let bytes = Folder::none(limits).read_model(path, &to_the_end)?;
    let mut warnings = Warnings::about(path);
    let environment = decode(&bytes, limits, &mut warnings).map_err(|why| {
        LoadError::new(LoadErrorKind::Unsupported, path, why, "save it as a Radiance image (.hdr)")
    })?;
    Ok((environment, warnings.into_list()))
}

fn decode(bytes: &[u8], limits: &Limits, warnings: &mut Warnings) -> Result<Environment, String> {
    if !bytes.starts_with(b"#?") {
        return Err("its first bytes are not those of a Radiance image".to_owned());
    }
    let reader = || {
        let mut reader = ImageReader::with_format(Cursor::new(bytes), ImageFormat::Hdr);
        reader.limits(decoder_limits(limits));
        reader
    };
    let (width, height) = reader().into_dimensions().map_err(|error| reason(&error))?;
    check_claim(width, height, limits)?;
    let mut pixels = reader().decode().map_err(|error| reason(&error))?.into_rgb32f().into_raw();
    let mut bright = 0;
    for value in pixels.iter_mut().filter(|value| **value > BRIGHTEST) {
        *value = BRIGHTEST;
        bright += 1;
    }
    warnings.push_counted(
        bright,
        Location::Whole,
        "a pixel is brighter than 1e9 and is held to that",
        "check the image's scale",
    );
    let (pixels, _) = pixels.as_chunks::<3>();
    Environment::from_equirectangular(width as usize, height as usize, pixels)
        .map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use trigon_math::Vec3;

    use super::*;

    /// An image of 16 × 8 pixels without compression, each with a mantissa for red, green and blue
    /// and a common exponent.
    fn image(pixel: impl Fn(usize, usize) -> [u8; 4]) -> Vec<u8> {
        let mut bytes = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n".to_vec();
        bytes.extend((0..128).flat_map(|index| pixel(index % 16, index / 16)));
        bytes
    }

    fn read(bytes: &[u8]) -> Result<(Environment, Vec<Warning>), LoadError> {
        let dir = tempfile::tempdir().expect("a folder");
        let path = dir.path().join("a.hdr");
        std::fs::write(&path, bytes).expect("a file");
        load_environment(&path, &Limits::default())
    }

    #[test]
    fn light_comes_from_where_the_image_has_it() {
        // 128 with the exponent 129 is 1; 130 doubles it.
        let (environment, warnings) = read(&image(|x, y| match (x, y) {
            (_, 0..4) => [0, 0, 128, 130],
            (0..8, _) => [128, 0, 0, 129],
            _ => [0, 128, 0, 129],
        }))
        .expect("an image");
        assert!(warnings.is_empty(), "nothing to warn of");
        let seen = |direction: Vec3| environment.radiance(direction, 0.0);
        for (direction, light) in [
            (Vec3::new(0.3, 1.0, 0.1), Vec3::new(0.0, 0.0, 2.0)),
            (Vec3::new(-1.0, -0.5, -0.1), Vec3::X),
            (Vec3::new(1.0, -0.5, -0.1), Vec3::Y),
        ] {
            assert!(seen(direction).distance(light) < 1e-3, "{direction} has {}", seen(direction));
        }
    }

    #[test]
    fn absurd_brightness_is_held_to_what_can_be_summed() {
        let (environment, warnings) = read(&image(|_, _| [255, 255, 255, 255])).expect("an image");
        assert_eq!((warnings.len(), warnings[0].more), (1, 3 * 128 - 1), "said once, and counted");
        assert!(environment.irradiance(Vec3::Y).is_finite(), "finite light");
    }

    #[test]
    fn what_is_no_image_says_why() {
        let whole = image(|_, _| [128, 0, 0, 129]);
        let claim = |size: &str| format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n{size}\n").into_bytes();
        for (bytes, word) in [
            (b"\x89PNG".to_vec(), "Radiance"),
            (Vec::new(), "Radiance"),
            (whole[..whole.len() - 40].to_vec(), "too early"),
            (claim("-Y 0 +X 16"), "no pixels"),
            (claim("-Y 99999999 +X 16"), "limit"),
            (claim("-Y 16000 +X 16000"), "limit"),
            (claim("+Y 8 +X 16"), "broken"),
        ] {
            let error = read(&bytes).map(|_| ()).expect_err("no image").to_string();
            assert!(error.contains("a.hdr") && error.contains(word), "{error:?} has {word:?}");
        }
    }
}
