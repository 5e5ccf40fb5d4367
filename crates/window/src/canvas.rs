//! The pixels of the window: the scene's image with the interface over it. Opaque, 8-bit sRGB, in
//! the order that windows have in memory.

use std::ops::Range;
use std::sync::{Arc, Weak};

use rayon::prelude::*;
use trigon_camera::Viewport;
use trigon_raster::paint2d::Rect;
use trigon_scene::Frame;

use crate::egui_painter::{ChannelOrder, EguiPainter};
use crate::panes::Area;
use crate::refinement;
use crate::worker::Redrawn;

/// Shown before the first image: dark, so as not to dazzle.
const EMPTY: [u8; 4] = [24, 24, 24, 255];

/// Rows from the top, without padding; blue, green, red, and an unused alpha.
#[derive(Debug, Default)]
pub(crate) struct Canvas {
    size: [u32; 2],
    /// The scene's image alone.
    beneath: Vec<[u8; 4]>,
    pixels: Vec<[u8; 4]>,
    painted: Vec<Rect>,
    /// The frame whose pixels lie beneath the interface, if each is one of the canvas.
    frame: Weak<Frame>,
    /// Where it lies.
    area: Option<Area>,
}

/// An image of the scene in a window.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed<'f> {
    pub(crate) frame: Option<&'f Arc<Frame>>,
    /// How it may differ from the one before, if that is known.
    pub(crate) redrawn: Option<&'f Redrawn>,
    /// The part of the window that it fills.
    pub(crate) area: Area,
}

impl Canvas {
    /// Takes this size and puts the frame's colours under the interface; calls `changed` with each
    /// part that differs from what was there. A frame of another size than its part of the window, as drafts are, is
    /// stretched bilinearly; transparent parts become black. Beside it, and without a frame, it is dark. If it is
    /// known in which parts the frame may differ from the one that was there, only these are compared.
    pub(crate) fn show(&mut self, placed: Placed<'_>, size: [u32; 2], mut changed: impl FnMut(Rect)) {
        let area = placed.area.within(Viewport { width: size[0], height: size[1] });
        let is_empty = area.size.width == 0 || area.size.height == 0;
        let frame = placed.frame.filter(|frame| !frame.color.is_empty() && !is_empty);
        let own = frame.filter(|frame| [frame.width, frame.height] == [area.size.width, area.size.height]);
        let before = std::mem::replace(&mut self.frame, own.map_or_else(Weak::new, Arc::downgrade));
        let parts = placed.redrawn.zip(own).and_then(|(redrawn, own)| redrawn.between(&before, own));
        let parts = parts.filter(|_| self.size == size && self.area == Some(area));
        (self.size, self.area) = (size, Some(area));
        let count = size[0] as usize * size[1] as usize;
        self.pixels.resize(count, EMPTY);
        self.beneath.resize(count, EMPTY);
        let size = size.map(|side| side as usize);
        let band = size[0].max(1) * BAND;
        let differing: Vec<Vec<Rect>> = match (parts, own) {
            (Some(parts), Some(frame)) => {
                let bands = self.beneath.par_chunks_mut(band).enumerate();
                let show = |(band, shown): (usize, &mut [_])| {
                    show_parts(band * BAND, shown, size[0], Own { frame, area }, parts)
                };
                bands.map(show).collect()
            }
            _ => {
                let columns = frame.and_then(|frame| source_columns(frame, area.size));
                let rows = || Rows::new(frame.map(Arc::as_ref), size[0], area, columns.as_deref());
                let bands = self.beneath.par_chunks_mut(band).enumerate();
                bands.map(|(band, shown)| show_band(band * BAND, shown, rows())).collect()
            }
        };
        differing.into_iter().flatten().for_each(&mut changed);
    }

    /// Brings the pixels up to date with the interface. Returns whether any changed.
    pub(crate) fn paint(&mut self, painter: &mut EguiPainter) -> bool {
        let painted = painter.paint(self.size, &mut self.pixels, &self.beneath);
        // A window larger than the painter's limit keeps its pixels.
        self.painted = painted.unwrap_or_default();
        !self.painted.is_empty()
    }

    /// Width and height.
    pub(crate) fn size(&self) -> [u32; 2] {
        self.size
    }

    /// All pixels, row by row.
    pub(crate) fn pixels(&self) -> &[[u8; 4]] {
        &self.pixels
    }

