//! Meshes: unchanged ones stay as in the file, others are rewritten.
//!
//! The materials of a scene belong to nodes, those of a glTF to meshes: a mesh that nodes draw with
//! different materials is written once for each combination, with shared accessors.

use std::borrow::Cow;
use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::value::RawValue;
use trigon_mesh::{EditData, Mesh, RenderMesh};
use trigon_scene::MeshId;

use super::draft::Draft;
use super::geometry::{GeometryPart, write_geometry, write_placeholder};
use super::raw::RetainedFile;
use super::raw::{RawObject, raw};
use crate::error::Location;
use crate::export::Loss;
use crate::formats::gltf::mesh::WireMaterials;
use crate::formats::gltf::native::{self, NativeHeader, columns_of_mesh};
use crate::formats::gltf::packed::DRACO;
use crate::formats::gltf::triangle_hash::TriangleHash;

/// A mesh in its current state.
pub(super) struct Shape<'a> {
    pub(super) mesh: &'a Mesh,
    /// If it is being edited.
    pub(super) edit_data: Option<&'a EditData>,
}

impl Shape<'_> {
    /// Whether it equals the file's mesh as it was read.
    pub(super) fn is_unchanged(&self, id: MeshId, retained: &RetainedFile) -> bool {
        let Some(asset) = retained.scene.meshes().get(id) else { return false };
        let none = EditData::default();
        let was = retained.edit_data.get(&id).unwrap_or(&none);
        let is_same_mesh = || std::ptr::eq(self.mesh, asset.mesh()) || *self.mesh == *asset.mesh();
        self.edit_data.is_none_or(|now| now == was) && is_same_mesh()
    }
}

#[derive(Serialize)]
struct Primitive<'p> {
    attributes: &'p BTreeMap<String, usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    indices: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    material: Option<usize>,
    #[serde(skip_serializing_if = "is_triangles")]
    mode: u32,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    targets: &'p [BTreeMap<&'static str, usize>],
}

fn is_triangles(mode: &u32) -> bool {
    *mode == 4
}

/// A mesh whose accessors are written.
pub(super) struct Written {
    /// The part that does not depend on materials.
    object: RawObject,
    form: Form,
    header: Option<NativeHeader>,
}

enum Form {
    /// Written anew.
    Parts(Vec<GeometryPart>),
    /// As the file has them, with the slot of each.
    Retained(Vec<(Box<RawValue>, Option<u32>)>),
}

impl Written {
    /// A mesh that is unchanged except for its materials.
    pub(super) fn retained(object: RawObject) -> Self {
        let primitives = object.list("primitives");
        let header = native_header(&object);
        let slots = match &header {
            Some(header) => header.slots.iter().map(|&slot| Some(slot)).collect(),
            None => slots_of(&primitives),
        };
        let slots = slots.into_iter().chain(std::iter::repeat(None));
        Self { object, form: Form::Retained(primitives.into_iter().zip(slots).collect()), header }
    }

    /// Writes the accessors of a mesh; `None` if there is nothing that a file for other programs could hold.
    pub(super) fn new(
        draft: &mut Draft<'_>,
        object: RawObject,
        shape: &Shape<'_>,
        is_native: bool,
    ) -> Option<Self> {
        let render = || RenderMesh::from_mesh(shape.mesh);
        let columns = || is_native.then(|| columns_of_mesh(shape.mesh, shape.edit_data));
        let (render, columns) = rayon::join(render, columns);
        let mut parts = write_geometry(draft, shape.mesh, &render);
        if parts.is_empty() && is_native {
            parts.push(write_placeholder(draft, shape.mesh));
        }
        if parts.is_empty() {
            return None;
        }
        let header = columns.map(|(writer, mut header)| {
            for (name, bytes) in writer.columns {
                header.columns.insert(name, draft.view(Cow::Owned(bytes), None));
            }
            header.slots = parts.iter().map(|part| part.slot).collect();
            header.triangles = hash_parts(draft, &parts);
            header
        });
        let mut object = object;
        write_extras(&mut object, shape.mesh);
        Some(Self { object, form: Form::Parts(parts), header })
    }

    /// The slots that its primitives use have these materials in the file.
    pub(super) fn has_materials(&self, materials: &[Option<usize>]) -> bool {
        let Form::Retained(primitives) = &self.form else { return false };
        if self.header.as_ref().is_some_and(|header| header.materials != materials) {
            return false;
        }
        primitives.iter().all(|(primitive, slot)| {
            let Some(slot) = slot else { return true };
            let material = RawObject::parse(primitive.get()).index("material");
            materials.get(*slot as usize).copied().flatten() == material
        })
    }

    /// The mesh in some materials.
    pub(super) fn in_materials(&self, materials: &[Option<usize>]) -> RawObject {
        let material = |slot: u32| materials.get(slot as usize).copied().flatten();
        let primitives: Vec<Box<RawValue>> = match &self.form {
            Form::Parts(parts) => {
                parts.iter().map(|part| raw(&primitive(part, material(part.slot)))).collect()
            }
            Form::Retained(retained) => retained
                .iter()
                .map(|(text, slot)| {
                    let mut primitive = RawObject::parse(text.get());
                    if let Some(slot) = slot {
                        primitive.set_or_remove("material", material(*slot).as_ref());
                    }
                    raw(&primitive)
                })
                .collect(),
        };
        let mut object = self.object.clone();
        object.set("primitives", &primitives);
        let mut extras = object.object("extras");
        match &self.header {
            Some(header) => {
                let header = NativeHeader { materials: materials.to_vec(), ..header.clone() };
                extras.set(native::MEMBER, &header);
                object.set("extras", &extras);
            }
            None if extras.get(native::MEMBER).is_some() => {
                extras.remove(native::MEMBER);
                object.set_object("extras", &extras);
            }
            None => {}
        }
        object
    }
}

