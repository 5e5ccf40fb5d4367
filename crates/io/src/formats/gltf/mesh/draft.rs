//! The mesh under construction: parts welded into one.

use std::collections::HashMap;
use std::hash::Hash;
use std::mem::take;
use std::ops::Range;

use rayon::prelude::*;
use trigon_math::{Vec2, Vec3, Vec4};
use trigon_mesh::{Attributes, MeshBuilder};

use super::BuiltMesh;
use super::movement::{Movements, bits};
use super::part::Part;
use crate::formats::gltf::primitive::Elements;
use crate::vertex_table::{AT_ONCE, VertexTable};

/// So many triangles are checked at once.
const FACES_AT_ONCE: usize = 1 << 10;

/// The mesh under construction.
pub(super) struct MeshDraft {
    builder: MeshBuilder,
    /// The vertices by position and movement.
    welded: VertexTable,
    movements: Movements,
    /// The colours of the vertices, of a mesh in which lines or points have any.
    vertex_colors: Option<Vec<Vec4>>,
    attributes: Attributes,
    /// Once there are several materials.
    face_materials: Vec<u32>,
    materials: Vec<Option<usize>>,
    slots: HashMap<Option<usize>, u32>,
    /// The corners of each part.
    pub(super) corners: Vec<Range<usize>>,
    pub(super) flat: usize,
    pub(super) non_finite: usize,
}

impl MeshDraft {
    pub(super) fn new(parts: &[Part], target_names: &[String]) -> Self {
        let sum = |count: fn(&Part) -> usize| parts.iter().map(count).sum::<usize>();
        let (vertices, faces) =
            (sum(|part| part.positions.len()), sum(|part| part.elements.triangles.len() / 3));
        let any = |has: fn(&Part) -> bool| parts.iter().any(has);
        let sets = parts.iter().map(|part| part.uv_sets.len()).max().unwrap_or(0);
        let attributes = Attributes {
            corner_normals: any(|part| part.normals.is_some()).then(|| Vec::with_capacity(3 * faces)),
            corner_tangents: any(|part| part.tangents.is_some()).then(|| Vec::with_capacity(3 * faces)),
            corner_colors: any(Part::has_colored_faces).then(|| Vec::with_capacity(3 * faces)),
            uv_sets: (0..sets).map(|_| Vec::with_capacity(3 * faces)).collect(),
            ..Attributes::default()
        };
        Self {
            builder: MeshBuilder::with_capacity(vertices, faces, 3 * faces),
            welded: VertexTable::with_capacity(vertices),
            movements: Movements::new(parts, target_names),
            vertex_colors: any(|part| part.wire_colors().is_some() || part.tint.is_some())
                .then(|| Vec::with_capacity(vertices)),
            attributes,
            face_materials: Vec::new(),
            materials: Vec::new(),
            slots: HashMap::new(),
            corners: Vec::new(),
            flat: 0,
            non_finite: 0,
        }
    }

    pub(super) fn add(&mut self, mut part: Part) {
        let slot = if part.tint.is_some() { 0 } else { self.slot(part.material) };
        let first_corner = self.builder.corner_count();
        let has_slots = self.materials.len() > 1;
        if has_slots {
            self.face_materials.resize(self.builder.face_count(), 0);
        }
        let vertices = self.weld(&part);
        // Large, and not needed any more.
        part.positions = Vec::new();
        self.add_triangles(&mut part, &vertices);
        if has_slots {
            self.face_materials.resize(self.builder.face_count(), slot);
        }
        self.add_corners(&part);
        self.corners.push(first_corner..self.builder.corner_count());
        self.add_loose(&part.elements, &vertices);
    }

    /// The slot of a material, a new one for a new material.
    pub(super) fn slot(&mut self, material: Option<usize>) -> u32 {
        *self.slots.entry(material).or_insert_with(|| {
            self.materials.push(material);
            self.materials.len() as u32 - 1
        })
    }

