//! Placements of objects that become places of their vertices.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::{DAffine3, DVec3};
use trigon_modelling::{EditMesh, FaceId, Transform as MeshTransform, VertexId};
use trigon_scene::{MeshId, NodeId};

use super::scene::named_or_selected;
use super::set_transform::transform_of;
use super::{Action, Outcome, Rotation, SetTransform, TransformSpace};
use crate::error::EditError;
use crate::state::Change;

/// Applies the placement of the selected objects to their vertices and clears it, so that nothing moves in the
/// image and lengths in the mesh are those in the world. Child objects stay where they are.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ApplyTransform {
    /// Whether their location is applied.
    pub location: bool,
    /// Whether their rotation is applied.
    pub rotation: bool,
    /// Whether their scale is applied.
    pub scale: bool,
}

const COMMAND: &str = "applying a transform";

impl Action for ApplyTransform {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if change.selection().is_editing() {
            return Err(EditError::Editing(COMMAND));
        }
        let objects = named_or_selected(change, &[], COMMAND)?;
        let retained = SetTransform {
            object: None,
            space: TransformSpace::Local,
            location: self.location.then_some([0.0; 3]),
            rotation: self.rotation.then_some(Rotation::Quaternion { xyzw: [0.0, 0.0, 0.0, 1.0] }),
            scale: self.scale.then_some(DVec3::ONE.to_array()),
        };
        let mut count = 0;
        for id in objects {
            let node = change.scene().node(id).expect("it was just found");
            let (Some(mesh), placed) = (node.mesh, node.transform) else { continue };
            check(change, mesh)?;
            let rest = retained.placed(placed);
            let map = rest.to_affine().inverse() * placed.to_affine();
            if !map.is_finite() {
                return Err(refused("its size is 0: give it a size first"));
            }
            change.edit(mesh, |mesh| move_all(mesh, map))?;
            set_placements(change, id, rest, map);
            count += 1;
        }
        if count == 0 {
            return Err(EditError::NothingSelected { command: COMMAND, needed: "an object with a mesh" });
        }
        Ok(Outcome::counted("applied to", count, ["object", "objects"]))
    }
}

/// Gives an object its new placement, and lets what hangs on it stay.
pub(super) fn set_placements(
    change: &mut Change<'_>,
    id: NodeId,
    rest: trigon_scene::Transform,
    map: DAffine3,
) {
    let scene = change.scene_mut();
    let node = scene.node_mut(id).expect("it was just found");
    node.transform = rest;
    for child in node.children().to_vec() {
        let child = scene.node_mut(child).expect("it hangs there");
        child.transform = transform_of(map * child.transform.to_affine());
    }
}

/// Whether a mesh belongs to one object alone, and all of it follows its vertices.
fn check(change: &Change<'_>, mesh: MeshId) -> Result<(), EditError> {
    let nodes = change.scene().nodes();
    if nodes.iter().filter(|(_, node)| node.mesh == Some(mesh)).count() > 1 {
        return Err(refused(
            "several objects share the mesh, and would move: apply it to an object with its own mesh",
        ));
    }
    let attributes = change.scene().meshes().get(mesh).map(|asset| asset.mesh().attributes());
    if attributes.is_some_and(|values| values.skin.is_some() || !values.morph_targets.is_empty()) {
        return Err(refused("the mesh has a skin or morph targets, which would not follow"));
    }
    Ok(())
}

fn refused(reason: &'static str) -> EditError {
    trigon_modelling::Refusal::NotPossible { operation: COMMAND, reason }.into()
}

