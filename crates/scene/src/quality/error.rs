//! The error of images relative to the reference, and its prediction.

use trigon_math::color;

use super::Quality;
use crate::frame::Frame;

/// The root mean square of the differences between two images, in linear light: red, green and blue
/// from 0 to 1, premultiplied. 0 for images of different sizes or without colours, which cannot be
/// compared.
#[must_use]
pub fn rmse(image: &Frame, reference: &Frame) -> f64 {
    let pixels = image.color.len() / 4;
    if pixels == 0 { 0.0 } else { (squares(image, reference) / (3 * pixels) as f64).sqrt() }
}

/// The error that an image has because its light is rounded to bytes, as [`rmse`] measures it: the root mean square over all
/// the light that its bytes stand for, each from half a step below to half a step above. Images that differ from it by less
/// are as good. 0 without colours.
///
/// ```
/// use trigon_scene::{Frame, quality::rounding_floor};
///
/// let grey = |byte: u8| Frame { width: 1, height: 1, color: vec![byte, byte, byte, 255], ..Frame::default() };
/// assert!(rounding_floor(&grey(200)) > rounding_floor(&grey(20)), "steps of sRGB grow with the light");
/// ```
#[must_use]
pub fn rounding_floor(image: &Frame) -> f64 {
    let light = |byte: f32| f64::from(color::srgb_to_linear((byte / 255.0).clamp(0.0, 1.0)));
    let cube = |value: f64| value * value * value;
    let of_byte: Vec<f64> = (0..=255_u8)
        .map(|byte| {
            let [low, middle, high] = [-0.5, 0.0, 0.5].map(|half| light(f32::from(byte) + half));
            (cube(high - middle) + cube(middle - low)) / (3.0 * (high - low))
        })
        .collect();
    let of_pixel = |&[red, green, blue, alpha]: &[u8; 4]| {
        let alpha = f64::from(alpha) / 255.0;
        [red, green, blue].map(|byte| of_byte[usize::from(byte)]).iter().sum::<f64>() * alpha * alpha
    };
    let pixels = pixels(image);
    if pixels.is_empty() {
        return 0.0;
    }
    (pixels.iter().map(of_pixel).sum::<f64>() / (3 * pixels.len()) as f64).sqrt()
}

/// Learns from images of a scene and their references what error others will have.
///
/// Errors of faster settings are concentrated where light changes from pixel to pixel: at outlines,
/// edges of shadows, highlights, fine textures. The sum of squared second differences along rows
/// and columns, called detail here, measures how much of that an image has, and needs no reference.
/// The error of a quality is assumed to be proportional to the root of the detail in its own
/// images; the proportion is learnt, and the detail is that of the last frame. So errors follow a
/// moving camera without drawing anything twice.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ErrorModel {
    known: Vec<Known>,
    /// The last frame's quality, and its detail per pixel.
    last: Option<(Quality, f64)>,
}

/// What is known about one quality.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Known {
    quality: Quality,
    /// Sums over all images, with the highest weight on the newest.
    now: Sums,
    /// Sums over those from which every quality was learnt.
    at_first: Sums,
}

/// Sums over pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Sums {
    squares: f64,
    detail: f64,
    pixels: f64,
}

impl Sums {
    fn of(image: &Frame, reference: &Frame) -> Self {
        let pixels = (image.color.len() / 4) as f64;
        Self { squares: squares(image, reference), detail: mean_detail(image) * pixels, pixels }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            squares: self.squares + other.squares,
            detail: self.detail + other.detail,
            pixels: self.pixels + other.pixels,
        }
    }

    fn times(self, factor: f64) -> Self {
        Self { squares: self.squares * factor, detail: self.detail * factor, pixels: self.pixels * factor }
    }

    /// Per pixel.
    fn mean_detail(&self) -> f64 {
        self.detail / self.pixels
    }
}

impl ErrorModel {
    /// An image in a quality, and its reference. Both may be part of a frame; all qualities must be
    /// learnt from the same parts.
    pub fn learn(&mut self, quality: Quality, image: &Frame, reference: &Frame) {
        let new = Sums::of(image, reference);
        if new.pixels == 0.0 {
            return;
        }
        match self.of_mut(quality) {
            Some(known) => (known.now, known.at_first) = (known.now.plus(new), known.at_first.plus(new)),
            None => self.known.push(Known { quality, now: new, at_first: new }),
        }
    }

    /// A newer image in a quality that was learnt, from any part of the scene, and its reference.
    /// Older ones have less weight from now on.
    ///
    /// Qualities with the same number of shaded samples and the same shadows are mostly wrong in
    /// the same places: they follow it half of the way.
    pub fn correct(&mut self, quality: Quality, image: &Frame, reference: &Frame) {
        /// The weight that older images keep: about ten images count.
        const RETAINED: f64 = 0.9;
        let Some(known) = self.of_mut(quality) else { return };
        let before = known.now.squares / known.now.detail;
        known.now = known.now.times(RETAINED).plus(Sums::of(image, reference));
        let change = (known.now.squares / known.now.detail / before).sqrt();
        let is_alike = |other: Quality| {
            other != quality
                && (other.shaded_samples(), other.shadows) == (quality.shaded_samples(), quality.shadows)
        };
        // Without errors, or without detail, there is nothing to compare.
        for known in self.known.iter_mut().filter(|known| change.is_normal() && is_alike(known.quality)) {
            known.now.squares *= change;
        }
    }

