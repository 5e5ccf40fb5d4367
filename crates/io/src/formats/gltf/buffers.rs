//! The bytes behind a document: from the GLB, from data URIs, from files in the model's folder. Each buffer
//! is read when the first accessor or image needs it. A buffer view may be compressed by an extension.

use std::collections::HashMap;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use gltf::json::Root;
use serde::Deserialize;
use serde_json::Value;

use super::draco::Budget;
use super::meshopt;
use super::meshopt::{Filter, Layout, Mode};
use crate::error::{LoadError, LoadErrorKind, Location};
use crate::folder::{Folder, Lookup};
use crate::refusal::Refusal;
use crate::uri::{FileNames, Reference, parse_reference, quotable};

/// What went wrong with a reference, before it has a place.
pub(crate) struct UnreadReason {
    pub(crate) kind: LoadErrorKind,
    pub(crate) what: String,
    pub(crate) remedy: &'static str,
}

pub(crate) struct Buffers {
    /// That of a GLB.
    binary: Option<Arc<[u8]>>,
    read: Vec<Option<Arc<[u8]>>>,
    /// The views that were compressed.
    decoded: HashMap<usize, Arc<[u8]>>,
    /// How many bytes were decoded of compressed primitives.
    pub(crate) unpacked: usize,
    /// What decoding them may cost.
    pub(crate) budget: Budget,
}

/// A buffer and the range of a view in it.
pub(crate) type Bytes = (Arc<[u8]>, Range<usize>);

impl Buffers {
    pub(crate) fn new(root: &Root, binary: Option<Arc<[u8]>>) -> Self {
        Self {
            binary,
            read: vec![None; root.buffers.len()],
            decoded: HashMap::new(),
            unpacked: 0,
            budget: Budget::default(),
        }
    }

    /// How many bytes the buffers that were needed so far have, and what was
    /// decoded of them.
    pub(crate) fn bytes_read(&self) -> usize {
        let bytes = self.read.iter().flatten().chain(self.decoded.values());
        bytes.map(|bytes| bytes.len()).sum::<usize>() + self.unpacked
    }

    /// The bytes of a buffer view, at a checked index. At least as long as the
    /// view claims.
    pub(crate) fn view(&mut self, root: &Root, index: usize, folder: &mut Folder) -> Result<Bytes, Unplaced> {
        let view = &root.buffer_views[index];
        if let Some(bytes) = self.decode(root, index, folder)? {
            let whole = 0..bytes.len();
            return Ok((bytes, whole));
        }
        let buffer = self.buffer(root, view.buffer.value(), folder)?;
        let start = view.byte_offset.map_or(0, |offset| offset.0) as usize;
        // Checked against the buffer's claim, and the claim against its bytes.
        Ok((buffer, start..start + view.byte_length.0 as usize))
    }

    /// The bytes of a compressed view; none when it is plain.
    fn decode(
        &mut self,
        root: &Root,
        index: usize,
        folder: &mut Folder,
    ) -> Result<Option<Arc<[u8]>>, Unplaced> {
        if let Some(bytes) = self.decoded.get(&index) {
            return Ok(Some(bytes.clone()));
        }
        let broken = |kind, what, remedy| {
            Unplaced(Location::Item("bufferView", index), UnreadReason { kind, what, remedy })
        };
        let malformed = |what| broken(LoadErrorKind::Malformed, what, "compress or export the model again");
        let Some(view) = compressed_view(root, index).map_err(malformed)? else { return Ok(None) };
        folder
            .account(view.decoded_length() as u64)
            .map_err(|refusal| broken(LoadErrorKind::Limit, refusal.to_string(), refusal.remedy()))?;
        let buffer = self.buffer(root, view.buffer, folder)?;
        let bytes: Arc<[u8]> = meshopt::decode(&view.layout, &buffer[view.range])
            .map_err(|why| malformed(format!("its compressed bytes are invalid: {why}")))?
            .into();
        self.decoded.insert(index, bytes.clone());
        Ok(Some(bytes))
    }

