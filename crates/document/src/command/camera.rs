//! New cameras.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::DVec3;
use trigon_scene::camera::Projection;
use trigon_scene::{Node, Transform};

use super::scene::select_only;
use super::{Action, Outcome, Rotation};
use crate::error::EditError;
use crate::state::Change;

/// Adds a camera and selects it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AddCamera {
    /// Its name.
    pub name: String,
    /// The position of the eye, in metres.
    pub position: [f64; 3],
    /// The orientation; without a rotation the camera looks along −Z.
    pub rotation: Rotation,
}

impl Default for AddCamera {
    fn default() -> Self {
        let rotation = Rotation::Euler { angles: [0.0; 3] };
        Self { name: "Camera".to_owned(), position: [0.0; 3], rotation }
    }
}

impl Action for AddCamera {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if change.selection().is_editing() {
            return Err(EditError::Editing("adding a camera"));
        }
        let (turn, position) = (self.rotation.to_quaternion(), DVec3::from(self.position));
        let transform = Transform::from_scale_rotation_translation(DVec3::ONE, turn, position);
        let mut node = Node::default().with_name(self.name.clone()).with_transform(transform);
        node.camera = Some(Projection::default());
        let id = change.scene_mut().add(node);
        select_only(change, id);
        Ok(Outcome::silent())
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;
    use trigon_mesh::math::DVec3;
    use trigon_scene::Scene;

    use crate::document::Document;

    #[test]
    fn a_camera_looks_where_it_is_turned_to() {
        let mut document = Document::new(Scene::new());
        let turn = json!({ "by": "euler", "angles": [0.0, 90.0, 0.0] });
        let add = json!({ "op": "add_camera", "position": [3.0, 0.0, 0.0], "rotation": turn });
        document.run(serde_json::from_value(add).expect("a command")).expect("it can be done");
        let (id, camera) = document.nodes().cameras().into_iter().next().expect("it is there");
        let sight = camera.orientation * DVec3::NEG_Z;
        // The sine and the cosine of half the angle are rounded.
        assert!(sight.abs_diff_eq(DVec3::NEG_X, 1e-15), "{sight}: to the origin");
        assert_eq!(camera.position, DVec3::X * 3.0);
        assert_eq!(document.selection().active, Some(id), "it is selected");
    }
}
