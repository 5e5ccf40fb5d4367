//! Frees what meshes of trigon's own files leave behind when they are rewritten: without this, a
//! file would grow by a mesh each time it is opened, edited and saved. Meshes of any file leave the
//! declaration behind that they are compressed.
//!
//! Other objects keep their numbers: an unused accessor or view becomes the smallest valid one, and
//! its bytes are removed. Only objects that trigon wrote itself are considered, since unknown
//! extensions may refer to anything.

use std::collections::BTreeSet;
use std::ops::Range;

use serde_json::{Value, json};

use super::draft::{ALIGNMENT, Draft};
use super::raw::RawObject;
use crate::formats::gltf::native::{MEMBER, NativeHeader};
use crate::formats::gltf::packed::DRACO;

/// Accessors, views and declarations that may be unused now.
#[derive(Default)]
pub(super) struct Replaced {
    /// Whether there was a compressed primitive.
    was_packed: bool,
    accessors: BTreeSet<usize>,
    views: BTreeSet<usize>,
}

impl Replaced {
    /// Records a mesh that is about to be rewritten.
    pub(super) fn note(&mut self, mesh: &RawObject) {
        self.was_packed |= is_packed(mesh);
        let own = mesh.object("extras");
        let Some(header) = own.get(MEMBER).and_then(|own| serde_json::from_str::<NativeHeader>(own).ok())
        else {
            return;
        };
        self.views.extend(header.columns.values());
        for primitive in mesh.list("primitives") {
            let Ok(primitive) = serde_json::from_str(primitive.get()) else { continue };
            self.accessors.extend(accessors_of(&primitive));
        }
    }

    /// Frees what nothing in the document uses.
    pub(super) fn free(mut self, draft: &mut Draft<'_>) {
        if self.was_packed {
            forget_packed(draft);
        }
        if self.accessors.is_empty() && self.views.is_empty() {
            return;
        }
        // If it is nested too deeply to be read, it may use anything.
        let Some(used) = used_accessors(draft) else { return };
        self.accessors.retain(|accessor| !used.contains(accessor));
        for &accessor in &self.accessors {
            let object = draft.object("accessors", accessor);
            if object.get("sparse").is_none() {
                self.views.extend(object.index("bufferView"));
                let smallest = json!({"componentType": 5121, "type": "SCALAR", "count": 1});
                draft.set("accessors", accessor, &smallest);
            }
        }
        let Some(used) = used_views(draft) else { return };
        self.views.retain(|view| !used.contains(view));
        let cuts = cuts(draft, &self.views);
        draft.cut(&cuts);
        let cuts = Shift::new(&cuts);
        for index in 0..draft.list("bufferViews").len() {
            let mut view = draft.object("bufferViews", index);
            if self.views.contains(&index) {
                draft.set("bufferViews", index, &json!({"buffer": 0, "byteLength": 1}));
                continue;
            }
            shift(&mut view, &cuts);
            draft.update("bufferViews", index, &view);
        }
    }
}

/// The compressed forms of a mesh's primitives.
fn streams(mesh: &RawObject) -> impl Iterator<Item = RawObject> {
    let primitives = mesh.list("primitives").into_iter();
    let extensions = primitives.map(|primitive| RawObject::parse(primitive.get()).object("extensions"));
    extensions.filter_map(|extensions| extensions.get(DRACO).map(RawObject::parse))
}

fn is_packed(mesh: &RawObject) -> bool {
    streams(mesh).next().is_some()
}

/// Takes the extension of compressed primitives out of a document without any: others could not
/// read the file.
fn forget_packed(draft: &mut Draft<'_>) {
    if draft.list("meshes").iter().any(|mesh| is_packed(&RawObject::parse(mesh.get()))) {
        return;
    }
    for list in ["extensionsUsed", "extensionsRequired"] {
        let mut names = draft.top.list(list);
        names.retain(|name| serde_json::from_str::<String>(name.get()).is_ok_and(|name| name != DRACO));
        draft.top.set_or_remove(list, Some(&names).filter(|names| !names.is_empty()));
    }
}

/// Every number in a value, which includes all indices.
fn numbers(value: &Value, found: &mut Vec<usize>) {
    match value {
        Value::Number(number) => found.extend(number.as_u64().and_then(|n| usize::try_from(n).ok())),
        Value::Array(list) => list.iter().for_each(|item| numbers(item, found)),
        Value::Object(map) => map.values().for_each(|item| numbers(item, found)),
        _ => {}
    }
}

/// The accessors of a primitive.
fn accessors_of(primitive: &Value) -> Vec<usize> {
    let mut found = Vec::new();
    for member in ["attributes", "indices", "targets"] {
        numbers(primitive.get(member).unwrap_or(&Value::Null), &mut found);
    }
    found
}