    /// The bytes of a buffer, at a checked index. At least as many as it claims.
    pub(crate) fn buffer(
        &mut self,
        root: &Root,
        index: usize,
        folder: &mut Folder,
    ) -> Result<Arc<[u8]>, Unplaced> {
        if let Some(bytes) = &self.read[index] {
            return Ok(bytes.clone());
        }
        let location = Location::Item("buffer", index);
        let claim = root.buffers[index].byte_length.0;
        let bytes: Arc<[u8]> = match (&root.buffers[index].uri, &self.binary) {
            (Some(uri), _) => read_reference(uri, folder, Lookup::Exact)
                .map_err(|unread| Unplaced(location.clone(), unread))?
                .0
                .into(),
            (None, Some(binary)) if index == 0 => Arc::clone(binary),
            (None, _) => {
                let what = "the buffer has no data".to_owned();
                return Err(Unplaced(
                    location,
                    UnreadReason {
                        kind: LoadErrorKind::Malformed,
                        what,
                        remedy: "export the model again, as GLB",
                    },
                ));
            }
        };
        if (bytes.len() as u64) < claim {
            let what = format!("the buffer has {} bytes and should have {claim}", bytes.len());
            return Err(Unplaced(
                location,
                UnreadReason {
                    kind: LoadErrorKind::Malformed,
                    what,
                    remedy: "export or download the model again",
                },
            ));
        }
        self.read[index] = Some(bytes.clone());
        Ok(bytes)
    }
}

/// Something unread, with its place in the document.
pub(crate) struct Unplaced(pub(crate) Location, pub(crate) UnreadReason);

impl Unplaced {
    pub(crate) fn into_error(self, path: &Path) -> LoadError {
        LoadError::new(self.1.kind, path, self.1.what, self.1.remedy).at(self.0)
    }
}

/// Reads what a URI leads to; the second value is another spelling that
/// was used for a file.
pub(crate) fn read_reference(
    uri: &str,
    folder: &mut Folder,
    lookup: Lookup,
) -> Result<(Vec<u8>, Option<String>), UnreadReason> {
    let quoted = quotable(uri);
    let unread = |kind, why: &dyn std::fmt::Display, remedy| UnreadReason {
        kind,
        what: format!("{quoted} is not read: {why}"),
        remedy,
    };
    match parse_reference(uri) {
        Err(why) => Err(unread(LoadErrorKind::Malformed, &why, "export the model again")),
        Ok(Reference::Data(bytes)) => {
            folder
                .account(bytes.len() as u64)
                .map_err(|refusal| unread(LoadErrorKind::Limit, &refusal, refusal.remedy()))?;
            Ok((bytes, None))
        }
        Ok(Reference::Path(names)) => read_file(&names, folder, lookup)
            .map_err(|refusal| unread(kind_of(&refusal), &refusal, refusal.remedy())),
    }
}

/// Reads the first file that one of several names leads to; the second value is another spelling that was used.
fn read_file(
    names: &FileNames,
    folder: &mut Folder,
    lookup: Lookup,
) -> Result<(Vec<u8>, Option<String>), Refusal> {
    let mut refused = None;
    // No guess comes before a name that is exact.
    for (lookup, name) in
        [Lookup::Exact, lookup].into_iter().flat_map(|way| names.all().map(move |name| (way, name)))
    {
        match folder.read(Path::new(""), name, lookup) {
            Ok(found) => {
                let is_guessed = found.respelled || names.encoded.as_deref() == Some(name);
                return Ok((found.bytes, is_guessed.then(|| found.path.display().to_string())));
            }
            Err(refusal) if refusal.is_of_a_file_that_is_there() => return Err(refusal),
            Err(refusal) => refused = refused.or(Some(refusal)),
        }
    }
    Err(refused.unwrap_or(Refusal::Missing))
}

fn kind_of(refusal: &Refusal) -> LoadErrorKind {
    if refusal.is_forbidden() { LoadErrorKind::Forbidden } else { LoadErrorKind::Read }
}

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
struct ViewExtension {
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
    let from: ViewExtension = serde_json::from_value(value)
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