/// Moves all of a mesh, first positions included.
pub(super) fn move_all(mesh: &mut EditMesh, map: DAffine3) -> Result<(), EditError> {
    let vertices: Vec<VertexId> = mesh.vertices().collect();
    if vertices.is_empty() {
        return Ok(());
    }
    for &vertex in &vertices {
        let first = mesh.first_position(vertex).as_dvec3();
        mesh.set_first_position(vertex, map.transform_point3(first).as_vec3());
    }
    mesh.transform_vertices(&vertices, &MeshTransform::Affine { map }, None)?;
    let faces: Vec<FaceId> = mesh.faces().collect();
    // A mirrored mesh would be seen from inside.
    if map.matrix3.determinant() < 0.0 && !faces.is_empty() {
        mesh.flip_faces(&faces)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use serde_json::json;
    use trigon_mesh::math::{DQuat, Vec3};
    use trigon_mesh::primitives;
    use trigon_scene::{Material, Node, Scene, Transform};

    use super::*;
    use crate::document::Document;
    use crate::tests::commands::try_run as run;

    /// Where all vertices and the child are in the world.
    fn positions(document: &mut Document) -> Vec<DVec3> {
        let scene = document.scene().clone();
        let ids: Vec<NodeId> = scene.nodes().iter().map(|(id, _)| id).collect();
        let mesh = scene.meshes().iter().next().expect("the cube").1.mesh();
        let world = scene.world_transform(ids[0]);
        let vertices = mesh.positions().iter().map(|position| world.transform_point3(position.as_dvec3()));
        vertices.chain([scene.world_transform(ids[1]).translation]).collect()
    }

    fn document() -> (Document, NodeId) {
        let mut scene = Scene::new();
        let cube = scene.add_object("cube", primitives::cube(2.0), Material::default());
        let turn = DQuat::from_rotation_z(0.5);
        scene.node_mut(cube).expect("it was added").transform = Transform::from_scale_rotation_translation(
            DVec3::new(2.0, -3.0, 0.5),
            turn,
            DVec3::new(1.0, 2.0, 3.0),
        );
        let child = Node::default().with_transform(Transform::from_translation(DVec3::Y));
        scene.add_child(cube, child).expect("the cube is there");
        let mut document = Document::new(scene);
        run(&mut document, json!({ "op": "select", "objects": ["cube"] })).expect("it is there");
        (document, cube)
    }

    #[test]
    fn nothing_is_seen_to_move_when_a_placement_is_applied() {
        for parts in [["location", "rotation", "scale"].as_slice(), &["scale"], &["rotation"], &["location"]]
        {
            let (mut document, cube) = document();
            let before = positions(&mut document);
            let mut command = json!({ "op": "apply_transform" });
            parts.iter().for_each(|part| command[*part] = json!(true));
            run(&mut document, command).expect("it can be done");
            for (was, is) in before.iter().zip(positions(&mut document)) {
                assert!(was.abs_diff_eq(is, 1e-5), "{parts:?}: {was} is at {is}, but for rounding to f32");
            }
            let placed = document.nodes().node(cube).expect("it stays").transform;
            if parts.len() == 3 {
                assert_eq!(placed, Transform::IDENTITY, "all of it");
            }
            document.undo().expect("one entry");
            assert_eq!(positions(&mut document), before, "{parts:?} undone");
        }
    }

    #[test]
    fn a_mirrored_mesh_still_looks_outwards() {
        let (mut document, _) = document();
        run(&mut document, json!({ "op": "apply_transform", "scale": true })).expect("it can be done");
        let id = document.nodes().meshes().iter().next().expect("the cube").0;
        let mesh = document.mesh(id).expect("it was edited");
        let outwards = |face| mesh.face_normal(face).dot(mesh.face_center(face)) > 0.0;
        assert!(mesh.faces().all(outwards), "seen from outside");
        let lowest = mesh.vertices().map(|vertex| mesh.position(vertex)).fold(Vec3::ZERO, Vec3::min);
        assert_eq!(lowest, Vec3::new(-2.0, -3.0, -0.5), "lengths are those in the world");
    }

    #[test]
    fn meshes_that_several_objects_share_are_left_alone() {
        let (mut document, _) = document();
        run(&mut document, json!({ "op": "duplicate_objects", "linked": true })).expect("it can be done");
        let refused =
            run(&mut document, json!({ "op": "apply_transform", "scale": true })).expect_err("shared");
        assert!(refused.to_string().contains("share"), "{refused}");
    }
}
