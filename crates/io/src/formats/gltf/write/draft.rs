//! A glTF document under construction: lists of objects, and the bytes of its only buffer.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::io::Write;
use std::ops::Range;

use gltf::json::accessor::{ComponentType, Type};
use serde::Serialize;
use serde_json::value::RawValue;

use super::raw::{RawObject, raw};
use crate::formats::gltf::triangle_hash::accessor_hash;
use crate::formats::gltf::triangle_hash::xxh64;
use crate::write::WriteError;

/// Views are aligned to this, the size of their largest number.
pub(super) const ALIGNMENT: usize = 8;

/// The WebGL target of a buffer view.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum BufferTarget {
    Vertices = 34962,
    Indices = 34963,
}

/// The extension with the list of lights.
pub(super) const LIGHTS: &str = "KHR_lights_punctual";

/// The lists are written in this order, after everything else.
const LISTS: &[&str] = &[
    "scenes",
    "nodes",
    "meshes",
    "skins",
    "animations",
    "cameras",
    "materials",
    "textures",
    "samplers",
    "images",
    "accessors",
    "bufferViews",
    "buffers",
];

/// A document under construction.
pub(super) struct Draft<'a> {
    /// All members except the lists.
    pub(super) top: RawObject,
    lists: BTreeMap<&'static str, Vec<Box<RawValue>>>,
    segments: Vec<Cow<'a, [u8]>>,
    length: usize,
    /// The extensions that its objects have.
    pub(super) extensions: BTreeSet<&'static str>,
    /// Those without which the file cannot be read.
    pub(super) required: BTreeSet<&'static str>,
    /// Of KHR_lights_punctual.
    lights: Vec<Box<RawValue>>,
    /// Of the accessors that were added; see [`accessor_hash`].
    pub(super) hashes: BTreeMap<usize, u64>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct View {
    buffer: usize,
    byte_offset: usize,
    byte_length: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    target: Option<u32>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Accessor<'m> {
    buffer_view: usize,
    component_type: u32,
    #[serde(rename = "type")]
    kind: &'static str,
    count: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    min: Option<&'m [f32]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    max: Option<&'m [f32]>,
}

impl<'a> Draft<'a> {
    /// A document with only a version.
    pub(super) fn new() -> Self {
        let mut top = RawObject::default();
        let mut asset = RawObject::default();
        asset.set("version", "2.0");
        asset.set("generator", concat!("trigon ", env!("CARGO_PKG_VERSION")));
        top.set("asset", &asset);
        Self::from_top(top)
    }

    /// A document with the members of another one, without its lists.
    pub(super) fn from_top(mut top: RawObject) -> Self {
        let top_lights = top.object("extensions").object(LIGHTS).list("lights");
        let mut lists = BTreeMap::new();
        for &list in LISTS {
            lists.insert(list, top.list(list));
            top.remove(list);
        }
        Self {
            top,
            lists,
            segments: Vec::new(),
            length: 0,
            extensions: BTreeSet::new(),
            required: BTreeSet::new(),
            lights: top_lights,
            hashes: BTreeMap::new(),
        }
    }

    pub(super) fn list(&self, list: &'static str) -> &[Box<RawValue>] {
        &self.lists[list]
    }

    pub(super) fn list_mut(&mut self, list: &'static str) -> &mut Vec<Box<RawValue>> {
        self.lists.get_mut(list).expect("all lists are there")
    }

    /// The text of an object in a list; empty if there is no such object.
    pub(super) fn object(&self, list: &'static str, index: usize) -> RawObject {
        self.lists[list].get(index).map(|item| RawObject::parse(item.get())).unwrap_or_default()
    }

    pub(super) fn push(&mut self, list: &'static str, item: &impl Serialize) -> usize {
        let items = self.list_mut(list);
        items.push(raw(item));
        items.len() - 1
    }

    pub(super) fn set(&mut self, list: &'static str, index: usize, item: &impl Serialize) {
        if let Some(old) = self.list_mut(list).get_mut(index) {
            *old = raw(item);
        }
    }

    /// Changes an object, if its text differs.
    pub(super) fn update(&mut self, list: &'static str, index: usize, item: &RawObject) {
        if item.is_changed() {
            self.set(list, index, item);
        }
    }

    /// Adds a light and returns its index.
    pub(super) fn light(&mut self, light: &RawObject) -> usize {
        self.extensions.insert(LIGHTS);
        self.lights.push(raw(light));
        self.lights.len() - 1
    }

    /// Appends bytes to the buffer and returns their offset.
    pub(super) fn append(&mut self, bytes: Cow<'a, [u8]>) -> usize {
        let start = self.length;
        let padding = bytes.len().next_multiple_of(ALIGNMENT) - bytes.len();
        self.length += bytes.len() + padding;
        self.segments.push(bytes);
        if padding > 0 {
            self.segments.push(Cow::Borrowed(&[0; ALIGNMENT][..padding]));
        }
        start
    }

