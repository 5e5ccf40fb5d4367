//! Hiding all objects but some, and showing all that are hidden.

use std::collections::BTreeSet;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_scene::NodeId;

use super::scene::named_or_selected;
use super::{Action, Outcome};
use crate::document::Change;
use crate::error::EditError;

/// Hides all objects but the selected ones and those that they hang on.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct HideOthers {}

impl Action for HideOthers {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kept = named_or_selected(change, &[], "hiding other objects")?;
        let scene = change.scene();
        // What a hidden object carries is hidden with it.
        let kept: BTreeSet<NodeId> = kept.into_iter().flat_map(|id| scene.ancestors(id)).collect();
        let is_shown =
            |(id, node): (NodeId, &trigon_scene::Node)| (node.visible && !kept.contains(&id)).then_some(id);
        let others: Vec<NodeId> = scene.nodes().iter().filter_map(is_shown).collect();
        set_visible(change, &others, false);
        Ok(Outcome::counted("hid", others.len(), ["object", "objects"]))
    }
}

/// Shows all objects that are hidden, and selects them.
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
    use trigon_scene::{Node, Scene};

    use crate::document::Document;

    fn run(document: &mut Document, json: serde_json::Value) {
        document.run(serde_json::from_value(json.clone()).expect("a command")).expect("it can be done");
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
}
