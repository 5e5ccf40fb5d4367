//! Copying and joining parts of meshes: duplicate, split off, rip, and several objects into one.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::{DAffine3, DVec3};
use trigon_modelling::{EditMesh, Refusal, Transform};
use trigon_scene::{Material, MaterialId, MeshId, NodeId, Scene, Transform as NodeTransform};

use super::space::TransformSpace;
use super::{Action, Outcome};
use crate::error::EditError;
use crate::selection::{ElementKind, Elements};
use crate::state::{AfterEdit, Change};

const FACES: &str = "at least one selected face";

/// Duplicates the selection within its mesh, and selects the copies.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Duplicate {
    /// The offset of the copies, in metres.
    pub offset: [f64; 3],
}

impl Action for Duplicate {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let offset = DVec3::from(self.offset);
        change.edit_selected("duplicating", "something selected", |mesh, selection| {
            let (faces, edges) = (selection.faces(mesh, kind), selection.edges(mesh, kind));
            let made = mesh.duplicate(&selection.vertices(mesh, kind), &edges, &faces)?;
            if offset != DVec3::ZERO {
                mesh.transform_vertices(&made.vertices, &Transform::Translate { offset }, None)?;
            }
            Ok(AfterEdit::Select(Elements::Vertices(made.vertices)))
        })?;
        Ok(Outcome::silent())
    }
}

/// Splits the selected faces off from the others, within their mesh.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SplitOff {}

impl Action for SplitOff {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        change.edit_selected("splitting off", FACES, |mesh, selection| {
            let faces = selection.faces(mesh, kind);
            mesh.split_off(&faces)?;
            Ok(AfterEdit::Select(Elements::Faces(faces)))
        })?;
        Ok(Outcome::silent())
    }
}

/// Opens meshes along the selected edges, or at selected vertices without such edges, and selects the side that
/// comes loose.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Rip {
    /// The direction in which the side that comes loose lies; its length does not matter.
    pub direction: [f64; 3],
    /// The space of the direction.
    pub space: TransformSpace,
    /// Whether faces fill the gap.
    pub fill: bool,
}

impl Default for Rip {
    fn default() -> Self {
        Self { direction: [1.0, 0.0, 0.0], space: TransformSpace::default(), fill: false }
    }
}

impl Action for Rip {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (command, kind) = ("ripping", change.selection().kind());
        if kind == ElementKind::Face {
            let reason = "it works on edges and vertices; switch to one of these";
            return Err(Refusal::NotPossible { operation: command, reason }.into());
        }
        let into_meshes = self.space.into_meshes(command, change)?;
        let mut faces = 0;
        change.edit_selected_meshes(command, "a selected edge or vertex", |id, mesh, selection| {
            let into_mesh = into_meshes.get(&id).copied().unwrap_or(DAffine3::IDENTITY);
            let direction = (into_mesh.matrix3 * DVec3::from(self.direction)).normalize_or_zero();
            let vertices = match kind {
                ElementKind::Vertex => selection.vertices(mesh, kind),
                ElementKind::Edge | ElementKind::Face => Vec::new(),
            };
            let ripped = mesh.rip(&selection.edges(mesh, kind), &vertices, direction, self.fill)?;
            faces += ripped.faces.len();
            Ok(AfterEdit::Select(Elements::Vertices(ripped.vertices)))
        })?;
        if self.fill { Ok(Outcome::counted("made", faces, ["face", "faces"])) } else { Ok(Outcome::silent()) }
    }
}

/// Gives each selected vertex a new one in the same position on the edge that is closest to a direction, and selects the
/// new ones. A vertex without edges gets a loose edge.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ExtendVertices {
    /// The direction; its length does not matter.
    pub direction: [f64; 3],
    /// The space of the direction.
    pub space: TransformSpace,
}

impl Default for ExtendVertices {
    fn default() -> Self {
        Self { direction: [1.0, 0.0, 0.0], space: TransformSpace::default() }
    }
}

impl Action for ExtendVertices {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (command, kind) = ("extending vertices", change.selection().kind());
        let into_meshes = self.space.into_meshes(command, change)?;
        change.edit_selected_meshes(command, "at least one selected vertex", |id, mesh, selection| {
            let into_mesh = into_meshes.get(&id).copied().unwrap_or(DAffine3::IDENTITY);
            let direction = into_mesh.matrix3 * DVec3::from(self.direction);
            let made = mesh.extend_vertices(&selection.vertices(mesh, kind), direction)?;
            Ok(AfterEdit::Select(Elements::Vertices(made)))
        })?;
        Ok(Outcome::silent())
    }
}

/// Moves the meshes of the selected objects into that of the active one, keeping their positions. The other
/// objects are removed; their children stay in place and move to the removed object's parent.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct JoinObjects {}

