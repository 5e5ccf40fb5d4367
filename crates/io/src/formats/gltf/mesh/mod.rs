//! Meshes of the document: primitives become one polygon mesh with a material slot for each
//! material.
//!
//! Vertices in the same position with the same movement are merged: glTF splits them wherever a
//! normal or texture coordinate is discontinuous, and the shape would fall apart into loose pieces.
//!
//! `part` (one primitive, decoded) with `movement` (its skin and morph targets) → `draft` (all of
//! them welded, with the skin and morph targets of all) → tangents (if normal maps need them and the file has none).

mod draft;
mod movement;
mod part;

use std::collections::BTreeMap;
use std::ops::Range;

use draft::MeshDraft;
use gltf::json::Root;
use part::{Part, read_primitive};
use trigon_math::{Vec3, Vec4};
use trigon_mesh::{EditData, Mesh};
use trigon_scene::MaterialTexture;

use super::accessor::Accessors;
use super::buffers::Unplaced;
use super::materials::{is_opaque, unlit_colors};
use super::slots::SlotTexture;
use crate::error::Location;
use crate::gltf_source::PrimitiveFaces;
use crate::warning::Warnings;

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
    let mut draft = MeshDraft::new(&parts, target_names);
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
    complete(&mut built.mesh, &lacking, &corners);
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

/// A mesh, and the contents of its slots.
pub(super) struct BuiltMesh {
    pub(crate) mesh: Mesh,
    /// The material of each slot: an index of the document, or the default.
    pub(crate) materials: Vec<Option<usize>>,
    /// The faces of each primitive.
    pub(crate) primitives: Vec<PrimitiveFaces>,
    /// Of a native file, if the mesh was being edited.
    pub(crate) edit_data: Option<EditData>,
}

/// What a material needs of the meshes that use it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Needs {
    /// The UV sets of its textures.
    pub(crate) uv_sets: Vec<u32>,
    /// The UV set of its normal map.
    pub(crate) tangents_of: Option<u32>,
}

impl Needs {
    pub(crate) fn of(textures: &[SlotTexture]) -> Self {
        let mut uv_sets: Vec<u32> = textures.iter().map(|texture| texture.uv_set).collect();
        uv_sets.sort_unstable();
        uv_sets.dedup();
        let normal = textures.iter().find(|texture| texture.slot == MaterialTexture::Normal);
        Self { uv_sets, tangents_of: normal.map(|texture| texture.uv_set) }
    }
}

/// Generates the tangents that materials need and the file does not have, each for the UV set of
/// its primitive's normal map: `lacking`, by parts. `corners` are those of each part; others are unchanged.
fn complete(mesh: &mut Mesh, lacking: &[Option<u32>], corners: &[Range<usize>]) {
    let mut missing: BTreeMap<u32, Vec<Range<usize>>> = BTreeMap::new();
    for (set, corners) in lacking.iter().zip(corners) {
        if let Some(set) = *set {
            missing.entry(set).or_default().push(corners.clone());
        }
    }
    if missing.is_empty() {
        return;
    }
    let known = mesh.attributes().corner_tangents.clone();
    let mut tangents = known.unwrap_or_else(|| vec![Vec4::ZERO; mesh.corner_count()]);
    for (set, ranges) in missing {
        let Some(generated) = mesh.generate_tangents(set as usize) else { continue };
        for corners in ranges {
            tangents[corners.clone()].copy_from_slice(&generated[corners]);
        }
    }
    mesh.set_corner_tangents(tangents).expect("there is one a corner");
}

/// The materials of a mesh's lines and points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum WireMaterials {
    /// It has neither.
    Absent,
    /// All of them have this one, which gets the first slot.
    One(Option<usize>),
    /// They have several. The first slot gets the default material, which is white, and their vertices the colours that
    /// their own materials show.
    Several,
}

impl WireMaterials {
    /// Takes the material of each primitive that is lines or points.
    pub(super) fn of(materials: impl IntoIterator<Item = Option<usize>>) -> Self {
        materials.into_iter().fold(Self::Absent, |found, material| match found {
            Self::Absent => Self::One(material),
            Self::One(first) if first == material => found,
            _ => Self::Several,
        })
    }

    /// The material of the first slot, unless any primitive may have it.
    pub(super) fn first_slot(self) -> Option<Option<usize>> {
        match self {
            Self::Absent => None,
            Self::One(material) => Some(material),
            Self::Several => Some(None),
        }
    }
}

/// What a material makes of the colours of lines and points.
#[derive(Clone, Copy)]
struct WireTint {
    base_color: Vec4,
    emissive: Vec3,
    /// Whether it lets nothing through, wherever it is.
    is_opaque: bool,
}

impl WireTint {
    fn of(root: &Root, material: Option<usize>) -> Self {
        let (base_color, emissive) = unlit_colors(root, material);
        Self { base_color, emissive, is_opaque: is_opaque(root, material) }
    }

    /// The colour that a vertex shows: glTF 2.0, section 3.7.2.1.
    fn shown(self, vertex: Vec4) -> Vec4 {
        let color = self.base_color * vertex;
        (color.truncate() + self.emissive).extend(color.w)
    }
}
