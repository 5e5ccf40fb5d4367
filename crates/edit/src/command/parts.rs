//! Copies and parts of meshes: duplicate, split off, separate, join.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::edit::Transform;
use trigon_mesh::math::DVec3;

use super::{Action, Outcome};
use crate::document::{AfterEdit, Change};
use crate::error::EditError;
use crate::selection::Elements;

const FACES: &str = "at least one selected face";

/// Copies what is selected within its mesh, and selects the copies.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Duplicate {
    /// How far the copies are moved, in metres.
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

/// Makes the selected faces of each mesh an object of its own, at the same place.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Separate {}

impl Action for Separate {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let mut parts = Vec::new();
        change.edit_selected("separating", FACES, |mesh, selection| {
            parts.push(mesh.separate(&selection.faces(mesh, kind))?);
            Ok(AfterEdit::Clear)
        })?;
        let count = parts.len();
        change.add_parts(parts);
        Ok(Outcome::counted("made", count, ["object", "objects"]))
    }
}

/// Puts the meshes of the selected objects into that of the active one, each where it is. The others are
/// removed.
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
        let Some(active) = change.selection().active else { return Err(refused) };
        let Some(into) = change.scene().node(active).and_then(|node| node.mesh) else { return Err(refused) };
        let to_active = change.scene().world_transform(active).inverse();
        let others: Vec<_> = change.selection().objects.iter().copied().filter(|&id| id != active).collect();
        let mut joined = 0;
        for id in others {
            let Some(node) = change.scene().node(id) else { continue };
            let Some(mesh) = node.mesh else { continue };
            let materials = node.materials.clone();
            let transform = to_active * change.scene().world_transform(id);
            let Some(mut other) = change.mesh(mesh).cloned() else { continue };
            // The other's slots come after those of the active object.
            let known = change.scene().node(active).map_or(0, |node| node.materials.len()) as u32;
            let faces: Vec<_> = other.faces().collect();
            for face in faces {
                other.set_material(face, known + other.material(face));
            }
            change.edit(into, |mesh| Ok(mesh.join_mesh(&other, &transform)?))?;
            let scene = change.scene_mut();
            scene.remove(id);
            if let Some(node) = scene.node_mut(active) {
                node.materials.extend(materials);
            }
            joined += 1;
        }
        if joined == 0 {
            return Err(refused);
        }
        change.selection_mut().objects = [active].into();
        Ok(Outcome::counted("joined", joined, ["object", "objects"]))
    }
}
