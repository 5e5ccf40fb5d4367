//! Moving the origins of objects without moving what is seen, and geometry onto its origin.

use std::collections::BTreeSet;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::{DAffine3, DVec3};
use trigon_modelling::{EditMesh, Refusal};
use trigon_scene::{MeshId, NodeId};

use super::apply_transform::{move_all, set_placements};
use super::scene::named_or_selected;
use super::space::inverse;
use super::{Action, Outcome};
use crate::error::EditError;
use crate::state::Change;

const COMMAND: &str = "setting an origin";

/// What is moved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OriginTarget {
    /// The origin, to the centre of the mesh. Nothing is seen to move.
    #[default]
    Geometry,
    /// The origin, to a point. Nothing is seen to move.
    Point,
    /// The mesh, so that its centre is at the origin.
    GeometryToOrigin,
}

/// What the centre of a mesh is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum GeometryCenter {
    /// The middle of the smallest box around it, along the axes of the object.
    #[default]
    Bounds,
    /// The mean of its vertices.
    Vertices,
}

/// Moves the origins of the selected objects that have a mesh, or their meshes onto their origins. Child objects stay
/// where they are. Of a mesh that several objects share, all origins move.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SetOrigin {
    /// What is moved, and where to.
    pub to: OriginTarget,
    /// What the centre of a mesh is.
    pub center: GeometryCenter,
    /// The point, in metres in world space; for `to: "point"` alone.
    pub point: [f64; 3],
}

impl Action for SetOrigin {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if change.selection().is_editing() {
            return Err(EditError::Editing(COMMAND));
        }
        let mut moved = BTreeSet::new();
        for id in named_or_selected(change, &[], COMMAND)? {
            let Some(mesh) = change.scene().node(id).and_then(|node| node.mesh) else { continue };
            if moved.contains(&mesh) {
                continue;
            }
            check(change, mesh)?;
            let Some(center) = self.center(change, id, mesh)? else { continue };
            move_origin(change, mesh, center, self.to != OriginTarget::GeometryToOrigin)?;
            moved.insert(mesh);
        }
        if moved.is_empty() {
            return Err(EditError::NothingSelected { command: COMMAND, needed: "an object with a mesh" });
        }
        Ok(Outcome::silent())
    }
}

impl SetOrigin {
    /// The point of a mesh that becomes its origin; none if it has no vertices, and so no centre.
    fn center(
        &self,
        change: &mut Change<'_>,
        object: NodeId,
        mesh: MeshId,
    ) -> Result<Option<DVec3>, EditError> {
        if self.to == OriginTarget::Point {
            let into_mesh = inverse(change.scene().world_transform(object), COMMAND)?;
            return Ok(Some(into_mesh.transform_point3(DVec3::from(self.point))));
        }
        let center = self.center;
        Ok(change.mesh(mesh).filter(|mesh| mesh.vertex_count() > 0).map(|mesh| center.of(mesh)))
    }
}

impl GeometryCenter {
    /// Of a mesh with vertices.
    fn of(self, mesh: &EditMesh) -> DVec3 {
        let positions = mesh.vertices().map(|vertex| mesh.position(vertex).as_dvec3());
        match self {
            Self::Bounds => {
                let least = positions.clone().fold(DVec3::INFINITY, DVec3::min);
                let greatest = positions.fold(DVec3::NEG_INFINITY, DVec3::max);
                (least + greatest) / 2.0
            }
            Self::Vertices => positions.sum::<DVec3>() / mesh.vertex_count() as f64,
        }
    }
}

/// Subtracts a point from all positions; the origins of all objects that show the mesh move there, if they do.
fn move_origin(
    change: &mut Change<'_>,
    mesh: MeshId,
    center: DVec3,
    moves_origin: bool,
) -> Result<(), EditError> {
    let map = DAffine3::from_translation(-center);
    change.edit(mesh, |mesh| move_all(mesh, map))?;
    if !moves_origin {
        return Ok(());
    }
    let nodes = change.scene().nodes().iter();
    let owners: Vec<NodeId> = nodes.filter(|(_, node)| node.mesh == Some(mesh)).map(|(id, _)| id).collect();
    for id in owners {
        let mut rest = change.scene().node(id).expect("it was just listed").transform;
        rest.set_translation(rest.to_affine().transform_point3(center));
        set_placements(change, id, rest, map);
    }
    Ok(())
}

