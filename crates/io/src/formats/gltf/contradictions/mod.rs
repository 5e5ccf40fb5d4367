//! Contradictions in a document, found before it is read. It is drawn anyway, and each warning says
//! how.
//!
//! Only parts that the scene reaches are checked, because the rest is not visible. Contradictions
//! that only show in accessor data are reported where it is read.

mod animations;
mod materials;
mod meshes;
mod remedy;

use std::collections::BTreeSet;

use gltf::json::Root;

use self::remedy::REMEDY;
use super::document::Document;
use super::hierarchy::Hierarchy;
use crate::error::Location;
use crate::warning::Warnings;

pub(crate) fn warn_of_contradictions(document: &Document, hierarchy: &Hierarchy, warnings: &mut Warnings) {
    let root = &document.root;
    warn_of_version(root, warnings);
    warn_of_listed_children(hierarchy, warnings);
    let meshes: BTreeSet<usize> =
        hierarchy.order.iter().filter_map(|&node| Some(root.nodes[node].mesh?.value())).collect();
    meshes::warn_of_meshes(document, hierarchy, &meshes, warnings);
    let primitives = meshes.iter().flat_map(|&mesh| &root.meshes[mesh].primitives);
    let materials: BTreeSet<usize> =
        primitives.filter_map(|primitive| Some(primitive.material?.value())).collect();
    materials::warn_of_materials(root, &materials, warnings);
    animations::warn_of_animations(document, hierarchy, warnings);
}

/// A later 2.x may be read as 2.0, unless its `minVersion` says otherwise.
fn warn_of_version(root: &Root, warnings: &mut Warnings) {
    let version = &root.asset.version;
    if version.split('.').nth(1).is_some_and(|minor| minor != "0") {
        let what = format!("the file is glTF {version} and is read as 2.0: what is newer is not drawn");
        warnings.push(Location::Whole, what, "export the model as glTF 2.0");
    }
}

/// Reports nodes that the scene lists as its roots although they have a parent.
fn warn_of_listed_children(hierarchy: &Hierarchy, warnings: &mut Warnings) {
    for &node in &hierarchy.listed_children {
        let what = match hierarchy.parents[node] {
            Some(_) => {
                "the scene lists it as a root, and it is another node's child; it is drawn once, as that child"
            }
            None => {
                "the scene lists it as a root without its parent; it is drawn without the parent's transform"
            }
        };
        warnings.push(Location::Item("node", node), what, REMEDY);
    }
}
