//! Builds nodes from the parsed lists, one for each object or group, with progress. Faces of one smoothing group
//! are smooth among each other, with a crease towards all others.

use std::collections::HashMap;

use trigon_math::color::srgb_to_linear;
use trigon_math::{DVec3, Vec2, Vec3, Vec4};
use trigon_mesh::{Attributes, Mesh, MeshBuilder};

use super::index::NONE;
use super::oddities::Passed;
use super::parse::Parsed;
use super::record::Content;
use crate::error::{LoadError, Location};
use crate::rebase::offset_for;
use crate::warning::Warnings;

/// One object or group.
pub(crate) struct ObjPart {
    pub(crate) name: String,
    pub(crate) mesh: Mesh,
    /// The materials of its slots: indices of the record's names.
    pub(crate) materials: Vec<Option<u32>>,
    /// Of each slot, whether it has a face without texture coordinates.
    pub(crate) bare: Vec<bool>,
}

/// Some consecutive elements with the same state.
#[derive(Clone, Copy)]
struct Span {
    elements: (usize, usize),
    first_corner: usize,
    material: Option<u32>,
    smoothing: u32,
}

/// Cuts the file into parts. The offset is to be added to every position.
pub(crate) fn build_parts(
    parsed: &Parsed,
    warnings: &mut Warnings,
    follow: BuildProgress<'_>,
) -> Result<(Vec<ObjPart>, DVec3), LoadError> {
    let content = &parsed.content;
    follow(0.0)?;
    let used = used_vertices(content);
    follow(0.0)?;
    let positions =
        content.positions.iter().zip(&used).filter(|&(_, &used)| used).map(|(&position, _)| position);
    let cutter = Cutter { content, offset: offset_for(positions), follow };
    follow(0.0)?;
    let mut local = vec![NOT_YET; content.positions.len()];
    let mut passed = Passed::default();
    let spans = spans_by_part(parsed);
    let names = parsed.record.parts.list();
    let cut = |(name, spans): (&String, &Vec<Span>)| cutter.part(name, spans, &mut local, &mut passed);
    let parts = names.iter().zip(&spans).map(cut).collect::<Result<_, _>>()?;
    passed.warn(parsed, warnings);
    let is_odd = |&(color, &used): &(&Vec3, &bool)| used && color.is_nan();
    warnings.push_counted(
        content.colors.iter().zip(&used).filter(is_odd).count(),
        Location::Whole,
        "a vertex has a colour that is not finite; it is white there",
        "export the model again",
    );
    Ok((parts, cutter.offset))
}

/// Which vertices of the file belong to an element.
fn used_vertices(content: &Content) -> Vec<bool> {
    let mut used = vec![false; content.positions.len()];
    for &vertex in &content.position_indices {
        used[vertex as usize] = true;
    }
    used
}

/// Marks a vertex that the current part has not used.
const NOT_YET: u32 = u32::MAX;

/// The elements of each part, with where their corners start.
fn spans_by_part(parsed: &Parsed) -> Vec<Vec<Span>> {
    let (record, arities) = (&parsed.record, &parsed.content.arities);
    let mut parts = vec![Vec::new(); record.parts.list().len()];
    let mut corner = 0;
    for (index, run) in record.runs.iter().enumerate() {
        let end = record.runs.get(index + 1).map_or(record.elements, |next| next.first);
        let span = Span {
            elements: (run.first, end),
            first_corner: corner,
            material: run.material,
            smoothing: run.smoothing,
        };
        parts[run.part as usize].push(span);
        corner += arities[run.first..end].iter().map(|&arity| arity as usize).sum::<usize>();
    }
    parts
}

struct Cutter<'a> {
    content: &'a Content,
    offset: DVec3,
    follow: BuildProgress<'a>,
}

/// A part under construction.
struct PartDraft {
    builder: MeshBuilder,
    /// For each corner of the accepted faces, its corner in the file's lists.
    sources: Vec<u32>,
    face_slots: Vec<u32>,
    face_groups: Vec<u32>,
    materials: Vec<Option<u32>>,
    /// Of each slot, whether it has a face without texture coordinates.
    bare: Vec<bool>,
    slots: HashMap<Option<u32>, u32>,
    /// Edges that the file has as lines, the lower vertex first.
    lines: Vec<[u32; 2]>,
    /// Vertices of the file that the part uses.
    used: Vec<u32>,
    face: Vec<u32>,
}

