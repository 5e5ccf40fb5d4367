//! Hiding all objects except some, and showing hidden ones.

use std::collections::BTreeSet;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_scene::NodeId;

use super::scene::named_or_selected;
use super::{Action, Outcome};
use crate::error::EditError;
use crate::state::Change;

/// Hides all objects except the selected ones and their ancestors.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct HideOthers {}

impl Action for HideOthers {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kept = named_or_selected(change, &[], "hiding other objects")?;
        let scene = change.scene();
        // Hiding a parent hides its children.
        let kept: BTreeSet<NodeId> = kept.into_iter().flat_map(|id| scene.ancestors(id)).collect();
        let is_shown =
            |(id, node): (NodeId, &trigon_scene::Node)| (node.visible && !kept.contains(&id)).then_some(id);
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
    use serde_json::json;
    use trigon_mesh::primitives;
    use trigon_scene::{Material, Node, Scene};

    use crate::tests::commands::run;
    use crate::{Command, Document};

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
