//! Showing what was hidden.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Action, Outcome};
use crate::document::Change;
use crate::error::EditError;

/// Shows all objects that are hidden, and selects them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RevealObjects {}

impl Action for RevealObjects {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if change.selection().is_editing() {
            return Err(EditError::Editing("showing objects"));
        }
        let hidden = change.scene().nodes().iter().filter(|(_, node)| !node.visible);
        let hidden: Vec<_> = hidden.map(|(id, _)| id).collect();
        let scene = change.scene_mut();
        for id in &hidden {
            scene.node_mut(*id).expect("it was just found").visible = true;
        }
        let count = hidden.len();
        if count > 0 {
            let selection = change.selection_mut();
            selection.active = hidden.last().copied();
            selection.objects = hidden.into_iter().collect();
        }
        Ok(Outcome::counted("showed", count, ["object", "objects"]))
    }
}

#[cfg(test)]
mod tests {
    use trigon_mesh::primitives;
    use trigon_scene::{Material, Scene};

    use crate::{Command, Document};

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
