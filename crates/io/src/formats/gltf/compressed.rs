//! Buffer views that an extension compresses, as the document describes them.

use std::ops::Range;

use gltf::json::Root;
use serde::Deserialize;
use serde_json::Value;

use super::meshopt::{Filter, Layout, Mode};

/// Where a compressed view's bytes are, and what they hold.
pub(crate) struct CompressedView {
    pub(crate) buffer: usize,
    pub(crate) range: Range<usize>,
    pub(crate) layout: Layout,
}

impl CompressedView {
    /// Bytes, once decoded.
    pub(crate) fn decoded_length(&self) -> usize {
        // Checked to be the length of the plain view.
        self.layout.count * self.layout.stride
    }
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Extension {
    buffer: usize,
    #[serde(default)]
    byte_offset: u64,
    byte_length: u64,
    byte_stride: u64,
    count: u64,
    mode: String,
    filter: Option<String>,
}

/// The compressed form of a view, checked against the document; none when it
/// has no such form, and an error that says why it makes no sense.
pub(crate) fn compressed_view(root: &Root, index: usize) -> Result<Option<CompressedView>, String> {
    let view = &root.buffer_views[index];
    let others = view.extensions.as_ref().map(|extensions| &extensions.others);
    let names = ["EXT_meshopt_compression", "KHR_meshopt_compression"];
    let Some(value) = names.iter().find_map(|name| others?.get(*name)) else { return Ok(None) };
    read(root, value.clone(), view.byte_length.0).map(Some)
}

fn read(root: &Root, value: Value, plain_length: u64) -> Result<CompressedView, String> {
    let from: Extension = serde_json::from_value(value)
        .map_err(|error| format!("its compression is not described: {error}"))?;
    let mode = match from.mode.as_str() {
        "ATTRIBUTES" => Mode::Attributes,
        "TRIANGLES" => Mode::Triangles,
        "INDICES" => Mode::Indices,
        other => return Err(format!("its compression has the unknown mode {other}")),
    };
    let name = from.filter.as_deref().unwrap_or("NONE");
    let filter =
        Filter::from_name(name).ok_or_else(|| format!("its compression has the unknown filter {name}"))?;
    let length = root.buffers.get(from.buffer).map(|buffer| buffer.byte_length.0);
    let length = length.ok_or_else(|| format!("buffer {} does not exist", from.buffer))?;
    let end = from.byte_offset.checked_add(from.byte_length).filter(|&end| end <= length);
    let end = end.ok_or_else(|| format!("its compressed bytes lie outside buffer {}", from.buffer))?;
    if from.count.checked_mul(from.byte_stride) != Some(plain_length) {
        let (count, stride) = (from.count, from.byte_stride);
        return Err(format!(
            "{count} compressed elements of {stride} bytes do not fill its {plain_length} bytes"
        ));
    }
    Ok(CompressedView {
        buffer: from.buffer,
        range: from.byte_offset as usize..end as usize,
        layout: Layout { mode, filter, count: from.count as usize, stride: from.byte_stride as usize },
    })
}
