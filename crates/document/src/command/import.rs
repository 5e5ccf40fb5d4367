//! Adding the contents of another file to the scene.

use std::path::Path;

use schemars::JsonSchema;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use trigon_io::{LoadOptions, Loaded, UpAxis, load};

use super::{Action, Outcome};
use crate::error::EditError;
use crate::state::{Change, Names};

/// Adds the objects of a file in any readable format, placed as they are there, and selects them. Objects whose name
/// is taken get a number: `Cube.001`. The file is read again whenever the command runs again, in a script or from a recovery file.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ImportFile {
    /// The path of the file.
    pub path: String,
    /// The axis that is up in the file, such as "+Z", or a direction such as "0,1,0.5"; by default that of its
    /// format: +Z in STL and 3MF, +Y in all others. Objects of another axis than +Y come below a node that turns them
    /// without rounding.
    #[serde(serialize_with = "write_axis", deserialize_with = "read_axis")]
    #[schemars(with = "Option<String>")]
    pub up: Option<UpAxis>,
}

fn write_axis<S: Serializer>(up: &Option<UpAxis>, serializer: S) -> Result<S::Ok, S::Error> {
    up.map(|up| up.to_string()).serialize(serializer)
}

fn read_axis<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<UpAxis>, D::Error> {
    let text = Option::<String>::deserialize(deserializer)?;
    text.map(|text| text.parse().map_err(Error::custom)).transpose()
}

impl Action for ImportFile {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let options = LoadOptions { up: self.up, ..LoadOptions::default() };
        let loaded =
            load(Path::new(&self.path), &options).map_err(|error| EditError::Import(error.to_string()))?;
        self.add(change, &loaded)
    }
}

impl ImportFile {
    /// Adds the contents of a file.
    pub(crate) fn add(&self, change: &mut Change<'_>, loaded: &Loaded) -> Result<Outcome, EditError> {
        if change.selection().is_editing() {
            return Err(EditError::Editing("importing a file"));
        }
        change.note_files(&loaded.files);
        // Meshes and textures are shared.
        let mut turned = loaded.scene.clone();
        let mut names = Names::of(change.scene());
        let scene = change.scene_mut();
        turned.turn_to(scene.up);
        let added = scene.append(&turned);
        for &id in &added {
            let node = scene.node_mut(id).expect("it was just added");
            node.name = names.take(&node.name);
        }
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
    use trigon_mesh::math::DVec3;
    use trigon_mesh::primitives;
    use trigon_scene::{Material, Scene};

    use super::*;
    use crate::Command;
    use crate::document::Document;

    #[test]
    fn what_a_file_holds_is_added_selected_and_undone() {
        let folder = std::env::temp_dir().join(format!("trigon-document-import-{}", std::process::id()));
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
        let name = document.nodes().node(active).expect("the square").name.clone();
        document.run(import(&path).expect("a command")).expect("it can be read again");
        let second = document.selection().active.and_then(|id| document.nodes().node(id)).expect("another");
        assert_eq!(second.name, format!("{name}.001"), "the name is taken");
        (0..2).for_each(|_| document.undo().expect("two"));
        assert_eq!(document.scene().nodes().len(), 1, "the cube");
        let solid = "solid x\nfacet normal 1 0 0\nouter loop\nvertex 1 2 3\nvertex 4 5 6\nvertex 7 8 0\nendloop\nendfacet\nendsolid";
        let path = folder.join("part.stl");
        std::fs::write(&path, solid).expect("written");
        // Up and to the back, as the format has it, and as the command says.
        for (up, expected) in
            [(json!(null), DVec3::new(1.0, 3.0, -2.0)), (json!("+Y"), DVec3::new(1.0, 2.0, 3.0))]
        {
            let command = json!({ "op": "import_file", "path": path, "up": up });
            document.run(serde_json::from_value(command).expect("a command")).expect("it can be read");
            let scene = document.scene();
            let (id, node) = scene.nodes().iter().find(|(_, node)| node.name == "x").expect("the solid");
            let mesh = node.mesh.and_then(|mesh| scene.meshes().get(mesh)).expect("it has one").mesh();
            let corner = mesh.positions()[0].as_dvec3();
            assert_eq!(scene.world_transform(id).transform_point3(corner), expected, "{up}");
            document.undo().expect("one");
        }
        let wrong = json!({ "op": "import_file", "path": path, "up": "sideways" });
        let refused = serde_json::from_value::<Command>(wrong).expect_err("no axis").to_string();
        assert!(refused.contains("-Z"), "{refused}");
        let missing = import(&folder.join("missing.obj")).expect("a command");
        let refused = document.run(missing).expect_err("there is none").to_string();
        assert!(refused.contains("missing.obj"), "{refused}");
        std::fs::remove_dir_all(&folder).expect("it was made above");
    }
}
