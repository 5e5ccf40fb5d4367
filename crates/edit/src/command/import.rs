//! Adding the contents of another file to the scene.

use std::path::Path;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_io::{LoadOptions, Loaded, load};

use super::{Action, Outcome};
use crate::error::EditError;
use crate::state::Change;

/// Adds the objects of a file in any readable format, placed as they are there, and selects them. The file is
/// read again whenever the command runs again, in a script or from a recovery file.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ImportFile {
    /// The path of the file.
    pub path: String,
}

impl Action for ImportFile {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let loaded = load(Path::new(&self.path), &LoadOptions::default())
            .map_err(|error| EditError::Import(error.to_string()))?;
        self.add(change, &loaded)
    }
}

impl ImportFile {
    /// Adds the contents of a file.
    pub(crate) fn add(&self, change: &mut Change<'_>, loaded: &Loaded) -> Result<Outcome, EditError> {
        if change.selection().is_editing() {
            return Err(EditError::Editing("importing a file"));
        }
        let scene = change.scene_mut();
        let added = scene.append(&loaded.scene);
        let is_root = |id: &_| scene.node(*id).is_some_and(|node| node.parent().is_none());
        let roots: Vec<_> = added.iter().copied().filter(is_root).collect();
        let selection = change.selection_mut();
        selection.active = roots.first().copied();
        selection.objects = roots.into_iter().collect();
        let warnings = loaded.warnings.iter().map(ToString::to_string).collect();
        Ok(Outcome { warnings, ..Outcome::counted("added", added.len(), ["object", "objects"]) })
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;
    use trigon_mesh::primitives;
    use trigon_scene::{Material, Scene};

    use super::*;
    use crate::document::Document;

    #[test]
    fn what_a_file_holds_is_added_selected_and_undone() {
        let folder = std::env::temp_dir().join(format!("trigon-edit-import-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let path = folder.join("square.obj");
        std::fs::write(&path, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n").expect("written");
        let mut scene = Scene::new();
        scene.add_object("cube", primitives::cube(1.0), Material::default());
        let mut document = Document::new(scene);
        let import = |path: &Path| serde_json::from_value(json!({ "op": "import_file", "path": path }));
        document.run(import(&path).expect("a command")).expect("it can be read");
        assert_eq!(document.scene().nodes().len(), 2, "the cube and the square");
        let active = document.selection().active.expect("the square");
        let mesh = document.nodes().node(active).and_then(|node| node.mesh).expect("it has one");
        assert_eq!(document.nodes().meshes().get(mesh).expect("added").mesh().face_count(), 1);
        document.undo().expect("one");
        assert_eq!(document.scene().nodes().len(), 1, "the cube");
        let missing = import(&folder.join("missing.obj")).expect("a command");
        let refused = document.run(missing).expect_err("there is none").to_string();
        assert!(refused.contains("missing.obj"), "{refused}");
        std::fs::remove_dir_all(&folder).expect("it was made above");
    }
}
