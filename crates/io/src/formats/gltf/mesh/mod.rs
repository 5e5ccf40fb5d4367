//! Meshes of the document: primitives become one polygon mesh with a material slot for each
//! material.
//!
//! Vertices in the same position with the same movement are merged: glTF splits them wherever a
//! normal or texture coordinate is discontinuous, and the shape would fall apart into loose pieces.
//!
//! `part` (one primitive, decoded) with `movement` (its skin and morph targets) → `draft` (all of
//! them welded) with `movements` (the skin and morph targets of all) → `tangents` (if normal maps need them and the file has none).

mod built;
mod draft;
mod movement;
mod movements;
mod optional;
mod part;
mod soundness;
mod tangents;
mod wires;

use std::ops::Range;

use gltf::json::Root;

use super::accessor::Accessors;
use super::buffers::Unplaced;
use crate::error::Location;
use crate::gltf_source::PrimitiveFaces;
use crate::warning::Warnings;
pub(super) use built::{BuiltMesh, Needs};
use draft::Draft;
use part::{Part, read_primitive};
pub(super) use wires::WireMaterials;
use wires::WireTint;

/// Reads a mesh. `needs` returns what a material needs of it.
pub(crate) fn build_mesh(
    accessors: &mut Accessors<'_>,
    index: usize,
    target_names: &[String],
    needs: &dyn Fn(Option<usize>) -> Needs,
    warnings: &mut Warnings,
) -> Result<BuiltMesh, Unplaced> {
    let (mut parts, mut numbers) = (Vec::new(), Vec::new());
    for (number, primitive) in accessors.root.meshes[index].primitives.iter().enumerate() {
        let location = Location::Named(format!("mesh {index}, primitive {number}"));
        if let Some(part) = read_primitive(accessors, primitive, location, needs, warnings)? {
            parts.push(part);
            numbers.push(number);
        }
    }
    let lacking: Vec<Option<u32>> = parts.iter().map(Part::lacks_tangents_of).collect();
    let wires = WireMaterials::of(parts.iter().filter(|part| part.is_wire).map(|part| part.material));
    if wires == WireMaterials::Several {
        tint_wires(accessors.root, &mut parts, index, warnings);
    }
    let mut draft = Draft::new(&parts, target_names);
    if let Some(material) = wires.first_slot() {
        draft.slot(material);
    }
    for part in parts {
        draft.add(part);
    }
    let location = || Location::Item("mesh", index);
    warnings.push_counted(
        draft.non_finite,
        location(),
        "a triangle, line or point has a vertex that is not finite and is left out",
        "export the model again",
    );
    warnings.push_counted(
        draft.flat,
        location(),
        "a triangle has fewer than 3 different vertices and is left out",
        "remove doubles and export again if a hole shows",
    );
    let corners = std::mem::take(&mut draft.corners);
    let mut built = draft.finish();
    tangents::complete(&mut built.mesh, &lacking, &corners);
    let faces =
        |(primitive, corners): (usize, &Range<usize>)| PrimitiveFaces { primitive, end: corners.end / 3 };
    built.primitives = numbers.into_iter().zip(&corners).map(faces).collect();
    Ok(built)
}

/// Lets lines and points of several materials show these in the colours of their vertices.
fn tint_wires(root: &Root, parts: &mut [Part], mesh: usize, warnings: &mut Warnings) {
    for part in parts.iter_mut().filter(|part| part.is_wire) {
        part.tint = Some(WireTint::of(root, part.material));
    }
    let translucent_count = parts.iter().filter_map(|part| part.tint).filter(|tint| !tint.is_opaque).count();
    warnings.push_counted(
        translucent_count,
        Location::Item("mesh", mesh),
        "lines or points beside those of other materials are masked or translucent, and are drawn opaque",
        "give them a mesh of their own",
    );
}

/// The weights of a mesh's morph targets, for nodes without their own.
pub(crate) fn default_weights(root: &Root, mesh: usize) -> Vec<f32> {
    sound_weights(root.meshes[mesh].weights.as_deref().unwrap_or_default())
}

/// The weights, 0 for those that are not finite.
pub(crate) fn sound_weights(weights: &[f32]) -> Vec<f32> {
    weights.iter().map(|&weight| if weight.is_finite() { weight } else { 0.0 }).collect()
}
