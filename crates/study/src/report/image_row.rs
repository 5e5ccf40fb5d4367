//! Images side by side.

use image::RgbImage;
use image::codecs::png::PngEncoder;
use std::fs::File;
use std::io::{self, BufWriter};
use std::path::Path;
use trigon_classic::Field;

/// Some images of the same size next to each other.
pub(super) struct ImageRow {
    name: &'static str,
    pub(super) caption: String,
    pub(super) panels: Vec<Field<[u8; 3]>>,
}

impl ImageRow {
    /// Images from left to right.
    pub(super) fn new(name: &'static str, caption: impl Into<String>, panels: Vec<Field<[u8; 3]>>) -> Self {
        Self { name, caption: caption.into(), panels }
    }

    pub(super) fn file(&self, chapter: &str) -> String {
        format!("accuracy-{chapter}-{}.png", self.name)
    }

    pub(super) fn write(&self, path: &Path) -> io::Result<()> {
        // Not `save`, which chooses by the file's name and so compiles every encoder.
        let file = BufWriter::new(File::create(path)?);
        self.composed().write_with_encoder(PngEncoder::new(file)).map_err(io::Error::other)
    }

    /// Small pixels are shown large: panels are enlarged to about 256 pixels.
    fn composed(&self) -> RgbImage {
        const GAP: u32 = 8;
        let [width, height] = self.panels[0].size();
        let zoom = (256 / width).max(1);
        let [wide, high] = [width, height].map(|side| (side * zoom) as u32);
        let count = self.panels.len() as u32;
        RgbImage::from_fn(count * (wide + GAP) - GAP, high, |x, y| {
            let (panel, column) = (x / (wide + GAP), x % (wide + GAP));
            let place = [column, y].map(|part| part as usize / zoom);
            image::Rgb(if column < wide { self.panels[panel as usize][place] } else { [255; 3] })
        })
    }
}

/// Grey values, 0 to 1 of linear light, as bytes.
pub(super) fn grey(light: f64) -> [u8; 3] {
    [trigon_math::color::linear_to_srgb8(light as f32); 3]
}

/// How wrong something is, from black over red and yellow to white, 1 and above.
pub(super) fn heat(error: f64) -> [u8; 3] {
    [0.0, 1.0, 2.0].map(|start| ((error * 3.0 - start).clamp(0.0, 1.0) * 255.0) as u8)
}

/// A colour for a number, to tell neighbours apart.
pub(super) fn tint(number: u32) -> [u8; 3] {
    let bits = u64::from(number).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    [16, 32, 48].map(|shift| 64 + (bits >> shift & 0x7f) as u8)
}

/// The faces of an image in colours; nothing is dark.
pub(super) fn tinted(faces: &Field<u32>) -> Field<[u8; 3]> {
    faces.map(|&face| if face == u32::MAX { [24; 3] } else { tint(face) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_are_side_by_side_and_enlarged() {
        let panel = |red: u8| Field::from_fn([100, 3], |[x, y]| [red, x as u8, y as u8]);
        let row = ImageRow::new("name", "caption", vec![panel(1), panel(2), panel(3)]);
        let image = row.composed();
        // Twice 100 is the most that is at most 256; the gaps are 8 wide.
        assert_eq!(image.dimensions(), (3 * 200 + 2 * 8, 6));
        for (x, y, color) in image.enumerate_pixels() {
            let (number, column) = (x / 208, x % 208);
            let expected =
                if column < 200 { [number as u8 + 1, (column / 2) as u8, (y / 2) as u8] } else { [255; 3] };
            assert_eq!(color.0, expected, "{x}, {y}");
        }
        assert_eq!(row.file("line"), "accuracy-line-name.png");
        let large = ImageRow::new("name", "caption", vec![Field::new([300, 2], [0; 3])]);
        assert_eq!(large.composed().dimensions(), (300, 2), "large pixels are left as they are");
    }

    #[test]
    fn heat_runs_from_black_over_red_and_yellow_to_white() {
        let found = [-1.0, 0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0, 7.0].map(heat);
        assert_eq!(
            found,
            [[0; 3], [0; 3], [255, 0, 0], [255, 255, 0], [255; 3], [255; 3]],
            "each third is a channel"
        );
        assert_eq!(heat(0.5), [255, 127, 0], "half of the second");
    }

    #[test]
    fn greys_are_bytes_of_srgb() {
        assert_eq!([0.0, 0.5, 1.0].map(grey), [[0; 3], [188; 3], [255; 3]]);
    }

    #[test]
    fn neighbours_have_different_colours_and_none_is_dark() {
        for number in 0..2000 {
            let [one, next] = [number, number + 1].map(tint);
            assert!(one.iter().all(|channel| (64..192).contains(channel)), "{one:?}");
            let differs: u32 = one.iter().zip(next).map(|(a, b)| u32::from(a.abs_diff(b))).sum();
            assert!(differs > 20, "{number}: {one:?} and {next:?}");
        }
        let faces = Field::from_fn([2, 1], |[x, _]| if x == 0 { u32::MAX } else { 5 });
        assert_eq!(tinted(&faces).values(), [[24; 3], tint(5)], "nothing is dark");
    }
}
