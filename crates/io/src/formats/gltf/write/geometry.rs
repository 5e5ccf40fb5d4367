//! The triangles, lines and points of a mesh as accessors, for every program to read.
//!
//! All triangles share their vertices; each material slot has its own indices. Content that the
//! format forbids is corrected: triangles with positions that are not finite are left out, normals
//! and tangents without a direction get one, colours are clamped to 0…1.

use std::borrow::Cow;
use std::collections::BTreeMap;

use trigon_math::{Vec2, Vec3, Vec4};
use trigon_mesh::{Deltas, Mesh, RenderMesh, SkinWeights};

use super::draft::{Bounded, BufferTarget, Draft, Integers};

const POINTS: u32 = 0;
const LINES: u32 = 1;
const TRIANGLES: u32 = 4;

/// A primitive without its material.
#[derive(Clone)]
pub(super) struct GeometryPart {
    /// The material slot of its faces.
    pub(super) slot: u32,
    pub(super) mode: u32,
    /// Accessors by their names, sorted.
    pub(super) attributes: BTreeMap<String, usize>,
    pub(super) indices: Option<usize>,
    /// For each morph target.
    pub(super) targets: Vec<BTreeMap<&'static str, usize>>,
}

/// Writes a mesh; no parts if it has no vertex that could be shown.
pub(super) fn write_geometry(draft: &mut Draft<'_>, mesh: &Mesh, render: &RenderMesh) -> Vec<GeometryPart> {
    let mut parts = write_triangles(draft, render);
    let position = |vertex: &u32| mesh.positions()[*vertex as usize];
    let is_finite = |vertex: &u32| position(vertex).is_finite();
    let edges: Vec<u32> =
        mesh.loose_edges().iter().filter(|ends| ends.iter().all(is_finite)).flatten().copied().collect();
    let mut points: Vec<u32> =
        mesh.loose_points().iter().filter(|&point| is_finite(point)).copied().collect();
    if parts.is_empty() && edges.is_empty() && points.is_empty() {
        // Isolated vertices: the format can only store them as points.
        points = (0..mesh.vertex_count() as u32).filter(is_finite).collect();
    }
    for (mode, vertices) in [(LINES, edges), (POINTS, points)] {
        if !vertices.is_empty() {
            parts.push(write_loose(draft, mesh, mode, &vertices));
        }
    }
    parts
}

/// Stands for a mesh with nothing that other programs could show, because the format has no empty meshes: a triangle
/// without area.
pub(super) fn write_placeholder(draft: &mut Draft<'_>, mesh: &Mesh) -> GeometryPart {
    let corners = draft.floats(&[[0.0; 3]; 3], Some(BufferTarget::Vertices), Bounded::Yes);
    let target = BTreeMap::from([("POSITION", corners)]);
    GeometryPart {
        slot: 0,
        mode: TRIANGLES,
        attributes: BTreeMap::from([("POSITION".to_owned(), corners)]),
        indices: None,
        targets: vec![target; mesh.attributes().morph_targets.len()],
    }
}