/// The accessors used by meshes, skins, animations and instances; `None` if some of these cannot be
/// read.
fn used_accessors(draft: &Draft<'_>) -> Option<BTreeSet<usize>> {
    let mut used = Vec::new();
    for mesh in draft.list("meshes") {
        for primitive in RawObject::parse(mesh.get()).list("primitives") {
            used.extend(accessors_of(&serde_json::from_str(primitive.get()).ok()?));
        }
    }
    let members = [("skins", "inverseBindMatrices"), ("animations", "samplers"), ("nodes", "extensions")];
    for (list, member) in members {
        for item in draft.list(list) {
            if let Some(text) = RawObject::parse(item.get()).get(member) {
                numbers(&serde_json::from_str(text).ok()?, &mut used);
            }
        }
    }
    Some(used.into_iter().collect())
}

/// The views used by accessors, images and columns; `None` if some of these cannot be read.
fn used_views(draft: &Draft<'_>) -> Option<BTreeSet<usize>> {
    let mut used = Vec::new();
    for list in ["accessors", "images"] {
        for item in draft.list(list) {
            let object = RawObject::parse(item.get());
            used.extend(object.index("bufferView"));
            if let Some(sparse) = object.get("sparse") {
                numbers(&serde_json::from_str(sparse).ok()?, &mut used);
            }
        }
    }
    for mesh in draft.list("meshes") {
        let mesh = RawObject::parse(mesh.get());
        if let Some(own) = mesh.object("extras").get(MEMBER) {
            numbers(&serde_json::from_str(own).ok()?, &mut used);
        }
        used.extend(streams(&mesh).filter_map(|stream| stream.index("bufferView")));
    }
    Some(used.into_iter().collect())
}

/// The position of a view in the file's buffer.
fn range_of(view: &RawObject) -> Option<Range<usize>> {
    let start = view.index("byteOffset").unwrap_or(0);
    let end = start.checked_add(view.index("byteLength")?)?;
    (view.index("buffer") == Some(0)).then_some(start..end)
}

/// The bytes of views that no other view covers, in order, aligned so that the rest stays aligned.
fn cuts(draft: &Draft<'_>, views: &BTreeSet<usize>) -> Vec<Range<usize>> {
    let (mut gone, mut retained) = (Vec::new(), Vec::new());
    for (index, view) in draft.list("bufferViews").iter().enumerate() {
        let object = RawObject::parse(view.get());
        let into = if views.contains(&index) { &mut gone } else { &mut retained };
        into.extend(range_of(&object));
        let extensions = object.object("extensions");
        retained.extend(extensions.names().filter_map(|name| range_of(&extensions.object(name))));
    }
    let aligned =
        |range: Range<usize>| range.start.next_multiple_of(ALIGNMENT)..range.end.next_multiple_of(ALIGNMENT);
    let mut gone: Vec<Range<usize>> =
        gone.into_iter().map(aligned).filter(|range| !range.is_empty()).collect();
    gone.sort_unstable_by_key(|range| (range.start, range.end));
    gone.dedup_by(|next, before| next.start < before.end);
    retained.sort_unstable_by_key(|range| (range.start, range.end));
    // The largest end of all that start before.
    let mut ends: Vec<usize> = retained.iter().map(|range| range.end).collect();
    for index in 1..ends.len() {
        ends[index] = ends[index].max(ends[index - 1]);
    }
    gone.retain(|range| {
        let before = retained.partition_point(|other| other.start < range.end);
        before == 0 || ends[before - 1] <= range.start
    });
    gone
}

/// How far bytes move when preceding ones are removed.
struct Shift {
    /// The end of each removed range, and the number of bytes removed up to there.
    gone: Vec<(usize, usize)>,
}

impl Shift {
    fn new(cuts: &[Range<usize>]) -> Self {
        let sum = |gone: &mut usize, cut: &Range<usize>| {
            *gone += cut.len();
            Some((cut.end, *gone))
        };
        Self { gone: cuts.iter().scan(0, sum).collect() }
    }

    fn of(&self, start: usize) -> usize {
        match self.gone.partition_point(|(end, _)| *end <= start) {
            0 => 0,
            before => self.gone[before - 1].1,
        }
    }
}

/// Updates a view, and the references of its extensions to the buffer, to the new positions.
fn shift(view: &mut RawObject, by: &Shift) {
    shift_offset(view, by);
    let mut extensions = view.object("extensions");
    for name in ["EXT_meshopt_compression", "KHR_meshopt_compression"] {
        let mut compressed = extensions.object(name);
        shift_offset(&mut compressed, by);
        if compressed.is_changed() {
            extensions.set(name, &compressed);
            view.set("extensions", &extensions);
        }
    }
}

fn shift_offset(object: &mut RawObject, by: &Shift) {
    let Some(range) = range_of(object) else { return };
    let gone = by.of(range.start);
    if gone > 0 {
        object.set("byteOffset", &(range.start - gone));
    }
}
