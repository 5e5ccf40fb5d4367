//! One primitive of a mesh, decoded.

use gltf::json::mesh::{Mode, Primitive, Semantic};
use trigon_math::Vec3;

use super::built::Needs;
use super::movement::{PartSkin, PartTarget, read_skin, read_targets};
use super::optional::{Optional, find};
use super::soundness;
use super::wires::WireTint;
use crate::error::{LoadErrorKind, Location};
use crate::formats::gltf::accessor::{Accessors, valid};
use crate::formats::gltf::buffers::{Unplaced, Unread};
use crate::formats::gltf::formats;
use crate::formats::gltf::primitive::{Elements, corner_count, elements};
use crate::warning::{Warnings, counted};

/// A primitive, decoded.
pub(super) struct Part {
    pub(super) positions: Vec<Vec3>,
    pub(super) normals: Option<Vec<[f32; 3]>>,
    /// Only if a normal map needs them.
    pub(super) tangents: Option<Vec<[f32; 4]>>,
    pub(super) uv_sets: Vec<Vec<[f32; 2]>>,
    pub(super) colors: Option<Vec<[f32; 4]>>,
    pub(super) skin: Option<PartSkin>,
    pub(super) targets: Vec<PartTarget>,
    pub(super) elements: Elements,
    pub(super) material: Option<usize>,
    pub(super) needs: Needs,
    /// Whether it is lines or points.
    pub(super) is_wire: bool,
    /// What its material makes of the colours of lines and points, if they cannot have its slot.
    pub(super) tint: Option<WireTint>,
    /// Strips repeat vertices on purpose, to jump.
    pub(super) is_strip: bool,
}

impl Part {
    /// The colours of vertices of lines and points.
    pub(super) fn wire_colors(&self) -> Option<&[[f32; 4]]> {
        self.colors.as_deref().filter(|_| self.is_wire)
    }

    /// Whether it has triangles whose vertices have colours.
    pub(super) fn has_colored_faces(&self) -> bool {
        self.colors.is_some() && !self.elements.triangles.is_empty()
    }

    /// The UV set for which a material needs tangents, if the file has none.
    pub(super) fn lacks_tangents_of(&self) -> Option<u32> {
        self.needs.tangents_of.filter(|_| self.tangents.is_none())
    }
}

pub(super) fn read_primitive(
    accessors: &mut Accessors<'_>,
    primitive: &Primitive,
    location: Location,
    needs: &dyn Fn(Option<usize>) -> Needs,
    warnings: &mut Warnings,
) -> Result<Option<Part>, Unplaced> {
    let Some(position_index) = find(primitive, Semantic::Positions) else {
        warnings.push(location, "it has no POSITION and is not drawn", "export the model again");
        return Ok(None);
    };
    let Some(mode) = valid(&primitive.mode) else {
        warnings.push(location, "its mode is unknown and it is not drawn", "export the model again");
        return Ok(None);
    };
    accessors.unpack(primitive, &location, warnings)?;
    check_bounds(accessors, position_index)?;
    if let Some(what) = formats::POSITION.fault(accessors.root, position_index) {
        warnings.push(location.clone(), what, "export the model again");
    }
    let positions = accessors.vectors::<3>(position_index, formats::POSITION.types)?;
    let elements = read_elements(accessors, primitive, mode, positions.len(), &location, warnings)?;
    let material = primitive.material.map(|material| material.value());
    let needs = needs(material);
    let mut optional =
        Optional { accessors, primitive, vertices: positions.len(), location: &location, warnings };
    let normals = optional.read::<3>(Semantic::Normals, &formats::NORMAL)?;
    let tangents = match (&normals, needs.tangents_of) {
        // Without normals the file's tangents must be ignored.
        (Some(_), Some(_)) => optional.read::<4>(Semantic::Tangents, &formats::TANGENT)?,
        _ => None,
    };
    let colors = optional.read::<4>(Semantic::Colors(0), &formats::COLOR)?;
    let uv_sets = optional.uv_sets(&needs.uv_sets)?;
    let skin = read_skin(&mut optional)?;
    let targets = read_targets(&mut optional, tangents.is_some())?;
    soundness::warn_of_normals(&mut optional, normals.as_deref());
    soundness::warn_of_tangents(&mut optional, tangents.as_deref());
    soundness::warn_of_colors(&mut optional, colors.as_deref());
    soundness::warn_of_uv_sets(&mut optional, &uv_sets);
    soundness::warn_of_targets(&mut optional, &targets);
    Ok(Some(Part {
        positions: positions.into_iter().map(Vec3::from).collect(),
        normals,
        tangents,
        uv_sets,
        colors,
        skin,
        targets,
        elements,
        material,
        needs,
        is_wire: matches!(mode, Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip),
        tint: None,
        is_strip: matches!(mode, Mode::TriangleStrip) && accessors.unpacked.is_none(),
    }))
}

/// The bounds of POSITION may be missing, but must have three numbers.
fn check_bounds(accessors: &Accessors<'_>, index: usize) -> Result<(), Unplaced> {
    let accessor = &accessors.root.accessors[index];
    for (name, bound) in [("min", &accessor.min), ("max", &accessor.max)] {
        let Some(bound) = bound else { continue };
        let numbers = bound.as_array().map_or(0, Vec::len);
        if numbers != 3 {
            let what = format!("POSITION {name} has {numbers} numbers and should have 3");
            return Err(malformed(Location::Item("accessor", index), what));
        }
    }
    Ok(())
}

fn malformed(location: Location, what: String) -> Unplaced {
    let remedy = "export the model again";
    Unplaced(location, Unread { kind: LoadErrorKind::Malformed, what, remedy })
}

/// The triangles, edges and points, all of whose indices exist.
fn read_elements(
    accessors: &mut Accessors<'_>,
    primitive: &Primitive,
    mode: Mode,
    vertices: usize,
    location: &Location,
    warnings: &mut Warnings,
) -> Result<Elements, Unplaced> {
    let unpacked = accessors.unpacked.as_mut().map(|unpacked| std::mem::take(&mut unpacked.triangles));
    let mode = if unpacked.is_some() { Mode::Triangles } else { mode };
    let indices = match (unpacked, primitive.indices) {
        (Some(triangles), _) => triangles,
        (None, Some(indices)) => accessors.indices(indices.value())?,
        (None, None) => (0..vertices as u32).collect(),
    };
    accessors.spend(vertices.max(corner_count(mode, indices.len())), location)?;
    // The compiler finds the greatest of many at a time. The first one that does not exist is needed only if there is one.
    let is_beyond = |vertex: &u32| *vertex as usize >= vertices;
    let greatest = indices.iter().copied().max().filter(is_beyond);
    if let Some(beyond) = greatest.and_then(|_| indices.iter().copied().find(is_beyond)) {
        let has = counted(vertices, "vertex");
        let what = format!("index {beyond} does not exist; the primitive has {has}");
        return Err(malformed(location.clone(), what));
    }
    let count = indices.len();
    let elements = elements(mode, indices);
    if elements.left_over > 0 {
        let count = counted(elements.left_over, "index");
        let what = format!("{count} at the end left over, too few for a whole element");
        warnings.push(location.clone(), what, "export the model again");
    } else if elements.is_empty() {
        let count = counted(count, "index");
        let what = format!("{count} are too few for its mode; it is not drawn");
        warnings.push(location.clone(), what, "export the model again");
    }
    Ok(elements)
}
