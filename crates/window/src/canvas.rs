//! The pixels of the window: the scene's image with the interface over it. Opaque, 8-bit sRGB, in
//! the order that windows have in memory.

use trigon_raster::paint2d::Rect;
use trigon_scene::Frame;

use crate::egui_painter::{ChannelOrder, EguiPainter};
use crate::refinement;

/// Shown before the first image: dark, so as not to dazzle.
const EMPTY: [u8; 4] = [24, 24, 24, 255];

/// Rows from the top, without padding; blue, green, red, and an unused alpha.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Canvas {
    size: [u32; 2],
    /// The scene's image alone.
    beneath: Vec<[u8; 4]>,
    pixels: Vec<[u8; 4]>,
    painted: Vec<Rect>,
}

impl Canvas {
    /// Takes this size and puts the frame's colours under the interface. A frame of another size is
    /// stretched by repeating or skipping pixels; transparent parts become black. Without a frame
    /// it is dark.
    pub(crate) fn show(&mut self, frame: Option<&Frame>, [width, height]: [u32; 2]) {
        self.size = [width, height];
        let count = width as usize * height as usize;
        self.pixels.resize(count, EMPTY);
        match frame.filter(|frame| !frame.color.is_empty()) {
            Some(frame) => {
                self.beneath.resize(count, EMPTY);
                stretch(frame, [width as usize, height as usize], &mut self.beneath);
            }
            None => {
                self.beneath.clear();
                self.beneath.resize(count, EMPTY);
            }
        }
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

/// Writes a frame into an image of this size.
fn stretch(frame: &Frame, [width, height]: [usize; 2], to: &mut [[u8; 4]]) {
    let (from, across, down) = (frame.color.as_chunks::<4>().0, frame.width as usize, frame.height as usize);
    if [across, down] == [width, height] {
        to.iter_mut().zip(from).for_each(|(to, &rgba)| *to = over_black(rgba));
        return;
    }
    let columns: Vec<usize> = (0..width).map(|x| source_pixel(x, width, across)).collect();
    let source = |y: usize| source_pixel(y, height, down);
    for y in 0..height {
        let (above, row) = to.split_at_mut(y * width);
        let row = &mut row[..width];
        if y > 0 && source(y) == source(y - 1) {
            row.copy_from_slice(&above[(y - 1) * width..]);
            continue;
        }
        let source = &from[source(y) * across..][..across];
        row.iter_mut().zip(&columns).for_each(|(to, &x)| *to = over_black(source[x]));
    }
}

/// Maps one of `to` columns or rows of the window to one of `from` in the frame.
pub(crate) fn source_pixel(at: usize, to: usize, from: usize) -> usize {
    at * from / to
}

/// From straight alpha to an opaque pixel over black, as windows store it.
fn over_black(rgba: [u8; 4]) -> [u8; 4] {
    let [r, g, b] = refinement::over_black(rgba);
    ChannelOrder::Bgra.arrange([r, g, b, 255])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(width: u32, height: u32, color: Vec<u8>) -> Frame {
        Frame { width, height, color, ..Frame::default() }
    }

    fn shown(frame: Option<&Frame>, size: [u32; 2]) -> Vec<[u8; 4]> {
        let mut canvas = Canvas::default();
        canvas.show(frame, size);
        let mut painter = EguiPainter::new(ChannelOrder::Bgra);
        assert!(canvas.paint(&mut painter), "all of it is new");
        assert!(!canvas.paint(&mut painter), "and then nothing");
        canvas.pixels().to_vec()
    }

    #[test]
    fn a_smaller_frame_is_magnified() {
        let frame = frame(2, 1, vec![255, 0, 0, 255, 0, 0, 255, 255]);
        let [red, blue] = [[0, 0, 255, 255], [255, 0, 0, 255]];
        let row = [red, red, blue, blue];
        assert_eq!(shown(Some(&frame), [4, 2]), [row, row].concat(), "each pixel became four");
        assert_eq!(shown(Some(&frame), [3, 1]).len(), 3, "a size that does not divide is no problem");
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
    fn without_a_picture_it_is_dark() {
        assert_eq!(shown(None, [2, 1]), [EMPTY; 2], "and opaque");
    }
}
