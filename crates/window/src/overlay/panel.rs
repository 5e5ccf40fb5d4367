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

/// A run of rows, one below the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Column<'a> {
    rows: &'a [SheetRow],
    keys_width: i32,
    width: i32,
}

impl<'a> Column<'a> {
    fn new(rows: &'a [SheetRow], font: Font) -> Self {
        let widest =
            |text: fn(&SheetRow) -> &str| rows.iter().map(|r| font.width(text(r))).max().unwrap_or(0);
        let keys_width = widest(|row| &row.keys) + GAP * font.letter_width();
        Self { rows, keys_width, width: keys_width + widest(|row| &row.description) }
    }
}

/// How the rows are laid out.
#[derive(Debug)]
struct Layout<'a> {
    font: Font,
    columns: Vec<Column<'a>>,
    /// Rows that have no place.
    hidden: usize,
}

impl<'a> Layout<'a> {
    /// As large as it fits, up to the usual font. In a window that is too small
    /// even for the smallest one, the rows that come first.
    fn new(rows: &'a [SheetRow], canvas: &Canvas, usual: Font) -> Self {
        let mut fonts = usual.and_smaller();
        fonts.find_map(|font| Self::whole(rows, canvas, font)).unwrap_or_else(|| Self::part(rows, canvas))
    }

    /// All rows, if they fit.
    fn whole(rows: &'a [SheetRow], canvas: &Canvas, font: Font) -> Option<Self> {
        let columns = rows.len().div_ceil(lines(canvas, font));
        // Equal columns rather than a full one and a rest.
        let length = rows.len().div_ceil(columns.max(1)).max(1);
        let columns = rows.chunks(length).map(|rows| Column::new(rows, font)).collect();
        let layout = Self { font, columns, hidden: 0 };
        (layout.width() <= room(canvas, font)).then_some(layout)
    }

    /// One column of the smallest font, which leaves a line to say how many
    /// rows are missing.
    fn part(rows: &'a [SheetRow], canvas: &Canvas) -> Self {
        let font = Font::SMALLEST;
        let lines = lines(canvas, font);
        let shown = if rows.len() > lines { lines - 1 } else { rows.len() };
        let column = Column::new(&rows[..shown], font);
        Self { font, columns: vec![column], hidden: rows.len() - shown }
    }

    fn gaps(&self) -> i32 {
        let gaps = i32::try_from(self.columns.len()).unwrap_or(i32::MAX).saturating_sub(1);
        gaps.max(0).saturating_mul(GAP * self.font.letter_width())
    }

    fn width(&self) -> i32 {
        self.columns.iter().fold(self.gaps(), |sum, column| sum.saturating_add(column.width))
    }

    fn height(&self) -> i32 {
        let longest = self.columns.iter().map(|column| column.rows.len()).max().unwrap_or(0);
        let lines = longest + usize::from(self.hidden > 0);
        i32::try_from(lines).unwrap_or(i32::MAX).saturating_mul(self.font.line_height())
    }
}

/// How many lines have room, at least one.
fn lines(canvas: &Canvas, font: Font) -> usize {
    let lines = (canvas.height() - 2 * font.line_height()) / font.line_height();
    usize::try_from(lines).unwrap_or(0).max(1)
}

/// How wide the sheet may be.
fn room(canvas: &Canvas, font: Font) -> i32 {
    canvas.width() - 2 * padding(font)
}

fn padding(font: Font) -> i32 {
    font.line_height() / 2
}

/// Draws the sheet in the middle. In a window that is too small for it the font
/// shrinks; what does not fit even then is counted.
pub(crate) fn draw_sheet(canvas: &mut Canvas, font: Font, rows: &[SheetRow]) {
    let layout = Layout::new(rows, canvas, font);
    let (font, pad, room) = (layout.font, padding(layout.font), room(canvas, layout.font));
    let (width, height) = (layout.width().min(room), layout.height());
    let left = ((canvas.width() - width) / 2).max(pad);
    let top = ((canvas.height() - height) / 2).max(pad);
    let area = Area { x: left - pad, y: top - pad, width: width + 2 * pad, height: height + 2 * pad };
    canvas.fill(area, BACKDROP, ALPHA);
    let mut x = left;
    for column in &layout.columns {
        draw_column(canvas, font, column, (x, top), left + width);
        x += column.width + GAP * font.letter_width();
    }
    if layout.hidden > 0 {
        let text = font.shortened(&missing(layout.hidden), width);
        font.draw(canvas, (left, top + height - font.line_height()), &text, KEYS);
    }
}

/// Draws a column from (x, y) on; what reaches beyond `right` is shortened.
fn draw_column(canvas: &mut Canvas, font: Font, column: &Column<'_>, (x, y): (i32, i32), right: i32) {
    let descriptions = x + column.keys_width;
    for (row, y) in column.rows.iter().zip((y..).step_by(font.line_height() as usize)) {
        font.draw(canvas, (x, y), &font.shortened(&row.keys, right - x), KEYS);
        let description = font.shortened(&row.description, right - descriptions);
        font.draw(canvas, (descriptions, y), &description, INK);
    }
}

fn missing(rows: usize) -> String {
    format!("{rows} more: enlarge the window")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keymap::{Keymap, sheet};

    /// The sheet said nothing of rows that a small window had no place for.
    #[test]
    fn small_windows_say_how_much_of_the_sheet_is_missing() {
        let rows = sheet(&Keymap::default());
        let canvas = Canvas::white(300, 200);
        let layout = Layout::new(&rows, &canvas, Font::for_scale(1.0));
        let shown: usize = layout.columns.iter().map(|column| column.rows.len()).sum();
        assert!(layout.hidden > 0, "it is too small for {} rows", rows.len());
        assert_eq!(shown + layout.hidden, rows.len(), "every row is shown or counted");
        assert!(layout.height() <= canvas.height(), "the count itself is in the picture");
    }

    /// On dense displays the sheet fell to the smallest font, half as high as
    /// all other text, when the usual one was a little too wide.
    #[test]
    fn the_sheet_shrinks_no_further_than_it_must() {
        let rows = sheet(&Keymap::default());
        for (scale, width, height) in [(1.0, 1000, 600), (1.5, 1500, 900), (2.0, 2000, 1200)] {
            let layout = Layout::new(&rows, &Canvas::white(width, height), Font::for_scale(scale));
            let size = f64::from(layout.font.line_height()) / scale;
            assert!(size >= 12.0, "{size} logical pixels at scale {scale}");
            assert_eq!(layout.hidden, 0, "all rows at scale {scale}");
        }
    }

    #[test]
    fn tiny_windows_and_empty_sheets_are_no_problem() {
        let rows = sheet(&Keymap::default());
        for (width, height) in [(1, 1), (3, 200), (200, 3)] {
            let mut canvas = Canvas::white(width, height);
            draw_sheet(&mut canvas, Font::for_scale(3.0), &rows);
            draw_sheet(&mut canvas, Font::SMALLEST, &[]);
        }
    }
}
