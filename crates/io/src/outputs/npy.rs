//! NumPy's format, version 1.0: a header with type and shape, then the numbers. See `numpy.lib.format` in
//! NumPy's documentation.

use std::io::{self, BufWriter, Write};
use std::path::Path;

use trigon_scene::Frame;

use super::Output;
use super::values::Values;
use crate::write::{WriteError, write_atomically};

/// The numbers begin at a multiple of this, so that they can be mapped into memory.
const ALIGNMENT: usize = 64;

/// Writes an output as a NumPy array: `numpy.load(path)[y, x]` is what the frame holds
/// of a pixel, bit for bit. Depth and ids have the shape (height, width), all else has
/// the numbers of a pixel as a third axis. Ids are u4, colours u1, all else f4.
///
/// As with [`write_png`](crate::write_png), an old file is replaced whole or not at all.
///
/// # Errors
/// When the frame does not hold the output, or the file cannot be written.
pub fn write_npy(path: impl AsRef<Path>, frame: &Frame, output: Output) -> Result<(), WriteError> {
    let values = Values::checked(frame, output)?;
    write_atomically(path.as_ref(), |file| encode(file, frame, values))
}

/// As [`write_npy`], to a writer.
///
/// # Errors
/// When the frame does not hold the output, or the writer fails.
pub fn encode_npy(writer: impl Write, frame: &Frame, output: Output) -> Result<(), WriteError> {
    let values = Values::checked(frame, output)?;
    let mut writer = BufWriter::new(writer);
    encode(&mut writer, frame, values)?;
    Ok(writer.flush()?)
}

/// Writes [`Frame::origin`] as a NumPy array of three f8: what is to be added to positions for those in the world.
///
/// # Errors
/// When the file cannot be written.
pub fn write_origin_npy(path: impl AsRef<Path>, frame: &Frame) -> Result<(), WriteError> {
    write_atomically(path.as_ref(), |file| {
        file.write_all(&header("<f8", "3,"))?;
        frame.origin.to_array().iter().try_for_each(|number| file.write_all(&number.to_le_bytes()))
    })
}

fn encode(writer: &mut dyn Write, frame: &Frame, values: Values<'_>) -> io::Result<()> {
    let last = values.per_pixel().map(|numbers| format!(", {numbers}")).unwrap_or_default();
    let shape = format!("{}, {}{last}", frame.height, frame.width);
    writer.write_all(&header(kind(values), &shape))?;
    let mut floats =
        |numbers: &[f32]| numbers.iter().try_for_each(|number| writer.write_all(&number.to_le_bytes()));
    match values {
        Values::Colors(bytes) => writer.write_all(bytes),
        Values::Floats(numbers) => floats(numbers),
        Values::Pairs(pairs) => pairs.iter().try_for_each(|pair| floats(&pair.to_array())),
        Values::Vectors(vectors) => vectors.iter().try_for_each(|vector| floats(&vector.to_array())),
        Values::Lights(lights) => lights.iter().try_for_each(|light| floats(&light.to_array())),
        Values::Ids(ids) => ids.iter().try_for_each(|id| writer.write_all(&id.to_le_bytes())),
    }
}

/// What the numbers are.
fn kind(values: Values<'_>) -> &'static str {
    match values {
        Values::Colors(_) => "|u1",
        Values::Ids(_) => "<u4",
        Values::Floats(_) | Values::Pairs(_) | Values::Vectors(_) | Values::Lights(_) => "<f4",
    }
}

/// `shape` is what stands between the parentheses of a tuple in Python.
fn header(kind: &str, shape: &str) -> Vec<u8> {
    const MAGIC: &[u8] = b"\x93NUMPY\x01\x00";
    let mut text = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({shape}), }}");
    let before = MAGIC.len() + size_of::<u16>();
    let end = (before + text.len() + 1).next_multiple_of(ALIGNMENT);
    text.extend(std::iter::repeat_n(' ', end - before - text.len() - 1));
    text.push('\n');
    let length = (text.len() as u16).to_le_bytes();
    [MAGIC, &length, text.as_bytes()].concat()
}
