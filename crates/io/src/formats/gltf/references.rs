//! Checks every index and every byte range of a document before anything
//! follows it: afterwards, indexing a list of the document cannot fail.

use std::path::Path;

use gltf::json::validation::USize64;
use gltf::json::{Root, buffer};

use super::slots::slot_textures;
use crate::error::{LoadError, Location};

/// The texture index that gltf::json uses for "none".
const NO_SOURCE: usize = u32::MAX as usize;

pub(crate) fn check_references(path: &Path, root: &Root) -> Result<(), LoadError> {
    check(root)
        .map_err(|(location, what)| LoadError::malformed(path, what, "export the model again").at(location))
}

type ReferenceFault = (Location, String);

fn check(root: &Root) -> Result<(), ReferenceFault> {
    for (index, view) in root.buffer_views.iter().enumerate() {
        check_view(root, view, Location::Item("bufferView", index))?;
    }
    for (index, accessor) in root.accessors.iter().enumerate() {
        let location = || Location::Item("accessor", index);
        let views = root.buffer_views.len();
        within(location, "bufferView", accessor.buffer_view.map(|view| view.value()), views)?;
        if let Some(sparse) = &accessor.sparse {
            within(location, "bufferView", Some(sparse.indices.buffer_view.value()), views)?;
            within(location, "bufferView", Some(sparse.values.buffer_view.value()), views)?;
        }
    }
    check_meshes(root)?;
    check_nodes(root)?;
    check_movements(root)?;
    check_appearance(root)
}

fn within(
    location: impl Fn() -> Location,
    kind: &str,
    index: Option<usize>,
    length: usize,
) -> Result<(), ReferenceFault> {
    match index {
        Some(index) if index >= length => {
            Err((location(), format!("{kind} {index} does not exist; there are {length}")))
        }
        _ => Ok(()),
    }
}

fn check_view(root: &Root, view: &buffer::View, location: Location) -> Result<(), ReferenceFault> {
    within(|| location.clone(), "buffer", Some(view.buffer.value()), root.buffers.len())?;
    let buffer = &root.buffers[view.buffer.value()];
    let (offset, length) = (view.byte_offset.unwrap_or(USize64(0)).0, view.byte_length.0);
    let end = offset.checked_add(length);
    if end.is_none_or(|end| end > buffer.byte_length.0) {
        let (number, has) = (view.buffer.value(), buffer.byte_length.0);
        return Err((
            location,
            format!("{length} bytes from byte {offset} lie outside buffer {number}, which has {has}"),
        ));
    }
    Ok(())
}

fn check_meshes(root: &Root) -> Result<(), ReferenceFault> {
    for (mesh_index, mesh) in root.meshes.iter().enumerate() {
        for (index, primitive) in mesh.primitives.iter().enumerate() {
            let location = || Location::Named(format!("mesh {mesh_index}, primitive {index}"));
            let accessors = root.accessors.len();
            let attributes = primitive.attributes.values().map(|accessor| accessor.value());
            let targets = primitive.targets.iter().flatten();
            let targets = targets.flat_map(|target| [target.positions, target.normals, target.tangents]);
            let targets = targets.flatten().map(|accessor| accessor.value());
            let indices = primitive.indices.map(|indices| indices.value());
            for accessor in attributes.chain(targets).chain(indices) {
                within(location, "accessor", Some(accessor), accessors)?;
            }
            within(
                location,
                "material",
                primitive.material.map(|material| material.value()),
                root.materials.len(),
            )?;
        }
    }
    Ok(())
}

fn check_nodes(root: &Root) -> Result<(), ReferenceFault> {
    for (index, node) in root.nodes.iter().enumerate() {
        let location = || Location::Item("node", index);
        within(location, "mesh", node.mesh.map(|mesh| mesh.value()), root.meshes.len())?;
        within(location, "skin", node.skin.map(|skin| skin.value()), root.skins.len())?;
        within(location, "camera", node.camera.map(|camera| camera.value()), root.cameras.len())?;
        within(location, "light", super::lights::light_index(node), super::lights::light_count(root))?;
        for child in node.children.iter().flatten() {
            within(location, "node", Some(child.value()), root.nodes.len())?;
        }
    }
    for (index, scene) in root.scenes.iter().enumerate() {
        for node in &scene.nodes {
            within(|| Location::Item("scene", index), "node", Some(node.value()), root.nodes.len())?;
        }
    }
    within(|| Location::Whole, "scene", root.scene.map(|scene| scene.value()), root.scenes.len())
}

fn check_movements(root: &Root) -> Result<(), ReferenceFault> {
    let (nodes, accessors) = (root.nodes.len(), root.accessors.len());
    for (index, skin) in root.skins.iter().enumerate() {
        let location = || Location::Item("skin", index);
        for joint in &skin.joints {
            within(location, "node", Some(joint.value()), nodes)?;
        }
        within(location, "accessor", skin.inverse_bind_matrices.map(|matrices| matrices.value()), accessors)?;
    }
    for (index, animation) in root.animations.iter().enumerate() {
        let location = || Location::Item("animation", index);
        for channel in &animation.channels {
            within(location, "sampler", Some(channel.sampler.value()), animation.samplers.len())?;
            within(location, "node", Some(channel.target.node.value()), nodes)?;
        }
        for sampler in &animation.samplers {
            within(location, "accessor", Some(sampler.input.value()), accessors)?;
            within(location, "accessor", Some(sampler.output.value()), accessors)?;
        }
    }
    Ok(())
}

fn check_appearance(root: &Root) -> Result<(), ReferenceFault> {
    for (index, material) in root.materials.iter().enumerate() {
        for from in slot_textures(material) {
            let location = || Location::Item("material", index);
            within(location, "texture", Some(from.texture), root.textures.len())?;
        }
    }
    for (index, texture) in root.textures.iter().enumerate() {
        let location = || Location::Item("texture", index);
        let source = Some(texture.source.value()).filter(|&source| source != NO_SOURCE);
        within(location, "image", source, root.images.len())?;
        within(location, "sampler", texture.sampler.map(|sampler| sampler.value()), root.samplers.len())?;
    }
    for (index, image) in root.images.iter().enumerate() {
        let view = image.buffer_view.map(|view| view.value());
        within(|| Location::Item("image", index), "bufferView", view, root.buffer_views.len())?;
    }
    Ok(())
}

/// The image of a texture, when it names one itself.
pub(crate) fn source_of(texture: &gltf::json::Texture) -> Option<usize> {
    Some(texture.source.value()).filter(|&source| source != NO_SOURCE)
}
