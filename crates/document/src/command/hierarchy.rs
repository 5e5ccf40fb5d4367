//! Parents of objects, the order of siblings, and hiding and showing objects.

use std::collections::BTreeSet;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_scene::NodeId;

use super::scene::named_or_selected;
use super::set_transform::transform_of;
use super::{Action, ObjectName, Outcome};
use crate::error::EditError;
use crate::state::Change;

/// Sets or clears the parent of objects.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SetParent {
    /// The objects. Default: the selected ones.
    pub objects: Vec<ObjectName>,
    /// The parent; without one the objects move to the top level.
    pub parent: Option<ObjectName>,
    /// Whether they stay in place in the world. Otherwise they keep their placement relative to their parent,
    /// and move.
    pub keep_transform: bool,
    /// The index of the first one among its new siblings, from 0. Default: at the end.
    #[serde(rename = "place")]
    pub index: Option<u32>,
}

impl Action for SetParent {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let objects = named_or_selected(change, &self.objects, "setting a parent")?;
        let parent = self.parent.as_ref().map(|name| name.find(change.scene())).transpose()?;
        let scene = change.scene_mut();
        for (count, id) in objects.into_iter().filter(|&id| Some(id) != parent).enumerate() {
            let world = scene.world_transform(id);
            scene.set_parent(id, parent)?;
            if self.keep_transform {
                let outer = parent.map_or(Default::default(), |parent| scene.world_transform(parent));
                let local = transform_of(outer.inverse() * world);
                scene.node_mut(id).expect("it was just hung").transform = local;
            }
            if let Some(index) = self.index {
                scene.reorder(id, index as usize + count)?;
            }
        }
        Ok(Outcome::silent())
    }
}

/// Moves an object to another position among its siblings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ReorderObject {
    /// The object. Default: the active one.
    #[serde(default)]
    pub object: Option<ObjectName>,
    /// Its new index, from 0; beyond the last means last.
    pub to: u32,
}

impl Action for ReorderObject {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let id = super::set_transform::named_or_active(change, self.object.as_ref(), "reordering")?;
        change.scene_mut().reorder(id, self.to as usize)?;
        Ok(Outcome::silent())
    }
}

/// Hides all objects except the selected ones and their ancestors.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct HideOthers {}

impl Action for HideOthers {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let retained = named_or_selected(change, &[], "hiding other objects")?;
        let scene = change.scene();
        // Hiding a parent hides its children.
        let retained: BTreeSet<NodeId> = retained.into_iter().flat_map(|id| scene.ancestors(id)).collect();
        let is_shown = |(id, node): (NodeId, &trigon_scene::Node)| {
            (node.visible && !retained.contains(&id)).then_some(id)
        };
        let others: Vec<NodeId> = scene.nodes().iter().filter_map(is_shown).collect();
        set_visible(change, &others, false);
        Ok(Outcome::counted("hid", others.len(), ["object", "objects"]))
    }
}

/// Shows all hidden objects, and selects them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RevealObjects {}

impl Action for RevealObjects {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if change.selection().is_editing() {
            return Err(EditError::Editing("showing hidden objects"));
        }
        let nodes = change.scene().nodes().iter();
        let hidden: Vec<NodeId> = nodes.filter(|(_, node)| !node.visible).map(|(id, _)| id).collect();
        set_visible(change, &hidden, true);
        if let Some(&last) = hidden.last() {
            let selection = change.selection_mut();
            selection.active = Some(last);
            selection.objects = hidden.iter().copied().collect();
        }
        Ok(Outcome::counted("showed", hidden.len(), ["object", "objects"]))
    }
}

fn set_visible(change: &mut Change<'_>, objects: &[NodeId], visible: bool) {
    let scene = change.scene_mut();
    for &id in objects {
        scene.node_mut(id).expect("it was just found").visible = visible;
    }
}

#[cfg(test)]
mod tests {
    use crate::Command;
    use crate::document::Document;
    use crate::tests::commands::run;
    use serde_json::json;
    use trigon_mesh::math::{DQuat, DVec3};
    use trigon_mesh::primitives;
    use trigon_scene::{Material, Node, NodeId, Scene, Transform};

    fn document() -> (Document, [NodeId; 3]) {
        let mut scene = Scene::new();
        let ids = ["one", "two", "three"].map(|name| scene.add(Node::default().with_name(name)));
        let turned = Transform::from_scale_rotation_translation(
            DVec3::splat(2.0),
            DQuat::from_rotation_z(1.0),
            DVec3::new(3.0, 0.0, 0.0),
        );
        scene.node_mut(ids[0]).expect("it was added").transform = turned;
        (Document::new(scene), ids)
    }

    #[test]
    fn objects_stay_where_they_are_when_they_keep_their_transform() {
        let (mut document, [one, two, three]) = document();
        let before = document.nodes().world_transform(two);
        run(
            &mut document,
            json!({ "op": "set_parent", "objects": ["two"], "parent": "one", "keep_transform": true }),
        );
        // Rounding of an inverse and of a product of numbers up to 3.
        assert!(document.nodes().world_transform(two).abs_diff_eq(before, 1e-14), "it did not move");
        run(&mut document, json!({ "op": "set_parent", "objects": ["three"], "parent": "one" }));
        let moved = document.nodes().world_transform(three);
        assert_eq!(moved, document.nodes().world_transform(one), "it moved with what it hangs on");
    }

