//! The cheat sheet: all rows in as many columns as it takes.

use super::block::{BACKDROP, INK};
use super::text::Font;
use crate::canvas::{Area, Canvas};
use crate::keymap::SheetRow;

/// Denser than behind other text: there is much to read.
const ALPHA: u8 = 215;

const KEYS: [u8; 3] = [255, 214, 120];

/// Letters between the keys and their description, and between columns.
const GAP: i32 = 2;

/// How the rows are laid out.
struct Layout {
    font: Font,
    rows: usize,
    columns: usize,
    keys_width: i32,
    column_width: i32,
}

impl Layout {
    fn new(rows: &[SheetRow], canvas: &Canvas, font: Font) -> Self {
        let widest =
            |text: fn(&SheetRow) -> &str| rows.iter().map(|r| font.width(text(r))).max().unwrap_or(0);
        let gap = GAP * font.letter_width();
        let keys_width = widest(|row| &row.keys) + gap;
        let column_width = keys_width + widest(|row| &row.description) + gap;
        let room = (canvas.height() - 2 * font.line_height()) / font.line_height();
        let per_column = usize::try_from(room).unwrap_or(0).clamp(1, rows.len().max(1));
        let columns = rows.len().div_ceil(per_column).max(1);
        // Equal columns rather than a full one and a rest.
        Self { font, rows: rows.len().div_ceil(columns), columns, keys_width, column_width }
    }

    fn width(&self) -> i32 {
        i32::try_from(self.columns).unwrap_or(i32::MAX).saturating_mul(self.column_width)
    }
}

/// Draws the sheet in the middle. In a window that is too small for it the font
/// shrinks to its smallest size, and what does not fit even then is cut off.
pub(crate) fn draw_sheet(canvas: &mut Canvas, font: Font, rows: &[SheetRow]) {
    let usual = Layout::new(rows, canvas, font);
    let layout = if usual.width() + 2 * font.letter_width() <= canvas.width() {
        usual
    } else {
        Layout::new(rows, canvas, Font::SMALLEST)
    };
    let font = layout.font;
    let pad = font.line_height() / 2;
    let height = layout.rows as i32 * font.line_height();
    let left = ((canvas.width() - layout.width()) / 2).max(pad);
    let top = ((canvas.height() - height) / 2).max(pad);
    let area = Area {
        x: left - pad,
        y: top - pad,
        width: layout.width().saturating_add(2 * pad),
        height: height + 2 * pad,
    };
    canvas.fill(area, BACKDROP, ALPHA);
    for (i, row) in rows.iter().enumerate() {
        let x = left + (i / layout.rows) as i32 * layout.column_width;
        let y = top + (i % layout.rows) as i32 * font.line_height();
        font.draw(canvas, (x, y), &row.keys, KEYS);
        font.draw(canvas, (x + layout.keys_width, y), &row.description, INK);
    }
}
