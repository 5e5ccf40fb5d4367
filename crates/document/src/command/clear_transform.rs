//! Clearing placements.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::DVec3;

use super::scene::named_or_selected;
use super::{Action, Outcome, Rotation, SetTransform, TransformSpace};
use crate::error::EditError;
use crate::state::Change;

/// Clears the location, rotation or scale of the selected objects relative to their parent.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ClearTransform {
    /// Whether they move to their parent's origin.
    pub location: bool,
    /// Whether their rotation is cleared.
    pub rotation: bool,
    /// Whether their scale is reset to 1.
    pub scale: bool,
}

impl Action for ClearTransform {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let objects = named_or_selected(change, &[], "clearing a transform")?;
        let cleared = SetTransform {
            object: None,
            space: TransformSpace::Local,
            location: self.location.then_some([0.0; 3]),
            rotation: self.rotation.then_some(Rotation::Quaternion { xyzw: [0.0, 0.0, 0.0, 1.0] }),
            scale: self.scale.then_some(DVec3::ONE.to_array()),
        };
        for id in objects {
            let node = change.scene_mut().node_mut(id).expect("it was just found");
            node.transform = cleared.placed(node.transform);
        }
        Ok(Outcome::silent())
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;
    use trigon_mesh::math::{DQuat, DVec3};
    use trigon_scene::{Node, Scene, Transform};

    use crate::document::Document;

    #[test]
    fn each_part_of_a_placement_is_cleared_by_itself() {
        let turn = DQuat::from_rotation_z(1.0);
        let placed = Transform::from_scale_rotation_translation(DVec3::splat(2.0), turn, DVec3::X);
        for (part, expected) in [
            ("location", Transform::from_scale_rotation_translation(DVec3::splat(2.0), turn, DVec3::ZERO)),
            (
                "rotation",
                Transform::from_scale_rotation_translation(DVec3::splat(2.0), DQuat::IDENTITY, DVec3::X),
            ),
            ("scale", Transform::from_scale_rotation_translation(DVec3::ONE, turn, DVec3::X)),
        ] {
            let mut scene = Scene::new();
            let ids =
                ["one", "two"].map(|name| scene.add(Node::default().with_name(name).with_transform(placed)));
            let mut document = Document::new(scene);
            for json in [json!({ "op": "select_all" }), json!({ "op": "clear_transform", part: true })] {
                document.run(serde_json::from_value(json).expect("a command")).expect("it can be done");
            }
            for id in ids {
                assert_eq!(document.nodes().node(id).expect("it stays").transform, expected, "{part}");
            }
            document.undo().expect("one entry");
            let first = document.nodes().node(ids[0]).expect("it stays").transform;
            assert_eq!(first, placed, "{part} undone");
        }
    }
}
