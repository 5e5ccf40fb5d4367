//! The editor's additions to a standard glTF file: `extras.trigon` of meshes, nodes and materials.
//!
//! A mesh names buffer views with its polygons, its exact values and its marks ([`NativeHeader`]), and
//! the hash of the triangles that represent them. If another program changed the triangles, the
//! hash differs, and the triangles are used. Transforms need nothing here: numbers in glTF are
//! decimal, so a node's own members hold all digits of an f64.

mod columns;

use std::collections::{BTreeMap, BTreeSet, HashMap};

use gltf::json::mesh::Primitive;
use gltf::json::validation::Checked;
use serde::de::{DeserializeOwned, Deserializer};
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use trigon_mesh::{EditData, Mesh};

use self::columns::{ColumnReader, mesh_from_columns};
use super::accessor::{Accessors, TightBytes, valid};
use super::buffers::{Bytes, Unplaced};
use super::triangle_hash::xxh64;
use super::triangle_hash::{TriangleHash, accessor_hash};
use crate::error::{LoadErrorKind, Location};

pub(super) use columns::columns_of_mesh;

/// The member of `extras`.
pub(super) const MEMBER: &str = "trigon";

/// The version that is written, and the latest that is read.
pub(super) const VERSION: u32 = 1;

/// A mesh as modelled.
pub(super) struct NativeMesh {
    pub(super) mesh: Mesh,
    /// The material of each slot.
    pub(super) materials: Vec<Option<usize>>,
    /// Only if it was being edited.
    pub(super) edit_data: Option<EditData>,
}

/// Reads the mesh that a header describes; an error in words if its triangles must be used instead.
pub(super) fn read_native_mesh(
    accessors: &mut Accessors<'_>,
    index: usize,
    header: &NativeHeader,
) -> Result<Result<NativeMesh, String>, Unplaced> {
    let root = accessors.root;
    let primitives = &root.meshes[index].primitives;
    if header.version > VERSION {
        return Ok(Err("a newer version of trigon wrote its polygons".to_owned()));
    }
    let targets = |primitive: &Primitive| primitive.targets.as_ref().map_or(0, Vec::len);
    if header.slots.len() != primitives.len() || primitives.iter().any(|p| targets(p) != header.targets) {
        return Ok(Err(CHANGED.to_owned()));
    }
    let Some(triangles) = fetch_triangles(accessors, primitives)? else { return Ok(Err(CHANGED.to_owned())) };
    let columns = match fetch_columns(accessors, index, header) {
        Ok(Ok(columns)) => columns,
        Ok(Err(why)) => return Ok(Err(why)),
        Err(unplaced) if unplaced.1.kind == LoadErrorKind::Limit => return Err(unplaced),
        Err(unplaced) => return Ok(Err(format!("its polygons cannot be read: {}", unplaced.1.what))),
    };
    // The hash takes as long as a third of the rest.
    let (hash, built) = rayon::join(|| hash_triangles(primitives, &triangles), || build(header, &columns));
    if hash != header.triangles {
        return Ok(Err(CHANGED.to_owned()));
    }
    let materials = slot_materials(header, primitives, root.materials.len());
    Ok(built.map(|(mesh, edit_data)| NativeMesh { mesh, materials, edit_data }))
}

const CHANGED: &str = "another program changed its triangles";

/// The bytes of all accessors of a mesh, by their index; `None` if another program wrote them,
/// since trigon writes no gaps.
fn fetch_triangles(
    accessors: &mut Accessors<'_>,
    primitives: &[Primitive],
) -> Result<Option<HashMap<usize, TightBytes>>, Unplaced> {
    let mut found = HashMap::new();
    for primitive in primitives {
        for (_, accessor) in named_accessors(primitive) {
            if found.contains_key(&accessor) {
                continue;
            }
            match accessors.tight_bytes(accessor) {
                Ok(Some(bytes)) => drop(found.insert(accessor, bytes)),
                Err(unplaced) if unplaced.1.kind == LoadErrorKind::Limit => return Err(unplaced),
                Ok(None) | Err(_) => return Ok(None),
            }
        }
    }
    Ok(Some(found))
}

/// The accessors of a primitive in the order in which they are hashed.
fn named_accessors(primitive: &Primitive) -> Vec<(String, usize)> {
    let mut names: BTreeMap<String, usize> = BTreeMap::new();
    for (semantic, accessor) in &primitive.attributes {
        if let Checked::Valid(semantic) = semantic {
            names.insert(semantic.to_string(), accessor.value());
        }
    }
    let mut list: Vec<(String, usize)> = names.into_iter().collect();
    list.extend(primitive.indices.map(|indices| ("indices".to_owned(), indices.value())));
    for target in primitive.targets.iter().flatten() {
        let parts =
            [("NORMAL", target.normals), ("POSITION", target.positions), ("TANGENT", target.tangents)];
        let named = |(name, accessor): (&str, Option<gltf::json::Index<gltf::json::Accessor>>)| {
            Some((name.to_owned(), accessor?.value()))
        };
        list.extend(parts.into_iter().filter_map(named));
    }
    list
}

fn hash_triangles(primitives: &[Primitive], bytes: &HashMap<usize, TightBytes>) -> String {
    let mut hashes: HashMap<usize, u64> = HashMap::new();
    let mut hash = TriangleHash::default();
    for primitive in primitives {
        hash.primitive(valid(&primitive.mode).map_or(u32::MAX, |mode| mode.as_gl_enum()));
        for (name, accessor) in named_accessors(primitive) {
            let of_accessor = hashes.entry(accessor).or_insert_with(|| {
                let tight = &bytes[&accessor];
                let elements = xxh64(&tight.bytes.0[tight.bytes.1.clone()]);
                accessor_hash(tight.component, tight.kind, tight.normalized, tight.count, elements)
            });
            hash.accessor(&name, *of_accessor);
        }
    }
    hash.finish()
}

