//! Extensions: which are read, and the messages about the others.

use std::collections::BTreeSet;
use std::path::Path;

use gltf::json::Root;

use super::packed::DRACO;
use super::{material_extensions, specular_glossiness, variants};
use crate::error::{LoadError, LoadErrorKind, Location};
use crate::warning::Warnings;

/// Read in full, beside those of materials that [`material_extensions`] lists.
const READ: &[&str] = &[
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    DRACO,
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_unlit",
    specular_glossiness::NAME,
    variants::NAME,
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "KHR_texture_transform",
];

/// Images in formats that are not read: the geometry is shown all the same,
/// with a fallback or a checkerboard on it.
const IMAGES: &[&str] = &[
    "KHR_texture_basisu",
    "KHR_texture_ktx",
    "EXT_texture_avif",
    "MSFT_texture_dds",
    "GOOGLE_texture_basis",
];

/// Data about the file that does not show, and what says itself what of it is
/// left out: a texture without an image, a channel that moves no node.
const INVISIBLE: &[&str] =
    &["KHR_xmp", "KHR_xmp_json_ld", "EXT_texture_procedurals", "KHR_animation_pointer"];

fn is_read(name: &str) -> bool {
    READ.contains(&name) || material_extensions::names().contains(&name)
}

/// Refuses a file that cannot be understood without an extension, and names
/// what else is not drawn. `found` are the extensions that the document has
/// objects of, declared or not.
pub(crate) fn check_extensions(
    path: &Path,
    root: &Root,
    found: &BTreeSet<String>,
    warnings: &mut Warnings,
) -> Result<(), LoadError> {
    let unread: Vec<&str> =
        root.extensions_required.iter().map(String::as_str).filter(|name| !is_read(name)).collect();
    let is_needless = |name: &&&str| IMAGES.contains(*name) || INVISIBLE.contains(*name);
    let missing: Vec<&str> = unread.iter().filter(|name| !is_needless(name)).copied().collect();
    if !missing.is_empty() {
        let what = format!("the file requires {}, which trigon does not read", missing.join(", "));
        return Err(LoadError::new(LoadErrorKind::Unsupported, path, what, remedy(&missing)));
    }
    warn_of_required(root, &unread, warnings);
    let declared: BTreeSet<&str> = root.extensions_used.iter().map(String::as_str).collect();
    let undeclared = found.iter().map(String::as_str).filter(|name| !declared.contains(name));
    for name in root.extensions_used.iter().map(String::as_str).chain(undeclared) {
        if !is_read(name) && ![IMAGES, INVISIBLE].iter().any(|list| list.contains(&name)) {
            warnings.push(
                Location::Whole,
                format!("the extension {name} is not drawn"),
                "bake what it adds into the base colour or the mesh if it matters",
            );
        }
    }
    Ok(())
}

/// Says which required extensions the file is drawn without, whether or not
/// what it draws needs them, and which it requires without using them.
fn warn_of_required(root: &Root, unread: &[&str], warnings: &mut Warnings) {
    let of =
        |list: &[&str]| -> Vec<&str> { unread.iter().filter(|name| list.contains(name)).copied().collect() };
    let (images, invisible) = (of(IMAGES), of(INVISIBLE));
    if !images.is_empty() {
        let names = images.join(", ");
        let what =
            format!("the file requires {names}, which trigon does not support; such images are not drawn");
        warnings.push(Location::Whole, what, "export the model with PNG, JPEG or WebP images");
    }
    if !invisible.is_empty() {
        let names = invisible.join(", ");
        let what = format!("the file requires {names}, which trigon does not support; it is drawn without");
        warnings.push(Location::Whole, what, "export the model without it if something is missing");
    }
    for name in root.extensions_required.iter().filter(|name| !root.extensions_used.contains(name)) {
        let what = format!("the file requires {name}, which is missing in extensionsUsed");
        warnings.push(Location::Whole, what, "add it to extensionsUsed, or export the model again");
    }
}

fn remedy(missing: &[&str]) -> &'static str {
    let has = |part: &str| missing.iter().any(|name| name.contains(part));
    if has("materials") {
        "re-export with plain metallic-roughness materials"
    } else {
        "re-export without it"
    }
}
