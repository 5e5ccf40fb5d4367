//! Lights and cameras: new cameras, and the parameters of lights.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::{DVec3, Vec3};
use trigon_scene::{Light, LightKind, Node, Transform};

use super::scene::select_only;
use super::set_transform::named_or_active;
use super::{Action, LightShape, ObjectName, Outcome, Rotation};
use crate::error::EditError;
use crate::state::Change;

/// Changes an object's light. Parameters that are not given keep their values.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SetLight {
    /// The object. Default: the active one.
    pub object: Option<ObjectName>,
    /// The kind of light.
    pub light: Option<LightShape>,
    /// Linear red, green and blue.
    pub color: Option<[f32; 3]>,
    /// The brightness of a white surface that the light hits head-on, for points and spots from one
    /// metre away: 1 is white.
    #[schemars(range(min = 0.0))]
    pub intensity: Option<f32>,
    /// The distance beyond which a point or spot does not shine, in metres; 0 for no limit.
    #[schemars(range(min = 0.0))]
    pub range: Option<f32>,
    /// For soft shadows: the radius of a point or spot in metres, or of a directional light at a distance of one metre
    /// (0.00465 for the sun); 0 for sharp ones.
    #[schemars(range(min = 0.0))]
    pub radius: Option<f32>,
    /// For a spot: the angle from its axis at which it begins to fade, in degrees.
    #[schemars(range(min = 0.0, max = 90.0))]
    pub inner_angle: Option<f32>,
    /// For a spot: the angle from its axis beyond which there is no light, in degrees.
    #[schemars(range(min = 0.0, max = 90.0))]
    pub outer_angle: Option<f32>,
}

impl Action for SetLight {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let id = named_or_active(change, self.object.as_ref(), "changing a light")?;
        let light = change.scene().node(id).and_then(|node| node.light.as_deref());
        let needed = "an object that is a light";
        let light = light.ok_or(EditError::NothingSelected { command: "changing a light", needed })?;
        let changed = self.changed(*light);
        change.scene_mut().node_mut(id).expect("it was just found").light = Some(Box::new(changed));
        Ok(Outcome::silent())
    }
}

impl SetLight {
    /// A light with the given parameters.
    fn changed(&self, light: Light) -> Light {
        let kind = self.light.map_or(light.kind, |shape| match (shape, light.kind) {
            (LightShape::Point, _) => LightKind::Point,
            (LightShape::Directional, _) => LightKind::Directional,
            (LightShape::Spot, LightKind::Spot { .. }) => light.kind,
            (LightShape::Spot, _) => Light::spot(1.0).kind,
        });
        let range = self.range.map(|range| if range > 0.0 { range } else { f32::INFINITY });
        Light {
            kind: self.cone(kind),
            color: self.color.map_or(light.color, Vec3::from),
            intensity: self.intensity.unwrap_or(light.intensity).max(0.0),
            range: range.unwrap_or(light.range),
            radius: self.radius.unwrap_or(light.radius).max(0.0),
        }
    }

    /// The outer angle is never smaller than the inner: the one that is not given is adjusted.
    fn cone(&self, kind: LightKind) -> LightKind {
        let LightKind::Spot { inner, outer } = kind else { return kind };
        let given = |degrees: Option<f32>| degrees.map(|angle| angle.clamp(0.0, 90.0).to_radians());
        let (new_inner, new_outer) = (given(self.inner_angle), given(self.outer_angle));
        let outer = new_outer.unwrap_or_else(|| outer.max(new_inner.unwrap_or(0.0)));
        LightKind::Spot { inner: new_inner.unwrap_or(inner).min(outer), outer }
    }
}

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
        let mut node = Node::default().with_name(change.free_name(&self.name)).with_transform(transform);
        node.camera = Some(Box::default());
        let id = change.scene_mut().add(node);
        select_only(change, id);
        Ok(Outcome::silent())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Document;
    use serde_json::json;
    use trigon_mesh::math::DVec3;
    use trigon_scene::{Node, Scene};

    #[test]
    fn a_light_changes_what_is_given_and_keeps_the_rest() {
        let mut scene = Scene::new();
        let id = scene.add(Node::from_light(Light::point(3.0).with_range(7.0)).with_name("lamp"));
        let mut document = Document::new(scene);
        let mut run = |json: serde_json::Value| {
            document.run(serde_json::from_value(json).expect("a command")).expect("it can be done");
            document.nodes().node(id).and_then(|node| node.light.clone()).expect("it is a light")
        };
        let lamp = run(
            serde_json::json!({ "op": "set_light", "object": "lamp", "light": "spot", "inner_angle": 60.0 }),
        );
        let LightKind::Spot { inner, outer } = lamp.kind else { panic!("a spot: {lamp:?}") };
        assert_eq!((inner, outer), (60f32.to_radians(), 60f32.to_radians()), "the outer angle makes room");
        assert_eq!((lamp.intensity, lamp.range), (3.0, 7.0), "kept");
        let lamp = run(
            serde_json::json!({ "op": "set_light", "object": "lamp", "outer_angle": 10.0, "range": 0.0 }),
        );
        let LightKind::Spot { inner, outer } = lamp.kind else { panic!("a spot: {lamp:?}") };
        assert_eq!((inner, outer), (10f32.to_radians(), 10f32.to_radians()), "the inner angle follows");
        assert_eq!(lamp.range, f32::INFINITY, "no limit");
        let lamp = run(serde_json::json!({ "op": "set_light", "object": "lamp", "radius": 0.25 }));
        assert_eq!((lamp.radius, lamp.intensity), (0.25, 3.0), "soft shadows");
        assert!(
            document
                .run(
                    SetLight { object: Some(ObjectName::Name("nobody".into())), ..SetLight::default() }
                        .into()
                )
                .is_err(),
            "none"
        );
    }

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