impl Cutter<'_> {
    fn part(
        &self,
        name: &str,
        spans: &[Span],
        local: &mut [u32],
        passed: &mut Passed,
    ) -> Result<ObjPart, LoadError> {
        let faces = spans.iter().map(|span| span.elements.1 - span.elements.0).sum();
        let mut draft = PartDraft::with_capacity(faces);
        // Lines and points are drawn in the material of the first slot.
        let has_wires = |span: &&Span| {
            self.content.arities[span.elements.0..span.elements.1].iter().any(|&arity| arity < 3)
        };
        if let Some(span) = spans.iter().find(has_wires) {
            draft.slot(span.material);
        }
        for span in spans {
            self.span(span, &mut draft, local, passed)?;
        }
        for &vertex in &draft.used {
            local[vertex as usize] = NOT_YET;
        }
        let PartDraft {
            builder, sources, face_slots, face_groups, mut materials, mut bare, lines, used, ..
        } = draft;
        let mut mesh = builder.build();
        passed.note_covered(lines, &mesh);
        self.go_on(passed)?;
        let mut attributes = self.attributes(&sources, face_slots, &face_groups, materials.len());
        attributes.vertex_colors = self.wire_colors(&mesh, &used);
        self.go_on(passed)?;
        if has_several_groups(&face_groups) {
            let given = attributes.corner_normals.take();
            let go_on = || self.go_on(passed);
            attributes.corner_normals = Some(group_normals(&mesh, given, &face_groups, &go_on)?);
        }
        mesh.set_attributes(attributes).expect("one value per accepted corner and face");
        if materials.is_empty() {
            materials.push(None);
            bare.push(false);
        }
        Ok(ObjPart { name: name.to_owned(), mesh, materials, bare })
    }

    fn go_on(&self, passed: &Passed) -> Result<(), LoadError> {
        (self.follow)(passed.elements as f32 / self.content.arities.len().max(1) as f32)
    }

    fn span(
        &self,
        span: &Span,
        draft: &mut PartDraft,
        local: &mut [u32],
        passed: &mut Passed,
    ) -> Result<(), LoadError> {
        let slot = draft.slot(span.material);
        let mut corner = span.first_corner;
        for &arity in &self.content.arities[span.elements.0..span.elements.1] {
            let corners = corner..corner + arity as usize;
            corner = corners.end;
            draft.face.clear();
            for &vertex in &self.content.position_indices[corners.clone()] {
                let Some(index) = self.vertex(vertex, draft, local) else { break };
                draft.face.push(index);
            }
            passed.elements += 1;
            if passed.elements.is_multiple_of(STRIDE) {
                self.go_on(passed)?;
            }
            if draft.face.len() < corners.len() {
                passed.non_finite += 1;
                continue;
            }
            if arity < 3 {
                passed.note_wire(slot, span.material);
            } else {
                let coordinate = self.content.coordinate_indices.get(corners.start);
                draft.bare[slot as usize] |= coordinate.is_none_or(|&index| index == NONE);
            }
            draft.push(corners.start, slot, span.smoothing, passed);
        }
        Ok(())
    }

    /// The part's own index of a vertex; `None` when it has no finite place.
    fn vertex(&self, vertex: u32, draft: &mut PartDraft, local: &mut [u32]) -> Option<u32> {
        let known = &mut local[vertex as usize];
        if *known != NOT_YET {
            return Some(*known);
        }
        let position = (self.content.positions[vertex as usize] - self.offset).as_vec3();
        if !position.is_finite() {
            return None;
        }
        draft.used.push(vertex);
        *known = draft.builder.push_vertex(position);
        Some(*known)
    }

    fn attributes(
        &self,
        sources: &[u32],
        face_slots: Vec<u32>,
        face_groups: &[u32],
        slots: usize,
    ) -> Attributes {
        let is_smooth = face_groups.iter().any(|&group| group != 0);
        Attributes {
            corner_normals: self.normals(sources),
            uv_sets: self.coordinates(sources).into_iter().collect(),
            corner_colors: self.colors(sources),
            face_materials: (slots > 1).then_some(face_slots),
            face_smooth: is_smooth.then(|| face_groups.iter().map(|&group| group != 0).collect()),
            ..Attributes::default()
        }
    }

    /// The normals as the file has them, zero where it has none.
    fn normals(&self, sources: &[u32]) -> Option<Vec<Vec3>> {
        let Content { normals, normal_indices, .. } = self.content;
        if normal_indices.is_empty() {
            return None;
        }
        let normal = |&corner: &u32| match normal_indices[corner as usize] {
            NONE => Vec3::ZERO,
            index => Some(normals[index as usize]).filter(|normal| normal.is_finite()).unwrap_or_default(),
        };
        let normals: Vec<Vec3> = sources.iter().map(normal).collect();
        normals.iter().any(|&normal| normal != Vec3::ZERO).then_some(normals)
    }

    /// The texture coordinates, zero where the file has none.
    fn coordinates(&self, sources: &[u32]) -> Option<Vec<Vec2>> {
        let Content { coordinates, coordinate_indices, .. } = self.content;
        let index = |&corner: &u32| coordinate_indices[corner as usize];
        if coordinate_indices.is_empty() || sources.iter().all(|corner| index(corner) == NONE) {
            return None;
        }
        let coordinate = |corner: &u32| match index(corner) {
            NONE => Vec2::ZERO,
            index => Some(coordinates[index as usize]).filter(|uv| uv.is_finite()).unwrap_or_default(),
        };
        Some(sources.iter().map(coordinate).collect())
    }

    fn colors(&self, sources: &[u32]) -> Option<Vec<Vec4>> {
        let color = |&corner: &u32| self.color(self.content.position_indices[corner as usize]);
        (!self.content.colors.is_empty()).then(|| sources.iter().map(color).collect())
    }

    /// The colours of a part's vertices, if it has lines or points that show them. `used` are the file's vertices.
    fn wire_colors(&self, mesh: &Mesh, used: &[u32]) -> Option<Vec<Vec4>> {
        let has_wires = !mesh.loose_points().is_empty() || !mesh.loose_edges().is_empty();
        let has_colors = has_wires && !self.content.colors.is_empty();
        has_colors.then(|| used.iter().map(|&vertex| self.color(vertex)).collect())
    }

    /// The colour of a vertex of the file.
    fn color(&self, vertex: u32) -> Vec4 {
        let channel = |value: f32| if value.is_nan() { 1.0 } else { srgb_to_linear(value) };
        let [red, green, blue] = self.content.colors[vertex as usize].to_array().map(channel);
        Vec4::new(red, green, blue, 1.0)
    }
}

