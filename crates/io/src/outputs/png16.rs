//! PNG with 16 bits per channel, for programs that read nothing else: depth, ids and directions, as far as
//! they fit.

use std::io::Write;
use std::path::Path;

use trigon_scene::Frame;

use super::Output;
use super::values::Values;
use crate::png::{Pixels, encode_png, write_png};
use crate::write::WriteError;

/// Metres of a step of depth.
const STEP: f32 = 1e-3;

/// Writes an output as a PNG of 16 bits.
///
/// - Depth is grey, in millimetres, rounded, at least 1, at most 65535; 0 is background:
///   what depth cameras and their data sets have.
/// - Ids are grey; 65535 is background.
/// - Normals and geometric normals are red, green and blue: −1 is 0 and 1 is 65535. The
///   background, which has none, is (32768, 32768, 32768).
///
/// All other outputs are refused: colours have only 8 bits, which
/// [`write_png`](crate::write_png) writes, and the rest has no range of its own.
///
/// # Errors
/// When the frame does not hold the output, a value of it does not fit, or the file
/// cannot be written. Nothing is cut off silently.
pub fn write_png16(path: impl AsRef<Path>, frame: &Frame, output: Output) -> Result<(), WriteError> {
    let numbers = Numbers::new(frame, output)?;
    write_png(path, frame.width, frame.height, numbers.pixels())
}

/// As [`write_png16`], to a writer.
///
/// # Errors
/// As [`write_png16`].
pub fn encode_png16(writer: impl Write, frame: &Frame, output: Output) -> Result<(), WriteError> {
    let numbers = Numbers::new(frame, output)?;
    encode_png(writer, frame.width, frame.height, numbers.pixels())
}

enum Numbers {
    Gray(Vec<u16>),
    Rgb(Vec<u16>),
}

impl Numbers {
    fn new(frame: &Frame, output: Output) -> Result<Self, WriteError> {
        let values = Values::checked(frame, output)?;
        match (output, values) {
            (Output::Depth, Values::Floats(depths)) => {
                Ok(Self::Gray(depths.iter().map(|&depth| millimetres(depth)).collect::<Result<_, _>>()?))
            }
            (_, Values::Ids(ids)) => {
                Ok(Self::Gray(ids.iter().map(|&id| short(output, id)).collect::<Result<_, _>>()?))
            }
            (Output::Normals | Output::GeometricNormals, Values::Vectors(normals)) => {
                Ok(Self::Rgb(normals.iter().flat_map(|normal| normal.to_array().map(direction)).collect()))
            }
            _ => Err(WriteError::Unfit {
                output: output.name(),
                what: "it does not fit into 16 bits".to_owned(),
            }),
        }
    }

    fn pixels(&self) -> Pixels<'_> {
        match self {
            Self::Gray(values) => Pixels::Gray16(values),
            Self::Rgb(values) => Pixels::Rgb16(values),
        }
    }
}

fn millimetres(depth: f32) -> Result<u16, WriteError> {
    if depth == f32::INFINITY {
        return Ok(0);
    }
    let rounded_up = depth / STEP + 0.5;
    if (0.0..65536.0).contains(&rounded_up) {
        // What is seen is no background, however near it is.
        return Ok((rounded_up as u16).max(1));
    }
    let what = format!("a pixel is {depth} m away; 16 bits of millimetres go from 0 to 65.535 m");
    Err(WriteError::Unfit { output: Output::Depth.name(), what })
}

fn short(output: Output, id: u32) -> Result<u16, WriteError> {
    match u16::try_from(id) {
        _ if id == u32::MAX => Ok(u16::MAX),
        Ok(id) if id < u16::MAX => Ok(id),
        _ => Err(WriteError::Unfit {
            output: output.name(),
            what: format!("a pixel has the id {id}; 16 bits end at 65534"),
        }),
    }
}

/// From −1…1 to 0…65535.
fn direction(component: f32) -> u16 {
    ((component * 0.5 + 0.5) * f32::from(u16::MAX) + 0.5) as u16
}
