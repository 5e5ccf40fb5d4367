//! Wavefront OBJ and MTL.
//!
//! `lines` (pieces of the text) → `section` (one piece: `index`, `oddities`) → `parse` (all pieces
//! in parallel; `record` carries names and materials from one to the next) → `build` (polygons, one node for
//! each object or group). Materials and their images come from `mtl` and `convert` through
//! `library`. `write` is the other direction.
//!
//! The tests use the `tobj` crate as an oracle. The first reader used `tobj` and had to rewrite every line of the
//! file before passing it on. `tobj` stops at the first invalid byte without saying where, reads polylines as
//! polygons, and repeats the last texture coordinate where a corner has none (`tests/import/tobj_crate.rs` has all
//! cases). For a million triangles on one thread `tobj` takes 9.2 billion instructions and 258 MB besides the text.
//! This reader takes 4.7 billion and 168 MB up to the finished scene (example `obj_readers` under callgrind, `time
//! -v`).

mod build;
mod convert;
mod index;
mod library;
mod lines;
mod mtl;
mod mtl_reader;
mod oddities;
mod parse;
mod record;
mod section;
mod write;

use std::borrow::Cow;

use trigon_mesh::Mesh;
use trigon_scene::{Material, MaterialId, Node, Transform};

use self::build::ObjPart;
use self::library::Added;
use self::record::Record;
use crate::error::{LoadError, Location};
use crate::import::Import;
use crate::options::LoadStage;

pub(crate) use write::write_obj;

/// Reads an OBJ into the scene. Its text is given up as soon as it is parsed: it is
/// as large as everything that is made of it.
pub(crate) fn import_obj(import: &mut Import<'_>, bytes: Cow<'_, [u8]>) -> Result<(), LoadError> {
    let parsed = parse::parse(import.path, &bytes, import.options, &mut import.warnings)?;
    drop(bytes);
    let (count, limit) = (parsed.record.parts.list().len(), import.options.limits.nodes);
    if count > limit {
        return Err(LoadError::limit(
            import.path,
            format!("it has {count} groups; the limit is {limit} nodes"),
        ));
    }
    let follow = |share| {
        import.options.report(import.path, LoadStage::Geometry, parse::READ + (1.0 - parse::READ) * share)
    };
    let (parts, offset) = build::build_parts(&parsed, &mut import.warnings, &follow)?;
    import.options.report(import.path, LoadStage::Geometry, 1.0)?;
    let has_colors = !parsed.content.colors.is_empty();
    let record = parsed.record;
    let materials = library::add_materials(import, &record)?;
    let mut plain = PlainMaterial { id: None, has_colors };
    let transform = Transform::from_translation(offset);
    let stem = import
        .path
        .file_stem()
        .map_or_else(|| "object".to_owned(), |stem| stem.to_string_lossy().into_owned());
    for mut part in parts {
        if part.name.is_empty() {
            part.name.clone_from(&stem);
        }
        let added: Vec<Option<Added>> = part
            .materials
            .iter()
            .map(|material| material.and_then(|index| materials[index as usize]))
            .collect();
        warn_of_bare_faces(import, &record, &part, &added);
        let materials: Vec<MaterialId> =
            added.iter().map(|added| added.map_or_else(|| plain.id(import), |added| added.id)).collect();
        add_tangents(import, &mut part.mesh, &materials);
        let mesh = import.scene.add_mesh(part.name.clone(), part.mesh);
        let mut node = Node::default().with_name(part.name).with_transform(transform);
        (node.mesh, node.materials) = (Some(mesh), materials);
        import.scene.add(node);
    }
    Ok(())
}

/// A texture is placed by texture coordinates, and some faces have none.
fn warn_of_bare_faces(import: &mut Import<'_>, record: &Record, part: &ObjPart, added: &[Option<Added>]) {
    for ((added, &is_bare), material) in added.iter().zip(&part.bare).zip(&part.materials) {
        if let (true, Some(index), Some(Added { is_textured: true, .. })) = (is_bare, material, added) {
            import.warnings.push(
                Location::Line(record.material_lines[*index as usize]),
                "a material with textures is on faces without texture coordinates, which cannot show them",
                "export the texture coordinates (vt), too",
            );
        }
    }
}

/// Normal maps refer to tangents, which OBJ does not have.
fn add_tangents(import: &Import<'_>, mesh: &mut Mesh, materials: &[MaterialId]) {
    let has_normal_map = |&id: &MaterialId| {
        import.scene.materials.get(id).is_some_and(|material| material.normal_map.is_some())
    };
    if !materials.iter().any(has_normal_map) {
        return;
    }
    if let Some(tangents) = mesh.generate_tangents(0) {
        mesh.set_corner_tangents(tangents).expect("there is one a corner");
    }
}

/// The material of faces that have none, made when the first asks.
struct PlainMaterial {
    id: Option<MaterialId>,
    has_colors: bool,
}

impl PlainMaterial {
    fn id(&mut self, import: &mut Import<'_>) -> MaterialId {
        let mut material = Material::default().with_name("default");
        if self.has_colors {
            // Vertex colours are to be seen as they are.
            material.base_color = trigon_math::Vec4::ONE;
        }
        *self.id.get_or_insert_with(|| import.scene.add_material(material))
    }
}
