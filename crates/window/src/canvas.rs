//! The picture that goes into the window: opaque pixels of 8-bit sRGB, in the
//! layout that windows want.

use trigon_scene::Frame;

/// Pixels as `0x00RRGGBB`, rows from the top, without padding.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Canvas {
    width: usize,
    height: usize,
    pixels: Vec<u32>,
}

#[cfg(test)]
impl Canvas {
    /// For tests: a white canvas.
    pub(crate) fn white(width: u32, height: u32) -> Self {
        let color = vec![255; (4 * width * height) as usize];
        let mut canvas = Self::default();
        let frame = Frame { width, height, color, ..Frame::default() };
        canvas.show(&frame, width, height);
        canvas
    }
}

impl Canvas {
    /// Takes this size and the frame's colours. A frame that was drawn smaller
    /// is magnified by repeating its pixels; what is transparent in it is black.
    pub(crate) fn show(&mut self, frame: &Frame, width: u32, height: u32) {
        (self.width, self.height) = (width as usize, height as usize);
        self.pixels.resize(self.width * self.height, 0);
        if self.pixels.is_empty() || frame.color.is_empty() {
            return;
        }
        let (from, across) = (frame.color.as_chunks::<4>().0, frame.width as usize);
        if (frame.width, frame.height) == (width, height) {
            self.pixels.iter_mut().zip(from).for_each(|(to, &rgba)| *to = pack(rgba));
            return;
        }
        let down = frame.height as usize;
        let columns: Vec<usize> = (0..self.width).map(|x| x * across / self.width).collect();
        for (y, row) in self.pixels.chunks_exact_mut(self.width).enumerate() {
            let source = &from[y * down / self.height * across..][..across];
            row.iter_mut().zip(&columns).for_each(|(to, &x)| *to = pack(source[x]));
        }
    }

    pub(crate) fn width(&self) -> i32 {
        i32::try_from(self.width).unwrap_or(i32::MAX)
    }

    pub(crate) fn height(&self) -> i32 {
        i32::try_from(self.height).unwrap_or(i32::MAX)
    }

    /// All pixels, row by row.
    pub(crate) fn pixels(&self) -> &[u32] {
        &self.pixels
    }

    /// Mixes a colour into a pixel: 0 leaves it, 255 replaces it. In gamma
    /// space, as interfaces are drawn. Pixels outside are ignored.
    pub(crate) fn blend(&mut self, x: i32, y: i32, color: [u8; 3], alpha: u8) {
        let (Ok(column), Ok(row)) = (usize::try_from(x), usize::try_from(y)) else { return };
        if column >= self.width || row >= self.height {
            return;
        }
        let pixel = &mut self.pixels[row * self.width + column];
        let [_, r, g, b] = pixel.to_be_bytes();
        let mix = |old: u8, new: u8| {
            let sum = u32::from(old) * u32::from(255 - alpha) + u32::from(new) * u32::from(alpha);
            // Below 256, as both weights add up to 255.
            ((sum + 127) / 255) as u8
        };
        *pixel = u32::from_be_bytes([0, mix(r, color[0]), mix(g, color[1]), mix(b, color[2])]);
    }

    /// Mixes a colour into a rectangle.
    pub(crate) fn fill(&mut self, area: Area, color: [u8; 3], alpha: u8) {
        let right = (area.x + area.width).min(self.width());
        let bottom = (area.y + area.height).min(self.height());
        for y in area.y.max(0)..bottom {
            for x in area.x.max(0)..right {
                self.blend(x, y, color, alpha);
            }
        }
    }
}

/// A rectangle in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Area {
    pub(crate) x: i32,
    pub(crate) y: i32,
    pub(crate) width: i32,
    pub(crate) height: i32,
}

/// From straight alpha to a pixel over black.
fn pack([r, g, b, a]: [u8; 4]) -> u32 {
    if a == 255 {
        return u32::from_be_bytes([0, r, g, b]);
    }
    let dim = |channel: u8| ((u32::from(channel) * u32::from(a) + 127) / 255) as u8;
    u32::from_be_bytes([0, dim(r), dim(g), dim(b)])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(width: u32, height: u32, color: Vec<u8>) -> Frame {
        Frame { width, height, color, ..Frame::default() }
    }

    #[test]
    fn a_smaller_frame_is_magnified() {
        let mut canvas = Canvas::default();
        canvas.show(&frame(2, 1, vec![255, 0, 0, 255, 0, 0, 255, 255]), 4, 2);
        let row = [0xff_0000, 0xff_0000, 0xff, 0xff];
        assert_eq!(canvas.pixels(), [row, row].concat(), "each pixel became four");
        canvas.show(&frame(2, 1, vec![255, 0, 0, 255, 0, 0, 255, 255]), 3, 1);
        assert_eq!(canvas.pixels().len(), 3, "a size that does not divide is no problem");
    }

    #[test]
    fn blending_is_exact_at_both_ends_and_clips() {
        let mut canvas = Canvas::default();
        canvas.show(&frame(1, 1, vec![10, 20, 30, 255]), 1, 1);
        canvas.blend(0, 0, [200, 100, 50], 0);
        assert_eq!(canvas.pixels(), [0x000a_141e], "nothing mixed in");
        canvas.blend(0, 0, [200, 100, 50], 255);
        assert_eq!(canvas.pixels(), [0x00c8_6432], "all of it");
        canvas.fill(Area { x: -5, y: -5, width: 100, height: 100 }, [0, 0, 0], 255);
        canvas.blend(7, 0, [1, 1, 1], 255);
        assert_eq!(canvas.pixels(), [0], "outside is ignored");
    }

    #[test]
    fn transparent_pixels_are_black() {
        let mut canvas = Canvas::default();
        canvas.show(&frame(2, 1, vec![255, 255, 255, 0, 255, 255, 255, 51]), 2, 1);
        assert_eq!(canvas.pixels(), [0, 0x33_3333], "straight alpha over black");
    }
}
