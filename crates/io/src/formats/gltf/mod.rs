//! glTF 2.0 and GLB.
//!
//! A file passes through these modules in this order:
//!
//! 1. `container` takes a GLB apart; `document` parses the JSON, after a first look by `preview`.
//! 2. `preview` (its extensions), `references` and `hierarchy` check the document and may refuse it;
//!    `contradictions` only warns.
//! 3. `mesh` reads the meshes, with `accessor` and `buffers`; `buffers` and `packed` lead to the
//!    decoders `meshopt` and `draco`. `native` reads the meshes of the editor's files.
//! 4. `materials` reads the materials, with `slots` and `images`; before, `variants` chose them and
//!    `specular_glossiness` translated them.
//! 5. `nodes` adds the nodes, with instances from `hierarchy`; then come `skins` and `animations`.
//!
//! [`gltf_source`](crate::gltf_source) keeps the file itself on request. Everything is checked before
//! it is followed, and nothing is recursive.

mod accessor;
mod animations;
mod buffers;
mod container;
mod contradictions;
mod document;
mod draco;
mod formats;
mod hierarchy;
mod images;
mod keep;
mod lights;
mod material_extensions;
mod materials;
mod mesh;
mod meshopt;
mod native;
mod nodes;
mod packed;
mod preview;
mod primitive;
mod references;
mod skins;
mod slots;
mod specular_glossiness;
mod stream;
mod triangle_hash;
mod variants;
mod write;

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::sync::Arc;

use gltf::json::Root;
use trigon_mesh::Mesh;

use self::formats::AccessorReader;
use accessor::{Accessors, Doubts};
use buffers::{Buffers, Unplaced};
use document::Document;
use hierarchy::Hierarchy;
use mesh::{BuiltMesh, Needs};
use native::Extras;

pub(crate) use write::{GlbFile, Input, RetainedFile, mime_type, write_scene};
pub use write::{encode_glb, write_glb};

use crate::error::{LoadError, LoadErrorKind, Location};
use crate::import::Import;
use crate::options::LoadStage;
use crate::warning::Warnings;

/// Reads a binary glTF into the scene.
pub(crate) fn import_glb(import: &mut Import<'_>, bytes: Cow<'_, [u8]>) -> Result<(), LoadError> {
    let container = container::open_glb(import.path, &bytes, &mut import.warnings)?;
    let (json, binary) = (container.json.to_vec(), container.binary.map(Arc::from));
    // Held once while meshes are made of it.
    drop(bytes);
    import_parts(import, &json, binary)
}

/// Reads a glTF that is plain JSON into the scene.
pub(crate) fn import_gltf(import: &mut Import<'_>, bytes: &[u8]) -> Result<(), LoadError> {
    import_parts(import, bytes, None)
}

fn import_parts(import: &mut Import<'_>, json: &[u8], binary: Option<Arc<[u8]>>) -> Result<(), LoadError> {
    let mut document = document::parse_document(import.path, json)?;
    prepare_materials(import, &mut document.root)?;
    let root = &document.root;
    preview::check_extensions(import.path, root, &document.extensions, &mut import.warnings)?;
    references::check_references(import.path, root)?;
    let hierarchy = hierarchy::find_hierarchy(import.path, root, import.options)?;
    import.warnings.push_counted(
        document.unbounded,
        Location::Whole,
        "a number is too large for 32 bits of floating point and is taken as 0",
        "export the model again",
    );
    variants::warn_of_variants(root, &mut import.warnings);
    contradictions::warn_of_contradictions(&document, &hierarchy, &mut import.warnings);
    import.scene_names = hierarchy::scene_names(root);
    let mut buffers = Buffers::new(root, binary);
    let mut spent = 0;
    let mut meshes = build_meshes(import, &document, &hierarchy, &mut buffers, &mut spent)?;
    let used: BTreeSet<Option<usize>> =
        meshes.iter().flatten().flat_map(|mesh| mesh.materials.iter().copied()).collect();
    let used: Vec<Option<usize>> = used.into_iter().collect();
    let materials = materials::add_materials(import, &document, &mut buffers, &used)?;
    let primitives = keep::take_primitives(import, &mut meshes);
    let placed = nodes::add_nodes(import, &mut document, &hierarchy, meshes, &materials);
    keep::keep_placed(import, &placed, primitives, &materials);
    keep::keep_scene(import, hierarchy.scene);
    let mut reader = AccessorReader { root: &placed.document.root, buffers, spent };
    nodes::add_instances(import, &mut reader, &placed)?;
    skins::add_skins(import, &mut reader, &placed)?;
    animations::add_animations(import, &mut reader, &placed)?;
    keep::keep_file(import, json, &placed, &mut reader.buffers);
    Ok(())
}

/// Puts materials in the terms that all others use, and those of the chosen variant in place.
fn prepare_materials(import: &mut Import<'_>, root: &mut Root) -> Result<(), LoadError> {
    specular_glossiness::translate(root);
    import.variant_names = variants::variant_names(root);
    match &import.options.variant {
        Some(wanted) => variants::choose_variant(import.path, root, wanted),
        None => Ok(()),
    }
}

