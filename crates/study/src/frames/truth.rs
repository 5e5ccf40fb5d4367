//! The reference image: more samples than any quality has, at positions that none of them uses.

use super::{Case, Repeated};
use trigon_math::color::srgb8_to_linear;
use trigon_scene::quality::Preset;
use trigon_scene::{Frame, RenderError};

/// The light of each pixel of a case's image: the mean of the four pixels that `reference` draws
/// in its place at twice the size, 8×8 shaded places with 16 samples each.
///
/// The samples lie at odd sixteenths of a pixel. The samples of grids with 1, 2, 3 and 4 per row lie at
/// halves, quarters, sixths and eighths, which are never odd sixteenths.
pub struct Truth {
    size: [usize; 2],
    light: Vec<[f64; 3]>,
}

impl Truth {
    /// At the start of a case's flight.
    ///
    /// # Errors
    /// A size that cannot be drawn.
    pub fn new(case: Case, size: [u32; 2]) -> Result<Self, RenderError> {
        let mut drawn = Repeated::new(case, size.map(|side| 2 * side), Preset::Reference.quality());
        let frame = drawn.draw(0.0)?;
        let [width, height] = size.map(|side| side as usize);
        let mean = |pixel: usize| {
            let [x, y] = [2 * (pixel % width), 2 * (pixel / width)];
            let parts = [[x, y], [x + 1, y], [x, y + 1], [x + 1, y + 1]]
                .map(|[x, y]| light(frame, y * 2 * width + x));
            [0, 1, 2].map(|channel| parts.iter().map(|part| part[channel]).sum::<f64>() / 4.0)
        };
        Ok(Self { size: [width, height], light: (0..width * height).map(mean).collect() })
    }

    /// The root mean square difference of an image from it, in linear light, over red, green and blue.
    #[must_use]
    pub fn error(&self, frame: &Frame) -> f64 {
        assert_eq!(
            self.size,
            [frame.width as usize, frame.height as usize],
            "images of one size are compared"
        );
        let squares = self.light.iter().enumerate().map(|(pixel, right)| {
            let found = light(frame, pixel);
            (0..3)
                .map(|channel| (found[channel] - right[channel]) * (found[channel] - right[channel]))
                .sum::<f64>()
        });
        (squares.sum::<f64>() / (3 * self.light.len()) as f64).sqrt()
    }
}

/// Red, green and blue of a pixel in linear light.
fn light(frame: &Frame, pixel: usize) -> [f64; 3] {
    [0, 1, 2].map(|channel| srgb8_to_linear(frame.color[4 * pixel + channel]).into())
}