    /// Adds the triangles of a part, and removes from it those that are none. `vertices` are those at its vertices.
    fn add_triangles(&mut self, part: &mut Part, vertices: &[u32]) {
        let face = |corners: &[u32; 3]| corners.map(|corner| vertices[corner as usize]);
        let mut faces = Vec::with_capacity(FACES_AT_ONCE);
        let mut all = take(&mut part.elements.triangles);
        let (corners, mut retained) = (all.as_chunks_mut::<3>().0, 0);
        for first in (0..corners.len()).step_by(FACES_AT_ONCE) {
            let some = first..corners.len().min(first + FACES_AT_ONCE);
            faces.clear();
            faces.extend(corners[some.clone()].iter().map(face));
            if self.builder.push_triangles(&faces).is_ok() {
                corners.copy_within(some, retained);
                retained += faces.len();
                continue;
            }
            for (index, face) in some.zip(&faces) {
                if self.add_triangle(face, part.is_strip) {
                    corners[retained] = corners[index];
                    retained += 1;
                }
            }
        }
        all.truncate(3 * retained);
        part.elements.triangles = all;
    }

    /// Adds a triangle if it is one.
    fn add_triangle(&mut self, face: &[u32; 3], is_of_strip: bool) -> bool {
        if face.contains(&NOWHERE) {
            self.non_finite += 1;
            return false;
        }
        let is_accepted = self.builder.push_face(face).is_ok();
        self.flat += usize::from(!is_accepted && !is_of_strip);
        is_accepted
    }

    fn add_loose(&mut self, elements: &Elements, vertices: &[u32]) {
        for edge in &elements.edges {
            match edge.map(|end| vertices[end as usize]) {
                [NOWHERE, _] | [_, NOWHERE] => self.non_finite += 1,
                // A line without length is invisible.
                [from, to] if from == to => {}
                [from, to] => {
                    self.builder.push_loose_edge(from, to).expect("both vertices exist and differ");
                }
            }
        }
        for &point in &elements.points {
            match vertices[point as usize] {
                NOWHERE => self.non_finite += 1,
                vertex => {
                    self.builder.push_loose_point(vertex).expect("the vertex exists");
                }
            }
        }
    }

    /// The vertices at the positions of a part; [`NOWHERE`] where one is not finite.
    fn weld(&mut self, part: &Part) -> Vec<u32> {
        if self.vertex_colors.is_some() {
            self.weld_by::<ColoredKey>(part)
        } else {
            self.weld_by::<WeldKey>(part)
        }
    }

    fn weld_by<K: VertexKey>(&mut self, part: &Part) -> Vec<u32> {
        let mut vertices = Vec::with_capacity(part.positions.len());
        let (mut keys, mut hashes) = (Vec::new(), Vec::new());
        for positions in part.positions.chunks(AT_ONCE) {
            let first = vertices.len();
            let key = |(vertex, &position)| {
                let way = self.movements.way(part, vertex);
                K::new(WeldKey::new(position, way), || wire_color(part, vertex))
            };
            keys.clear();
            keys.extend((first..).zip(positions).map(key));
            self.welded.hash_all(keys.iter(), &mut hashes);
            let found = keys.iter().zip(&hashes).zip(positions).enumerate();
            vertices.extend(found.map(|(index, ((&key, &hash), &position))| {
                if position.is_finite() { self.vertex(part, first + index, key, hash) } else { NOWHERE }
            }));
        }
        vertices
    }

    /// The vertex of a vertex of a part.
    fn vertex<K: VertexKey>(&mut self, part: &Part, vertex: usize, key: K, hash: u64) -> u32 {
        let (positions, ways) = (self.builder.positions(), &self.movements.of_vertices);
        let colors = self.vertex_colors.as_deref().unwrap_or_default();
        let known = |vertex: u32| {
            let way = ways.get(vertex as usize).copied().unwrap_or(0);
            K::new(WeldKey::new(positions[vertex as usize], way), || colors[vertex as usize])
        };
        self.welded.number(&key, hash, known).unwrap_or_else(|new| {
            self.builder.push_vertex(part.positions[vertex]);
            self.movements.push_vertex(part, vertex, new, key.way());
            if let Some(colors) = &mut self.vertex_colors {
                colors.push(wire_color(part, vertex));
            }
            new
        })
    }

