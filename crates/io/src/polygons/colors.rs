//! Colours whose range only the whole file tells.

use trigon_math::{Vec3, Vec4};

use super::light_from_srgb;
use crate::warning::counted;

/// Colours as they are in a file: from 0 to 1, or to 255, or to 65535.
#[derive(Default)]
pub(crate) struct RawColors {
    colors: Vec<Vec4>,
    /// Whether alpha is there, in each.
    with_alpha: Vec<bool>,
    largest: f32,
    largest_alpha: f32,
}

impl RawColors {
    pub(crate) fn len(&self) -> usize {
        self.colors.len()
    }

    /// Adds what a row has of it: red, green, blue and perhaps alpha; fewer numbers are white.
    pub(crate) fn push(&mut self, numbers: &[f64]) {
        let channel = |at: usize| numbers.get(at).map(|&value| value as f32).filter(|value| !value.is_nan());
        let is_color = numbers.len() >= 3;
        let of = |at| if is_color { channel(at).unwrap_or(0.0) } else { f32::INFINITY };
        let color = Vec4::new(of(0), of(1), of(2), if is_color { channel(3).unwrap_or(0.0) } else { 0.0 });
        if is_color {
            self.largest = self.largest.max(color.truncate().max_element());
            self.largest_alpha = self.largest_alpha.max(color.w);
        }
        self.colors.push(color);
        self.with_alpha.push(is_color && numbers.len() > 3);
    }

    /// The number that stands for full light.
    pub(crate) fn full(&self) -> f32 {
        full(self.largest)
    }

    /// The alpha of what is opaque. An alpha of 1 beside colours to 255 is opaque, too.
    fn full_alpha(&self) -> f32 {
        if self.largest_alpha > 1.0 { full(self.largest_alpha).max(self.full()) } else { 1.0 }
    }

    /// The message if some are outside of their range, and are clamped.
    pub(crate) fn fault(&self) -> Option<String> {
        let (scale, alpha_scale) = (self.full(), self.full_alpha());
        let is_within = |value: f32, most: f32| (0.0..=most).contains(&value);
        let is_sound = |(color, &has_alpha): (&Vec4, &bool)| {
            let is_known = color.truncate() != Vec3::INFINITY;
            let channels = color.truncate().to_array();
            !is_known
                || channels.into_iter().all(|value| is_within(value, scale))
                    && (!has_alpha || is_within(color.w, alpha_scale))
        };
        let count = self.colors.iter().zip(&self.with_alpha).filter(|&color| !is_sound(color)).count();
        let (colors, are) = (counted(count, "colour"), if count == 1 { "is" } else { "are" });
        (count > 0).then(|| format!("{colors} {are} not between 0 and {scale}; what is outside is clamped"))
    }

    /// As linear light.
    pub(crate) fn finish(self) -> Vec<Vec4> {
        let (scale, alpha_scale) = (self.full(), self.full_alpha());
        let linear = |(color, &has_alpha): (&Vec4, &bool)| {
            let [red, green, blue] = (color.truncate() / scale).to_array();
            light_from_srgb([red, green, blue, if has_alpha { color.w / alpha_scale } else { 1.0 }])
        };
        self.colors.iter().zip(&self.with_alpha).map(linear).collect()
    }
}

/// What stands for 1, by the largest channel of a file.
fn full(largest: f32) -> f32 {
    /// Light may be somewhat brighter than white; a file whose largest byte is this dark would show nothing.
    const BRIGHTEST: f32 = 2.0;
    match largest {
        ..=BRIGHTEST => 1.0,
        ..=255.0 => 255.0,
        ..=65535.0 => 65535.0,
        // Not a colour at all; it is clamped.
        _ => 255.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn finished(rows: &[&[f64]]) -> (f32, Vec<[f32; 4]>) {
        let mut colors = RawColors::default();
        rows.iter().for_each(|row| colors.push(row));
        (colors.full(), colors.finish().iter().map(|color| color.to_array()).collect())
    }

    #[test]
    fn the_largest_channel_tells_the_range() {
        let (white, black) = ([1.0; 4], [0.0, 0.0, 0.0, 1.0]);
        assert_eq!(finished(&[&[1.0, 1.0, 1.0], &[0.0; 3]]), (1.0, vec![white, black]), "to 1");
        assert_eq!(finished(&[&[255.0; 3], &[0.0; 3]]), (255.0, vec![white, black]), "bytes");
        assert_eq!(finished(&[&[65535.0; 3], &[0.0; 3]]), (65535.0, vec![white, black]), "16 bits");
        assert_eq!(finished(&[&[1.2; 3], &[0.0; 3]]), (1.0, vec![white, black]), "brighter than white");
        assert_eq!(finished(&[&[f64::INFINITY; 3], &[]]).1[1], white, "what is no colour is white");
    }

    #[test]
    fn what_is_clamped_is_told() {
        let fault = |rows: &[&[f64]]| {
            let mut colors = RawColors::default();
            rows.iter().for_each(|row| colors.push(row));
            colors.fault()
        };
        for sound in
            [&[&[1.0, 0.0, 0.5][..], &[]][..], &[&[255.0, 0.0, 0.0, 1.0], &[0.0; 3]], &[&[65535.0; 3]]]
        {
            assert_eq!(fault(sound), None, "{sound:?}");
        }
        let told = |rows: &[&[f64]], what: &str| {
            let fault = fault(rows).expect("it is outside");
            assert!(fault.contains(what), "{rows:?}: {fault}");
        };
        told(&[&[1.2, 0.0, 0.0]], "not between 0 and 1;");
        told(&[&[-0.5, 0.0, 1.0], &[0.5; 3], &[-1.0; 3]], "2 colours");
        told(&[&[9.0, -0.5, 0.0]], "not between 0 and 255;");
        told(&[&[1e9, 0.0, 0.0]], "not between 0 and 255;");
        told(&[&[0.5, 0.5, 0.5, -1.0]], "not between 0 and 1;");
    }

    #[test]
    fn alpha_has_a_range_of_its_own() {
        let alpha = |rows: &[&[f64]]| finished(rows).1.iter().map(|color| color[3]).collect::<Vec<_>>();
        assert_eq!(alpha(&[&[255.0, 0.0, 0.0, 1.0], &[0.0, 9.0, 0.0, 0.5]]), [1.0, 0.5], "to 1");
        assert_eq!(alpha(&[&[255.0, 0.0, 0.0, 51.0], &[0.0, 9.0, 0.0, 255.0]]), [0.2, 1.0], "bytes");
        assert_eq!(alpha(&[&[1.0, 0.0, 0.0, 0.2], &[0.0, 1.0, 0.0]]), [0.2, 1.0], "none is opaque");
    }
}