    /// Reports a frame of this quality; the next one is assumed to be similar.
    pub fn saw(&mut self, quality: Quality, frame: &Frame) {
        if !frame.color.is_empty() {
            self.last = Some((quality, mean_detail(frame)));
        }
    }

    /// The predicted [`rmse`] of the next frame; `None` for a quality about which nothing was
    /// learnt.
    #[must_use]
    pub fn predict(&self, quality: Quality) -> Option<f64> {
        let known = self.of(quality)?;
        if known.now.detail == 0.0 {
            return Some((known.now.squares / (3.0 * known.now.pixels)).sqrt());
        }
        Some((known.now.squares / known.now.detail * self.detail_now(known) / 3.0).sqrt())
    }

    /// The predicted detail per pixel of the next frame in a quality.
    fn detail_now(&self, known: &Known) -> f64 {
        let Some((quality, detail)) = self.last else { return known.at_first.mean_detail() };
        match self.of(quality).map(|last| last.at_first.mean_detail()) {
            Some(usual) if usual > 0.0 => detail * (known.at_first.mean_detail() / usual),
            _ => detail,
        }
    }

    fn of(&self, quality: Quality) -> Option<&Known> {
        self.known.iter().find(|known| known.quality == quality)
    }

    fn of_mut(&mut self, quality: Quality) -> Option<&mut Known> {
        self.known.iter_mut().find(|known| known.quality == quality)
    }
}

/// The sum of the squares of all differences.
fn squares(image: &Frame, reference: &Frame) -> f64 {
    if [image.width, image.height] != [reference.width, reference.height] {
        return 0.0;
    }
    let pairs = pixels(image).iter().zip(pixels(reference));
    // An empty sum of floats is −0.
    pairs
        .filter(|(a, b)| a != b)
        .map(|(&a, &b)| apart(light(a), light(b)))
        .fold(0.0, |sum, square| sum + square)
}

fn pixels(frame: &Frame) -> &[[u8; 4]] {
    frame.color.as_chunks().0
}

fn light(pixel: [u8; 4]) -> [f32; 3] {
    let alpha = f32::from(pixel[3]) / 255.0;
    [0, 1, 2].map(|channel| color::srgb8_to_linear(pixel[channel]) * alpha)
}

fn apart(a: [f32; 3], b: [f32; 3]) -> f64 {
    (0..3).map(|channel| f64::from(a[channel] - b[channel])).map(|difference| difference * difference).sum()
}

