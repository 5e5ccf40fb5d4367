//! Keeps the parts of the file itself that a load reads, on request.

use std::collections::{BTreeMap, HashMap};

use gltf::json::Root;
use trigon_scene::MaterialId;

use super::buffers::{Buffers, UnreadReason};
use super::images::fetch_image;
use super::lights::light_index;
use super::mesh::BuiltMesh;
use super::nodes::Placed;
use crate::error::Location;
use crate::gltf_source::{JsonText, MeshOrigin, PrimitiveFaces, SharedBytes, SourceDraft, share};
use crate::import::Import;
use crate::warning::Warnings;

/// Takes the faces of all primitives out of meshes, where they are wanted.
pub(super) fn take_primitives(
    import: &Import<'_>,
    meshes: &mut [Option<BuiltMesh>],
) -> Vec<Vec<PrimitiveFaces>> {
    let wanted = import.source.is_some();
    let take = |built: &mut Option<BuiltMesh>| {
        built.as_mut().map(|built| std::mem::take(&mut built.primitives)).unwrap_or_default()
    };
    if wanted { meshes.iter_mut().map(take).collect() } else { Vec::new() }
}

/// Keeps which nodes, meshes, materials, cameras and lights of the file are where in the
/// scene. Before instances are made of nodes: these then lose their meshes.
pub(super) fn keep_placed(
    import: &mut Import<'_>,
    placed: &Placed<'_>,
    mut primitives: Vec<Vec<PrimitiveFaces>>,
    materials: &BTreeMap<Option<usize>, MaterialId>,
) {
    let Some(draft) = &mut import.source else { return };
    let root = &placed.document.root;
    let origins = &mut draft.origins;
    origins.materials = materials.iter().filter_map(|(&index, &id)| Some((id, index?))).collect();
    for (index, id) in placed.nodes() {
        origins.nodes.insert(id, index);
        let (from, Some(node)) = (&root.nodes[index], import.scene.node(id)) else { continue };
        if let (Some(mesh), Some(from)) = (node.mesh, from.mesh) {
            let index = from.value();
            let take = || MeshOrigin { index, primitives: std::mem::take(&mut primitives[index]) };
            origins.meshes.entry(mesh).or_insert_with(take);
        }
        let camera = from.camera.filter(|_| node.camera.is_some()).map(|camera| (id, camera.value()));
        origins.cameras.extend(camera);
        let light = light_index(from).filter(|_| node.light.is_some()).map(|light| (id, light));
        origins.lights.extend(light);
    }
}

/// Keeps which scene of the file was loaded.
pub(super) fn keep_scene(import: &mut Import<'_>, scene: Option<usize>) {
    if let Some(draft) = &mut import.source {
        draft.origins.scene = scene;
    }
}

/// Keeps the text and all buffers and images, and which skins are where. What cannot be kept
/// is a warning: the scene can be shown without it.
pub(super) fn keep_file(import: &mut Import<'_>, json: &[u8], placed: &Placed<'_>, buffers: &mut Buffers) {
    let Some(mut draft) = import.source.take() else { return };
    let root = &placed.document.root;
    match parse_text(json) {
        Ok(text) => draft.text = Some(text),
        Err(what) => {
            let what = format!("the file is not kept to be written back: {what}");
            import.warnings.push(Location::Whole, what, "export the model again");
        }
    }
    for (index, id) in placed.nodes() {
        let skin = import.scene.node(id).and_then(|node| node.skin);
        draft.origins.skins.extend(skin.zip(root.nodes[index].skin.map(|skin| skin.value())));
    }
    keep_images(&mut draft, import, root, buffers);
    keep_buffers(&mut draft, import, root, buffers);
    import.source = Some(draft);
}

/// Reads the images that no material uses.
fn keep_images(draft: &mut SourceDraft, import: &mut Import<'_>, root: &Root, buffers: &mut Buffers) {
    draft.image_count = root.images.len();
    // As many images as a file likes may name one and the same file.
    let mut read: HashMap<&str, Option<SharedBytes>> = HashMap::new();
    for (index, image) in root.images.iter().enumerate() {
        if draft.images.contains_key(&index) {
            continue;
        }
        let mut fetch = || match fetch_image(root, buffers, &mut import.folder, index) {
            Ok((bytes, _)) => Some(share(&bytes)),
            Err(unread) => {
                warn(&mut import.warnings, Location::Item("image", index), &unread);
                None
            }
        };
        let bytes = match &image.uri {
            Some(uri) => read.entry(uri).or_insert_with(fetch).clone(),
            None => fetch(),
        };
        draft.images.extend(bytes.map(|bytes| (index, bytes)));
    }
}

fn keep_buffers(draft: &mut SourceDraft, import: &mut Import<'_>, root: &Root, buffers: &mut Buffers) {
    for buffer in 0..root.buffers.len() {
        let bytes = match buffers.buffer(root, buffer, &mut import.folder) {
            Ok(bytes) => Some(bytes),
            Err(_) if is_stand_in(root, buffer) => None,
            Err(unplaced) => {
                warn(&mut import.warnings, unplaced.0, &unplaced.1);
                None
            }
        };
        draft.buffers.push(bytes);
    }
}

fn warn(warnings: &mut Warnings, location: Location, unread: &UnreadReason) {
    warnings.push(location, format!("it is not kept to be written back: {}", unread.what), unread.remedy);
}

/// The text without a byte order mark.
fn parse_text(json: &[u8]) -> Result<JsonText, String> {
    let json = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json);
    let text = std::str::from_utf8(json)
        .map_err(|error| format!("byte {} of its JSON is not UTF-8", error.valid_up_to()))?;
    JsonText::new(text).map_err(|error| error.to_string())
}

/// Whether a buffer has no bytes on purpose: they are compressed, in another one.
fn is_stand_in(root: &Root, buffer: usize) -> bool {
    let buffer = &root.buffers[buffer];
    let names = ["EXT_meshopt_compression", "KHR_meshopt_compression"];
    let extension = |name: &&str| buffer.extensions.as_ref()?.others.get(*name)?.get("fallback")?.as_bool();
    buffer.uri.is_none() && names.iter().filter_map(extension).any(|fallback| fallback)
}