fn has_several_groups(face_groups: &[u32]) -> bool {
    let mut groups = face_groups.iter().filter(|&&group| group != 0);
    let first = groups.next();
    groups.any(|group| Some(group) != first)
}

impl PartDraft {
    /// An empty one with room for so many faces.
    fn with_capacity(faces: usize) -> Self {
        Self {
            builder: MeshBuilder::with_capacity(faces / 2, faces, 3 * faces),
            sources: Vec::with_capacity(3 * faces),
            face_slots: Vec::with_capacity(faces),
            face_groups: Vec::with_capacity(faces),
            materials: Vec::new(),
            bare: Vec::new(),
            slots: HashMap::new(),
            lines: Vec::new(),
            used: Vec::new(),
            face: Vec::new(),
        }
    }

    /// The slot of a material, a new one for a new material.
    fn slot(&mut self, material: Option<u32>) -> u32 {
        *self.slots.entry(material).or_insert_with(|| {
            self.materials.push(material);
            self.bare.push(false);
            self.materials.len() as u32 - 1
        })
    }

    /// Adds the element in `self.face`, whose corners start at `corner`.
    fn push(&mut self, corner: usize, slot: u32, smoothing: u32, passed: &mut Passed) {
        let added = match *self.face.as_slice() {
            [point] => self.builder.push_loose_point(point),
            [from, to] if from == to => self.builder.push_loose_point(from),
            [from, to] => {
                self.lines.push([from.min(to), from.max(to)]);
                self.builder.push_loose_edge(from, to)
            }
            _ => self.builder.push_face(&self.face).map(|_| {
                self.sources.extend((corner..corner + self.face.len()).map(|corner| corner as u32));
                self.face_slots.push(slot);
                self.face_groups.push(smoothing);
            }),
        };
        // Its vertices were just added: it can only be too few different ones.
        passed.flat += usize::from(added.is_err());
    }
}

/// Is told which share of the elements has been built, and may end it.
pub(super) type BuildProgress<'a> = &'a dyn Fn(f32) -> Result<(), LoadError>;

/// So many elements are built before [`BuildProgress`] is asked again: some milliseconds.
pub(super) const STRIDE: usize = 1 << 17;

/// Fills in the normals of smooth faces where none is given (zero). Faces of
/// group 0 keep zero, which means flat. `go_on` is asked now and then, and may end it.
pub(crate) fn group_normals(
    mesh: &Mesh,
    given: Option<Vec<Vec3>>,
    face_groups: &[u32],
    go_on: &dyn Fn() -> Result<(), LoadError>,
) -> Result<Vec<Vec3>, LoadError> {
    let ask = |face: usize| if face.is_multiple_of(STRIDE) { go_on() } else { Ok(()) };
    let mut normals = given.unwrap_or_else(|| vec![Vec3::ZERO; mesh.corner_count()]);
    let mut sums: HashMap<(u32, u32), Vec3> = HashMap::new();
    for (face, &group) in face_groups.iter().enumerate().filter(|&(_, &group)| group != 0) {
        ask(face)?;
        let area = area_vector(mesh, face);
        for &vertex in mesh.face_vertices(face) {
            *sums.entry((vertex, group)).or_default() += area;
        }
    }
    for (face, &group) in face_groups.iter().enumerate().filter(|&(_, &group)| group != 0) {
        ask(face)?;
        for (corner, &vertex) in mesh.face_corners(face).zip(mesh.face_vertices(face)) {
            if normals[corner] == Vec3::ZERO {
                normals[corner] = sums[&(vertex, group)].normalize_or_zero();
            }
        }
    }
    Ok(normals)
}

/// The normal of a polygon, as long as twice its area (Newell's method; Sutherland,
/// Sproull, Schumacker, "A Characterization of Ten Hidden-Surface Algorithms", 1974).
fn area_vector(mesh: &Mesh, face: usize) -> Vec3 {
    let positions = mesh.positions();
    let corners = mesh.face_vertices(face);
    let origin = positions[corners[0] as usize];
    let from_origin = |index: usize| positions[corners[index] as usize] - origin;
    (1..corners.len() - 1).map(|index| from_origin(index).cross(from_origin(index + 1))).sum()
}
