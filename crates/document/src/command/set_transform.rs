//! Exact placements of objects, typed instead of dragged, and cleared.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::{DAffine3, DQuat, DVec3};
use trigon_scene::{NodeId, Transform};

use super::scene::named_or_selected;
use super::space::TransformSpace;
use super::{Action, ObjectName, Outcome, Rotation};
use crate::error::EditError;
use crate::state::Change;

/// Sets an object's exact placement. Parameters that are not given keep their values.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SetTransform {
    /// The object. Default: the active one.
    pub object: Option<ObjectName>,
    /// What the placement is relative to.
    pub space: TransformSpace,
    /// The position of its origin, in metres.
    pub location: Option<[f64; 3]>,
    /// The orientation.
    pub rotation: Option<Rotation>,
    /// The scale along its own axes; negative values mirror.
    pub scale: Option<[f64; 3]>,
}

impl Action for SetTransform {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let id = named_or_active(change, self.object.as_ref(), "placing an object")?;
        let node = change.scene().node(id).expect("it was just found");
        let transform = match self.space {
            TransformSpace::Local => self.placed(node.transform),
            TransformSpace::World => {
                let parent = node.parent().map(|parent| change.scene().world_transform(parent));
                self.placed_in_world(parent.unwrap_or_default(), node.transform)
            }
        };
        change.scene_mut().node_mut(id).expect("it was just found").transform = transform;
        Ok(Outcome::silent())
    }
}

impl SetTransform {
    /// A placement with the given parts.
    pub(super) fn placed(&self, transform: Transform) -> Transform {
        let mut placed = transform;
        if self.rotation.is_some() || self.scale.is_some() {
            let (scale, rotation, translation) = parts(&transform);
            placed = Transform::from_scale_rotation_translation(
                self.scale.map_or(scale, DVec3::from),
                self.rotation.map_or(rotation, Rotation::to_quaternion),
                translation,
            );
        }
        if let Some(location) = self.location {
            placed.set_translation(DVec3::from(location));
        }
        placed
    }

    /// The same in world space, as a placement in the parent.
    fn placed_in_world(&self, parent: DAffine3, local: Transform) -> Transform {
        let to_parent = parent.inverse();
        let mut placed = local;
        if self.rotation.is_some() || self.scale.is_some() {
            let world = Transform::Affine(parent * local.to_affine());
            placed = transform_of(to_parent * self.placed(world).to_affine());
        }
        if let Some(location) = self.location {
            placed.set_translation(to_parent.transform_point3(DVec3::from(location)));
        }
        placed
    }
}

/// Scale, rotation and translation of a placement, without its shear.
fn parts(transform: &Transform) -> (DVec3, DQuat, DVec3) {
    match *transform {
        Transform::Decomposed { translation, rotation, scale } => (scale, rotation, translation),
        Transform::Affine(affine) => {
            let (scale, rotation, translation) = affine.to_scale_rotation_translation();
            let is_whole = scale.is_finite() && rotation.is_finite();
            if is_whole { (scale, rotation, translation) } else { (DVec3::ONE, DQuat::IDENTITY, translation) }
        }
    }
}

/// A placement from its parts, or the map itself if it has no such parts, as under an unevenly scaled parent.
pub(crate) fn transform_of(affine: DAffine3) -> Transform {
    let (scale, rotation, translation) = affine.to_scale_rotation_translation();
    let whole = Transform::from_scale_rotation_translation(scale, rotation, translation);
    let largest = affine.matrix3.to_cols_array().iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    // A few roundings of numbers of this size.
    if whole.to_affine().matrix3.abs_diff_eq(affine.matrix3, 1e-12 * largest) {
        whole
    } else {
        Transform::Affine(affine)
    }
}

/// The object that a command names, or the active one.
pub(super) fn named_or_active(
    change: &Change<'_>,
    name: Option<&ObjectName>,
    command: &'static str,
) -> Result<NodeId, EditError> {
    if let Some(name) = name {
        return name.find(change.scene());
    }
    let active = change.selection().active.filter(|&id| change.scene().node(id).is_some());
    active.ok_or(EditError::NothingSelected { command, needed: "an active object" })
}

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
    use super::*;
    use crate::document::Document;
    use crate::tests::commands::run;
    use serde_json::json;
    use trigon_mesh::math::{DQuat, DVec3};
    use trigon_mesh::primitives;
    use trigon_scene::{Material, Node, Scene, Transform};

    #[test]
    fn a_typed_placement_is_the_placement() {
        let mut scene = Scene::new();
        let id = scene.add_object("cube", primitives::cube(1.0), Material::default());
        let mut document = Document::new(scene);
        let turn = serde_json::json!({ "by": "euler", "angles": [30.0, -45.0, 60.0] });
        run(
            &mut document,
            serde_json::json!({ "op": "set_transform", "object": "cube",
            "location": [1.0, 2.0, 3.0], "rotation": turn, "scale": [1.0, -2.0, 3.0] }),
        );
        let Transform::Decomposed { translation, rotation, scale } =
            document.nodes().node(id).unwrap().transform
        else {
            panic!("it has parts")
        };
        assert_eq!((translation, scale), (DVec3::new(1.0, 2.0, 3.0), DVec3::new(1.0, -2.0, 3.0)), "exact");
        let Rotation::Euler { angles } = Rotation::euler(rotation) else { panic!("angles") };
        // The rounding of three half turns and back.
        assert!((DVec3::from(angles) - DVec3::new(30.0, -45.0, 60.0)).length() < 1e-12, "{angles:?}");
        let z_first = rotation * DVec3::X;
        let by_hand = DQuat::from_rotation_z(60f64.to_radians())
            * (DQuat::from_rotation_y(-45f64.to_radians())
                * (DQuat::from_rotation_x(30f64.to_radians()) * DVec3::X));
        assert!(z_first.abs_diff_eq(by_hand, 1e-12), "about x, then y, then z");
        document.undo().expect("one");
        assert_eq!(document.nodes().node(id).unwrap().transform, Transform::IDENTITY, "undone");
    }

    #[test]
    fn a_place_in_the_world_is_one_below_a_turned_and_scaled_parent() {
        let mut scene = Scene::new();
        let turned = Transform::from_scale_rotation_translation(
            DVec3::new(2.0, 1.0, 0.5),
            DQuat::from_rotation_y(0.5),
            DVec3::new(5.0, 0.0, 0.0),
        );
        let parent = scene.add(Node::default().with_transform(turned));
        let child = scene.add_child(parent, Node::default().with_name("child")).expect("the parent is there");
        let mut document = Document::new(scene);
        let rotation = serde_json::json!({ "by": "quaternion", "xyzw": [0.0, 0.0, 2.0, 0.0] });
        run(
            &mut document,
            serde_json::json!({ "op": "set_transform", "object": "child", "space": "world",
            "location": [1.0, 2.0, 3.0], "rotation": rotation, "scale": [1.0, 1.0, 1.0] }),
        );
        let world = document.nodes().world_transform(child);
        let half_turn = DAffine3::from_rotation_translation(
            DQuat::from_xyzw(0.0, 0.0, 1.0, 0.0),
            DVec3::new(1.0, 2.0, 3.0),
        );
        // The inverse of a parent scaled by 0.5 to 2 rounds a few times.
        assert!(world.abs_diff_eq(half_turn, 1e-13), "{world:?}");
    }

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
