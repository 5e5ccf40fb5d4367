//! Morph targets and weights that do not match, and attributes that are not read.

use std::collections::BTreeSet;

use gltf::json::Root;

use super::remedy::REMEDY;
use crate::error::Location;
use crate::formats::gltf::document::Document;
use crate::formats::gltf::hierarchy::Hierarchy;
use crate::warning::{Warnings, counted};

pub(super) fn warn_of_meshes(
    document: &Document,
    hierarchy: &Hierarchy,
    used: &BTreeSet<usize>,
    warnings: &mut Warnings,
) {
    let root = &document.root;
    for &mesh in used {
        warn_of_weights(
            root.meshes[mesh].weights.as_ref(),
            root,
            mesh,
            Location::Item("mesh", mesh),
            warnings,
        );
        let counts: BTreeSet<usize> = target_counts(root, mesh).collect();
        if counts.len() > 1 {
            let what = "its primitives have different numbers of morph targets; a primitive without a target keeps its shape";
            warnings.push(Location::Item("mesh", mesh), what, REMEDY);
        }
    }
    for &node in &hierarchy.order {
        let from = &root.nodes[node];
        if let Some(mesh) = from.mesh {
            let location = Location::Item("node", node);
            warn_of_weights(from.weights.as_ref(), root, mesh.value(), location, warnings);
        }
    }
    for from in document.foreign_attributes.iter().filter(|from| used.contains(&from.mesh)) {
        let location = Location::Named(format!("mesh {}, primitive {}", from.mesh, from.primitive));
        let (name, remedy) = (&from.name, "rename or bake it if something is missing");
        let what = if from.in_target {
            format!("{name} of a morph target is not supported and is ignored")
        } else {
            format!("{name} is not an attribute of glTF and is ignored")
        };
        warnings.push(location, what, remedy);
    }
}

/// The number of morph targets of each primitive of a mesh.
fn target_counts(root: &Root, mesh: usize) -> impl Iterator<Item = usize> {
    let primitives = root.meshes[mesh].primitives.iter();
    primitives.map(|primitive| primitive.targets.as_ref().map_or(0, Vec::len))
}

/// Warns if the number of weights differs from the number of morph targets of a mesh.
fn warn_of_weights(
    weights: Option<&Vec<f32>>,
    root: &Root,
    mesh: usize,
    location: Location,
    warnings: &mut Warnings,
) {
    let targets = target_counts(root, mesh).max().unwrap_or(0);
    if let Some(weights) = weights.filter(|weights| weights.len() != targets) {
        let (weights, targets) = (counted(weights.len(), "weight"), counted(targets, "morph target"));
        let what =
            format!("it has {weights} for {targets}; missing weights count as 0, and extra ones are ignored");
        warnings.push(location, what, REMEDY);
    }
}
