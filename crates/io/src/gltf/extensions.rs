//! Extensions: which are read, and what is said about the others.

use std::path::Path;

use gltf::json::Root;

use crate::error::{LoadError, LoadErrorKind, Place};
use crate::warning::Warnings;

/// Read in full.
const READ: &[&str] = &[
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "KHR_texture_transform",
];

/// Pictures in formats that are not read: the geometry is shown all the same,
/// with a fallback or a checkerboard on it.
const PICTURES: &[&str] = &[
    "KHR_texture_basisu",
    "KHR_texture_ktx",
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
                format!("the extension {name} is not drawn"),
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
    } else if has("materials") {
        "re-export with plain metallic-roughness materials"
    } else {
        "re-export without it"
    }
}