fn write_triangles(draft: &mut Draft<'_>, render: &RenderMesh) -> Vec<GeometryPart> {
    let slots = sort_by_slot(render);
    if slots.is_empty() {
        return Vec::new();
    }
    let vertices = Some(BufferTarget::Vertices);
    let mut attributes = BTreeMap::new();
    let positions: Vec<[f32; 3]> = render.positions.iter().map(|&position| finite(position)).collect();
    attributes.insert("POSITION".to_owned(), draft.floats(&positions, vertices, Bounded::Yes));
    let normals: Vec<[f32; 3]> = render.normals.iter().map(|&normal| direction(normal).to_array()).collect();
    attributes.insert("NORMAL".to_owned(), draft.floats(&normals, vertices, Bounded::No));
    for (set, uvs) in render.uv_sets.iter().enumerate() {
        let uvs: Vec<[f32; 2]> = uvs.iter().map(|&uv| finite_uv(uv)).collect();
        attributes.insert(format!("TEXCOORD_{set}"), draft.floats(&uvs, vertices, Bounded::No));
    }
    if let Some(colors) = &render.colors {
        let colors: Vec<[f32; 4]> = colors.iter().map(|&color| clamped(color)).collect();
        attributes.insert("COLOR_0".to_owned(), draft.floats(&colors, vertices, Bounded::No));
    }
    if let Some(skin) = &render.skin {
        write_skin(draft, skin, 0..skin.vertex_count(), &mut attributes);
    }
    let tangent = render.tangents.as_ref().map(|tangents| {
        let sound =
            tangents.iter().zip(&render.normals).map(|(&tangent, &normal)| sound_tangent(tangent, normal));
        draft.floats(&sound.collect::<Vec<_>>(), vertices, Bounded::No)
    });
    let targets = write_targets(draft, render, positions.len());
    let part = |(slot, indices): (u32, Vec<u32>)| {
        let mut attributes = attributes.clone();
        let has_tangent = |&vertex: &u32| {
            render.tangents.as_ref().is_some_and(|tangents| is_sound(tangents[vertex as usize]))
        };
        if let Some(tangent) = tangent.filter(|_| indices.iter().all(has_tangent)) {
            attributes.insert("TANGENT".to_owned(), tangent);
        }
        let list = Integers::Indices(&indices, positions.len() as u32);
        let indices = Some(draft.integers(list, Some(BufferTarget::Indices)));
        GeometryPart { slot, mode: TRIANGLES, attributes, indices, targets: targets.clone() }
    };
    slots.into_iter().map(part).collect()
}

/// The vertices of all triangles with finite positions, by their material slot.
fn sort_by_slot(render: &RenderMesh) -> BTreeMap<u32, Vec<u32>> {
    let mut slots: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    let all_finite = render.positions.iter().all(|position| position.is_finite());
    let is_finite = |&vertex: &u32| render.positions[vertex as usize].is_finite();
    let mut start = 0;
    // Faces of one material are mostly consecutive.
    let none = || Cow::Owned(vec![0; render.triangles.len()]);
    let materials = render.triangle_materials.as_deref().map_or_else(none, Cow::Borrowed);
    for same in materials.chunk_by(|a, b| a == b) {
        let triangles = &render.triangles[start..start + same.len()];
        start += same.len();
        let list = slots.entry(same[0]).or_default();
        let whole = triangles.iter().filter(|triangle| all_finite || triangle.iter().all(is_finite));
        list.extend(whole.flatten());
    }
    slots.retain(|_, list| !list.is_empty());
    slots
}

fn write_targets(
    draft: &mut Draft<'_>,
    render: &RenderMesh,
    count: usize,
) -> Vec<BTreeMap<&'static str, usize>> {
    let targets = &render.morph_targets;
    let with_normals = targets.iter().any(|target| !target.normals.is_empty());
    let with_tangents = render.tangents.is_some() && targets.iter().any(|target| !target.tangents.is_empty());
    let mut write =
        |deltas: &Deltas, bounded| draft.floats(&dense(deltas, count), Some(BufferTarget::Vertices), bounded);
    let mut all = Vec::new();
    for target in targets {
        let mut of_target = BTreeMap::from([("POSITION", write(&target.positions, Bounded::Yes))]);
        if with_normals {
            of_target.insert("NORMAL", write(&target.normals, Bounded::No));
        }
        if with_tangents {
            of_target.insert("TANGENT", write(&target.tangents, Bounded::No));
        }
        all.push(of_target);
    }
    all
}