    /// Removes bytes from the buffer: ranges in order, without overlap.
    pub(super) fn cut(&mut self, cuts: &[Range<usize>]) {
        let mut start = 0;
        let mut retained = Vec::with_capacity(self.segments.len() + cuts.len());
        for segment in std::mem::take(&mut self.segments) {
            let (mut at, end) = (start, start + segment.len());
            let first = cuts.partition_point(|cut| cut.end <= start);
            for cut in cuts[first..].iter().take_while(|cut| cut.start < end) {
                if cut.start > at {
                    retained.push(part(&segment, at - start..cut.start - start));
                }
                at = cut.end.min(end);
            }
            match at == start {
                true => retained.push(segment),
                false if at < end => retained.push(part(&segment, at - start..end - start)),
                false => {}
            }
            start = end;
        }
        self.segments = retained;
        self.length = self.segments.iter().map(|segment| segment.len()).sum();
    }

    /// Adds bytes, at least one, as a view.
    pub(super) fn view(&mut self, bytes: Cow<'a, [u8]>, target: Option<BufferTarget>) -> usize {
        let byte_length = bytes.len();
        let byte_offset = self.append(bytes);
        let target = target.map(|target| target as u32);
        self.push("bufferViews", &View { buffer: 0, byte_offset, byte_length, target })
    }

    /// Adds vectors of `N` numbers, at least one, with their bounds if `bounded`.
    pub(super) fn floats<const N: usize>(
        &mut self,
        values: &[[f32; N]],
        target: Option<BufferTarget>,
        bounded: Bounded,
    ) -> usize {
        let (kind, name) = match N {
            1 => (Type::Scalar, "SCALAR"),
            2 => (Type::Vec2, "VEC2"),
            3 => (Type::Vec3, "VEC3"),
            4 => (Type::Vec4, "VEC4"),
            _ => (Type::Mat4, "MAT4"),
        };
        let bounds = (bounded == Bounded::Yes).then(|| bounds(values));
        let bytes = float_bytes(values.as_flattened());
        let hash = accessor_hash(ComponentType::F32, kind, false, values.len(), xxh64(&bytes));
        let buffer_view = self.view(Cow::Owned(bytes), target);
        let accessor = Accessor {
            buffer_view,
            component_type: ComponentType::F32.as_gl_enum(),
            kind: name,
            count: values.len(),
            min: bounds.as_ref().map(|(min, _)| min.as_slice()),
            max: bounds.as_ref().map(|(_, max)| max.as_slice()),
        };
        let index = self.push("accessors", &accessor);
        self.hashes.insert(index, hash);
        index
    }

    /// Adds integers, at least one.
    pub(super) fn integers(&mut self, values: Integers<'_>, target: Option<BufferTarget>) -> usize {
        let (component, bytes, kind, name, count) = match values {
            Integers::Indices(list, limit) if limit <= u32::from(u16::MAX) => {
                let bytes = list.iter().flat_map(|&value| (value as u16).to_le_bytes()).collect();
                (ComponentType::U16, bytes, Type::Scalar, "SCALAR", list.len())
            }
            Integers::Indices(list, _) => {
                (ComponentType::U32, word_bytes(list), Type::Scalar, "SCALAR", list.len())
            }
            Integers::Joints(list) => {
                let bytes = list.as_flattened().iter().flat_map(|value| value.to_le_bytes()).collect();
                (ComponentType::U16, bytes, Type::Vec4, "VEC4", list.len())
            }
        };
        let hash = accessor_hash(component, kind, false, count, xxh64(&bytes));
        let buffer_view = self.view(Cow::Owned(bytes), target);
        let component_type = component.as_gl_enum();
        let accessor = Accessor { buffer_view, component_type, kind: name, count, min: None, max: None };
        let index = self.push("accessors", &accessor);
        self.hashes.insert(index, hash);
        index
    }

