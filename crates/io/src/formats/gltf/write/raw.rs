//! The document that a scene came from as the start of the one being written, and JSON objects as text: a member that
//! is not set keeps its position, its digits and its spaces.

use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap};
use std::fmt;

use serde::de::{Deserializer, MapAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Serialize, Serializer};
use serde_json::value::{RawValue, to_raw_value};
use trigon_mesh::EditData;
use trigon_scene::{MeshId, Scene};

use super::draft::Draft;
use super::textures::mime_type;
use crate::gltf_source::GltfSource;

/// An object whose members are texts.
#[derive(Clone, Debug, Default)]
pub(super) struct RawObject {
    members: Vec<(String, Box<RawValue>)>,
    is_changed: bool,
}

impl RawObject {
    /// The object in a text; an empty one if it is none.
    pub(super) fn parse(text: &str) -> Self {
        serde_json::from_str(text).unwrap_or_default()
    }

    pub(super) fn get(&self, name: &str) -> Option<&str> {
        self.members.iter().find(|(known, _)| known == name).map(|(_, value)| value.get())
    }

    /// A member that is an object; an empty one if it is none.
    pub(super) fn object(&self, name: &str) -> Self {
        self.get(name).map(Self::parse).unwrap_or_default()
    }

    /// A member that is a list of anything; an empty one if it is none.
    pub(super) fn list(&self, name: &str) -> Vec<Box<RawValue>> {
        self.get(name).and_then(|text| serde_json::from_str(text).ok()).unwrap_or_default()
    }

    /// A member that is an index.
    pub(super) fn index(&self, name: &str) -> Option<usize> {
        self.get(name)?.parse().ok()
    }

    pub(super) fn set(&mut self, name: &str, value: &(impl Serialize + ?Sized)) {
        let value = raw(value);
        if self.get(name) == Some(value.get()) {
            return;
        }
        self.is_changed = true;
        match self.members.iter_mut().find(|(known, _)| known == name) {
            Some((_, old)) => *old = value,
            None => self.members.push((name.to_owned(), value)),
        }
    }

    /// Sets a member that is an object if it changed, or takes an empty one away.
    pub(super) fn set_object(&mut self, name: &str, value: &Self) {
        match value.is_empty() {
            true => self.remove(name),
            false if value.is_changed => self.set(name, value),
            false => {}
        }
    }

    pub(super) fn set_or_remove(&mut self, name: &str, value: Option<&impl Serialize>) {
        match value {
            Some(value) => self.set(name, value),
            None => self.remove(name),
        }
    }

    pub(super) fn remove(&mut self, name: &str) {
        let before = self.members.len();
        self.members.retain(|(known, _)| known != name);
        self.is_changed |= self.members.len() < before;
    }

    /// Whether it says something else than the text that it was read from.
    pub(super) fn is_changed(&self) -> bool {
        self.is_changed
    }

    pub(super) fn is_empty(&self) -> bool {
        self.members.is_empty()
    }

    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.members.iter().map(|(name, _)| name.as_str())
    }
}

/// The text of a value.
pub(super) fn raw(value: &(impl Serialize + ?Sized)) -> Box<RawValue> {
    to_raw_value(value).expect("it is made of numbers, texts, lists and maps by text")
}

impl Serialize for RawObject {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.members.len()))?;
        for (name, value) in &self.members {
            map.serialize_entry(name, value)?;
        }
        map.end()
    }
}

impl<'de> Deserialize<'de> for RawObject {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Members)
    }
}

struct Members;

impl<'de> Visitor<'de> for Members {
    type Value = RawObject;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<RawObject, A::Error> {
        let mut object = RawObject::default();
        while let Some((name, value)) = map.next_entry::<String, Box<RawValue>>()? {
            // Of members with one name the last counts; a search in each would be quadratic.
            object.members.push((name, value));
        }
        let mut known = std::collections::HashSet::new();
        object.members.reverse();
        object.members.retain(|(name, _)| known.insert(name.clone()));
        object.members.reverse();
        Ok(object)
    }
}

/// A file, and the scene as loaded: whatever is unchanged in a scene is unchanged in the file.
#[derive(Debug)]
pub(crate) struct RetainedFile {
    pub(crate) source: GltfSource,
    pub(crate) scene: Scene,
    pub(crate) edit_data: BTreeMap<MeshId, EditData>,
}

/// The new offset of a buffer's bytes.
#[derive(Clone, Copy)]
struct Moved {
    buffer: usize,
    offset: usize,
}

/// The document that a scene came from, as the start of the one being written: everything that is not changed
/// afterwards stays as it was, to the byte.
///
/// Only external parts have to change: buffers are merged into one, and images in separate files move into
/// it.
///
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_set_stays_as_it_is_written() {
        let mut object = RawObject::parse(r#"{"z":1.000 ,"a":[ 1e-400],"m":{"é\u00e9" : 2}}"#);
        object.set("a", &[0.1f32, -0.0]);
        object.remove("m");
        object.set("b", "x");
        assert_eq!(raw(&object).get(), r#"{"z":1.000,"a":[0.1,-0.0],"b":"x"}"#, "in its order");
        assert_eq!(RawObject::parse(r#"{"a":1,"a":2}"#).get("a"), Some("2"), "the last counts");
    }
}
