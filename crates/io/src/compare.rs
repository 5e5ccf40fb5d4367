//! Compares two images, perceptually and byte by byte.
//!
//! The error is 1 − SSIM: Wang, Bovik, Sheikh and Simoncelli, "Image Quality Assessment:
//! From Error Visibility to Structural Similarity" (2004), of blocks of 8×8 pixels that
//! overlap by half, the mean over blocks and over red, green, blue (times alpha) and alpha.

use thiserror::Error;

use crate::rgba_image::RgbaImage;

/// The side of a block in pixels, and the distance between blocks.
const BLOCK: usize = 8;
const STEP: usize = 4;

/// (0.01 · 255)² and (0.03 · 255)², as in the paper: they keep dark blocks from dominating.
const C1: f64 = 6.5025;
const C2: f64 = 58.5225;

/// The difference between two images.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ImageDifference {
    /// 0 for equal images, up to 1 and in rare cases to 2; below 0.04 they look alike.
    pub error: f64,
    /// The number of pixels with a different byte.
    pub different_pixels: u64,
    /// The largest difference between two bytes.
    pub largest: u8,
    /// A map of the differences: opaque, black where the images are equal, stretched so that the
    /// largest difference is white in its channel. Alpha counts for all three channels.
    pub image: RgbaImage,
}

/// Images of different sizes cannot be compared.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[error("one image is {}×{}, the other {}×{}; draw it in the size of the other", .0[0], .0[1], .1[0], .1[1])]
pub struct SizeMismatch([u32; 2], [u32; 2]);

/// Compares two images.
///
/// # Errors
/// The images have different sizes.
pub fn compare_images(one: &RgbaImage, other: &RgbaImage) -> Result<ImageDifference, SizeMismatch> {
    let sizes = [one, other].map(|image| [image.width, image.height]);
    if sizes[0] != sizes[1] {
        return Err(SizeMismatch(sizes[0], sizes[1]));
    }
    let (pixels, others) = (one.rgba.as_chunks::<4>().0, other.rgba.as_chunks::<4>().0);
    let apart = |(a, b): (&[u8; 4], &[u8; 4])| std::array::from_fn(|i| a[i].abs_diff(b[i]));
    let differences: Vec<[u8; 4]> = pixels.iter().zip(others).map(apart).collect();
    let largest = differences.iter().flatten().copied().max().unwrap_or(0);
    let stretched = |&[r, g, b, alpha]: &[u8; 4]| {
        let shown = [r, g, b].map(|channel| channel.max(alpha));
        let [r, g, b] = shown.map(|channel| (u32::from(channel) * 255 / u32::from(largest.max(1))) as u8);
        [r, g, b, 255]
    };
    let rgba = differences.iter().flat_map(stretched).collect();
    Ok(ImageDifference {
        error: 1.0 - similarity(one, other),
        different_pixels: differences.iter().filter(|&&pixel| pixel != [0; 4]).count() as u64,
        largest,
        image: RgbaImage { width: one.width, height: one.height, rgba },
    })
}

/// The mean of all blocks and channels, summed in the order of rows.
fn similarity(one: &RgbaImage, other: &RgbaImage) -> f64 {
    let (width, height) = (one.width as usize, one.height as usize);
    let (mut sum, mut count) = (0.0, 0.0);
    for y in starts(height) {
        for x in starts(width) {
            for channel in 0..4 {
                sum += block(one, other, [x, y], channel);
                count += 1.0;
            }
        }
    }
    if count > 0.0 { sum / count } else { 1.0 }
}

/// The start of each block; there is at least one, in an image of any size.
fn starts(side: usize) -> impl Iterator<Item = usize> {
    (0..side.saturating_sub(BLOCK - STEP).max(1)).step_by(STEP)
}

