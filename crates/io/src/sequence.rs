//! Animated images: GIF and animated PNG, one frame in memory at a time.

use std::io::{self, Write};
use std::path::Path;

use image::codecs::gif::{GifEncoder, Repeat};
use image::{Delay, Frame, RgbaImage};

use super::encode_image::{into_io, on_white};
use crate::write::{WriteError, write_atomically};

/// GIF stores sides in 16 bits.
const MOST_SIDE: u32 = 65_535;

/// The common properties of all frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sequence {
    /// Pixels, 1 to 65,535.
    pub width: u32,
    /// Pixels, 1 to 65,535.
    pub height: u32,
    /// The number of frames, at least 1.
    pub frames: u32,
    /// Frames per second: 0.02 to 1000. Programs that show GIF files use at least 20 ms per frame,
    /// in hundredths of a second.
    pub frames_per_second: f64,
}

impl Sequence {
    fn check(&self) -> Result<(), WriteError> {
        let sides = 1..=MOST_SIDE;
        let fits = sides.contains(&self.width) && sides.contains(&self.height) && self.frames > 0;
        let &Self { width, height, .. } = self;
        if fits { Ok(()) } else { Err(WriteError::Size { width, height, length: self.frames as usize }) }
    }

    /// The duration of a frame, in milliseconds.
    fn milliseconds(&self) -> u16 {
        (1000.0 / self.frames_per_second).round().clamp(1.0, 50_000.0) as u16
    }

    /// A frame, if it has the right number of pixels.
    fn checked(&self, rgba: Vec<u8>) -> io::Result<Vec<u8>> {
        if rgba.len() as u64 == 4 * u64::from(self.width) * u64::from(self.height) {
            return Ok(rgba);
        }
        Err(io::Error::other("a frame has another size than the sequence"))
    }
}

/// Writes a looping GIF with 256 colours per frame; transparent pixels become white. `frame`
/// returns the frame of a number from 0: sRGB with straight alpha, rows from the top. The file is
/// written atomically.
///
/// # Errors
/// A size does not match, `frame` fails, or the file cannot be written.
pub fn write_gif(
    path: impl AsRef<Path>,
    sequence: &Sequence,
    frame: &mut dyn FnMut(u32) -> io::Result<Vec<u8>>,
) -> Result<(), WriteError> {
    sequence.check()?;
    write_atomically(path.as_ref(), |file| {
        // . 10: the best palette in an acceptable time.
        let mut encoder = GifEncoder::new_with_speed(file, 10);
        encoder.set_repeat(Repeat::Infinite).map_err(into_io)?;
        let delay = Delay::from_numer_denom_ms(u32::from(sequence.milliseconds()), 1);
        for number in 0..sequence.frames {
            let rgba = sequence.checked(frame(number)?)?;
            let image = RgbaImage::from_raw(sequence.width, sequence.height, opaque(&rgba))
                .expect("the size was checked");
            encoder.encode_frame(Frame::from_parts(image, 0, 0, delay)).map_err(into_io)?;
        }
        Ok(())
    })
}

fn opaque(rgba: &[u8]) -> Vec<u8> {
    let (pixels, _) = rgba.as_chunks::<4>();
    pixels.iter().flat_map(|&pixel| on_white(pixel).into_iter().chain([255])).collect()
}

/// Writes a looping animated PNG: every byte of every frame is kept. Programs that support only PNG
/// show the first. `frame` returns the frame of a number from 0: sRGB with straight alpha, rows
/// from the top. The file is written atomically.
///
/// # Errors
/// A size does not match, `frame` fails, or the file cannot be written.
pub fn write_apng(
    path: impl AsRef<Path>,
    sequence: &Sequence,
    frame: &mut dyn FnMut(u32) -> io::Result<Vec<u8>>,
) -> Result<(), WriteError> {
    sequence.check()?;
    write_atomically(path.as_ref(), |file| apng(file, sequence, frame).map_err(from_png))
}

fn apng(
    file: &mut dyn Write,
    sequence: &Sequence,
    frame: &mut dyn FnMut(u32) -> io::Result<Vec<u8>>,
) -> Result<(), png::EncodingError> {
    let mut encoder = png::Encoder::new(file, sequence.width, sequence.height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_animated(sequence.frames, 0)?;
    encoder.set_frame_delay(sequence.milliseconds(), 1000)?;
    let mut writer = encoder.write_header()?;
    for number in 0..sequence.frames {
        writer.write_image_data(&sequence.checked(frame(number)?)?)?;
    }
    writer.finish()
}

fn from_png(error: png::EncodingError) -> io::Error {
    match error {
        png::EncodingError::IoError(error) => error,
        other => io::Error::other(other),
    }
}

#[cfg(test)]
mod tests {
    use image::AnimationDecoder;
    use image::codecs::{gif::GifDecoder, png::PngDecoder};
    use std::io::Cursor;

    use super::*;

    const SEQUENCE: Sequence = Sequence { width: 4, height: 2, frames: 3, frames_per_second: 20.0 };

    /// A grey that grows from frame to frame.
    fn grey(number: u32) -> Vec<u8> {
        (0..8).flat_map(|_| [80 * number as u8, 80 * number as u8, 80 * number as u8, 255]).collect()
    }

    fn written(write: impl FnOnce(&Path) -> Result<(), WriteError>) -> Vec<u8> {
        let dir = tempfile::tempdir().expect("a temporary folder");
        let path = dir.path().join("moving");
        write(&path).expect("written");
        std::fs::read(&path).expect("a file")
    }

    #[test]
    fn every_frame_comes_back() {
        let gif = written(|path| write_gif(path, &SEQUENCE, &mut |number| Ok(grey(number))));
        let frames = GifDecoder::new(Cursor::new(gif)).expect("a GIF").into_frames();
        let apng = written(|path| write_apng(path, &SEQUENCE, &mut |number| Ok(grey(number))));
        let apng = PngDecoder::new(Cursor::new(apng)).expect("a PNG").apng().expect("it moves").into_frames();
        for (name, frames) in [("gif", frames), ("apng", apng)] {
            let frames = frames.collect_frames().expect("whole");
            assert_eq!(frames.len(), 3, "{name}: all frames");
            for (frame, number) in frames.iter().zip(0..) {
                assert_eq!(frame.delay().numer_denom_ms(), (50, 1), "{name}: a twentieth of a second");
                assert_eq!(frame.buffer().as_raw(), &grey(number), "{name}: frame {number}");
            }
        }
    }

    #[test]
    fn a_frame_that_fails_leaves_no_file() {
        let dir = tempfile::tempdir().expect("a temporary folder");
        let path = dir.path().join("a.gif");
        for broken in [Sequence { frames: 0, ..SEQUENCE }, Sequence { width: 5, ..SEQUENCE }, SEQUENCE] {
            let mut frame =
                |number| if number == 2 { Err(io::Error::other("lost")) } else { Ok(grey(number)) };
            write_gif(&path, &broken, &mut frame).expect_err("refused");
            write_apng(&path, &broken, &mut frame).expect_err("refused");
        }
        assert_eq!(std::fs::read_dir(dir.path()).expect("a folder").count(), 0, "nothing stays");
    }
}
