//! Keeps the window's scene in step with the document.

use trigon_document::{Document, SceneChange};
use trigon_window::SharedScene;

/// What of a scene changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Changed {
    /// Anything at all.
    pub(crate) anything: bool,
    /// Its nodes were taken over from the document.
    pub(crate) nodes: bool,
}

/// Updates a window's scene to the document. This takes time proportional to what changed: moved vertices are
/// sent to the drawing threads, and nothing is copied for them.
///
/// The scene has to be the same at each call, and nothing else may change its meshes.
pub(crate) fn show(document: &mut Document, scene: &mut SharedScene) -> Changed {
    let mut changed = Changed::default();
    for change in document.take_scene_changes() {
        changed.anything = true;
        changed.nodes |= matches!(change, SceneChange::Whole | SceneChange::Parts);
        match change {
            SceneChange::Whole => *scene = document.nodes().clone().into(),
            SceneChange::Values(id, values) => {
                scene.change_mesh(id, &values).expect("the document's scene was changed so");
            }
            other => other.apply(document.nodes(), scene),
        }
    }
    changed
}

#[cfg(test)]
mod tests {
    use trigon_document::Command;
    use trigon_document::scene::{Scene, showcase};

    use super::*;

    fn positions(scene: &Scene) -> Vec<Vec<trigon_document::scene::math::Vec3>> {
        scene.meshes().iter().map(|(_, asset)| asset.mesh().positions().to_vec()).collect()
    }

    #[test]
    fn the_window_shows_what_is_edited_undone_and_added() {
        let mut document = Document::new(showcase());
        let mut scene = SharedScene::default();
        let commands = [
            r#"{ "op": "select_all" }"#,
            r#"{ "op": "edit_objects" }"#,
            r#"{ "op": "select_all" }"#,
            r#"{ "op": "translate", "offset": [0, 1, 0] }"#,
            r#"{ "op": "translate", "offset": [1, 0, 0] }"#,
            r#"{ "op": "subdivide" }"#,
            r#"{ "op": "leave_edit_mode" }"#,
            r#"{ "op": "add_object", "object": { "shape": "cube", "edge": 1.0 } }"#,
        ];
        for json in commands {
            let command: Command = serde_json::from_str(json).expect("a command");
            document.run(command).unwrap_or_else(|error| panic!("{json}: {error}"));
            show(&mut document, &mut scene);
            assert!(positions(&scene) == positions(document.scene()), "after {json}");
            assert_eq!(scene.nodes().len(), document.nodes().nodes().len(), "after {json}");
        }
        while document.undo().is_ok() {
            show(&mut document, &mut scene);
            assert!(positions(&scene) == positions(document.scene()), "undone");
            assert_eq!(scene.nodes().len(), document.nodes().nodes().len(), "undone");
        }
    }
}