impl Action for JoinObjects {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if change.selection().is_editing() {
            return Err(EditError::Editing("joining objects"));
        }
        let needed = "two objects with meshes, one of them active";
        let refused = EditError::NothingSelected { command: "joining objects", needed };
        let mesh_of = |id: NodeId| change.scene().node(id).and_then(|node| node.mesh);
        let Some(active) = change.selection().active else { return Err(refused) };
        let Some(into) = mesh_of(active) else { return Err(refused) };
        let others = change.selection().objects.iter().filter(|&&id| id != active);
        let others: Vec<_> =
            others.filter_map(|&id| Some(Joined { object: id, mesh: mesh_of(id)? })).collect();
        if others.is_empty() {
            return Err(refused);
        }
        let to_active = change.scene().world_transform(active).inverse();
        if !to_active.is_finite() {
            let reason = "the active object is scaled to zero";
            return Err(Refusal::NotPossible { operation: "joining objects", reason }.into());
        }
        let mut slots = Slots::of_active(change, active, into)?;
        for other in &others {
            let transform = to_active * change.scene().world_transform(other.object);
            join(change, into, other, &transform, &mut slots)?;
        }
        let scene = change.scene_mut();
        others.iter().for_each(|other| remove_alone(scene, other.object));
        if let Some(node) = scene.node_mut(active) {
            node.materials = slots.materials;
        }
        change.selection_mut().objects = [active].into();
        Ok(Outcome::counted("joined", others.len(), ["object", "objects"]))
    }
}

/// An object that is joined to another, and its mesh.
struct Joined {
    object: NodeId,
    mesh: MeshId,
}

/// Adds an object's mesh to another mesh.
fn join(
    change: &mut Change<'_>,
    into: MeshId,
    &Joined { object, mesh }: &Joined,
    transform: &DAffine3,
    slots: &mut Slots,
) -> Result<(), EditError> {
    let materials = change.scene().node(object).map(|node| node.materials.clone()).unwrap_or_default();
    let Some(mut other) = change.mesh(mesh).cloned() else { return Ok(()) };
    slots.assign(change.scene_mut(), &mut other, &materials);
    change.edit(into, |mesh| Ok(mesh.join_mesh(&other, transform)?))?;
    Ok(())
}

/// Removes a node. Its children stay in place and move to its parent.
pub(super) fn remove_alone(scene: &mut Scene, id: NodeId) {
    let Some(node) = scene.node(id) else { return };
    let (parent, children) = (node.parent(), node.children().to_vec());
    let transform = node.transform.to_affine();
    for child in children {
        scene.set_parent(child, parent).expect("a child's grandparent is no descendant of it");
        let child = scene.node_mut(child).expect("it was just hung up");
        child.transform = NodeTransform::Affine(transform * child.transform.to_affine());
    }
    scene.remove(id);
}

/// The material slots of the object that the others are joined to.
pub(super) struct Slots {
    pub(super) materials: Vec<MaterialId>,
    /// The material that is drawn for empty slots, once it is needed.
    default: Option<MaterialId>,
}

impl Slots {
    /// The active object's own slots. Faces in slots without a material get a slot with the default
    /// material, before the others' slots.
    pub(super) fn of_active(
        change: &mut Change<'_>,
        active: NodeId,
        mesh: MeshId,
    ) -> Result<Self, EditError> {
        let materials = change.scene().node(active).map(|node| node.materials.clone()).unwrap_or_default();
        let count = materials.len() as u32;
        let mut slots = Self { materials: materials.clone(), default: None };
        let has_no_material = |edited: &EditMesh| edited.faces().any(|face| edited.material(face) >= count);
        if change.mesh(mesh).is_some_and(has_no_material) {
            let slot = slots.slot(change.scene_mut(), None);
            change.edit(mesh, |edited| {
                let faces: Vec<_> = edited.faces().filter(|&face| edited.material(face) >= count).collect();
                faces.into_iter().for_each(|face| edited.set_material(face, slot));
                Ok(())
            })?;
        }
        Ok(slots)
    }

    /// Maps the faces of a mesh with these materials to the slots that hold the same ones here.
    pub(super) fn assign(&mut self, scene: &mut Scene, mesh: &mut EditMesh, materials: &[MaterialId]) {
        let faces: Vec<_> = mesh.faces().collect();
        for face in faces {
            let material = materials.get(mesh.material(face) as usize).copied();
            let slot = self.slot(scene, material);
            mesh.set_material(face, slot);
        }
    }

    /// The slot of a material, or of the default one; added if there is none yet.
    fn slot(&mut self, scene: &mut Scene, material: Option<MaterialId>) -> u32 {
        let known = material.filter(|&id| scene.materials.get(id).is_some());
        let material = known
            .unwrap_or_else(|| *self.default.get_or_insert_with(|| scene.add_material(Material::default())));
        let index = self.materials.iter().position(|&other| other == material);
        let slot = index.unwrap_or_else(|| {
            self.materials.push(material);
            self.materials.len() - 1
        });
        slot as u32
    }
}