    /// The area that the last [`paint`](Self::paint) changed.
    pub(crate) fn painted(&self) -> &[Rect] {
        &self.painted
    }
}

/// Rows that a thread takes at a time.
const BAND: usize = 32;

/// Puts rows of a frame into those of the window from `top` on. The parts that differ from what was there.
fn show_band(top: usize, shown: &mut [[u8; 4]], mut rows: Rows<'_>) -> Vec<Rect> {
    let mut parts = Vec::new();
    for (shown, y) in shown.chunks_exact_mut(rows.width).zip(top..) {
        let row = rows.row(y);
        for columns in differing(shown, row) {
            shown[columns.clone()].copy_from_slice(&row[columns.clone()]);
            let [left, right] = [columns.start as i32, columns.end as i32];
            parts.push(Rect::new([left, y as i32], [right, y as i32 + 1]));
        }
    }
    parts
}

/// A frame of the size of its part of the window.
#[derive(Clone, Copy)]
struct Own<'f> {
    frame: &'f Frame,
    area: Area,
}

/// The same, of a frame of the size of its part of the window, in those parts of its rows alone.
fn show_parts(
    top: usize,
    shown: &mut [[u8; 4]],
    width: usize,
    Own { frame, area }: Own<'_>,
    parts: &[Rect],
) -> Vec<Rect> {
    let rows = top as i32..(top + shown.len() / width) as i32;
    let [left, above] = area.min.map(|side| side as i32);
    let (colors, mut differing_parts, mut row) =
        (frame.color.as_chunks().0, Vec::new(), vec![EMPTY; frame.width as usize]);
    for part in parts {
        for y in (part.min[1] + above).max(rows.start)..(part.max[1] + above).min(rows.end) {
            let columns = part.min[0] as usize..part.max[0] as usize;
            let of_frame = (y - above) as usize * frame.width as usize;
            let of_window = (y - rows.start) as usize * width + left as usize;
            let shown = &mut shown[of_window + columns.start..of_window + columns.end];
            let row = &mut row[..columns.len()];
            over_black(&colors[of_frame + columns.start..of_frame + columns.end], row);
            for columns in differing(shown, row) {
                shown[columns.clone()].copy_from_slice(&row[columns.clone()]);
                let [from, to] = [columns.start, columns.end].map(|x| left + part.min[0] + x as i32);
                differing_parts.push(Rect::new([from, y], [to, y + 1]));
            }
        }
    }
    differing_parts
}

/// Pixels of a row that are compared at a time.
const PIECE: usize = 64;

/// The columns in which two rows of one length differ, in pieces.
fn differing(a: &[[u8; 4]], b: &[[u8; 4]]) -> Vec<Range<usize>> {
    let mut ranges: Vec<Range<usize>> = Vec::new();
    for (piece, (a_piece, b_piece)) in a.chunks(PIECE).zip(b.chunks(PIECE)).enumerate() {
        if a_piece == b_piece {
            continue;
        }
        let (start, end) = (piece * PIECE, piece * PIECE + a_piece.len());
        match ranges.last_mut() {
            Some(last) if last.end == start => last.end = end,
            _ => ranges.push(start..end),
        }
    }
    ranges
}

/// The rows of a window with a frame in a part of it, from the top.
struct Rows<'f> {
    frame: Option<&'f Frame>,
    width: usize,
    area: Area,
    /// For each column of the part what it shows, if the frame has another size.
    columns: Option<&'f [Blend]>,
    /// A row above or below the frame.
    beside: Vec<[u8; 4]>,
    /// The last row.
    row: Vec<[u8; 4]>,
    /// The frame's rows around it, as wide as the part, with their numbers.
    around: [Stretched; 2],
}

/// A row of a frame, as wide as an image.
#[derive(Default)]
struct Stretched {
    number: Option<usize>,
    /// As the frame has it, over black.
    opaque: Vec<[u8; 4]>,
    /// In 1/256 levels.
    pixels: Vec<[u16; 4]>,
}

impl<'f> Rows<'f> {
    fn new(frame: Option<&'f Frame>, width: usize, area: Area, columns: Option<&'f [Blend]>) -> Self {
        Self {
            frame,
            width,
            area,
            columns,
            beside: vec![EMPTY; width],
            row: vec![EMPTY; width],
            around: [(); 2].map(|()| Stretched::default()),
        }
    }

