//! Letters onto a canvas: Noto Sans Mono, rasterized beforehand, so that
//! overlays look the same everywhere and need no font on the machine.

use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

use crate::canvas::{Area, Canvas};

/// Height of a line in logical pixels.
const LINE_HEIGHT: f64 = 16.0;

/// The heights that the font comes in.
const HEIGHTS: [RasterHeight; 4] =
    [RasterHeight::Size16, RasterHeight::Size20, RasterHeight::Size24, RasterHeight::Size32];

/// A size of the font. Sizes beyond the largest raster repeat its pixels.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Font {
    height: RasterHeight,
    zoom: i32,
}

impl Font {
    /// The smallest one.
    pub(crate) const SMALLEST: Self = Self { height: RasterHeight::Size16, zoom: 1 };

    /// The size that is nearest to the usual one at this many physical pixels
    /// per logical one.
    pub(crate) fn for_scale(scale: f64) -> Self {
        let wanted = LINE_HEIGHT * scale;
        let miss = |font: &Self| (f64::from(font.line_height()) - wanted).abs();
        // The first of equals: the one with the least repeating.
        Self::all().min_by(|a, b| miss(a).total_cmp(&miss(b))).unwrap_or(Self::SMALLEST)
    }

    /// This size, and those below it, from the largest down.
    pub(crate) fn and_smaller(self) -> impl Iterator<Item = Self> {
        let smaller = Self::all().filter(move |font| font.line_height() < self.line_height());
        let mut smaller: Vec<Self> = smaller.collect();
        smaller.sort_by_key(|font| std::cmp::Reverse(font.line_height()));
        std::iter::once(self).chain(smaller)
    }

    /// All sizes; some are as large as another one, with more repeating.
    fn all() -> impl Iterator<Item = Self> {
        const LARGEST_ZOOM: i32 = 8;
        (1..=LARGEST_ZOOM).flat_map(|zoom| HEIGHTS.map(|height| Self { height, zoom }))
    }

    /// From line to line, in pixels.
    pub(crate) fn line_height(self) -> i32 {
        self.height.val() as i32 * self.zoom
    }

    /// From letter to letter, in pixels.
    pub(crate) fn letter_width(self) -> i32 {
        get_raster_width(FontWeight::Regular, self.height) as i32 * self.zoom
    }

    /// Width of a line, in pixels.
    pub(crate) fn width(self, text: &str) -> i32 {
        i32::try_from(text.chars().count()).unwrap_or(i32::MAX).saturating_mul(self.letter_width())
    }

    /// The text, shortened to fit into this many pixels.
    pub(crate) fn shortened(self, text: &str, width: i32) -> String {
        let letters = usize::try_from(width / self.letter_width()).unwrap_or(0);
        if text.chars().count() <= letters {
            return text.to_owned();
        }
        let kept = text.chars().take(letters.saturating_sub(3));
        kept.chain(std::iter::repeat_n('.', letters.min(3))).collect()
    }

    /// Writes a line with its upper left corner at (x, y).
    pub(crate) fn draw(self, canvas: &mut Canvas, (x, y): (i32, i32), text: &str, color: [u8; 3]) {
        for (letter, left) in text.chars().zip((x..).step_by(self.letter_width() as usize)) {
            match get_raster(letter, FontWeight::Regular, self.height) {
                Some(glyph) => self.draw_glyph(canvas, (left, y), glyph.raster(), color),
                None => self.draw_missing(canvas, (left, y), color),
            }
        }
    }

    fn draw_glyph(self, canvas: &mut Canvas, (x, y): (i32, i32), rows: &[&[u8]], color: [u8; 3]) {
        for (row, top) in rows.iter().zip((y..).step_by(self.zoom as usize)) {
            for (&coverage, left) in row.iter().zip((x..).step_by(self.zoom as usize)) {
                if coverage > 0 {
                    let dot = Area { x: left, y: top, width: self.zoom, height: self.zoom };
                    canvas.fill(dot, color, coverage);
                }
            }
        }
    }

    /// A hollow box for letters that the font lacks.
    fn draw_missing(self, canvas: &mut Canvas, (x, y): (i32, i32), color: [u8; 3]) {
        let (width, height) = (self.letter_width() - 2 * self.zoom, self.line_height() / 2);
        let (left, top) = (x + self.zoom, y + self.line_height() / 4);
        for (dx, dy, w, h) in [
            (0, 0, width, self.zoom),
            (0, height - self.zoom, width, self.zoom),
            (0, 0, self.zoom, height),
            (width - self.zoom, 0, self.zoom, height),
        ] {
            canvas.fill(Area { x: left + dx, y: top + dy, width: w, height: h }, color, 255);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_font_grows_with_the_display() {
        for (scale, height) in [(1.0, 16), (1.25, 20), (1.5, 24), (2.0, 32), (2.5, 40), (3.0, 48), (0.1, 16)]
        {
            assert_eq!(Font::for_scale(scale).line_height(), height, "at scale {scale}");
        }
        let absurd = Font::for_scale(f64::NAN).line_height();
        assert!((16..=256).contains(&absurd), "any scale has a font: {absurd}");
    }

    #[test]
    fn long_lines_are_shortened() {
        let font = Font::SMALLEST;
        let width = font.width("0123456789");
        assert_eq!(font.shortened("0123456789", width), "0123456789", "fits");
        assert_eq!(font.shortened("0123456789a", width), "0123456...", "does not");
        assert_eq!(font.shortened("0123456789a", 0), "", "nothing fits into nothing");
    }
}