/// SSIM of one channel of one block, cropped at the image's edges.
fn block(one: &RgbaImage, other: &RgbaImage, [left, top]: [usize; 2], channel: usize) -> f64 {
    let (width, height) = (one.width as usize, one.height as usize);
    // Sums of a, b, a², b² and ab are exact: 64 · 255² is far below 2³².
    let mut sums = [0u32; 5];
    let mut count = 0u32;
    for y in top..(top + BLOCK).min(height) {
        for x in left..(left + BLOCK).min(width) {
            let [a, b] = [one, other].map(|image| value(image, y * width + x, channel));
            for (sum, term) in sums.iter_mut().zip([a, b, a * a, b * b, a * b]) {
                *sum += term;
            }
            count += 1;
        }
    }
    let [a, b, aa, bb, ab] = sums.map(|sum| f64::from(sum) / f64::from(count));
    // In this order the covariance of equal images is exact.
    let (variances, covariance) = ((aa - a * a) + (bb - b * b), ab - a * b);
    (2.0 * a * b + C1) * (2.0 * covariance + C2) / ((a * a + b * b + C1) * (variances + C2))
}

/// A channel of a pixel, colours times alpha, so that transparent pixels do not count.
fn value(image: &RgbaImage, pixel: usize, channel: usize) -> u32 {
    let [byte, alpha] = [channel, 3].map(|channel| u32::from(image.rgba[4 * pixel + channel]));
    if channel == 3 { byte } else { byte * alpha / 255 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(width: u32, height: u32, pixel: impl Fn(u32, u32) -> [u8; 4]) -> RgbaImage {
        let rows = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        RgbaImage { width, height, rgba: rows.flat_map(|(x, y)| pixel(x, y)).collect() }
    }

    fn stripes(x: u32, _: u32) -> [u8; 4] {
        if x % 4 < 2 { [200, 100, 50, 255] } else { [20, 40, 60, 255] }
    }

    #[test]
    fn the_same_image_has_no_error_in_any_size() {
        for (width, height) in [(1, 1), (3, 9), (8, 8), (37, 21)] {
            let one = image(width, height, stripes);
            let difference = compare_images(&one, &one).expect("of one size");
            assert_eq!(difference.error, 0.0, "{width}×{height}");
            assert_eq!((difference.different_pixels, difference.largest), (0, 0), "{width}×{height}");
        }
    }

    #[test]
    fn what_looks_more_different_has_a_larger_error() {
        let one = image(40, 40, stripes);
        let error = |other: &RgbaImage| compare_images(&one, other).expect("of one size").error;
        let brighter = image(40, 40, |x, y| stripes(x, y).map(|channel| channel.saturating_add(2)));
        let moved = image(40, 40, |x, y| stripes(x + 2, y));
        assert!(error(&brighter) < 0.04, "hardly seen: {}", error(&brighter));
        assert!(error(&moved) > 0.5, "another image: {}", error(&moved));
        let dot = image(40, 40, |x, y| if (x, y) == (20, 20) { [255; 4] } else { stripes(x, y) });
        let difference = compare_images(&one, &dot).expect("of one size");
        assert_eq!((difference.different_pixels, difference.largest), (1, 205), "one pixel");
        assert_eq!(difference.image.rgba[4 * (40 * 20 + 20) + 2], 255, "stretched");
        assert_eq!(difference.image.rgba[..4], [0, 0, 0, 255], "black elsewhere");
    }

    #[test]
    fn colours_of_what_is_transparent_do_not_count() {
        let [one, other] = [0, 255].map(|red| image(16, 16, |_, _| [red, 0, 0, 0]));
        assert_eq!(compare_images(&one, &other).expect("of one size").error, 0.0, "nothing is seen");
    }

    #[test]
    fn different_sizes_say_both() {
        let [one, other] = [4, 5].map(|width| image(width, 3, stripes));
        let message = compare_images(&one, &other).expect_err("no way").to_string();
        assert!(message.contains("4×3") && message.contains("5×3"), "{message}");
    }
}
