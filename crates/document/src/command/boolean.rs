//! Booleans of objects, and of parts of a mesh.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::DAffine3;
use trigon_modelling::{BooleanOperation, BooleanTool, EditMesh, Refusal};
use trigon_scene::{MeshId, NodeId};

use super::parts::{Slots, remove_alone};
use super::set_transform::named_or_active;
use super::space::inverse;
use super::{Action, ObjectName, Outcome};
use crate::error::EditError;
use crate::selection::Elements;
use crate::state::{AfterEdit, Change};

const COMMAND: &str = "a boolean";

const NOTHING_LEFT: &str =
    "nothing is left of the object: look where the objects overlap, or choose another operation";

/// Combines the volume of an object's mesh with those of other objects. In edit mode, the selected faces of each mesh
/// are the tool, and its other faces are changed: both have to be closed.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Boolean {
    /// Whether the result is what is in any of them (`union`), what is in the object alone (`difference`), or what is in
    /// all of them (`intersection`).
    pub operation: BooleanOperation,
    /// The object that is changed. Default: the active one. Not for edit mode.
    pub object: Option<ObjectName>,
    /// The tools. Default: the other selected objects that have meshes. Not for edit mode.
    pub objects: Vec<ObjectName>,
    /// Whether the tools stay. Otherwise they are removed; their children stay where they are and move to the removed
    /// object's parent.
    pub keep_tools: bool,
}

impl Action for Boolean {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if change.selection().is_editing() { self.run_on_faces(change) } else { self.run_on_objects(change) }
    }
}

/// An object whose mesh is combined with another one.
struct ToolObject {
    object: NodeId,
    mesh: EditMesh,
    transform: DAffine3,
}

impl Boolean {
    fn run_on_faces(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if self.object.is_some() || !self.objects.is_empty() {
            return Err(EditError::Editing("a boolean of named objects"));
        }
        let kind = change.selection().kind();
        change.edit_selected(COMMAND, "the faces of a closed part of a mesh", |mesh, selection| {
            let combined = mesh.boolean_of_faces(&selection.faces(mesh, kind), self.operation)?;
            Ok(AfterEdit::Select(Elements::Edges(combined.edges)))
        })?;
        Ok(Outcome::silent())
    }

    fn run_on_objects(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let object = named_or_active(change, self.object.as_ref(), COMMAND)?;
        let needed = "two objects with meshes, one of them active";
        let refused = EditError::NothingSelected { command: COMMAND, needed };
        let Some(mesh) = change.scene().node(object).and_then(|node| node.mesh) else { return Err(refused) };
        let tools = self.tools(change, object)?;
        if tools.is_empty() {
            return Err(refused);
        }
        if let Some(refusal) = change.mesh(mesh).and_then(|mesh| mesh.check_solid().err()) {
            return Err(of_object(change, object, refusal));
        }
        let from_world = inverse(change.scene().world_transform(object), COMMAND)?;
        let mut slots = Slots::of_active(change, object, mesh)?;
        let mut operands = Vec::with_capacity(tools.len());
        for (tool, mesh) in tools {
            let Some(mut mesh) = change.mesh_to_read(mesh) else { continue };
            mesh.check_solid().map_err(|refusal| of_object(change, tool, refusal))?;
            let transform = from_world * change.scene().world_transform(tool);
            let materials = change.scene().node(tool).map(|node| node.materials.clone()).unwrap_or_default();
            slots.assign(change.scene_mut(), &mut mesh, &materials);
            operands.push(ToolObject { object: tool, mesh, transform });
        }
        change.edit(mesh, |mesh| {
            let tools: Vec<BooleanTool<'_>> = operands
                .iter()
                .map(|tool| BooleanTool { mesh: &tool.mesh, transform: tool.transform })
                .collect();
            Ok(mesh.boolean(&tools, self.operation)?)
        })?;
        self.finish(change, object, &operands, slots);
        let mut outcome = Outcome::counted("combined with", operands.len(), ["object", "objects"]);
        if change.mesh(mesh).is_some_and(|mesh| mesh.face_count() == 0) {
            outcome.warnings.push(NOTHING_LEFT.into());
        }
        Ok(outcome)
    }

    /// The objects with meshes to combine with another one, and their meshes.
    fn tools(&self, change: &Change<'_>, object: NodeId) -> Result<Vec<(NodeId, MeshId)>, EditError> {
        let named: Vec<NodeId> = if self.objects.is_empty() {
            change.selection().objects.iter().copied().collect()
        } else {
            self.objects.iter().map(|name| name.find(change.scene())).collect::<Result<_, _>>()?
        };
        let mut tools: Vec<(NodeId, MeshId)> = Vec::with_capacity(named.len());
        for id in named.into_iter().filter(|&id| id != object) {
            let mesh = change.scene().node(id).and_then(|node| node.mesh);
            tools.extend(mesh.filter(|_| tools.iter().all(|&(known, _)| known != id)).map(|mesh| (id, mesh)));
        }
        Ok(tools)
    }

    /// Removes the tools, and selects the object that is left.
    fn finish(&self, change: &mut Change<'_>, object: NodeId, tools: &[ToolObject], slots: Slots) {
        let scene = change.scene_mut();
        if let Some(node) = scene.node_mut(object) {
            node.materials = slots.materials;
        }
        if self.keep_tools {
            return;
        }
        tools.iter().for_each(|tool| remove_alone(scene, tool.object));
        let selection = change.selection_mut();
        for tool in tools {
            selection.objects.remove(&tool.object);
        }
        selection.objects.insert(object);
        selection.active = Some(object);
    }
}

/// A refusal with the name of the object that it is about.
fn of_object(change: &Change<'_>, object: NodeId, refusal: Refusal) -> EditError {
    let name = change.scene().node(object).map(|node| node.name.clone()).unwrap_or_default();
    EditError::OfObject { name, refusal }
}