    fn row(&mut self, y: usize) -> &[[u8; 4]] {
        let Area { min, size } = self.area;
        let (height, left) = (size.height as usize, min[0] as usize);
        let y = y.checked_sub(min[1] as usize).filter(|&y| y < height);
        let Some((frame, y)) = self.frame.zip(y) else { return &self.beside };
        let width = frame.width as usize;
        let source = |y: usize| &frame.color.as_chunks::<4>().0[y * width..][..width];
        let part = &mut self.row[left..left + size.width as usize];
        let Some(columns) = self.columns else {
            over_black(source(y), part);
            return &self.row;
        };
        let Blend { pair, share } = Blend::at(y, height, frame.height as usize);
        if self.around[0].number != Some(pair[0]) {
            // Going down, the lower one mostly becomes the upper one.
            self.around.swap(0, 1);
        }
        for (stretched, number) in self.around.iter_mut().zip(pair) {
            if stretched.number != Some(number) {
                stretched.fill(source(number), columns);
                stretched.number = Some(number);
            }
        }
        let [upper, lower] = &self.around;
        blend_rows(part, [&upper.pixels, &lower.pixels], share);
        &self.row
    }
}

impl Stretched {
    fn fill(&mut self, source: &[[u8; 4]], columns: &[Blend]) {
        let Self { opaque, pixels, .. } = self;
        opaque.resize(source.len(), EMPTY);
        over_black(source, opaque);
        pixels.clear();
        pixels.extend(columns.iter().map(|Blend { pair, share }| {
            let [left, right] = pair.map(|column| opaque[column].map(u16::from));
            std::array::from_fn(|channel| left[channel] * (256 - share) + right[channel] * share)
        }));
    }
}

/// A row between two others.
fn blend_rows(row: &mut [[u8; 4]], [upper, lower]: [&[[u16; 4]]; 2], share: u16) {
    let share = u32::from(share);
    let channels = upper.as_flattened().iter().zip(lower.as_flattened());
    for (to, (&upper, &lower)) in row.as_flattened_mut().iter_mut().zip(channels) {
        let sum = u32::from(upper) * (256 - share) + u32::from(lower) * share;
        *to = ((sum + (1 << 15)) >> 16) as u8;
    }
}

/// Two neighbouring columns or rows of a frame, and how much of the second one a column or row of an image
/// shows, in 1/256: the middles of pixels are interpolated, as an image between drafts should have no blocks. Only with
/// integers, so that it has the same bytes everywhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Blend {
    pair: [usize; 2],
    share: u16,
}

impl Blend {
    /// What one of `to` columns or rows shows of the `from` ones of a frame.
    fn at(at: usize, to: usize, from: usize) -> Self {
        // From the middle of the first pixel, in half pixels of the image.
        let whole = 2 * to;
        let position = ((2 * at + 1) * from).saturating_sub(to).min(whole * (from - 1));
        let (first, rest) = (position / whole, position % whole);
        Self { pair: [first, (first + 1).min(from - 1)], share: ((256 * rest + to) / whole) as u16 }
    }
}

/// What each column of an image of some size shows of a frame, unless they are of one size.
fn source_columns(frame: &Frame, size: Viewport) -> Option<Vec<Blend>> {
    let (width, across) = (size.width as usize, frame.width as usize);
    let is_same = [frame.width, frame.height] == [size.width, size.height];
    (!is_same).then(|| (0..width).map(|x| Blend::at(x, width, across)).collect())
}

