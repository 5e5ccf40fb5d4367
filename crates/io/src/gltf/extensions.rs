//! Extensions: which are read, and what is said about the others.

use std::path::Path;

use gltf_json::Root;

use crate::error::{LoadError, LoadErrorKind, Place};
use crate::warning::{Warnings, counted};

/// Read in full.
const READ: &[&str] =
    &["KHR_mesh_quantization", "KHR_texture_transform", "KHR_lights_punctual", "KHR_materials_unlit"];

/// Pictures in formats that are not read: the geometry is shown all the same,
/// with a fallback or a checkerboard on it.
const PICTURES: &[&str] = &[
    "KHR_texture_basisu",
    "KHR_texture_ktx",
    "EXT_texture_webp",
    "EXT_texture_avif",
    "MSFT_texture_dds",
    "GOOGLE_texture_basis",
];

/// Data about the file that does not show.
const INVISIBLE: &[&str] =
    &["KHR_xmp", "KHR_xmp_json_ld", "EXT_texture_procedurals", "KHR_animation_pointer"];

/// Refuses a file that cannot be understood without an extension, and names
/// what else is not drawn.
pub(crate) fn check_extensions(path: &Path, root: &Root, warnings: &mut Warnings) -> Result<(), LoadError> {
    let required = root.extensions_required.iter();
    let missing: Vec<&str> = required
        .map(String::as_str)
        .filter(|name| !READ.contains(name) && !PICTURES.contains(name))
        .collect();
    if !missing.is_empty() {
        let what = format!("the file requires {}, which trigon does not read", missing.join(", "));
        return Err(LoadError::new(LoadErrorKind::Unsupported, path, what, remedy(&missing)));
    }
    for name in &root.extensions_used {
        let known = [READ, PICTURES, INVISIBLE].iter().any(|list| list.contains(&name.as_str()));
        if !known {
            warnings.push(
                Place::Whole,
                format!("the extension {name} is not drawn yet"),
                "bake what it adds into the base colour or the mesh if it matters",
            );
        }
    }
    Ok(())
}

fn remedy(missing: &[&str]) -> &'static str {
    let has = |part: &str| missing.iter().any(|name| name.contains(part));
    if has("draco") {
        "re-export without Draco compression, or decompress it with `gltf-transform dedup in.glb out.glb`"
    } else if has("meshopt") {
        "re-export without meshopt compression, or decompress it with `gltf-transform dedup in.glb out.glb`"
    } else if has("materials") {
        "re-export with plain metallic-roughness materials"
    } else {
        "re-export without it"
    }
}

/// Says once each what the file has and trigon does not draw yet.
pub(crate) fn warn_of_undrawn(root: &Root, warnings: &mut Warnings) {
    let mut warn = |count: usize, kind: &str, what: &str| {
        if count > 0 {
            let remedy = "export the model in the pose to be shown";
            warnings.push(Place::Whole, format!("{} {what}", counted(count, kind)), remedy);
        }
    };
    let primitives = || root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let is_morphed = |primitive: &&gltf_json::mesh::Primitive| {
        primitive.targets.as_ref().is_some_and(|targets| !targets.is_empty())
    };
    let skinned = root.nodes.iter().filter(|node| node.skin.is_some()).count();
    warn(root.animations.len(), "animation", "not played yet: the rest pose is shown");
    warn(skinned, "skin", "not followed yet: the bind pose is shown");
    warn(
        primitives().filter(is_morphed).count(),
        "primitive",
        "with morph targets that are not drawn yet: the base shape is shown",
    );
}
