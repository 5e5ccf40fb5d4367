//! Meshes of native files: polygons and marks, as long as the triangles are those that were written
//! with them.

use std::collections::{BTreeMap, HashMap};

use gltf::json::mesh::Primitive;
use gltf::json::validation::Checked;
use trigon_mesh::{EditData, Mesh};

use super::columns::{ColumnReader, mesh_from_columns};
use super::extras::Header;
use crate::error::{LoadErrorKind, Location};
use crate::formats::gltf::accessor::{Accessors, TightBytes, valid};
use crate::formats::gltf::buffers::{Bytes, Unplaced};
use crate::formats::gltf::hash::xxh64;
use crate::formats::gltf::triangle_hash::{TriangleHash, accessor_hash};

/// A mesh as modelled.
pub(in crate::formats::gltf) struct NativeMesh {
    pub(in crate::formats::gltf) mesh: Mesh,
    /// The material of each slot.
    pub(in crate::formats::gltf) materials: Vec<Option<usize>>,
    /// Only if it was being edited.
    pub(in crate::formats::gltf) edit_data: Option<EditData>,
}

/// Reads the mesh that a header describes; an error in words if its triangles must be used instead.
pub(in crate::formats::gltf) fn read_native_mesh(
    accessors: &mut Accessors<'_>,
    index: usize,
    header: &Header,
) -> Result<Result<NativeMesh, String>, Unplaced> {
    let root = accessors.root;
    let primitives = &root.meshes[index].primitives;
    if header.version > super::VERSION {
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
    header: &Header,
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

fn build(header: &Header, columns: &BTreeMap<String, Bytes>) -> Result<(Mesh, Option<EditData>), String> {
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
fn slot_materials(header: &Header, primitives: &[Primitive], count: usize) -> Vec<Option<usize>> {
    let known = |material: &Option<usize>| material.filter(|&material| material < count);
    let mut materials: Vec<Option<usize>> = header.materials.iter().map(known).collect();
    for (&slot, primitive) in header.slots.iter().zip(primitives) {
        if let Some(material) = materials.get_mut(slot as usize) {
            *material = primitive.material.map(|material| material.value());
        }
    }
    materials
}