/// The mean square of second differences in linear light, of every fourth row and column.
fn mean_detail(frame: &Frame) -> f64 {
    /// A quarter is enough, and takes a quarter of the time.
    const STEP: usize = 4;
    let (pixels, width) = (pixels(frame), frame.width as usize);
    let (mut sum, mut count) = (0.0, 0_usize);
    let mut add = |line: &mut dyn Iterator<Item = [u8; 4]>| {
        let (mut before, mut middle) = (None, None);
        for after in line.map(light) {
            if let (Some(a), Some(b)) = (before, middle) {
                let [a, b]: [[f32; 3]; 2] = [a, b];
                let doubled = b.map(|channel| 2.0 * channel);
                let around = [0, 1, 2].map(|channel| a[channel] + after[channel]);
                sum += apart(around, doubled);
                count += 1;
            }
            (before, middle) = (middle, Some(after));
        }
    };
    pixels.chunks(width.max(1)).skip(STEP / 2).step_by(STEP).for_each(|row| add(&mut row.iter().copied()));
    for column in (0..width).skip(STEP / 2).step_by(STEP) {
        add(&mut pixels[column..].iter().step_by(width).copied());
    }
    if count == 0 { 0.0 } else { sum / count as f64 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quality::Preset;

    /// Stripes of so many pixels, of a grey and black.
    fn stripes(width: usize, grey: u8) -> Frame {
        let pixel = |i: usize| {
            let light = if (i % 32 / width).is_multiple_of(2) { grey } else { 0 };
            [light, light, light, 255]
        };
        Frame { width: 32, height: 32, color: (0..32 * 32).flat_map(pixel).collect(), ..Frame::default() }
    }

    #[test]
    fn errors_are_means_in_linear_light() {
        let (white, half) = (stripes(32, 255), stripes(16, 255));
        assert_eq!(rmse(&white, &white), 0.0, "the same");
        // Half of the pixels are off by 1.
        assert_eq!(rmse(&white, &half), 0.5_f64.sqrt(), "half of it");
        assert_eq!(rmse(&Frame::default(), &white), 0.0, "nothing to compare");
        let clear = Frame { color: [255, 255, 255, 0].repeat(32 * 32), ..white.clone() };
        assert_eq!(rmse(&clear, &white), 1.0, "what is transparent has no light");
    }

    /// Against light that is rounded to bytes here, spread over all that shows.
    #[test]
    fn rounding_errs_as_much_as_is_said() {
        const SIDE: u32 = 128;
        let count = SIDE * SIDE;
        let light = |index: u32| (f64::from(index) + 0.5) / f64::from(count);
        // Even in sRGB, so that all light of a byte is as frequent as that of any other.
        let exact: Vec<f32> = (0..count).map(|index| color::srgb_to_linear(light(index) as f32)).collect();
        let color = exact.iter().flat_map(|&light| {
            let byte = color::linear_to_srgb8(light);
            [byte, byte, byte, 255]
        });
        let image = Frame { width: SIDE, height: SIDE, color: color.collect(), ..Frame::default() };
        let squares = exact.iter().zip(pixels(&image)).map(|(exact, pixel)| {
            let error = f64::from(exact - color::srgb8_to_linear(pixel[0]));
            error * error
        });
        let measured = (squares.sum::<f64>() / f64::from(count)).sqrt();
        let said = rounding_floor(&image);
        // 64 samples in each byte's range: their mean square is off by 1/64² of it and by uneven density in it.
        assert!((said / measured - 1.0).abs() < 0.01, "{said} for {measured}");
        assert_eq!(rounding_floor(&Frame::default()), 0.0, "no colours");
        let clear = Frame { color: [255, 255, 255, 0].repeat(32 * 32), ..stripes(32, 0) };
        assert_eq!(rounding_floor(&clear), 0.0, "what is transparent has no light");
    }

    #[test]
    fn errors_grow_with_the_detail_of_the_last_frame() {
        let [draft, high] = [Preset::Draft, Preset::High].map(Preset::quality);
        let (coarse, reference) = (stripes(8, 255), stripes(8, 250));
        let mut errors = ErrorModel::default();
        assert_eq!(errors.predict(draft), None, "nothing is known");
        errors.learn(draft, &coarse, &reference);
        let learnt = errors.predict(draft).expect("just learnt");
        assert!((learnt / rmse(&coarse, &reference) - 1.0).abs() < 1e-12, "as it was: {learnt}");
        assert_eq!(errors.predict(high), None, "of this one nothing");
        errors.saw(draft, &coarse);
        assert_eq!(errors.predict(draft), Some(learnt), "the same image again");
        let detail = [8, 2].map(|width| mean_detail(&stripes(width, 255)));
        errors.saw(draft, &stripes(2, 255));
        let more = errors.predict(draft).expect("learnt");
        // In proportion to its root; the predictions are a few roundings of f64 away.
        assert!((more / learnt - (detail[1] / detail[0]).sqrt()).abs() < 1e-12, "{learnt} becomes {more}");
        assert!(more > 1.5 * learnt, "with four times the edges: {learnt} becomes {more}");
    }

    #[test]
    fn newer_images_correct_older_ones() {
        let [draft, high] = [Preset::Draft, Preset::High].map(Preset::quality);
        let (coarse, fine) = (stripes(8, 255), stripes(2, 255));
        let mut errors = ErrorModel::default();
        errors.learn(draft, &coarse, &stripes(8, 250));
        errors.learn(high, &coarse, &stripes(8, 254));
        errors.saw(draft, &fine);
        let before = errors.predict(high);
        (0..60).for_each(|_| errors.correct(draft, &fine, &stripes(2, 200)));
        let (said, is) = (errors.predict(draft).expect("learnt"), rmse(&fine, &stripes(2, 200)));
        // What is old is left to 0.9^60 = 0.2 %.
        assert!((said / is - 1.0).abs() < 0.01, "as it is now: {said} for {is}");
        assert_eq!(errors.predict(high), before, "of a quality that is not like it that tells nothing");
    }

    #[test]
    fn what_another_quality_shows_is_converted() {
        let [draft, high] = [Preset::Draft, Preset::High].map(Preset::quality);
        let mut errors = ErrorModel::default();
        errors.learn(draft, &stripes(4, 255), &stripes(4, 240));
        errors.learn(high, &stripes(4, 128), &stripes(4, 125));
        let before = errors.predict(draft).expect("learnt");
        errors.saw(high, &stripes(4, 128));
        let after = errors.predict(draft).expect("learnt");
        assert!((after / before - 1.0).abs() < 1e-12, "the scene is the same: {before}, {after}");
    }

    #[test]
    fn odd_images_are_no_trouble() {
        let mut errors = ErrorModel::default();
        let quality = Preset::Draft.quality();
        errors.learn(quality, &Frame::default(), &Frame::default());
        errors.saw(quality, &Frame::default());
        assert_eq!(errors, ErrorModel::default(), "no image tells nothing");
        let dot = Frame { width: 1, height: 1, color: vec![9, 9, 9, 255], ..Frame::default() };
        errors.learn(quality, &dot, &dot);
        errors.saw(quality, &dot);
        assert_eq!(errors.predict(quality), Some(0.0), "right, and without detail");
    }
}
