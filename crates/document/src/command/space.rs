//! The space of moves, rotations and scales, and the maps from there to meshes and objects.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::{DAffine3, DMat3, DVec3};
use trigon_modelling::{EditMesh, Refusal, VertexId};
use trigon_scene::{MeshId, NodeId, Scene};

use crate::error::EditError;
use crate::selection::{ElementKind, MeshSelection};
use crate::state::Change;

/// The space in which offsets, axes and centres are given.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TransformSpace {
    /// Elements in the space of their mesh, objects in that of their parent.
    #[default]
    Local,
    /// World space. If selected objects are parents of each other, only the topmost are changed,
    /// and the others follow.
    World,
}

impl TransformSpace {
    /// The map from this space into that of each edited mesh. A mesh that several objects share is placed by
    /// the first selected one.
    pub(super) fn into_meshes(
        self,
        command: &'static str,
        change: &Change<'_>,
    ) -> Result<BTreeMap<MeshId, DAffine3>, EditError> {
        let meshes = change.selection().meshes().map(|(id, _)| id);
        let into_mesh = |id| {
            let to_world = match self {
                Self::Local => return Ok((id, DAffine3::IDENTITY)),
                Self::World => change.state().mesh_transform(id),
            };
            Ok((id, inverse(to_world, command)?))
        };
        meshes.map(into_mesh).collect()
    }
}

/// The inverse map.
pub(super) fn inverse(map: DAffine3, command: &'static str) -> Result<DAffine3, EditError> {
    let reason = "the object or its parent is scaled to zero; scale it up first";
    let flat = Refusal::NotPossible { operation: command, reason };
    let matrix = map.matrix3.try_inverse().filter(DMat3::is_finite).ok_or(flat)?;
    Ok(DAffine3 { matrix3: matrix, translation: -(matrix * map.translation) })
}

/// The factor by which lengths change on the way into another space; exactly 1 if they do not.
pub(super) fn length_factor(map: &DAffine3) -> f64 {
    let volume = map.matrix3.determinant().abs();
    if volume == 1.0 { 1.0 } else { trigon_mesh::math::elementary::cbrt(volume) }
}

/// Whether a matrix preserves angles: it rotates, mirrors and scales uniformly.
pub(super) fn keeps_angles(matrix: &DMat3) -> bool {
    // The rounding error of a product of a few rotations and uniform scales; unequal scales that a user can
    // see are far above it.
    const ROUNDING: f64 = 1e-9;
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let square = x.length_squared();
    let uneven = [y.length_squared() - square, z.length_squared() - square, x.dot(y), y.dot(z), z.dot(x)];
    uneven.iter().all(|difference| difference.abs() <= ROUNDING * square)
}

/// The selected objects that a command in a space changes: in world space those without a selected
/// ancestor.
pub(super) fn objects_to_change(
    change: &Change<'_>,
    command: &'static str,
    space: TransformSpace,
) -> Result<Vec<NodeId>, EditError> {
    let objects = &change.selection().objects;
    if objects.is_empty() {
        return Err(EditError::NothingSelected { command, needed: "at least one object" });
    }
    let follows = |id: NodeId| change.scene().ancestors(id).skip(1).any(|above| objects.contains(&above));
    let is_changed = |id: &NodeId| space == TransformSpace::Local || !follows(*id);
    Ok(objects.iter().copied().filter(is_changed).collect())
}

/// The map from an object's parent into the world.
pub(super) fn parent_to_world(scene: &Scene, object: NodeId) -> DAffine3 {
    let parent = scene.node(object).and_then(trigon_scene::Node::parent);
    parent.map_or(DAffine3::IDENTITY, |parent| scene.world_transform(parent))
}

/// The mean of some vertices; the origin if it is not finite.
pub(super) fn middle(mesh: &EditMesh, vertices: &[VertexId]) -> DVec3 {
    let sum: DVec3 = vertices.iter().map(|&vertex| mesh.position(vertex).as_dvec3()).sum();
    let mean = sum / vertices.len() as f64;
    if mean.is_finite() { mean } else { DVec3::ZERO }
}

/// The selected vertices in groups connected by selected edges and faces.
pub(super) fn islands(mesh: &EditMesh, selection: &MeshSelection, kind: ElementKind) -> Vec<Vec<VertexId>> {
    let vertices = selection.vertices(mesh, kind);
    // Each entry points to a lower one of its group, or to itself.
    let mut first: Vec<usize> = (0..vertices.len()).collect();
    for edge in selection.edges(mesh, kind) {
        let [a, b] = mesh.edge_vertices(edge).map(|vertex| vertices.binary_search(&vertex));
        if let (Ok(a), Ok(b)) = (a, b) {
            let (a, b) = (lowest(&mut first, a), lowest(&mut first, b));
            first[a.max(b)] = a.min(b);
        }
    }
    let mut groups: Vec<Vec<VertexId>> = vec![Vec::new(); vertices.len()];
    for (index, &vertex) in vertices.iter().enumerate() {
        groups[lowest(&mut first, index)].push(vertex);
    }
    groups.retain(|group| !group.is_empty());
    groups
}

/// The lowest entry of a group; paths are shortened along the way.
fn lowest(first: &mut [usize], mut index: usize) -> usize {
    while first[index] != index {
        first[index] = first[first[index]];
        index = first[index];
    }
    index
}
