//! Lines of text on a translucent backdrop, in a corner.

use super::text::Font;
use crate::canvas::{Area, Canvas};

/// Where text goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Corner {
    /// Above, on the left.
    TopLeft,
    /// Above, in the middle.
    Top,
    /// Above, on the right.
    TopRight,
    /// Below, on the left; messages are written above it.
    BottomLeft,
    /// Below, on the right.
    BottomRight,
}

impl Corner {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::TopLeft, Self::Top, Self::TopRight, Self::BottomLeft, Self::BottomRight];

    /// Where a rectangle of this size goes, `gap` from the edges.
    pub(crate) fn place(self, (width, height): (i32, i32), canvas: &Canvas, gap: i32) -> Area {
        let x = match self {
            Self::TopLeft | Self::BottomLeft => gap,
            Self::Top => (canvas.width() - width) / 2,
            Self::TopRight | Self::BottomRight => canvas.width() - width - gap,
        };
        let y = match self {
            Self::TopLeft | Self::Top | Self::TopRight => gap,
            Self::BottomLeft | Self::BottomRight => canvas.height() - height - gap,
        };
        Area { x, y, width, height }
    }
}

/// Text that is to be drawn.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Block<'a> {
    pub(crate) corner: Corner,
    pub(crate) lines: &'a [String],
}

/// White on a dark backdrop is readable on any picture.
pub(crate) const INK: [u8; 3] = [240, 240, 240];
pub(crate) const BACKDROP: [u8; 3] = [16, 18, 22];
pub(crate) const BACKDROP_ALPHA: u8 = 170;

/// Draws a block; nothing if it has no lines. Lines that are too long for the
/// canvas are shortened.
pub(crate) fn draw_block(canvas: &mut Canvas, font: Font, block: Block<'_>) {
    if block.lines.is_empty() {
        return;
    }
    let pad = font.letter_width();
    let room = canvas.width() - 4 * pad;
    let lines: Vec<String> = block.lines.iter().map(|line| font.shortened(line, room)).collect();
    let width = lines.iter().map(|line| font.width(line)).max().unwrap_or(0) + 2 * pad;
    let count = i32::try_from(lines.len()).unwrap_or(i32::MAX);
    let height = count.saturating_mul(font.line_height()).saturating_add(pad);
    let area = block.corner.place((width, height), canvas, pad);
    canvas.fill(area, BACKDROP, BACKDROP_ALPHA);
    for (line, y) in lines.iter().zip((area.y + pad / 2..).step_by(font.line_height() as usize)) {
        font.draw(canvas, (area.x + pad, y), line, INK);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Columns and rows that differ from the white canvas: (left, right, top, bottom).
    fn touched(canvas: &Canvas) -> Option<(usize, usize, usize, usize)> {
        let width = canvas.width() as usize;
        let changed = canvas.pixels().iter().enumerate().filter(|&(_, &p)| p != 0x00ff_ffff);
        changed.map(|(i, _)| (i % width, i / width)).fold(None, |all, (x, y)| {
            let (l, r, t, b) = all.unwrap_or((x, x, y, y));
            Some((l.min(x), r.max(x), t.min(y), b.max(y)))
        })
    }

    #[test]
    fn blocks_stand_in_their_corners() {
        let lines = ["ab".to_owned(), "c".to_owned()];
        for (corner, left, top) in [
            (Corner::TopLeft, true, true),
            (Corner::TopRight, false, true),
            (Corner::BottomLeft, true, false),
            (Corner::BottomRight, false, false),
        ] {
            let mut canvas = Canvas::white(200, 100);
            draw_block(&mut canvas, Font::SMALLEST, Block { corner, lines: &lines });
            let (l, r, t, b) = touched(&canvas).expect("something was drawn");
            // Two letters and a letter's width on either side, 7 px each; two lines.
            assert_eq!((r - l + 1, b - t + 1), (28, 39), "{corner:?}: the backdrop's size");
            assert_eq!((l == 7, r == 192), (left, !left), "{corner:?}: {l}..{r}");
            assert_eq!((t == 7, b == 92), (top, !top), "{corner:?}: {t}..{b}");
        }
    }

    #[test]
    fn text_is_legible_on_white() {
        let mut canvas = Canvas::white(100, 40);
        draw_block(&mut canvas, Font::SMALLEST, Block { corner: Corner::Top, lines: &["H".to_owned()] });
        let brightness = |pixel: &u32| pixel & 0xff;
        let inside: Vec<u32> = canvas.pixels().iter().map(brightness).filter(|&b| b < 255).collect();
        let (dark, light) = (inside.iter().min().expect("backdrop"), inside.iter().max().expect("ink"));
        assert!(light - dark > 120, "ink {light} on backdrop {dark}");
    }

    #[test]
    fn tiny_windows_are_no_problem() {
        for (width, height) in [(1, 1), (3, 200), (200, 3)] {
            let mut canvas = Canvas::white(width, height);
            for corner in Corner::ALL {
                let lines = ["a long line that cannot fit".to_owned()];
                draw_block(&mut canvas, Font::for_scale(3.0), Block { corner, lines: &lines });
            }
        }
    }
}
