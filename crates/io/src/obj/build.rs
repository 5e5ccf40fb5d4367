//! From parsed lists to nodes: one for each object or group of the file.

use std::collections::HashMap;

use trigon_math::{DVec3, Vec2, Vec3, Vec4, color::srgb_to_linear};
use trigon_mesh::{Attributes, Mesh, MeshBuilder};

use super::parse::Parsed;
use super::smoothing::group_normals;
use crate::error::Place;
use crate::rebase::offset_for;
use crate::warning::Warnings;

/// One object or group.
pub(crate) struct Part {
    pub(crate) name: String,
    pub(crate) mesh: Mesh,
    /// The materials of its slots: indices of the record's names.
    pub(crate) materials: Vec<Option<u32>>,
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
pub(crate) fn build_parts(parsed: &Parsed, warnings: &mut Warnings) -> (Vec<Part>, DVec3) {
    let positions: Vec<DVec3> = parsed.mesh.positions.chunks_exact(3).map(DVec3::from_slice).collect();
    let offset = offset_for(&positions);
    let cutter = Cutter { parsed, offset, positions: &positions };
    let mut local = vec![NOT_YET; positions.len()];
    let mut dropped = Dropped::default();
    let spans = spans_by_part(parsed);
    let names = parsed.record.parts.list();
    let cut = |(name, spans): (&String, &Vec<Span>)| cutter.part(name, spans, &mut local, &mut dropped);
    let parts = names.iter().zip(&spans).map(cut).collect();
    let place = parsed.non_finite_line.map_or(Place::Whole, Place::Line);
    warnings.push_counted(
        dropped.non_finite,
        place,
        "a face has a vertex that is not finite and is left out",
        "export the model again",
    );
    let colors = parsed
        .mesh
        .vertex_color
        .chunks_exact(3)
        .filter(|color| !color.iter().all(|channel| channel.is_finite()))
        .count();
    warnings.push_counted(
        colors,
        Place::Whole,
        "a vertex has a colour that is not finite; it is white there",
        "export the model again",
    );
    warnings.push_counted(
        dropped.flat,
        Place::Whole,
        "a face has fewer than 3 different vertices and is left out",
        "clean the model up",
    );
    (parts, offset)
}

/// Marks a vertex that the current part has not used.
const NOT_YET: u32 = u32::MAX;

#[derive(Default)]
struct Dropped {
    non_finite: usize,
    flat: usize,
}

/// The elements of each part, with where their corners start.
fn spans_by_part(parsed: &Parsed) -> Vec<Vec<Span>> {
    let record = &parsed.record;
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
        corner += (run.first..end).map(|element| arity(parsed, element)).sum::<usize>();
    }
    parts
}

/// How many corners an element has; tobj keeps no list when all are triangles.
fn arity(parsed: &Parsed, element: usize) -> usize {
    parsed.mesh.face_arities.get(element).map_or(3, |&arity| arity as usize)
}

struct Cutter<'a> {
    parsed: &'a Parsed,
    positions: &'a [DVec3],
    offset: DVec3,
}

/// A part under construction.
struct Draft {
    builder: MeshBuilder,
    /// For each corner of the accepted faces, its corner in tobj's lists.
    sources: Vec<u32>,
    face_slots: Vec<u32>,
    face_groups: Vec<u32>,
    materials: Vec<Option<u32>>,
    slots: HashMap<Option<u32>, u32>,
    /// Vertices of the file that the part uses.
    used: Vec<u32>,
    face: Vec<u32>,
}

