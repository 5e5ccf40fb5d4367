//! How the vertices of the mesh under construction move: their joints and morph targets.

use std::collections::HashMap;

use trigon_math::Vec3;
use trigon_mesh::{Deltas, MorphTarget, SkinWeights};

use super::movement::delta;
use super::part::Part;

/// The movement of vertices.
pub(super) struct Movements {
    per_vertex: usize,
    joints: Vec<u16>,
    weights: Vec<f32>,
    targets: Vec<Target>,
    /// A number for each movement; 0 means none.
    ways: HashMap<Vec<u32>, u32>,
    /// The movement of each vertex up to the last that has one.
    pub(super) of_vertices: Vec<u32>,
}

#[derive(Default)]
struct Target {
    name: String,
    positions: Vec<(u32, Vec3)>,
    normals: Vec<(u32, Vec3)>,
    tangents: Vec<(u32, Vec3)>,
    corner_count: u32,
}

impl Movements {
    pub(super) fn new(parts: &[Part], target_names: &[String]) -> Self {
        let per_vertex = parts.iter().filter_map(|part| part.skin.as_ref()).map(|skin| skin.per_vertex).max();
        let count = parts.iter().map(|part| part.targets.len()).max().unwrap_or(0);
        let name = |index: usize| target_names.get(index).cloned().unwrap_or_default();
        let target = |index| Target { name: name(index), ..Target::default() };
        Self {
            per_vertex: per_vertex.unwrap_or(0),
            joints: Vec::new(),
            weights: Vec::new(),
            targets: (0..count).map(target).collect(),
            ways: HashMap::new(),
            of_vertices: Vec::new(),
        }
    }

    /// A number that vertices share exactly if they move the same way.
    pub(super) fn way(&mut self, part: &Part, vertex: usize) -> u32 {
        if part.skin.is_none() && part.targets.is_empty() {
            return 0;
        }
        let mut key = Vec::new();
        for (joint, weight) in part.skin.iter().flat_map(|skin| skin.of_vertex(vertex)) {
            key.extend([u32::from(joint), bits(weight)]);
        }
        for (index, target) in part.targets.iter().enumerate() {
            let delta = delta(target.positions.as_ref(), vertex);
            if delta != Vec3::ZERO {
                key.push(index as u32);
                key.extend(delta.to_array().map(bits));
            }
        }
        let next = self.ways.len() as u32 + 1;
        *self.ways.entry(key).or_insert(next)
    }

    pub(super) fn push_vertex(&mut self, part: &Part, vertex: usize, new: u32, way: u32) {
        if way != 0 {
            self.of_vertices.resize(new as usize, 0);
            self.of_vertices.push(way);
        }
        let filled = self.joints.len() + self.per_vertex;
        for (joint, weight) in part.skin.iter().flat_map(|skin| skin.of_vertex(vertex)) {
            self.joints.push(joint);
            self.weights.push(weight);
        }
        self.joints.resize(filled, 0);
        self.weights.resize(filled, 0.0);
        for (to, from) in self.targets.iter_mut().zip(&part.targets) {
            push(&mut to.positions, new, delta(from.positions.as_ref(), vertex));
        }
    }

    pub(super) fn push_corners(&mut self, part: &Part, vertices: &[u32]) {
        for (index, to) in self.targets.iter_mut().enumerate() {
            let first = to.corner_count;
            to.corner_count += vertices.len() as u32;
            let Some(from) = part.targets.get(index) else { continue };
            for (corner, &vertex) in (first..).zip(vertices) {
                push(&mut to.normals, corner, delta(from.normals.as_ref(), vertex as usize));
                push(&mut to.tangents, corner, delta(from.tangents.as_ref(), vertex as usize));
            }
        }
    }

    pub(super) fn finish(self) -> (Option<SkinWeights>, Vec<MorphTarget>) {
        let target = |from: Target| MorphTarget {
            name: from.name,
            positions: Deltas::new(from.positions),
            normals: Deltas::new(from.normals),
            tangents: Deltas::new(from.tangents),
        };
        let skin = SkinWeights::new(self.per_vertex, self.joints, self.weights);
        (skin, self.targets.into_iter().map(target).collect())
    }
}

fn push(list: &mut Vec<(u32, Vec3)>, index: u32, delta: Vec3) {
    if delta != Vec3::ZERO {
        list.push((index, delta));
    }
}

/// Adding zero makes −0 and +0 equal.
pub(super) fn bits(value: f32) -> u32 {
    (value + 0.0).to_bits()
}
