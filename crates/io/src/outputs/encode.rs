//! Encodes the outputs of a frame as NumPy's format 1.0 (`numpy.lib.format` in NumPy's documentation), as
//! OpenEXR with one channel for each number, and as PNG with 16 bits for each channel.

use std::io;
use std::io::{BufWriter, Cursor, Write};
use std::path::Path;

use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Blocks, Compression, Encoding, FlatSamples, Image, Layer,
    LayerAttributes, LineOrder, Text, WritableImage,
};
use trigon_math::color;
use trigon_scene::Frame;

use super::{Output, OutputValues};
use crate::encode_image::{Pixels, encode_png, write_png};
use crate::write::{WriteError, write_atomically};

/// The numbers begin at a multiple of this, so that they can be mapped into memory.
const ALIGNMENT: usize = 64;

/// Writes an output as a NumPy array: `numpy.load(path)[y, x]` is what the frame holds
/// of a pixel, bit for bit. Depth and ids have the shape (height, width), all else has
/// the numbers of a pixel as a third axis. Ids are u4, colours u1, all else f4.
///
/// As with [`write_png`], an old file is replaced whole or not at all.
///
/// # Errors
/// When the frame does not hold the output, or the file cannot be written.
pub fn write_npy(path: impl AsRef<Path>, frame: &Frame, output: Output) -> Result<(), WriteError> {
    let values = OutputValues::checked(frame, output)?;
    write_atomically(path.as_ref(), |file| npy_bytes(file, frame, values))
}

/// As [`write_npy`], to a writer.
///
/// # Errors
/// When the frame does not hold the output, or the writer fails.
pub fn encode_npy(writer: impl Write, frame: &Frame, output: Output) -> Result<(), WriteError> {
    let values = OutputValues::checked(frame, output)?;
    let mut writer = BufWriter::new(writer);
    npy_bytes(&mut writer, frame, values)?;
    Ok(writer.flush()?)
}

/// Writes [`Frame::origin`] as a NumPy array of three f8: what is to be added to positions for those in the world.
///
/// # Errors
/// When the file cannot be written.
pub fn write_origin_npy(path: impl AsRef<Path>, frame: &Frame) -> Result<(), WriteError> {
    write_atomically(path.as_ref(), |file| {
        file.write_all(&npy_header("<f8", "3,"))?;
        frame.origin.to_array().iter().try_for_each(|number| file.write_all(&number.to_le_bytes()))
    })
}

fn npy_bytes(writer: &mut dyn Write, frame: &Frame, values: OutputValues<'_>) -> io::Result<()> {
    let last = values.per_pixel().map(|numbers| format!(", {numbers}")).unwrap_or_default();
    let shape = format!("{}, {}{last}", frame.height, frame.width);
    writer.write_all(&npy_header(kind(values), &shape))?;
    let mut floats =
        |numbers: &[f32]| numbers.iter().try_for_each(|number| writer.write_all(&number.to_le_bytes()));
    match values {
        OutputValues::Colors(bytes) => writer.write_all(bytes),
        OutputValues::Floats(numbers) => floats(numbers),
        OutputValues::Pairs(pairs) => pairs.iter().try_for_each(|pair| floats(&pair.to_array())),
        OutputValues::Vectors(vectors) => vectors.iter().try_for_each(|vector| floats(&vector.to_array())),
        OutputValues::Lights(lights) => lights.iter().try_for_each(|light| floats(&light.to_array())),
        OutputValues::Ids(ids) => ids.iter().try_for_each(|id| writer.write_all(&id.to_le_bytes())),
    }
}