    /// The file.
    ///
    /// # Errors
    /// It would be larger than the format allows.
    pub(super) fn finish(mut self) -> Result<GlbFile<'a>, WriteError> {
        self.finish_extensions("extensionsUsed", &self.extensions.clone());
        self.finish_extensions("extensionsRequired", &self.required.clone());
        if self.extensions.contains(LIGHTS) {
            let mut extensions = self.top.object("extensions");
            let mut lights = extensions.object(LIGHTS);
            lights.set("lights", &self.lights);
            extensions.set(LIGHTS, &lights);
            self.top.set("extensions", &extensions);
        }
        self.finish_buffers();
        for &list in LISTS {
            let items = &self.lists[list];
            self.top.set_or_remove(list, Some(items).filter(|items| !items.is_empty()));
        }
        let mut json = serde_json::to_vec(&self.top).expect("texts are written");
        json.resize(json.len().next_multiple_of(4), b' ');
        let length = GlbFile::HEADERS + json.len() + self.length;
        if u32::try_from(length).is_err() {
            return Err(WriteError::TooLarge { bytes: length as u64 });
        }
        Ok(GlbFile { json, segments: self.segments, binary: self.length })
    }

    /// Adds names to a list of extensions that lacks them.
    fn finish_extensions(&mut self, list: &str, added: &BTreeSet<&'static str>) {
        let mut names = self.top.get(list).map(strings).unwrap_or_default();
        let known: BTreeSet<String> = names.iter().cloned().collect();
        names.extend(added.iter().filter(|name| !known.contains(**name)).map(|&name| name.to_owned()));
        if names.len() > known.len() {
            self.top.set(list, &names);
        }
    }

    /// The first buffer is that of the file; external ones come after it.
    fn finish_buffers(&mut self) {
        if self.length == 0 && self.lists["buffers"].len() > 1 {
            // The others keep their numbers.
            self.append(Cow::Borrowed(&[0; ALIGNMENT]));
        }
        let mut buffer = match self.lists["buffers"].is_empty() {
            true => RawObject::default(),
            false => self.object("buffers", 0),
        };
        buffer.remove("uri");
        buffer.set("byteLength", &self.length);
        match (self.length, self.lists["buffers"].is_empty()) {
            (0, _) => self.list_mut("buffers").clear(),
            (_, true) => drop(self.push("buffers", &buffer)),
            (_, false) => self.set("buffers", 0, &buffer),
        }
    }
}

fn part<'a>(segment: &Cow<'a, [u8]>, range: Range<usize>) -> Cow<'a, [u8]> {
    match segment {
        Cow::Borrowed(bytes) => Cow::Borrowed(&bytes[range]),
        Cow::Owned(bytes) => Cow::Owned(bytes[range].to_vec()),
    }
}

/// Whether an accessor has minimum and maximum.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Bounded {
    Yes,
    No,
}

/// Lists of integers as stored in glTF.
pub(super) enum Integers<'v> {
    /// The exclusive upper bound.
    Indices(&'v [u32], u32),
    Joints(&'v [[u16; 4]]),
}

pub(super) fn float_bytes(values: &[f32]) -> Vec<u8> {
    let mut bytes = vec![0; values.len() * 4];
    for (to, from) in bytes.as_chunks_mut::<4>().0.iter_mut().zip(values) {
        *to = from.to_le_bytes();
    }
    bytes
}

pub(super) fn word_bytes(values: &[u32]) -> Vec<u8> {
    let mut bytes = vec![0; values.len() * 4];
    for (to, from) in bytes.as_chunks_mut::<4>().0.iter_mut().zip(values) {
        *to = from.to_le_bytes();
    }
    bytes
}

fn strings(text: &str) -> Vec<String> {
    serde_json::from_str(text).unwrap_or_default()
}

/// The minimum and maximum of each component; the values are finite.
fn bounds<const N: usize>(values: &[[f32; N]]) -> ([f32; N], [f32; N]) {
    let first = values[0];
    values.iter().fold((first, first), |(mut min, mut max), value| {
        for component in 0..N {
            if value[component] < min[component] {
                min[component] = value[component];
            }
            if value[component] > max[component] {
                max[component] = value[component];
            }
        }
        (min, max)
    })
}

/// A GLB in parts.
pub(crate) struct GlbFile<'a> {
    /// Padded to 4 bytes.
    pub(crate) json: Vec<u8>,
    pub(crate) segments: Vec<Cow<'a, [u8]>>,
    /// The total size of the segments.
    pub(crate) binary: usize,
}

impl GlbFile<'_> {
    /// Of the file and its two chunks.
    pub(crate) const HEADERS: usize = 12 + 8 + 8;

    pub(crate) fn write_to(&self, writer: &mut dyn Write) -> io::Result<()> {
        let has_binary = self.binary > 0;
        let without = if has_binary { 0 } else { 8 };
        let length = Self::HEADERS - without + self.json.len() + self.binary;
        let word = |value: usize| (value as u32).to_le_bytes();
        writer.write_all(b"glTF\x02\0\0\0")?;
        writer.write_all(&word(length))?;
        writer.write_all(&word(self.json.len()))?;
        writer.write_all(b"JSON")?;
        writer.write_all(&self.json)?;
        if has_binary {
            writer.write_all(&word(self.binary))?;
            writer.write_all(b"BIN\0")?;
            for segment in &self.segments {
                writer.write_all(segment)?;
            }
        }
        Ok(())
    }

    pub(crate) fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(Self::HEADERS + self.json.len() + self.binary);
        self.write_to(&mut bytes).expect("memory takes every byte");
        bytes
    }
}
