//! Draco: the mesh compression of KHR_draco_mesh_compression. Written from its "Draco Bitstream
//! Specification" (Google, version 2.2), and where that is silent, from how Google's own decoder
//! numbers points: other data of a primitive may rely on their order.
//!
//! A stream holds the triangles and then the attributes:
//!
//! 1. The header has the kind of the mesh; metadata is passed over.
//! 2. Triangles that are stored as indices are read here. `edgebreaker` rebuilds triangles that are stored as
//!    a walk, with the symbols of `walk`, into a table of `corners`. Seams split that table for attributes that
//!    are discontinuous, and the vertices of the result are numbered.
//! 3. `attributes` reads the values, in the order given by `order`. `prediction` adds to the stored
//!    corrections what their neighbours let expect.
//!
//! `symbols` is the entropy coding below all of them. Every read is checked. A
//! few bytes may stand for millions of equal symbols: a `Budget` bounds the memory and the time.
//!
//! The results have the bytes of Google's decoder (`tests/draco`). The crate `draco-oxide-decoder` is not used: it
//! would bring 58 other crates, a minute of compilation and `unsafe`.

mod attributes;
mod corners;
mod edgebreaker;
mod order;
mod prediction;
mod symbols;
mod values;
mod walk;

use self::attributes::MeshShape;
use self::symbols::read_symbols;
use super::stream::Broken;
use super::stream::Stream;

pub(crate) use attributes::DecodedAttribute;
pub(crate) use symbols::{Budget, Failure};

/// A decoded mesh.
pub(crate) struct DecodedMesh {
    /// How many points it has: every attribute has one value for each.
    pub(crate) points: usize,
    /// Three points each.
    pub(crate) triangles: Vec<u32>,
    pub(crate) attributes: Vec<DecodedAttribute>,
}

/// Decodes a mesh.
pub(crate) fn decode(bytes: &[u8], budget: &mut Budget) -> Result<DecodedMesh, Failure> {
    let mut stream = Stream(bytes);
    let method = read_header(&mut stream)?;
    let shape = match method {
        Method::Sequential => read_triangles(&mut stream, budget)?,
        Method::Edgebreaker => edgebreaker::read_triangles(&mut stream, budget)?,
    };
    let attributes = attributes::read_attributes(&mut stream, &shape, budget)?;
    Ok(DecodedMesh { points: shape.points, triangles: shape.triangles, attributes })
}

fn read_triangles(stream: &mut Stream<'_>, budget: &mut Budget) -> Result<MeshShape, Failure> {
    let (faces, points) = (stream.varint()? as usize, stream.varint()?);
    // The smallest index takes a byte, compressed ones less.
    let corners = faces.checked_mul(3).ok_or("it has too many triangles")?;
    budget.spend(corners)?;
    budget.spend(points as usize)?;
    let triangles = match stream.byte()? {
        0 => differences(&read_symbols(stream, corners, 1, budget)?),
        1 => read_plain(stream, corners, points)?,
        _ => return Err(Failure::Foreign("indices of an unknown kind")),
    };
    if triangles.iter().any(|&point| point >= points) {
        return Err("an index is beyond its points".into());
    }
    Ok(MeshShape { points: points as usize, triangles, tables: None })
}

/// Indices of which each is stored as the difference to the one before, with its sign in the
/// lowest bit.
fn differences(symbols: &[u32]) -> Vec<u32> {
    let add = |last: &mut u32, &symbol: &u32| {
        let size = symbol >> 1;
        *last = if symbol & 1 == 0 { last.wrapping_add(size) } else { last.wrapping_sub(size) };
        Some(*last)
    };
    symbols.iter().scan(0, add).collect()
}

/// Indices in as many bytes as the number of points needs.
fn read_plain(stream: &mut Stream<'_>, corners: usize, points: u32) -> Result<Vec<u32>, Broken> {
    if corners > stream.0.len() {
        return Err("it has more triangles than bytes for them");
    }
    let read = |_| {
        Ok(match points {
            0..=0xff => u32::from(stream.byte()?),
            0x100..=0xffff => u32::from(u16::from_le_bytes(stream.array()?)),
            0x1_0000..=0x1f_ffff => stream.varint()?,
            _ => u32::from_le_bytes(stream.array()?),
        })
    };
    (0..corners).map(read).collect()
}

/// How triangles are stored.
enum Method {
    /// As indices.
    Sequential,
    /// As a walk over the surface.
    Edgebreaker,
}

/// Says that metadata follows.
const HAS_METADATA: u16 = 1 << 15;

/// Reads up to the triangles.
fn read_header(stream: &mut Stream<'_>) -> Result<Method, Failure> {
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

#[cfg(test)]
mod tests;