impl Cutter<'_> {
    fn part(&self, name: &str, spans: &[Span], local: &mut [u32], dropped: &mut Dropped) -> Part {
        let faces = spans.iter().map(|span| span.elements.1 - span.elements.0).sum();
        let builder = MeshBuilder::with_capacity(faces / 2, faces, 3 * faces);
        let (sources, face_slots) = (Vec::with_capacity(3 * faces), Vec::with_capacity(faces));
        let face_groups = Vec::with_capacity(faces);
        let mut draft = Draft {
            builder,
            sources,
            face_slots,
            face_groups,
            materials: Vec::new(),
            slots: HashMap::new(),
            used: Vec::new(),
            face: Vec::new(),
        };
        for span in spans {
            self.span(span, &mut draft, local, dropped);
        }
        for &vertex in &draft.used {
            local[vertex as usize] = NOT_YET;
        }
        let Draft { builder, sources, face_slots, face_groups, mut materials, .. } = draft;
        let mut mesh = builder.build();
        let attributes = self.attributes(&mesh, &sources, face_slots, &face_groups, materials.len());
        mesh.set_attributes(attributes).expect("one value per accepted corner and face");
        if materials.is_empty() {
            materials.push(None);
        }
        Part { name: name.to_owned(), mesh, materials }
    }

    fn span(&self, span: &Span, draft: &mut Draft, local: &mut [u32], dropped: &mut Dropped) {
        let slot = draft.slot(span.material);
        let mut corner = span.first_corner;
        for element in span.elements.0..span.elements.1 {
            let corners = corner..corner + arity(self.parsed, element);
            corner = corners.end;
            draft.face.clear();
            for &vertex in &self.parsed.mesh.indices[corners.clone()] {
                let Some(index) = self.vertex(vertex, draft, local) else { break };
                draft.face.push(index);
            }
            if draft.face.len() < corners.len() {
                dropped.non_finite += 1;
                continue;
            }
            draft.push(corners.start, slot, span.smoothing, dropped);
        }
    }

    /// The part's own index of a vertex; `None` when it has no finite place.
    fn vertex(&self, vertex: u32, draft: &mut Draft, local: &mut [u32]) -> Option<u32> {
        let known = &mut local[vertex as usize];
        if *known != NOT_YET {
            return Some(*known);
        }
        let position = (self.positions[vertex as usize] - self.offset).as_vec3();
        if !position.is_finite() {
            return None;
        }
        draft.used.push(vertex);
        *known = draft.builder.push_vertex(position);
        Some(*known)
    }

    fn attributes(
        &self,
        mesh: &Mesh,
        sources: &[u32],
        face_slots: Vec<u32>,
        face_groups: &[u32],
        slots: usize,
    ) -> Attributes {
        let given = self.normals(sources);
        let is_smooth = face_groups.iter().any(|&group| group != 0);
        let mut groups: Vec<u32> = face_groups.iter().copied().filter(|&group| group != 0).collect();
        groups.dedup();
        let several = groups.iter().any(|&group| group != groups[0]);
        let corner_normals = if several { Some(group_normals(mesh, given, face_groups)) } else { given };
        Attributes {
            corner_normals,
            uv_sets: self.coordinates(sources).into_iter().collect(),
            corner_colors: self.colors(sources),
            face_materials: (slots > 1).then_some(face_slots),
            face_smooth: is_smooth.then(|| face_groups.iter().map(|&group| group != 0).collect()),
            ..Attributes::default()
        }
    }

    /// The normals as the file has them, zero where it has none.
    fn normals(&self, sources: &[u32]) -> Option<Vec<Vec3>> {
        let mesh = &self.parsed.mesh;
        if mesh.normal_indices.is_empty() {
            return None;
        }
        let normal = |&corner: &u32| {
            let at = 3 * mesh.normal_indices[corner as usize] as usize;
            let normal = DVec3::from_slice(&mesh.normals[at..at + 3]).as_vec3();
            if normal.is_finite() { normal } else { Vec3::ZERO }
        };
        let normals: Vec<Vec3> = sources.iter().map(normal).collect();
        normals.iter().any(|&normal| normal != Vec3::ZERO).then_some(normals)
    }

    /// The texture coordinates with v turned down, zero where the file has
    /// none.
    fn coordinates(&self, sources: &[u32]) -> Option<Vec<Vec2>> {
        let mesh = &self.parsed.mesh;
        if mesh.texcoord_indices.is_empty() {
            return None;
        }
        let mut any = false;
        let mut coordinate = |&corner: &u32| {
            let at = 2 * mesh.texcoord_indices[corner as usize] as usize;
            let (u, v) = (mesh.texcoords[at], mesh.texcoords[at + 1]);
            any |= !u.is_nan();
            // OBJ counts from the lower left of the picture, trigon from the upper left.
            let uv = Vec2::new(u as f32, (1.0 - v) as f32);
            if uv.is_finite() { uv } else { Vec2::ZERO }
        };
        let coordinates = sources.iter().map(&mut coordinate).collect();
        any.then_some(coordinates)
    }

    fn colors(&self, sources: &[u32]) -> Option<Vec<Vec4>> {
        let mesh = &self.parsed.mesh;
        if mesh.vertex_color.is_empty() {
            return None;
        }
        let channel =
            |value: f64| if value.is_finite() { srgb_to_linear(value.clamp(0.0, 1.0) as f32) } else { 1.0 };
        let color = |&corner: &u32| {
            let at = 3 * mesh.indices[corner as usize] as usize;
            let [red, green, blue] = [0, 1, 2].map(|index| channel(mesh.vertex_color[at + index]));
            Vec4::new(red, green, blue, 1.0)
        };
        Some(sources.iter().map(color).collect())
    }
}

impl Draft {
    /// The slot of a material, a new one for a new material.
    fn slot(&mut self, material: Option<u32>) -> u32 {
        *self.slots.entry(material).or_insert_with(|| {
            self.materials.push(material);
            self.materials.len() as u32 - 1
        })
    }

    /// Adds the element in `self.face`, whose corners start at `corner`.
    fn push(&mut self, corner: usize, slot: u32, smoothing: u32, dropped: &mut Dropped) {
        let added = match *self.face.as_slice() {
            [point] => self.builder.push_loose_point(point),
            [from, to] if from == to => self.builder.push_loose_point(from),
            [from, to] => self.builder.push_loose_edge(from, to),
            _ => self.builder.push_face(&self.face).map(|_| {
                self.sources.extend((corner..corner + self.face.len()).map(|corner| corner as u32));
                self.face_slots.push(slot);
                self.face_groups.push(smoothing);
            }),
        };
        // Its vertices were just added: it can only be too few different ones.
        dropped.flat += usize::from(added.is_err());
    }
}
