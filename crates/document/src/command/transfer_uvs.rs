//! Transfer of texture coordinates and colours between objects.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::DAffine3;
use trigon_modelling::{FaceId, TransferMapping, TransferSettings, TransferSource};
use trigon_scene::{MeshId, NodeId};

use super::action::whole_meshes;
use super::set_transform::named_or_active;
use super::space::inverse;
use super::{Action, ObjectName, Outcome};
use crate::error::EditError;
use crate::state::{AfterEdit, Change};

const COMMAND: &str = "transferring texture coordinates";

/// Gives meshes the texture coordinates of another object, where both are in the scene. In edit mode the selected faces
/// get them, otherwise all faces of the selected objects.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct TransferUvs {
    /// The object that has them. Default: the active one.
    pub from: Option<ObjectName>,
    /// Whether values are those of the nearest point, or of the same corner of the same face.
    pub mapping: TransferMapping,
    /// Whether all sets of texture coordinates are transferred.
    pub uvs: bool,
    /// Whether colours are transferred.
    pub colors: bool,
}

impl Default for TransferUvs {
    fn default() -> Self {
        let TransferSettings { mapping, uvs, colors } = TransferSettings::default();
        Self { from: None, mapping, uvs, colors }
    }
}

impl Action for TransferUvs {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let &Self { mapping, uvs, colors, .. } = self;
        let settings = TransferSettings { mapping, uvs, colors };
        let from = named_or_active(change, self.from.as_ref(), COMMAND)?;
        let nothing = EditError::NothingSelected { command: COMMAND, needed: "another object with a mesh" };
        let Some(id) = change.scene().node(from).and_then(|node| node.mesh) else { return Err(nothing) };
        let Some(mesh) = change.mesh_to_read(id) else { return Err(nothing) };
        let targets: Vec<MeshId> =
            whole_meshes(change, COMMAND)?.into_iter().filter(|&target| target != id).collect();
        if targets.is_empty() {
            return Err(nothing);
        }
        let transforms = transforms(change, from, &targets)?;
        let is_editing = change.selection().is_editing();
        if !is_editing {
            for (target, transform) in transforms {
                change.edit(target, |changed| {
                    let faces: Vec<FaceId> = changed.faces().collect();
                    Ok(changed.transfer_values(
                        &faces,
                        &TransferSource { mesh: &mesh, transform },
                        &settings,
                    )?)
                })?;
            }
            return Ok(Outcome::counted("changed", targets.len(), ["mesh", "meshes"]));
        }
        let kind = change.selection().kind();
        let count = change.edit_selected_meshes(
            COMMAND,
            "at least one selected face",
            |target, changed, selection| {
                // The source itself may be edited, too.
                let found = transforms.iter().find(|(id, _)| *id == target);
                if let Some(&(_, transform)) = found {
                    let source = TransferSource { mesh: &mesh, transform };
                    changed.transfer_values(&selection.faces(changed, kind), &source, &settings)?;
                }
                Ok(AfterEdit::Keep)
            },
        )?;
        Ok(Outcome::counted("changed", count, ["mesh", "meshes"]))
    }
}

/// For each mesh the map from an object's space to its own.
fn transforms(
    change: &Change<'_>,
    from: NodeId,
    targets: &[MeshId],
) -> Result<Vec<(MeshId, DAffine3)>, EditError> {
    let to_world = change.scene().world_transform(from);
    let map =
        |&target: &MeshId| Ok((target, inverse(change.state().mesh_transform(target), COMMAND)? * to_world));
    targets.iter().map(map).collect()
}

#[cfg(test)]
mod tests {
    use serde_json::json;
    use trigon_mesh::primitives;
    use trigon_scene::{Material, Scene};

    use crate::document::Document;
    use crate::tests::commands::{edit_faces, run, try_run};

    #[test]
    fn a_moved_grid_gets_the_texture_coordinates_below_it_and_is_undone() {
        let mut scene = Scene::new();
        scene.add_object("from", primitives::grid(4.0, 4.0, 2, 2), Material::default());
        scene.add_object("to", primitives::grid(2.0, 2.0, 4, 4), Material::default());
        let mut document = Document::new(scene);
        run(&mut document, json!({ "op": "select", "objects": ["from"] }));
        edit_faces(&mut document, &["from"]);
        run(&mut document, json!({ "op": "select_all" }));
        run(
            &mut document,
            json!({ "op": "project_uvs", "normal": [0, 1, 0], "up": [0, 0, -1], "height": 4 }),
        );
        run(&mut document, json!({ "op": "leave_edit_mode" }));
        run(&mut document, json!({ "op": "set_transform", "object": "to", "location": [1, 0.5, 0] }));
        run(&mut document, json!({ "op": "select", "objects": ["to"] }));
        let refused =
            try_run(&mut document, json!({ "op": "transfer_uvs", "from": "to" })).expect_err("itself");
        assert!(refused.to_string().contains("another object"), "{refused}");
        run(&mut document, json!({ "op": "transfer_uvs", "from": "from" }));
        edit_faces(&mut document, &["to"]);
        let mesh = crate::tests::commands::edited(&document);
        for corner in mesh.corners() {
            let position = mesh.position(mesh.corner_vertex(corner));
            let expected = [(position.x + 3.0) / 4.0, (position.z + 2.0) / 4.0];
            let uv = mesh.uv(0, corner).expect("a set").to_array();
            assert!((0..2).all(|axis| (uv[axis] - expected[axis]).abs() < 1e-6), "{uv:?} for {expected:?}");
        }
        let before = mesh.uv(0, mesh.corners().next().expect("some"));
        (0..3).for_each(|_| document.undo().expect("also the edit mode and its kind"));
        edit_faces(&mut document, &["to"]);
        let mesh = crate::tests::commands::edited(&document);
        assert_ne!(mesh.uv(0, mesh.corners().next().expect("some")), before, "its own again");
    }
}