/// The bytes of all columns that a header names.
fn fetch_columns(
    accessors: &mut Accessors<'_>,
    index: usize,
    header: &NativeHeader,
) -> Result<Result<BTreeMap<String, Bytes>, String>, Unplaced> {
    let root = accessors.root;
    let mut columns = BTreeMap::new();
    for (name, &view) in &header.columns {
        if view >= root.buffer_views.len() {
            return Ok(Err(format!("its {name} are in bufferView {view}, which does not exist")));
        }
        let bytes = accessors.buffers.view(root, view, accessors.folder)?;
        // At least the smallest value of a column.
        accessors.spend(bytes.1.len() / 12, &Location::Item("mesh", index))?;
        columns.insert(name.clone(), bytes);
    }
    Ok(Ok(columns))
}

fn build(
    header: &NativeHeader,
    columns: &BTreeMap<String, Bytes>,
) -> Result<(Mesh, Option<EditData>), String> {
    let find = |name: &str| columns.get(name).map(|(buffer, range)| &buffer[range.clone()]);
    let mut reader = ColumnReader::new(header, &find);
    let built = mesh_from_columns(&mut reader, header)?;
    // Even an intact column may belong to another mesh: views may have been renumbered.
    if reader.hash() == header.data {
        return Ok(built);
    }
    Err("its polygons are not those that were written".to_owned())
}

/// The material of each slot: the current one of its primitive, or otherwise the stored one.
fn slot_materials(header: &NativeHeader, primitives: &[Primitive], count: usize) -> Vec<Option<usize>> {
    let known = |material: &Option<usize>| material.filter(|&material| material < count);
    let mut materials: Vec<Option<usize>> = header.materials.iter().map(known).collect();
    for (&slot, primitive) in header.slots.iter().zip(primitives) {
        if let Some(material) = materials.get_mut(slot as usize) {
            *material = primitive.material.map(|material| material.value());
        }
    }
    materials
}

/// The member of `extras` of some object.
#[derive(Clone, Debug, Default)]
pub(super) enum Extras<T> {
    /// It does not exist.
    #[default]
    Absent,
    /// It exists but cannot be parsed.
    Broken,
    Present(T),
}

impl<T> Extras<T> {
    pub(super) fn get(&self) -> Option<&T> {
        match self {
            Self::Present(value) => Some(value),
            Self::Absent | Self::Broken => None,
        }
    }
}

impl<'de, T: DeserializeOwned> Deserialize<'de> for Extras<T> {
    /// Parses any value, at any depth, without recursion.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        struct Members {
            #[serde(default)]
            trigon: Option<Box<RawValue>>,
        }
        let text = Box::<RawValue>::deserialize(deserializer)?;
        let members = serde_json::from_str::<Members>(text.get());
        let Some(own) = members.ok().and_then(|members| members.trigon) else { return Ok(Self::Absent) };
        Ok(serde_json::from_str(own.get()).map_or(Self::Broken, Self::Present))
    }
}

/// Of a mesh.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct NativeHeader {
    pub(super) version: u32,
    /// The hash of the triangles; see `triangle_hash`.
    pub(super) triangles: String,
    /// The hash of the columns.
    pub(super) data: String,
    /// Views by the names of columns.
    pub(super) columns: BTreeMap<String, usize>,
    /// The material slot of each primitive.
    pub(super) slots: Vec<u32>,
    /// The material of each slot: for those without a primitive.
    pub(super) materials: Vec<Option<usize>>,
    /// How many joints the skin has for each vertex.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) joints_per_vertex: Option<usize>,
    /// How many morph targets there are.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub(super) targets: usize,
    /// Columns that exist without values: views have at least one byte.
    #[serde(default, skip_serializing_if = "BTreeSet::is_empty")]
    pub(super) empty: BTreeSet<String>,
    /// Whether the mesh was being edited, and so has edit data.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(super) edited: bool,
    /// The names of the vertex groups of an edited mesh.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) groups: Vec<String>,
    /// The stack of modifiers of an edited mesh.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) modifiers: Option<Box<RawValue>>,
    /// Of a file of an older version, which knew one modifier: in how many Catmull-Clark levels the mesh is shown.
    #[serde(default, skip_serializing)]
    pub(super) subdivision: u32,
}

fn is_zero(number: &usize) -> bool {
    *number == 0
}

fn is_nothing(number: &f32) -> bool {
    *number == 0.0
}

/// Of a node.
#[derive(Clone, Debug, Default, Deserialize, Serialize, PartialEq)]
pub(super) struct NodeExtras {
    pub(super) version: u32,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(super) hidden: bool,
    /// The light, if it is of a kind that the format lacks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) ambient: Option<AmbientExtras>,
    /// The radius of its light, which the format lacks.
    #[serde(default, skip_serializing_if = "is_nothing")]
    pub(super) radius: f32,
}

/// Ambient light.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize, PartialEq)]
pub(super) struct AmbientExtras {
    pub(super) color: [f32; 3],
    pub(super) intensity: f32,
}

/// Of a material.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(super) struct MaterialExtras {
    pub(super) version: u32,
    pub(super) shading: ExactShading,
}

/// The shading models that the format lacks.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, PartialEq)]
#[serde(rename_all = "camelCase", tag = "model")]
pub(super) enum ExactShading {
    Lambert,
    /// Its texture is the specular colour's.
    BlinnPhong {
        specular: [f32; 3],
        shininess: f32,
    },
}