fn primitive(part: &GeometryPart, material: Option<usize>) -> Primitive<'_> {
    let GeometryPart { mode, attributes, indices, targets, .. } = part;
    Primitive { attributes, indices: *indices, material, mode: *mode, targets }
}

fn hash_parts(draft: &Draft<'_>, parts: &[GeometryPart]) -> String {
    let mut hash = TriangleHash::default();
    for part in parts {
        hash.primitive(part.mode);
        for (name, accessor) in &part.attributes {
            hash.accessor(name, draft.hashes[accessor]);
        }
        if let Some(indices) = part.indices {
            hash.accessor("indices", draft.hashes[&indices]);
        }
        for (name, accessor) in part.targets.iter().flatten() {
            hash.accessor(name, draft.hashes[accessor]);
        }
    }
    hash.finish()
}

/// The native file's header of a mesh.
fn native_header(mesh: &RawObject) -> Option<NativeHeader> {
    serde_json::from_str(mesh.object("extras").get(native::MEMBER)?).ok()
}

/// The last kind of primitive: triangle fans.
const LAST_MODE: usize = 6;

/// The `mode` of primitives that have none: triangles.
const DEFAULT_MODE: usize = 4;

/// The greatest `mode` of lines and points.
const LAST_WIRE_MODE: usize = 3;

/// What the reader takes of a primitive to find its slot.
struct ReadPrimitive {
    material: Option<usize>,
    /// Whether it is lines or points.
    is_wire: bool,
}

impl ReadPrimitive {
    /// `None` for a primitive that is not read.
    fn new(text: &RawValue) -> Option<Self> {
        let primitive = RawObject::parse(text.get());
        primitive.object("attributes").get("POSITION")?;
        let mode = primitive.index("mode").unwrap_or(DEFAULT_MODE);
        let material = primitive.index("material");
        (mode <= LAST_MODE).then_some(Self { material, is_wire: mode <= LAST_WIRE_MODE })
    }
}

/// The slots of primitives as assigned by the reader: a new one for each material, that of lines and points first.
/// `None` for primitives that are not read, and for lines and points of several materials, which have no slot.
fn slots_of(primitives: &[Box<RawValue>]) -> Vec<Option<u32>> {
    let read: Vec<_> = primitives.iter().map(|text| ReadPrimitive::new(text)).collect();
    let of_wires = read.iter().flatten().filter(|primitive| primitive.is_wire);
    let wires = WireMaterials::of(of_wires.map(|primitive| primitive.material));
    let mut known: BTreeMap<Option<usize>, u32> =
        wires.first_slot().map(|first| (first, 0)).into_iter().collect();
    let mut slot = |primitive: ReadPrimitive| {
        if primitive.is_wire && wires == WireMaterials::Several {
            return None;
        }
        let next = known.len() as u32;
        Some(*known.entry(primitive.material).or_insert(next))
    };
    read.into_iter().map(|primitive| slot(primitive?)).collect()
}

/// The names of morph targets, if the file has others.
fn write_extras(object: &mut RawObject, mesh: &Mesh) {
    let names: Vec<&str> =
        mesh.attributes().morph_targets.iter().map(|target| target.name.as_str()).collect();
    let mut extras = object.object("extras");
    if names.iter().any(|name| !name.is_empty()) {
        extras.set("targetNames", &names);
    } else {
        extras.remove("targetNames");
    }
    object.set_object("extras", &extras);
}

/// What is lost when a mesh of a file is rewritten.
pub(super) fn losses(object: &RawObject, index: usize, mesh: &Mesh) -> Vec<Loss> {
    let mut losses = Vec::new();
    for (number, text) in object.list("primitives").iter().enumerate() {
        let primitive = RawObject::parse(text.get());
        let location = || Location::Named(format!("mesh {index}, primitive {number}"));
        for name in primitive.object("attributes").names().filter(|name| !is_held(name, mesh)) {
            losses.push(Loss { location: location(), what: format!("its attribute {name}") });
        }
        // Only how it is stored.
        for name in primitive.object("extensions").names().filter(|&name| name != DRACO) {
            losses.push(Loss { location: location(), what: format!("its extension {name}") });
        }
        if primitive.get("extras").is_some() {
            losses.push(Loss { location: location(), what: "its extras".to_owned() });
        }
    }
    losses
}

/// Whether a mesh of a scene has an attribute of a file.
fn is_held(name: &str, mesh: &Mesh) -> bool {
    let attributes = mesh.attributes();
    let Some((kind, number)) = name.rsplit_once('_') else {
        return match name {
            "POSITION" | "NORMAL" => true,
            "TANGENT" => attributes.corner_tangents.is_some(),
            _ => false,
        };
    };
    let below = |count: usize| number.parse::<usize>().is_ok_and(|number| number < count);
    match kind {
        "TEXCOORD" => below(attributes.uv_sets.len()),
        "COLOR" => below(usize::from(attributes.has_colors())),
        "JOINTS" | "WEIGHTS" => {
            below(attributes.skin.as_ref().map_or(0, |skin| skin.per_vertex().div_ceil(4)))
        }
        _ => false,
    }
}
