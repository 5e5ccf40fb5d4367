//! KHR_materials_variants: one of several sets of materials.

use std::collections::BTreeMap;
use std::path::Path;

use gltf::json::mesh::Primitive;
use gltf::json::{Index, Root};
use serde_json::Value;

use crate::error::{LoadError, LoadErrorKind, Location};
use crate::warning::Warnings;

/// The name of the extension.
pub(crate) const NAME: &str = "KHR_materials_variants";

/// The names of all variants, in the order of the file.
pub(crate) fn variant_names(root: &Root) -> Vec<String> {
    let extension = root.extensions.as_ref().and_then(|extensions| extensions.others.get(NAME));
    let list = extension.and_then(|extension| extension.get("variants")?.as_array());
    let name = |(index, variant): (usize, &Value)| {
        variant.get("name").and_then(Value::as_str).map_or_else(|| format!("variant {index}"), str::to_owned)
    };
    list.map(|list| list.iter().enumerate().map(name).collect()).unwrap_or_default()
}

/// Gives all primitives the materials of a variant. Those that it does not mention keep their own. A file
/// without variants stays as it is.
pub(crate) fn choose_variant(path: &Path, root: &mut Root, wanted: &str) -> Result<(), LoadError> {
    let names = variant_names(root);
    if names.is_empty() {
        return Ok(());
    }
    let Some(variant) = names.iter().position(|name| name == wanted) else {
        let list: Vec<String> = names.iter().map(|name| format!("{name:?}")).collect();
        let what = format!("there is no variant {wanted:?}");
        let remedy = format!("choose one of {}", list.join(", "));
        return Err(LoadError::new(LoadErrorKind::Unsupported, path, what, remedy));
    };
    let materials = root.materials.len();
    for primitive in root.meshes.iter_mut().flat_map(|mesh| &mut mesh.primitives) {
        let material = materials_in(primitive, variant).find(|&material| material < materials);
        if let Some(material) = material {
            primitive.material = Some(Index::new(material as u32));
        }
    }
    Ok(())
}

/// Warns of primitives with several materials for one variant, and with materials that do not exist.
pub(crate) fn warn_of_variants(root: &Root, warnings: &mut Warnings) {
    let names = variant_names(root);
    for (index, mesh) in root.meshes.iter().enumerate() {
        let mut warn =
            |what: String| warnings.push(Location::Item("mesh", index), what, "export the model again");
        for primitive in &mesh.primitives {
            for (variant, materials) in materials_by_variant(primitive) {
                let Some(name) = names.get(variant) else { continue };
                if materials.len() > 1 {
                    warn(format!(
                        "it has several materials for the variant {name:?}, of which the first is used"
                    ));
                }
                if materials.iter().any(|&material| material >= root.materials.len()) {
                    warn(format!(
                        "it has a material for the variant {name:?} that does not exist and is ignored"
                    ));
                }
            }
        }
    }
}

/// The materials that a primitive has in a variant: one, if the file is sound.
fn materials_in(primitive: &Primitive, variant: usize) -> impl Iterator<Item = usize> {
    mapped(primitive).filter(move |&(of, _)| of == variant).map(|(_, material)| material)
}

fn materials_by_variant(primitive: &Primitive) -> BTreeMap<usize, Vec<usize>> {
    let mut all: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    mapped(primitive).for_each(|(variant, material)| all.entry(variant).or_default().push(material));
    all
}

/// Variants with their materials.
fn mapped(primitive: &Primitive) -> impl Iterator<Item = (usize, usize)> {
    let extension = primitive.extensions.as_ref().and_then(|extensions| extensions.others.get(NAME));
    let mappings = extension.and_then(|extension| extension.get("mappings")?.as_array());
    let number = |value: &Value| usize::try_from(value.as_u64()?).ok();
    mappings.into_iter().flatten().flat_map(move |mapping| {
        let material = mapping.get("material").and_then(number);
        let variants = mapping.get("variants").and_then(Value::as_array).into_iter().flatten();
        variants.filter_map(move |variant| Some((number(variant)?, material?)))
    })
}