    /// Adds the values at the corners of the accepted triangles.
    fn add_corners(&mut self, part: &Part) {
        let corners = part.elements.triangles.as_slice();
        self.movements.push_corners(part, corners);
        let Attributes { corner_normals, corner_tangents, corner_colors, uv_sets, .. } = &mut self.attributes;
        if let Some(list) = corner_normals {
            add(list, corners, part.normals.as_deref(), Vec3::ZERO, |value| sound(value, Vec3::is_finite));
        }
        if let Some(list) = corner_tangents {
            add(list, corners, part.tangents.as_deref(), Vec4::ZERO, sound_tangent);
        }
        if let Some(list) = corner_colors {
            add(list, corners, part.colors.as_deref(), Vec4::ONE, sound_color);
        }
        for (set, list) in uv_sets.iter_mut().enumerate() {
            // A set that is missing before others is empty.
            let values = part.uv_sets.get(set).map(Vec::as_slice).filter(|values| !values.is_empty());
            add(list, corners, values, Vec2::ZERO, |value| sound(value, Vec2::is_finite));
        }
    }

    pub(super) fn finish(mut self) -> BuiltMesh {
        let mut mesh = self.builder.build();
        if self.materials.len() > 1 {
            self.attributes.face_materials = Some(self.face_materials);
        }
        self.attributes.vertex_colors = self.vertex_colors;
        (self.attributes.skin, self.attributes.morph_targets) = self.movements.finish();
        mesh.set_attributes(self.attributes).expect("one value per accepted vertex, corner and face");
        BuiltMesh { mesh, materials: self.materials, primitives: Vec::new(), edit_data: None }
    }
}

/// What tells the vertices of a mesh apart.
trait VertexKey: Copy + Eq + Hash {
    /// `color` is that of its vertex.
    fn new(key: WeldKey, color: impl FnOnce() -> Vec4) -> Self;

    /// The number of its movement.
    fn way(&self) -> u32;
}

/// What tells vertices apart where lines and points have no colours.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct WeldKey {
    position: [u32; 3],
    /// The number of its movement.
    way: u32,
}

impl WeldKey {
    fn new(position: Vec3, way: u32) -> Self {
        Self { position: position.to_array().map(bits), way }
    }
}

impl VertexKey for WeldKey {
    fn new(key: WeldKey, _: impl FnOnce() -> Vec4) -> Self {
        key
    }

    fn way(&self) -> u32 {
        self.way
    }
}

/// What tells vertices apart where they do: three axes that begin at one place keep their colours.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct ColoredKey {
    key: WeldKey,
    color: [u32; 4],
}

impl VertexKey for ColoredKey {
    fn new(key: WeldKey, color: impl FnOnce() -> Vec4) -> Self {
        Self { key, color: color().to_array().map(bits) }
    }

    fn way(&self) -> u32 {
        self.key.way
    }
}

/// The colour that lines or points of a part show at a vertex: white without one, and of faces, which have theirs at
/// corners.
fn wire_color(part: &Part, vertex: usize) -> Vec4 {
    let color = part.wire_colors().map_or(Vec4::ONE, |colors| sound_color(colors[vertex].into()));
    part.tint.map_or(color, |tint| tint.shown(color))
}

/// Stands for a vertex that has no place.
const NOWHERE: u32 = u32::MAX;

/// Adds the values at corners, or as often the same if there are none. All threads write them.
fn add<T: Copy + Send + Sync, const N: usize>(
    list: &mut Vec<T>,
    corners: &[u32],
    values: Option<&[[f32; N]]>,
    missing: T,
    sound: impl Fn(T) -> T + Sync,
) where
    [f32; N]: Into<T>,
{
    match values {
        None => list.resize(list.len() + corners.len(), missing),
        Some(values) => {
            list.par_extend(corners.par_iter().map(|&corner| sound(values[corner as usize].into())));
        }
    }
}

/// Zero instead of what is not finite.
fn sound<T: Copy + Default>(value: T, is_finite: fn(T) -> bool) -> T {
    if is_finite(value) { value } else { T::default() }
}

/// White instead of what is not finite.
fn sound_color(color: Vec4) -> Vec4 {
    if color.is_finite() { color.clamp(Vec4::ZERO, Vec4::ONE) } else { Vec4::ONE }
}

/// A unit vector with a handedness, or zero.
fn sound_tangent(tangent: Vec4) -> Vec4 {
    let direction = tangent.truncate().normalize_or_zero();
    if direction == Vec3::ZERO || !tangent.is_finite() {
        return Vec4::ZERO;
    }
    direction.extend(if tangent.w < 0.0 { -1.0 } else { 1.0 })
}