/// The meshes that the nodes use, by their index in the document.
fn build_meshes(
    import: &mut Import<'_>,
    document: &Document,
    hierarchy: &Hierarchy,
    buffers: &mut Buffers,
    spent: &mut usize,
) -> Result<Vec<Option<BuiltMesh>>, LoadError> {
    let root = &document.root;
    let mut meshes: Vec<Option<BuiltMesh>> = root.meshes.iter().map(|_| None).collect();
    let used: BTreeSet<usize> =
        hierarchy.order.iter().filter_map(|&node| Some(root.nodes[node].mesh?.value())).collect();
    let limits = &import.options.limits;
    let mut drawable = false;
    for (done, &index) in used.iter().enumerate() {
        import.options.report(import.path, LoadStage::Geometry, done as f32 / used.len() as f32)?;
        let most = limits.vertices.max(limits.corners);
        let mut accessors = Accessors {
            root,
            buffers,
            folder: &mut import.folder,
            most,
            most_corners: limits.corners,
            spent,
            unpacked: None,
            doubts: Doubts::default(),
        };
        let needs = |material| Needs::of(&materials::slot_textures_of(root, material));
        let names = document.target_names.get(index).map_or(&[][..], Vec::as_slice);
        let extras = document.native_meshes.get(index).unwrap_or(&Extras::Absent);
        let native = native_mesh(&mut accessors, index, extras, names, &mut import.warnings)
            .map_err(|unplaced| unplaced.into_error(import.path))?;
        let built = match native {
            Some(built) => built,
            None => mesh::build_mesh(&mut accessors, index, names, &needs, &mut import.warnings)
                .map_err(|unplaced| unplaced.into_error(import.path))?,
        };
        accessors.doubts.tell(&mut import.warnings);
        let mesh = &built.mesh;
        if mesh.vertex_count() > limits.vertices {
            let what = format!("it has more than {} vertices", limits.vertices);
            return Err(LoadError::limit(import.path, what).at(Location::Item("mesh", index)));
        }
        drawable |= mesh.face_count() + mesh.loose_edges().len() + mesh.loose_points().len() > 0;
        meshes[index] = Some(built);
    }
    if !drawable && !import.options.may_be_empty {
        return Err(nothing(import, root, used.len()));
    }
    check_placed(import, root, hierarchy, &meshes)?;
    Ok(meshes)
}

/// A mesh of a native file as it was modelled; none of others, and none, with a warning, if
/// its triangles are to be used instead.
fn native_mesh(
    accessors: &mut Accessors<'_>,
    index: usize,
    extras: &Extras<native::NativeHeader>,
    target_names: &[String],
    warnings: &mut Warnings,
) -> Result<Option<BuiltMesh>, Unplaced> {
    let read = match extras {
        Extras::Absent => return Ok(None),
        Extras::Broken => Err("the description of its polygons is invalid".to_owned()),
        Extras::Present(header) => native::read_native_mesh(accessors, index, header)?,
    };
    let native = match read {
        Ok(native) => native,
        Err(why) => {
            let what = format!("{why}; they are read without polygons, marks and original positions");
            warnings.push(
                Location::Item("mesh", index),
                what,
                "open the file that trigon saved if you need these",
            );
            return Ok(None);
        }
    };
    let native::NativeMesh { mut mesh, materials, edit_data } = native;
    let mut attributes = mesh.attributes().clone();
    for (target, name) in attributes.morph_targets.iter_mut().zip(target_names) {
        target.name.clone_from(name);
    }
    if !attributes.morph_targets.is_empty() {
        mesh.set_attributes(attributes).expect("only names are others");
    }
    Ok(Some(BuiltMesh { mesh, materials, primitives: Vec::new(), edit_data }))
}

/// Holds what the nodes place to the limit: many copies of one mesh take no
/// memory here, but the image needs every one.
fn check_placed(
    import: &Import<'_>,
    root: &Root,
    hierarchy: &Hierarchy,
    meshes: &[Option<BuiltMesh>],
) -> Result<(), LoadError> {
    let corners =
        |mesh: &Mesh| mesh.corner_count() + 2 * mesh.loose_edges().len() + mesh.loose_points().len();
    let each: Vec<usize> =
        meshes.iter().map(|built| built.as_ref().map_or(0, |built| corners(&built.mesh))).collect();
    let (mut placed, mut copies, limit) = (0_usize, 0_usize, import.options.limits.corners);
    for &node in &hierarchy.order {
        let times = hierarchy::instance_count(root, node);
        // They are nodes of their own, below the file's.
        copies = copies.saturating_add(if hierarchy::has_instances(root, node) { times } else { 0 });
        let corners = root.nodes[node].mesh.map_or(0, |mesh| each[mesh.value()]);
        placed = placed.saturating_add(corners.saturating_mul(times));
        if placed > limit {
            let what = format!("with it, the nodes place more than {limit} corners");
            return Err(LoadError::limit(import.path, what).at(Location::Item("node", node)));
        }
    }
    let nodes = hierarchy.order.len().saturating_add(copies);
    if nodes > import.options.limits.nodes {
        let what =
            format!("with its instances it has {nodes} nodes; the limit is {}", import.options.limits.nodes);
        return Err(LoadError::limit(import.path, what));
    }
    Ok(())
}

/// Why there is nothing to draw: the first warning is usually the reason.
fn nothing(import: &Import<'_>, root: &Root, used: usize) -> LoadError {
    let reason = match (root.meshes.len(), used, import.warnings.first()) {
        (0, ..) => "the file has no meshes".to_owned(),
        (count, 0, _) => format!("no node of its scene places one of its {count} meshes"),
        (.., Some(warning)) => format!("its meshes are empty{}: {}", warning.location, warning.what),
        (.., None) => "its meshes are empty".to_owned(),
    };
    let what = format!("there is nothing to draw: {reason}");
    LoadError::new(LoadErrorKind::Empty, import.path, what, "export the model with visible meshes")
}
