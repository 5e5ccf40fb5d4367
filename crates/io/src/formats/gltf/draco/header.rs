//! The header, and metadata, which no picture shows.

use super::failure::Failure;
use crate::formats::gltf::stream::Stream;

/// How triangles are stored.
pub(super) enum Method {
    /// As indices.
    Sequential,
    /// As a walk over the surface.
    Edgebreaker,
}

/// Says that metadata follows.
const HAS_METADATA: u16 = 1 << 15;

/// Reads up to the triangles.
pub(super) fn read_header(stream: &mut Stream<'_>) -> Result<Method, Failure> {
    if stream.array()? != *b"DRACO" {
        return Err("it does not start with DRACO".into());
    }
    // The only version of the extension.
    if stream.array()? != [2, 2] {
        return Err(Failure::Foreign("another version of the format than 2.2"));
    }
    let [kind, method] = stream.array()?;
    let flags = u16::from_le_bytes(stream.array()?);
    if kind != 1 {
        return Err(Failure::Foreign("something else than a mesh of triangles"));
    }
    let method = match method {
        0 => Method::Sequential,
        1 => Method::Edgebreaker,
        _ => return Err(Failure::Foreign("triangles of an unknown kind")),
    };
    if flags & HAS_METADATA != 0 {
        skip_metadata(stream)?;
    }
    Ok(method)
}

/// Passes over the metadata of attributes and of the file.
fn skip_metadata(stream: &mut Stream<'_>) -> Result<(), Failure> {
    for _ in 0..stream.varint()? {
        stream.varint()?;
        skip_elements(stream)?;
    }
    skip_elements(stream)
}

/// Passes over an element and those in it, to any depth.
fn skip_elements(stream: &mut Stream<'_>) -> Result<(), Failure> {
    // How many elements are left at each level, of which all but the first have names.
    let mut left = vec![1];
    let mut is_first = true;
    while let Some(count) = left.last_mut() {
        if *count == 0 {
            left.pop();
            continue;
        }
        *count -= 1;
        if !std::mem::take(&mut is_first) {
            skip_text(stream)?;
        }
        for _ in 0..stream.varint()? {
            skip_text(stream)?;
            stream.counted_bytes()?;
        }
        left.push(stream.varint()?);
    }
    Ok(())
}

fn skip_text(stream: &mut Stream<'_>) -> Result<(), Failure> {
    let length = stream.byte()?;
    stream.take(usize::from(length))?;
    Ok(())
}
