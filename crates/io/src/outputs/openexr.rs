//! OpenEXR: all outputs of a frame in one file, one channel per number.

use std::io::{Cursor, Write};
use std::path::Path;

use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Blocks, Compression, Encoding, FlatSamples, Image, Layer,
    LayerAttributes, LineOrder, Text, WritableImage,
};
use trigon_math::color;
use trigon_scene::Frame;

use super::Output;
use super::values::Values;
use crate::write::{WriteError, write_atomically};

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
/// [`write_png`](crate::write_png), an old file is replaced whole or not at all.
///
/// # Errors
/// When the frame holds nothing, or the file cannot be written.
pub fn write_exr(path: impl AsRef<Path>, frame: &Frame) -> Result<(), WriteError> {
    let bytes = encode(frame)?;
    write_atomically(path.as_ref(), |file| file.write_all(&bytes))
}

/// As [`write_exr`], to a writer.
///
/// # Errors
/// When the frame holds nothing, or the writer fails.
pub fn encode_exr(mut writer: impl Write, frame: &Frame) -> Result<(), WriteError> {
    Ok(writer.write_all(&encode(frame)?)?)
}

/// The file. It is put together in memory, because its table of offsets at the front
/// is known last.
fn encode(frame: &Frame) -> Result<Vec<u8>, WriteError> {
    let values = Values::all(frame)?;
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
        .map_err(|error| WriteError::Stream(std::io::Error::other(error)))?;
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

fn channels(output: Output, values: Values<'_>) -> Vec<Channel> {
    match values {
        Values::Colors(bytes) => colors(bytes),
        Values::Floats(numbers) => vec![channel(name(output), FlatSamples::F32(numbers.to_vec()))],
        Values::Ids(ids) => vec![channel(name(output), FlatSamples::U32(ids.to_vec()))],
        Values::Pairs(pairs) => {
            let axis = |axis: usize| FlatSamples::F32(pairs.iter().map(|pair| pair[axis]).collect());
            vec![channel("U", axis(0)), channel("V", axis(1))]
        }
        Values::Lights(lights) => {
            let column = |at: usize| FlatSamples::F32(lights.iter().map(|light| light[at]).collect());
            let channels = ["R", "G", "B", "A"].into_iter().enumerate();
            channels.map(|(at, axis)| channel(axis, column(at))).collect()
        }
        Values::Vectors(vectors) => {
            let axes = if output == Output::Albedo { ["R", "G", "B"] } else { ["X", "Y", "Z"] };
            let column = |axis: usize| FlatSamples::F32(vectors.iter().map(|vector| vector[axis]).collect());
            (0..3).map(|axis| channel(&format!("{}.{}", name(output), axes[axis]), column(axis))).collect()
        }
    }
}

/// The channel of an output that has one, or what stands before the dot.
fn name(output: Output) -> &'static str {
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