/// Lines or points: they have no face attributes, but the colours of their vertices, and move with the others.
fn write_loose(draft: &mut Draft<'_>, mesh: &Mesh, mode: u32, vertices: &[u32]) -> GeometryPart {
    let mut used = vertices.to_vec();
    used.sort_unstable();
    used.dedup();
    let number = |vertex: &u32| used.binary_search(vertex).expect("it is used") as u32;
    let positions: Vec<[f32; 3]> =
        used.iter().map(|&vertex| mesh.positions()[vertex as usize].to_array()).collect();
    let mut attributes = BTreeMap::new();
    let target = Some(BufferTarget::Vertices);
    attributes.insert("POSITION".to_owned(), draft.floats(&positions, target, Bounded::Yes));
    if let Some(colors) = &mesh.attributes().vertex_colors {
        let colors: Vec<[f32; 4]> = used.iter().map(|&vertex| clamped(colors[vertex as usize])).collect();
        attributes.insert("COLOR_0".to_owned(), draft.floats(&colors, target, Bounded::No));
    }
    if let Some(skin) = &mesh.attributes().skin {
        write_skin(draft, skin, used.iter().map(|&vertex| vertex as usize), &mut attributes);
    }
    let mut targets = Vec::new();
    for morph in &mesh.attributes().morph_targets {
        let all = dense(&morph.positions, mesh.vertex_count());
        let deltas: Vec<[f32; 3]> = used.iter().map(|&vertex| all[vertex as usize]).collect();
        targets.push(BTreeMap::from([("POSITION", draft.floats(&deltas, target, Bounded::Yes))]));
    }
    let indices: Vec<u32> = vertices.iter().map(number).collect();
    let list = Integers::Indices(&indices, used.len() as u32);
    let indices = Some(draft.integers(list, Some(BufferTarget::Indices)));
    GeometryPart { slot: 0, mode, attributes, indices, targets }
}

/// Joints and weights, in sets of four.
fn write_skin(
    draft: &mut Draft<'_>,
    skin: &SkinWeights,
    vertices: impl Iterator<Item = usize> + Clone,
    attributes: &mut BTreeMap<String, usize>,
) {
    for set in 0..skin.per_vertex().div_ceil(4) {
        let (mut joints, mut weights) = (Vec::new(), Vec::new());
        for vertex in vertices.clone() {
            let (mut of_joints, mut of_weights) = ([0; 4], [0.0; 4]);
            let influences = skin.influences(vertex).skip(4 * set).take(4);
            // A joint without weight is 0.
            for (slot, (joint, weight)) in influences.enumerate().filter(|(_, (_, weight))| *weight > 0.0) {
                of_joints[slot] = joint;
                of_weights[slot] = weight;
            }
            joints.push(of_joints);
            weights.push(of_weights);
        }
        let target = Some(BufferTarget::Vertices);
        attributes.insert(format!("JOINTS_{set}"), draft.integers(Integers::Joints(&joints), target));
        attributes.insert(format!("WEIGHTS_{set}"), draft.floats(&weights, target, Bounded::No));
    }
}

fn dense(deltas: &Deltas, count: usize) -> Vec<[f32; 3]> {
    let mut values = vec![[0.0; 3]; count];
    for (index, value) in deltas.iter() {
        values[index as usize] = value.to_array();
    }
    values
}

fn finite(position: Vec3) -> [f32; 3] {
    if position.is_finite() { position.to_array() } else { [0.0; 3] }
}

fn finite_uv(uv: Vec2) -> [f32; 2] {
    if uv.is_finite() { uv.to_array() } else { [0.0; 2] }
}

fn clamped(color: Vec4) -> [f32; 4] {
    let channel = |value: f32| if value > 0.0 { value.min(1.0) } else { 0.0 };
    color.to_array().map(channel)
}

/// Whether a vector has unit length up to rounding.
fn is_unit(vector: Vec3) -> bool {
    /// Far less than the tolerance of other programs, and more than rounding error.
    const ROUNDING: f32 = 1e-4;
    (vector.length_squared() - 1.0).abs() <= ROUNDING
}

/// A unit vector: the same, or its direction, or an arbitrary one.
fn direction(normal: Vec3) -> Vec3 {
    if is_unit(normal) { normal } else { normal.try_normalize().unwrap_or(Vec3::Z) }
}

fn is_sound(tangent: Vec4) -> bool {
    is_unit(tangent.truncate()) && tangent.w.abs() == 1.0
}

fn sound_tangent(tangent: Vec4, normal: Vec3) -> [f32; 4] {
    if is_sound(tangent) {
        return tangent.to_array();
    }
    direction(normal).any_orthonormal_vector().extend(1.0).to_array()
}
