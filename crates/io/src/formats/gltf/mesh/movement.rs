//! The movement of a primitive's vertices: joints with weights, and morph targets.

use gltf::json::mesh::Semantic;
use gltf::json::validation::Checked;
use trigon_math::Vec3;

use super::optional::Optional;
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