/// Whether all of a mesh follows its vertices and its node.
fn check(change: &Change<'_>, mesh: MeshId) -> Result<(), EditError> {
    let asset = change.scene().meshes().get(mesh);
    if asset.is_some_and(|asset| asset.mesh().attributes().skin.is_some()) {
        let reason = "the mesh has a skin, whose joints place it";
        return Err(Refusal::NotPossible { operation: COMMAND, reason }.into());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};
    use trigon_mesh::math::DQuat;
    use trigon_mesh::primitives;
    use trigon_scene::{Material, Node, Scene, Transform};

    use super::*;
    use crate::document::Document;
    use crate::tests::commands::{run, try_run};

    /// A pyramid below a turned parent, with a child, and a second object that shares its mesh.
    fn document() -> (Document, [NodeId; 3]) {
        let mut scene = Scene::new();
        let outer = scene.add(Node::default().with_transform(placed(0.5)).with_name("outer"));
        let cone = scene.add_object("cone", primitives::pyramid(2.0, 3.0), Material::default());
        scene.set_parent(cone, Some(outer)).expect("no circle");
        scene.node_mut(cone).expect("there").transform = placed(-1.0);
        let child = Node::default().with_transform(placed(2.0)).with_name("child");
        let child = scene.add_child(cone, child).expect("the cone is there");
        let twin = scene.node(cone).expect("there").clone().with_name("twin").with_transform(placed(0.25));
        let twin = scene.add(twin);
        let mut document = Document::new(scene);
        run(&mut document, json!({ "op": "select", "objects": ["cone"] }));
        (document, [cone, child, twin])
    }

    fn placed(turn: f64) -> Transform {
        Transform::from_scale_rotation_translation(
            DVec3::new(2.0, -1.0, 0.5),
            DQuat::from_rotation_z(turn),
            DVec3::new(turn, 2.0, 3.0),
        )
    }

    /// Where the vertices of the cone and of its twin are in the world, and the child's corners.
    fn seen(document: &mut Document, [cone, child, twin]: [NodeId; 3]) -> Vec<DVec3> {
        let scene = document.scene();
        let mesh = scene.node(cone).and_then(|node| node.mesh).expect("it has one");
        let positions = scene.meshes().get(mesh).expect("there").mesh().positions();
        let of = |id| {
            let world = scene.world_transform(id);
            positions.iter().map(move |position| world.transform_point3(position.as_dvec3()))
        };
        let hung = scene.world_transform(child);
        let axes = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z].map(|point| hung.transform_point3(point));
        of(cone).chain(of(twin)).chain(axes).collect()
    }

    fn check_all_stay(command: &Value, expected: impl Fn(&Scene, NodeId) -> DVec3) {
        let (mut document, ids) = document();
        let before = seen(&mut document, ids);
        let origin = expected(document.nodes(), ids[0]);
        run(&mut document, command.clone());
        for (was, is) in before.iter().zip(seen(&mut document, ids)) {
            // Positions of a few metres, rounded to f32 once.
            assert!(was.abs_diff_eq(is, 1e-6), "{command}: {was} is at {is}");
        }
        let found = document.nodes().world_transform(ids[0]).translation;
        assert!(found.abs_diff_eq(origin, 1e-12), "{command}: the origin is at {found}, not at {origin}");
        document.undo().expect("one entry");
        assert_eq!(seen(&mut document, ids), before, "{command}: undone");
    }

    #[test]
    fn an_origin_moves_and_nothing_is_seen_to() {
        check_all_stay(&json!({ "op": "set_origin", "to": "point", "point": [7.0, -1.0, 2.5] }), |_, _| {
            DVec3::new(7.0, -1.0, 2.5)
        });
        // The pyramid of the primitives has its middle of height at the origin, and four of five vertices below.
        let middle = |scene: &Scene, id| scene.world_transform(id).translation;
        check_all_stay(&json!({ "op": "set_origin" }), middle);
        let mean = DVec3::new(0.0, (4.0 * -1.5 + 1.5) / 5.0, 0.0);
        check_all_stay(&json!({ "op": "set_origin", "center": "vertices" }), |scene, id| {
            scene.world_transform(id).transform_point3(mean)
        });
    }

    #[test]
    fn geometry_moves_onto_the_origin_and_children_stay() {
        let (mut document, ids) = document();
        run(&mut document, json!({ "op": "set_origin", "to": "point", "point": [7.0, -1.0, 2.5] }));
        let before = seen(&mut document, ids);
        run(&mut document, json!({ "op": "set_origin", "to": "geometry_to_origin" }));
        let after = seen(&mut document, ids);
        let (mesh, hung) = (after.len() - 4, &after[after.len() - 4..]);
        assert_eq!(hung, &before[mesh..], "what hangs on it stays");
        let origin = document.nodes().world_transform(ids[0]).translation;
        assert!(origin.abs_diff_eq(DVec3::new(7.0, -1.0, 2.5), 1e-12), "{origin}: it stays");
        let id = document.nodes().node(ids[0]).and_then(|node| node.mesh).expect("it has one");
        let center = GeometryCenter::Bounds.of(document.mesh(id).expect("edited"));
        // Two roundings of positions of a few metres to f32.
        assert!(center.abs_diff_eq(DVec3::ZERO, 1e-6), "{center}");
        assert!(!before[0].abs_diff_eq(after[0], 1e-3), "it moved");
    }

    #[test]
    fn what_has_no_mesh_or_no_size_is_refused() {
        let (mut document, _) = document();
        run(&mut document, json!({ "op": "select", "objects": ["child"] }));
        try_run(&mut document, json!({ "op": "set_origin" })).expect_err("it has no mesh");
        run(&mut document, json!({ "op": "select", "objects": ["cone"] }));
        run(&mut document, json!({ "op": "set_transform", "scale": [1.0, 0.0, 1.0] }));
        let refused = try_run(&mut document, json!({ "op": "set_origin", "to": "point" }));
        assert!(refused.expect_err("it is flat").to_string().contains("scale"), "the remedy");
    }
}
