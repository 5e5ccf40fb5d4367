//! The document that a scene came from, as the start of the one being written: everything that is
//! not changed afterwards stays as it was, to the byte.
//!
//! Only external parts have to change: buffers are merged into one, and images in separate files
//! move into it.

use std::borrow::Cow;
use std::collections::HashMap;

use serde_json::value::RawValue;

use super::draft::Draft;
use super::raw::{RawObject, raw};
use super::textures::mime_type;
use crate::GltfSource;

/// The new offset of a buffer's bytes.
#[derive(Clone, Copy)]
struct Moved {
    buffer: usize,
    offset: usize,
}

/// A document with the contents of the file.
pub(super) fn draft_of(source: &GltfSource) -> Draft<'_> {
    let mut draft = Draft::from_top(RawObject::parse(source.json()));
    let moves = join_buffers(&mut draft, source);
    let views = std::mem::take(draft.list_mut("bufferViews"));
    let moved = views.into_iter().map(|view| moved_view(view, &moves));
    *draft.list_mut("bufferViews") = moved.collect();
    take_images_in(&mut draft, source);
    draft
}

fn join_buffers<'a>(draft: &mut Draft<'a>, source: &'a GltfSource) -> Vec<Moved> {
    let buffers = std::mem::take(draft.list_mut("buffers"));
    let (mut first, mut others, mut moves) = (None, Vec::new(), Vec::new());
    for (index, buffer) in buffers.into_iter().enumerate() {
        match source.buffer(index) {
            Some(bytes) => {
                first.get_or_insert(buffer);
                moves.push(Moved { buffer: 0, offset: draft.append(Cow::Borrowed(bytes)) });
            }
            // Stand-ins for compressed ones, and those that could not be read.
            None => {
                others.push(buffer);
                moves.push(Moved { buffer: others.len(), offset: 0 });
            }
        }
    }
    if first.is_some() || !others.is_empty() {
        others.insert(0, first.unwrap_or_else(|| raw(&RawObject::default())));
    }
    *draft.list_mut("buffers") = others;
    moves
}

/// A view with its new offset; the same text if it does not move.
fn moved_view(view: Box<RawValue>, moves: &[Moved]) -> Box<RawValue> {
    let is_still = |moved: &Moved| moved.buffer == 0 && moved.offset == 0;
    if moves.first().is_none_or(is_still) && moves.len() <= 1 {
        return view;
    }
    let mut object = RawObject::parse(view.get());
    let mut changed = move_within(&mut object, moves);
    let mut extensions = object.object("extensions");
    for name in ["EXT_meshopt_compression", "KHR_meshopt_compression"] {
        let mut compressed = extensions.object(name);
        if move_within(&mut compressed, moves) {
            extensions.set(name, &compressed);
            object.set("extensions", &extensions);
            changed = true;
        }
    }
    if changed { raw(&object) } else { view }
}

/// Updates references to a buffer and an offset in it; returns whether anything changed.
fn move_within(object: &mut RawObject, moves: &[Moved]) -> bool {
    let Some(buffer) = object.index("buffer") else { return false };
    let Some(moved) = moves.get(buffer).copied() else { return false };
    if moved.buffer != buffer {
        object.set("buffer", &moved.buffer);
    }
    if moved.offset > 0 {
        let offset = object.index("byteOffset").unwrap_or(0) + moved.offset;
        object.set("byteOffset", &offset);
    }
    moved.buffer != buffer || moved.offset > 0
}

/// Moves images in files or URIs into the buffer.
fn take_images_in<'a>(draft: &mut Draft<'a>, source: &'a GltfSource) {
    let mut views: HashMap<(usize, usize), usize> = HashMap::new();
    for index in 0..draft.list("images").len() {
        let mut image = draft.object("images", index);
        let Some(bytes) = source.image(index).filter(|_| image.get("uri").is_some()) else { continue };
        let Some(kind) = mime_type(bytes) else { continue };
        // Many images may be the same file.
        let key = (bytes.as_ptr().addr(), bytes.len());
        let view = *views.entry(key).or_insert_with(|| draft.view(Cow::Borrowed(bytes), None));
        image.remove("uri");
        image.set("bufferView", &view);
        image.set("mimeType", kind);
        draft.set("images", index, &image);
    }
}