    #[test]
    fn siblings_and_roots_are_reordered_and_undone() {
        let (mut document, [one, two, three]) = document();
        let roots = |document: &Document| document.nodes().roots().collect::<Vec<_>>();
        assert_eq!(roots(&document), [one, two, three], "as they were added");
        run(&mut document, json!({ "op": "reorder_object", "object": "three", "to": 0 }));
        assert_eq!(roots(&document), [three, one, two], "the last is the first");
        run(&mut document, json!({ "op": "add_light" }));
        assert_eq!(roots(&document)[..3], [three, one, two], "a new one comes last");
        document.undo().expect("the light");
        for (object, expected) in [("three", [three]), ("two", [three])] {
            run(&mut document, json!({ "op": "set_parent", "objects": [object], "parent": "one" }));
            assert_eq!(
                document.nodes().node(one).expect("there").children()[..1],
                expected,
                "hung on at the end"
            );
        }
        run(&mut document, json!({ "op": "set_parent", "objects": ["two"], "parent": "one", "place": 0 }));
        assert_eq!(document.nodes().node(one).expect("there").children(), [two, three], "among its siblings");
        (0..4).for_each(|_| document.undo().expect("four were done"));
        assert_eq!(roots(&document), [one, two, three], "all is undone");
    }
    #[test]
    fn the_order_of_roots_is_saved() {
        let (mut document, _) = document();
        // A file without any mesh cannot be opened.
        run(&mut document, json!({ "op": "add_object", "object": { "shape": "cube", "edge": 1.0 } }));
        run(&mut document, json!({ "op": "reorder_object", "object": "three", "to": 0 }));
        let bytes = document.to_native().encode().expect("small").to_bytes();
        let name = std::path::Path::new("order.glb");
        let (again, _) = Document::open_bytes(name, &bytes, &Default::default()).expect("as written");
        let names = again.nodes().roots().filter_map(|id| Some(again.nodes().node(id)?.name.clone()));
        assert_eq!(names.collect::<Vec<_>>(), ["three", "one", "two", "Cube"], "as ordered");
        let bytes_again = again.to_native().encode().expect("small").to_bytes();
        assert!(bytes == bytes_again, "and saved as loaded");
    }

    #[test]
    fn others_are_hidden_and_all_shown_again() {
        let mut scene = Scene::new();
        let [arm, other] = ["arm", "other"].map(|name| scene.add(Node::default().with_name(name)));
        let hand = scene.add_child(arm, Node::default().with_name("hand")).expect("the arm is there");
        let mut document = Document::new(scene);
        let shown = |document: &Document| {
            [arm, hand, other].map(|id| document.nodes().node(id).expect("it stays").visible)
        };
        run(&mut document, json!({ "op": "select", "objects": ["hand"] }));
        run(&mut document, json!({ "op": "hide_others" }));
        assert_eq!(shown(&document), [true, true, false], "what the hand hangs on is shown, too");
        run(&mut document, json!({ "op": "reveal_objects" }));
        assert_eq!(shown(&document), [true; 3], "all");
        let selection = document.selection();
        assert_eq!(selection.objects.iter().copied().collect::<Vec<_>>(), [other], "what was hidden");
        (0..2).for_each(|_| document.undo().expect("two were done"));
        assert_eq!(shown(&document), [true; 3], "undone");
    }

    #[test]
    fn hidden_objects_are_not_selected_until_they_are_shown_again() {
        let mut scene = Scene::new();
        for name in ["one", "other", "third"] {
            scene.add_object(name, primitives::cube(1.0), Material::default());
        }
        let mut document = Document::new(scene);
        let mut run = |json: &str| -> Vec<String> {
            let command: Command = serde_json::from_str(json).expect("a command");
            document.run(command).unwrap_or_else(|error| panic!("{json}: {error}"));
            let (scene, selection) = (document.nodes(), document.selection());
            assert!(selection.active.is_none_or(|active| selection.objects.contains(&active)), "{json}");
            selection.objects.iter().map(|id| scene.node(*id).expect("it is there").name.clone()).collect()
        };
        run(r#"{ "op": "select", "objects": ["one", "other"] }"#);
        assert!(
            run(r#"{ "op": "show_objects", "visible": false }"#).is_empty(),
            "nobody moves what is not seen"
        );
        run(r#"{ "op": "select", "objects": ["third"] }"#);
        assert_eq!(run(r#"{ "op": "reveal_objects" }"#), ["one", "other"], "and those alone");
        assert_eq!(run(r#"{ "op": "reveal_objects" }"#), ["one", "other"], "nothing is hidden any more");
        document.undo().expect("nothing changed");
        document.undo().expect("they are hidden");
        let hidden = document.nodes().nodes().iter().filter(|(_, node)| !node.visible).count();
        assert_eq!(hidden, 2, "as before");
    }
}
