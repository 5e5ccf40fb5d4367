//! How vertices move: the joints with weights and the morph targets of a primitive, and those of the mesh under
//! construction.

use std::collections::HashMap;

use gltf::json::mesh::Semantic;
use gltf::json::validation::Checked;
use trigon_math::Vec3;
use trigon_mesh::{Deltas, MorphTarget, SkinWeights};

use super::part::Optional;
use super::part::Part;
use crate::formats::gltf::buffers::Unplaced;
use crate::formats::gltf::formats::{JOINTS, TARGET_NORMAL, TARGET_POSITION, TARGET_TANGENT, Usage, WEIGHTS};

/// Joints in a set of attributes: JOINTS_0 has four, JOINTS_1 four more.
const PER_SET: usize = 4;
/// The maximum number of sets.
const MOST_SETS: u32 = 4;
/// The largest deviation of a vertex's total weight from 1 without a warning: quantized weights are
/// off by about 1/255 each.
const TOLERANCE: f32 = 0.02;

/// The joints of each vertex, all sets of a vertex together.
pub(super) struct PartSkin {
    pub(super) per_vertex: usize,
    pub(super) joints: Vec<u16>,
    pub(super) weights: Vec<f32>,
}

impl PartSkin {
    pub(super) fn of_vertex(&self, vertex: usize) -> impl Iterator<Item = (u16, f32)> {
        let range = vertex * self.per_vertex..(vertex + 1) * self.per_vertex;
        self.joints[range.clone()].iter().copied().zip(self.weights[range].iter().copied())
    }
}

/// The deltas of a morph target for each vertex.
#[derive(Default)]
pub(super) struct PartTarget {
    pub(super) positions: Option<Vec<[f32; 3]>>,
    pub(super) normals: Option<Vec<[f32; 3]>>,
    pub(super) tangents: Option<Vec<[f32; 3]>>,
}

/// The vector of a vertex; zero if it is missing or not finite.
pub(super) fn delta(list: Option<&Vec<[f32; 3]>>, vertex: usize) -> Vec3 {
    let value = list.map_or(Vec3::ZERO, |list| Vec3::from(list[vertex]));
    if value.is_finite() { value } else { Vec3::ZERO }
}

/// Reads joints and weights; `None` unless there is a set of both.
pub(super) fn read_skin(from: &mut Optional<'_, '_>) -> Result<Option<PartSkin>, Unplaced> {
    let mut sets = Vec::new();
    for set in 0..=MOST_SETS {
        if set == MOST_SETS {
            warn_of_later_sets(from, set);
            break;
        }
        let joints = from.read::<4>(Semantic::Joints(set), &JOINTS)?;
        let weights = from.read::<4>(Semantic::Weights(set), &WEIGHTS)?;
        match (joints, weights) {
            (Some(joints), Some(weights)) => sets.push((joints, weights)),
            (None, None) => {
                warn_of_later_sets(from, set);
                break;
            }
            _ => {
                from.warn(format!("JOINTS_{set} and WEIGHTS_{set} are not both there and are ignored"));
                break;
            }
        }
    }
    if sets.is_empty() {
        return Ok(None);
    }
    let (mut joints, mut weights) = (Vec::new(), Vec::new());
    let mut mended = 0;
    for vertex in 0..from.vertices {
        let start = weights.len();
        for (of_joints, of_weights) in &sets {
            // Indices are integers of at most 16 bits; a cast limits others to that.
            joints.extend(of_joints[vertex].map(|joint| joint as u16));
            weights.extend_from_slice(&of_weights[vertex]);
        }
        mended += usize::from(!are_sound(&weights[start..]));
    }
    if mended > 0 {
        from.warnings.push_counted(
            mended,
            from.location.clone(),
            "a vertex has skin weights that are negative, not finite or not 1 in all; they are corrected",
            "normalize the weights and export again",
        );
    }
    Ok(Some(PartSkin { per_vertex: sets.len() * PER_SET, joints, weights }))
}

/// Warns if there are more sets than were read.
fn warn_of_later_sets(from: &mut Optional<'_, '_>, read: u32) {
    let is_later = |key: &Checked<Semantic>| matches!(key, Checked::Valid(Semantic::Joints(set) | Semantic::Weights(set)) if *set >= read);
    if from.primitive.attributes.keys().any(is_later) {
        from.warn(format!(
            "its JOINTS and WEIGHTS from set {read} on are ignored: set numbers must have no gap, and {MOST_SETS} sets are supported"
        ));
    }
}

fn are_sound(weights: &[f32]) -> bool {
    let sum: f32 = weights.iter().sum();
    weights.iter().all(|&weight| weight >= 0.0) && (sum - 1.0).abs() <= TOLERANCE
}

/// Reads the morph targets. Their tangents are read if the base has some.
pub(super) fn read_targets(
    from: &mut Optional<'_, '_>,
    with_tangents: bool,
) -> Result<Vec<PartTarget>, Unplaced> {
    let mut targets = Vec::new();
    let (has_normals, has_tangents) = (from.has(Semantic::Normals), from.has(Semantic::Tangents));
    for target in from.primitive.targets.iter().flatten() {
        from.accessors.spend(from.vertices, from.location)?;
        if target.normals.is_some() && !has_normals || target.tangents.is_some() && !has_tangents {
            from.warn("a morph target has a NORMAL or TANGENT that the primitive lacks; it is ignored");
        }
        let mut read = |index: Option<usize>, usage: &Usage| match index {
            Some(index) => from.read_accessor::<3>(index, usage),
            None => Ok(None),
        };
        let index = |accessor: Option<gltf::json::Index<gltf::json::Accessor>>| accessor.map(|a| a.value());
        targets.push(PartTarget {
            positions: read(index(target.positions), &TARGET_POSITION)?,
            normals: read(index(target.normals).filter(|_| has_normals), &TARGET_NORMAL)?,
            tangents: read(index(target.tangents).filter(|_| with_tangents), &TARGET_TANGENT)?,
        });
    }
    Ok(targets)
}

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