/// From straight alpha to opaque pixels over black, as windows have them.
fn over_black(from: &[[u8; 4]], to: &mut [[u8; 4]]) {
    // Nearly all rows are opaque. The compiler vectorizes this loop, but not the one below.
    if from.iter().fold(255, |alpha, rgba| alpha & rgba[3]) == 255 {
        to.iter_mut().zip(from).for_each(|(to, &rgba)| *to = ChannelOrder::Bgra.arrange(rgba));
        return;
    }
    for (to, &rgba) in to.iter_mut().zip(from) {
        let [r, g, b] = refinement::over_black(rgba);
        *to = ChannelOrder::Bgra.arrange([r, g, b, 255]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(width: u32, height: u32, color: Vec<u8>) -> Arc<Frame> {
        Arc::new(Frame { width, height, color, ..Frame::default() })
    }

    /// In all of a window.
    fn whole<'f>(
        frame: Option<&'f Arc<Frame>>,
        redrawn: Option<&'f Redrawn>,
        [width, height]: [u32; 2],
    ) -> Placed<'f> {
        Placed { frame, redrawn, area: Area { min: [0, 0], size: Viewport { width, height } } }
    }

    fn shown(frame: Option<&Arc<Frame>>, size: [u32; 2]) -> Vec<[u8; 4]> {
        let mut canvas = Canvas::default();
        let mut painter = EguiPainter::new(ChannelOrder::Bgra);
        canvas.show(whole(frame, None, size), size, |part| painter.invalidate_part(part));
        assert!(canvas.paint(&mut painter), "all of it is new");
        assert!(!canvas.paint(&mut painter), "and then nothing");
        canvas.pixels().to_vec()
    }

    /// Drafts were enlarged to blocks.
    #[test]
    fn a_smaller_frame_is_magnified_smoothly() {
        let frame = frame(2, 1, vec![255, 0, 0, 255, 0, 0, 255, 255]);
        let [red, blue] = [[0, 0, 255, 255], [255, 0, 0, 255]];
        // The middles of the pixels lie at 1 and 3 of 4.
        let row = [red, [64, 0, 191, 255], [191, 0, 64, 255], blue];
        assert_eq!(shown(Some(&frame), [4, 2]), [row, row].concat(), "quarters of the way");
        assert_eq!(shown(Some(&frame), [3, 1])[1], [128, 0, 128, 255], "a size that does not divide");
    }

    #[test]
    fn every_pixel_of_a_stretched_frame_is_the_bilinear_mean_of_its_neighbours() {
        let (width, height) = (7, 5);
        let color: Vec<u8> =
            (0..4 * width * height).map(|i| if i % 4 == 3 { 255 } else { (i * 67 % 256) as u8 }).collect();
        let small = frame(width, height, color.clone());
        for size in [[16, 11], [7, 9], [64, 5], [3, 2], [1, 1]] {
            let found = shown(Some(&small), size);
            let at = |pixel: u32, to: u32, from: u32| {
                let position = (f64::from(pixel) + 0.5) * f64::from(from) / f64::from(to) - 0.5;
                let position = position.clamp(0.0, f64::from(from - 1));
                (position.floor() as usize, position.fract())
            };
            for y in 0..size[1] {
                for x in 0..size[0] {
                    let ((column, right), (row, below)) = (at(x, size[0], width), at(y, size[1], height));
                    let value = |dx: usize, dy: usize, channel: usize| {
                        let (x, y) =
                            ((column + dx).min(width as usize - 1), (row + dy).min(height as usize - 1));
                        f64::from(color[4 * (y * width as usize + x) + channel])
                    };
                    for channel in 0..3 {
                        let upper = value(0, 0, channel) * (1.0 - right) + value(1, 0, channel) * right;
                        let lower = value(0, 1, channel) * (1.0 - right) + value(1, 1, channel) * right;
                        let expected = upper * (1.0 - below) + lower * below;
                        // Shares are rounded to 1/256.
                        let shown = f64::from(found[(y * size[0] + x) as usize][2 - channel]);
                        assert!(
                            (shown - expected).abs() < 1.6,
                            "{shown} for {expected} at {x}, {y} of {size:?}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn beside_its_part_of_the_window_a_frame_shows_nothing() {
        let color = |seed: usize| -> Vec<u8> {
            (0..4 * 90 * 40).map(|i| if i % 4 == 3 { 255 } else { ((i + seed) * 67 % 256) as u8 }).collect()
        };
        let (size, part) = ([120, 50], Viewport { width: 90, height: 40 });
        let area = Area { min: [20, 7], size: part };
        let first = frame(90, 40, color(0));
        let mut second = color(0);
        second[4 * (3 * 90 + 5)] = 1;
        let second = frame(90, 40, second);
        let redrawn = Redrawn {
            images: [&first, &second].map(Arc::downgrade),
            parts: vec![Rect::new([0, 0], [64, 8])],
        };
        let (mut canvas, mut painter) = (Canvas::default(), EguiPainter::new(ChannelOrder::Bgra));
        canvas.show(Placed { frame: Some(&first), redrawn: None, area }, size, |_| {});
        let mut parts = Vec::new();
        let placed = Placed { frame: Some(&second), redrawn: Some(&redrawn), area };
        canvas.show(placed, size, |part| parts.push(part));
        assert_eq!(parts, [Rect::new([20, 10], [84, 11])], "the one row that differs");
        canvas.paint(&mut painter);
        for (index, &pixel) in canvas.pixels().iter().enumerate() {
            let (x, y) = (index % 120, index / 120);
            let is_inside = (20..110).contains(&x) && (7..47).contains(&y);
            let expected = if is_inside {
                let at = 4 * ((y - 7) * 90 + x - 20);
                [second.color[at + 2], second.color[at + 1], second.color[at], 255]
            } else {
                EMPTY
            };
            assert_eq!(pixel, expected, "{x}, {y}");
        }
        let moved = Area { min: [25, 9], ..area };
        let placed = Placed { area: moved, ..placed };
        canvas.show(placed, size, |part| painter.invalidate_part(part));
        canvas.paint(&mut painter);
        assert_eq!(canvas.pixels()[120 * 20 + 22], EMPTY, "where it was before");
        assert_eq!(canvas.pixels()[120 * 9 + 25][0], second.color[2], "its first pixel");
    }

    #[test]
    fn transparent_pixels_are_black() {
        let frame = frame(2, 1, vec![255, 255, 255, 0, 255, 255, 255, 51]);
        assert_eq!(
            shown(Some(&frame), [2, 1]),
            [[0, 0, 0, 255], [51, 51, 51, 255]],
            "straight alpha over black"
        );
    }

    #[test]
    fn only_what_looks_different_is_painted_again() {
        let (size, mut canvas) = ([200, 3], Canvas::default());
        let mut painter = EguiPainter::new(ChannelOrder::Bgra);
        let mut color = vec![255; 4 * 600];
        let mut show = |color: &[u8]| {
            let frame = frame(200, 3, color.to_vec());
            let mut parts = Vec::new();
            canvas.show(whole(Some(&frame), None, size), size, |part| parts.push(part));
            parts.iter().for_each(|part| painter.invalidate_part(*part));
            canvas.paint(&mut painter);
            (parts, canvas.painted().to_vec(), canvas.pixels().to_vec())
        };
        let (parts, painted, _) = show(&color);
        assert_eq!(parts.len(), 3, "white instead of dark in every row: {parts:?}");
        assert_eq!(painted, [Rect::new([0, 0], [200, 3])], "all is painted at first");
        assert!(show(&color).0.is_empty(), "the same image");
        color[4 * (200 + 70)] = 9;
        let (parts, painted, pixels) = show(&color);
        assert_eq!(parts, [Rect::new([64, 1], [128, 2])], "a piece of the middle row");
        assert!(painted.iter().map(|rect| (rect.max[0] - rect.min[0]) * 3).sum::<i32>() < 300, "{painted:?}");
        assert_eq!(pixels[200 + 70], [255, 255, 9, 255], "the one pixel");
        assert_eq!(pixels.iter().filter(|&&pixel| pixel != [255; 4]).count(), 1, "and no other");
    }

    #[test]
    fn only_parts_that_may_differ_are_compared() {
        let color = |byte: u8| (0..600).flat_map(|_| [byte, 0, 9, 255]).collect::<Vec<u8>>();
        let (first, mut color) = (frame(200, 3, color(1)), color(1));
        (color[4 * 70], color[4 * (400 + 150)]) = (77, 88);
        let second = frame(200, 3, color);
        let redrawn = |before: &Arc<Frame>, after: &Arc<Frame>| Redrawn {
            images: [before, after].map(Arc::downgrade),
            parts: vec![Rect::new([60, 0], [80, 2])],
        };
        let differing = |known: &Redrawn, size: [u32; 2]| {
            let (mut canvas, mut parts) = (Canvas::default(), Vec::new());
            canvas.show(whole(Some(&first), None, size), size, |_| {});
            canvas.show(whole(Some(&second), Some(known), size), size, |part| parts.push(part));
            (parts, canvas.beneath)
        };
        let (parts, beneath) = differing(&redrawn(&first, &second), [200, 3]);
        assert_eq!(parts, [Rect::new([60, 0], [80, 1])], "a part of the upper row");
        assert_eq!((beneath[70][2], beneath[550][2]), (77, 1), "nobody looked at the last row");
        // Of other images, or in a window of another size, it says nothing.
        for known in [redrawn(&second, &second), redrawn(&first, &first)] {
            assert_eq!(differing(&known, [200, 3]).0.len(), 2, "{known:?}");
        }
        assert_eq!(differing(&redrawn(&first, &second), [400, 3]).0.len(), 2, "all of it is compared");
    }

    #[test]
    fn without_an_image_it_is_dark() {
        assert_eq!(shown(None, [2, 1]), [EMPTY; 2], "and opaque");
    }
}