/// What the numbers are.
fn kind(values: OutputValues<'_>) -> &'static str {
    match values {
        OutputValues::Colors(_) => "|u1",
        OutputValues::Ids(_) => "<u4",
        OutputValues::Floats(_)
        | OutputValues::Pairs(_)
        | OutputValues::Vectors(_)
        | OutputValues::Lights(_) => "<f4",
    }
}

/// `shape` is what stands between the parentheses of a tuple in Python.
fn npy_header(kind: &str, shape: &str) -> Vec<u8> {
    const MAGIC: &[u8] = b"\x93NUMPY\x01\x00";
    let mut text = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({shape}), }}");
    let before = MAGIC.len() + size_of::<u16>();
    let end = (before + text.len() + 1).next_multiple_of(ALIGNMENT);
    text.extend(std::iter::repeat_n(' ', end - before - text.len() - 1));
    text.push('\n');
    let length = (text.len() as u16).to_le_bytes();
    [MAGIC, &length, text.as_bytes()].concat()
}

type Channel = AnyChannel<FlatSamples>;

/// Writes all that the frame holds as one OpenEXR image of 32-bit channels,
/// compressed without loss (ZIP).
///
/// | output | channels |
/// |---|---|
/// | radiance; or, of a frame without it, colour | `R` `G` `B` `A`: linear light, premultiplied, as OpenEXR has it; of a colour in the 256 steps of sRGB |
/// | depth | `Z` |
/// | ids, as u32 | `id.object` `id.face` `id.material` `id.triangle` |
/// | barycentrics | `barycentric.X` `.Y` `.Z` |
/// | positions, normals, geometric normals | `P.X` `P.Y` `P.Z`, `N.X` …, `Ng.X` … |
/// | the origin of positions | the text attribute `P.origin`: three numbers of f64 |
/// | texture coordinates | `U` `V` |
/// | albedo | `albedo.R` `.G` `.B` |
///
/// All but a colour is, bit for bit, what the frame holds. As with
/// [`write_png`], an old file is replaced whole or not at all.
///
/// # Errors
/// When the frame holds nothing, or the file cannot be written.
pub fn write_exr(path: impl AsRef<Path>, frame: &Frame) -> Result<(), WriteError> {
    let bytes = exr_bytes(frame)?;
    write_atomically(path.as_ref(), |file| file.write_all(&bytes))
}

/// As [`write_exr`], to a writer.
///
/// # Errors
/// When the frame holds nothing, or the writer fails.
pub fn encode_exr(mut writer: impl Write, frame: &Frame) -> Result<(), WriteError> {
    Ok(writer.write_all(&exr_bytes(frame)?)?)
}

/// The file. It is put together in memory, because its table of offsets at the front
/// is known last.
fn exr_bytes(frame: &Frame) -> Result<Vec<u8>, WriteError> {
    let values = OutputValues::all(frame)?;
    let shown = |output| output != Output::Color || frame.radiance.is_none();
    let values = values.into_iter().filter(|&(output, _)| shown(output));
    let channels = values.flat_map(|(output, values)| channels(output, values)).collect();
    let size = (frame.width as usize, frame.height as usize);
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let layer = Layer::new(size, attributes(frame), encoding, AnyChannels::sort(channels));
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer)
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .map_err(|error| WriteError::Stream(io::Error::other(error)))?;
    Ok(bytes.into_inner())
}

/// What channels do not tell: what positions are relative to. As text, for OpenEXR has no vectors of f64.
fn attributes(frame: &Frame) -> LayerAttributes {
    let mut attributes = LayerAttributes::default();
    if frame.positions.is_some() {
        let origin = frame.origin.to_array().map(|number| number.to_string()).join(" ");
        attributes.other.insert(Text::from("P.origin"), AttributeValue::Text(Text::from(origin.as_str())));
    }
    attributes
}

