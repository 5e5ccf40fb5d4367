//! EXT_meshopt_compression and KHR_meshopt_compression: buffer views whose
//! bytes are compressed. Written from the specification of the latter (Khronos,
//! draft of 2025), which includes the former.
//!
//! `attributes` has the first of its three modes with the optional filters, `triangles` the other two. Every
//! read is checked, and memory grows with the decoded data, never with claimed sizes.
//!
//! The tests use the crate `meshoptimizer-rs` as an oracle. The product does not use it, although it is 1.5
//! to 4 times as fast: it accepts what the specification calls invalid, and its errors do not say what is
//! wrong.

mod attributes;
mod triangles;

use super::stream::Broken;
pub(crate) use attributes::Filter;

/// The compression of a view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mode {
    /// Elements of any kind, byte for byte.
    Attributes,
    /// Indices of a triangle list.
    Triangles,
    /// Other indices.
    Indices,
}

/// The contents of a compressed view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Layout {
    pub(crate) mode: Mode,
    pub(crate) filter: Filter,
    /// Elements.
    pub(crate) count: usize,
    /// Bytes per element.
    pub(crate) stride: usize,
}

/// Decodes a view: `count · stride` bytes.
pub(crate) fn decode(layout: &Layout, bytes: &[u8]) -> Result<Vec<u8>, Broken> {
    layout.check()?;
    let mut decoded = match layout.mode {
        Mode::Attributes => attributes::decode(bytes, layout.count, layout.stride)?,
        Mode::Triangles => written(&triangles::decode(bytes, layout.count)?, layout.stride),
        Mode::Indices => written(&triangles::decode_indices(bytes, layout.count)?, layout.stride),
    };
    layout.filter.apply(&mut decoded, layout.stride);
    Ok(decoded)
}

impl Layout {
    /// The conditions of the extension.
    fn check(&self) -> Result<(), Broken> {
        let Self { mode, filter, count, stride } = *self;
        match mode {
            Mode::Attributes if stride == 0 || stride > 256 || stride % 4 != 0 => {
                Err("elements must have 4 to 256 bytes, a multiple of 4")
            }
            Mode::Attributes if !filter.fits(stride) => {
                Err("the filter does not fit the size of the elements")
            }
            Mode::Attributes => Ok(()),
            _ if stride != 2 && stride != 4 => Err("indices must have 2 or 4 bytes"),
            _ if filter != Filter::None => Err("indices cannot have a filter"),
            Mode::Triangles if !count.is_multiple_of(3) => Err("the indices are not whole triangles"),
            _ => Ok(()),
        }
    }
}

/// Indices as little-endian bytes, truncated to their size.
fn written(indices: &[u32], stride: usize) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(indices.len() * stride);
    if stride == 2 {
        indices.iter().for_each(|&index| bytes.extend_from_slice(&(index as u16).to_le_bytes()));
    } else {
        indices.iter().for_each(|&index| bytes.extend_from_slice(&index.to_le_bytes()));
    }
    bytes
}

#[cfg(test)]
mod tests;
