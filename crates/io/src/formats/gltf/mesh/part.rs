//! One primitive of a mesh, decoded: its positions and elements, its optional attributes, and the checks of their
//! values. `draft` corrects invalid ones.

use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::validation::Checked;
use trigon_math::Vec3;

use super::movement::{PartSkin, PartTarget, read_skin, read_targets};
use super::{Needs, WireTint};
use crate::error::{LoadErrorKind, Location};
use crate::formats::gltf::accessor::{Accessors, valid};
use crate::formats::gltf::buffers::{Unplaced, UnreadReason};
use crate::formats::gltf::formats;
use crate::formats::gltf::formats::Usage;
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
    warn_of_normals(&mut optional, normals.as_deref());
    warn_of_tangents(&mut optional, tangents.as_deref());
    warn_of_colors(&mut optional, colors.as_deref());
    warn_of_uv_sets(&mut optional, &uv_sets);
    warn_of_targets(&mut optional, &targets);
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
    Unplaced(location, UnreadReason { kind: LoadErrorKind::Malformed, what, remedy })
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

/// The number of UV sets always read, and the maximum.
const UV_SETS: u32 = 2;
const MOST_UV_SETS: u32 = 8;

/// The accessor of an attribute.
pub(super) fn find(primitive: &Primitive, semantic: Semantic) -> Option<usize> {
    primitive.attributes.get(&Checked::Valid(semantic)).map(|accessor| accessor.value())
}

/// Reads optional attributes of primitives.
pub(super) struct Optional<'o, 'a> {
    pub(super) accessors: &'o mut Accessors<'a>,
    pub(super) primitive: &'o Primitive,
    pub(super) vertices: usize,
    pub(super) location: &'o Location,
    pub(super) warnings: &'o mut Warnings,
}

impl Optional<'_, '_> {
    pub(super) fn read<const N: usize>(
        &mut self,
        semantic: Semantic,
        usage: &Usage,
    ) -> Result<Option<Vec<[f32; N]>>, Unplaced> {
        find(self.primitive, semantic).map_or(Ok(None), |index| self.read_accessor(index, usage))
    }

    pub(super) fn has(&self, semantic: Semantic) -> bool {
        find(self.primitive, semantic).is_some()
    }

    /// `None`, with a warning, if there is not one value per vertex.
    pub(super) fn read_accessor<const N: usize>(
        &mut self,
        index: usize,
        usage: &Usage,
    ) -> Result<Option<Vec<[f32; N]>>, Unplaced> {
        let (name, count) = (usage.name, self.accessors.count(index));
        if count != self.vertices as u64 {
            let what = format!("{name} has {count} values for {} vertices and is ignored", self.vertices);
            self.warn(what);
            return Ok(None);
        }
        if let Some(what) = usage.fault(self.accessors.root, index) {
            self.warn(what);
        }
        self.accessors.vectors(index, usage.types).map(Some)
    }

    pub(super) fn warn(&mut self, what: impl Into<String>) {
        self.warnings.push(self.location.clone(), what, "export the model again");
    }

    /// A warning about `count` vertices.
    pub(super) fn warn_counted(&mut self, count: usize, what: &str) {
        self.warnings.push_counted(count, self.location.clone(), what, "export the model again");
    }

    /// The UV sets; sets that a material needs and the primitive lacks are copies of the first.
    /// Later sets keep their number: a missing one before them is empty.
    pub(super) fn uv_sets(&mut self, wanted: &[u32]) -> Result<Vec<Vec<[f32; 2]>>, Unplaced> {
        let last = wanted.iter().copied().filter(|&set| set < MOST_UV_SETS).max();
        let mut sets = Vec::new();
        for set in 0..UV_SETS.max(last.map_or(0, |last| last + 1)) {
            sets.push(self.read::<2>(Semantic::TexCoords(set), &formats::TEXCOORD)?);
        }
        for &set in wanted {
            if sets.get(set as usize).is_some_and(Option::is_some) {
                continue;
            }
            let instead = match &sets[0] {
                _ if set >= MOST_UV_SETS => "the texture is not drawn",
                Some(_) => "TEXCOORD_0 is used",
                None => "the texture shows one colour",
            };
            let what = format!("one of its textures needs TEXCOORD_{set}, which is missing; {instead}");
            self.warnings.push(self.location.clone(), what, "export the model with that UV map");
            if (set as usize) < sets.len() {
                sets[set as usize] = sets[0].clone();
            }
        }
        while sets.last().is_some_and(Option::is_none) {
            sets.pop();
        }
        Ok(sets.into_iter().map(Option::unwrap_or_default).collect())
    }
}

/// How far a colour may be outside 0 to 1 without a warning: half an 8-bit step, which no image
/// shows.
const COLOR_TOLERANCE: f32 = 0.5 / 255.0;
/// How far the sign of a tangent may be from 1 or −1: one step of a normalized byte.
const SIGN_TOLERANCE: f32 = 1.0 / 127.0;

pub(super) fn warn_of_normals(from: &mut Optional<'_, '_>, normals: Option<&[[f32; 3]]>) {
    let count = normals.map_or(0, |list| list.iter().filter(|normal| !is_direction(normal)).count());
    from.warn_counted(
        count,
        "a vertex has a normal that is zero or not finite; the normal of its face is used",
    );
}

pub(super) fn warn_of_tangents(from: &mut Optional<'_, '_>, tangents: Option<&[[f32; 4]]>) {
    let is_sound = |tangent: &[f32; 4]| {
        let [x, y, z, sign] = *tangent;
        is_direction(&[x, y, z]) && (sign.abs() - 1.0).abs() <= SIGN_TOLERANCE
    };
    let count = tangents.map_or(0, |list| list.iter().filter(|tangent| !is_sound(tangent)).count());
    from.warn_counted(
        count,
        "a vertex has a tangent that is zero or not finite, or whose w is not 1 or −1; it is corrected",
    );
}

pub(super) fn warn_of_colors(from: &mut Optional<'_, '_>, colors: Option<&[[f32; 4]]>) {
    let sound = -COLOR_TOLERANCE..=1.0 + COLOR_TOLERANCE;
    let is_sound = |color: &[f32; 4]| color.iter().all(|channel| sound.contains(channel));
    let count = colors.map_or(0, |list| list.iter().filter(|color| !is_sound(color)).count());
    from.warn_counted(count, "a vertex has a colour that is not between 0 and 1; it is clamped");
}

pub(super) fn warn_of_uv_sets(from: &mut Optional<'_, '_>, sets: &[Vec<[f32; 2]>]) {
    let count = sets.iter().flatten().filter(|uv| !are_finite(&uv[..])).count();
    from.warn_counted(count, "a vertex has texture coordinates that are not finite; they count as 0");
}

pub(super) fn warn_of_targets(from: &mut Optional<'_, '_>, targets: &[PartTarget]) {
    let lists = targets.iter().flat_map(|target| [&target.positions, &target.normals, &target.tangents]);
    let count = lists.flatten().flatten().filter(|delta| !are_finite(&delta[..])).count();
    from.warn_counted(count, "a morph target has a value that is not finite; it counts as 0");
}

/// Whether it is longer than 0; the length itself does not matter.
fn is_direction(vector: &[f32; 3]) -> bool {
    are_finite(vector) && vector.iter().any(|&value| value != 0.0)
}

fn are_finite(values: &[f32]) -> bool {
    values.iter().all(|value| value.is_finite())
}