fn channels(output: Output, values: OutputValues<'_>) -> Vec<Channel> {
    match values {
        OutputValues::Colors(bytes) => colors(bytes),
        OutputValues::Floats(numbers) => {
            vec![channel(channel_name(output), FlatSamples::F32(numbers.to_vec()))]
        }
        OutputValues::Ids(ids) => vec![channel(channel_name(output), FlatSamples::U32(ids.to_vec()))],
        OutputValues::Pairs(pairs) => {
            let axis = |axis: usize| FlatSamples::F32(pairs.iter().map(|pair| pair[axis]).collect());
            vec![channel("U", axis(0)), channel("V", axis(1))]
        }
        OutputValues::Lights(lights) => {
            let column = |at: usize| FlatSamples::F32(lights.iter().map(|light| light[at]).collect());
            let channels = ["R", "G", "B", "A"].into_iter().enumerate();
            channels.map(|(at, axis)| channel(axis, column(at))).collect()
        }
        OutputValues::Vectors(vectors) => {
            let axes = if output == Output::Albedo { ["R", "G", "B"] } else { ["X", "Y", "Z"] };
            let column = |axis: usize| FlatSamples::F32(vectors.iter().map(|vector| vector[axis]).collect());
            (0..3)
                .map(|axis| channel(&format!("{}.{}", channel_name(output), axes[axis]), column(axis)))
                .collect()
        }
    }
}

/// The channel of an output that has one, or what stands before the dot.
fn channel_name(output: Output) -> &'static str {
    match output {
        // These have names of their own for each number.
        Output::Color | Output::Radiance | Output::Uvs => "",
        Output::Depth => "Z",
        Output::ObjectIds => "id.object",
        Output::FaceIds => "id.face",
        Output::MaterialIds => "id.material",
        Output::TriangleIds => "id.triangle",
        Output::Barycentrics => "barycentric",
        Output::Positions => "P",
        Output::Normals => "N",
        Output::GeometricNormals => "Ng",
        Output::Albedo => "albedo",
    }
}

/// Linear light, multiplied with alpha.
fn colors(bytes: &[u8]) -> Vec<Channel> {
    let pixels = bytes.as_chunks::<4>().0;
    let alpha = |pixel: &[u8; 4]| f32::from(pixel[3]) / 255.0;
    let light = |at: usize| {
        pixels.iter().map(|pixel| color::srgb8_to_linear(pixel[at]) * alpha(pixel)).collect::<Vec<f32>>()
    };
    vec![
        channel("R", FlatSamples::F32(light(0))),
        channel("G", FlatSamples::F32(light(1))),
        channel("B", FlatSamples::F32(light(2))),
        channel("A", FlatSamples::F32(pixels.iter().map(alpha).collect())),
    ]
}

fn channel(name: &str, samples: FlatSamples) -> Channel {
    AnyChannel::new(name, samples)
}

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
/// [`write_png`] writes, and the rest has no range of its own.
///
/// # Errors
/// When the frame does not hold the output, a value of it does not fit, or the file
/// cannot be written. Nothing is cut off silently.
pub fn write_png16(path: impl AsRef<Path>, frame: &Frame, output: Output) -> Result<(), WriteError> {
    let numbers = EncodedNumbers::new(frame, output)?;
    write_png(path, frame.width, frame.height, numbers.pixels())
}

/// As [`write_png16`], to a writer.
///
/// # Errors
/// As [`write_png16`].
pub fn encode_png16(writer: impl Write, frame: &Frame, output: Output) -> Result<(), WriteError> {
    let numbers = EncodedNumbers::new(frame, output)?;
    encode_png(writer, frame.width, frame.height, numbers.pixels())
}

enum EncodedNumbers {
    Gray(Vec<u16>),
    Rgb(Vec<u16>),
}

impl EncodedNumbers {
    fn new(frame: &Frame, output: Output) -> Result<Self, WriteError> {
        let values = OutputValues::checked(frame, output)?;
        match (output, values) {
            (Output::Depth, OutputValues::Floats(depths)) => {
                Ok(Self::Gray(depths.iter().map(|&depth| millimetres(depth)).collect::<Result<_, _>>()?))
            }
            (_, OutputValues::Ids(ids)) => {
                Ok(Self::Gray(ids.iter().map(|&id| short(output, id)).collect::<Result<_, _>>()?))
            }
            (Output::Normals | Output::GeometricNormals, OutputValues::Vectors(normals)) => {
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
