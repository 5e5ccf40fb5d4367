//! Commands as JSON, for all tests of this crate.

use serde_json::{Value, json};

use crate::{Command, Document, EditError, Outcome};

pub(crate) fn command(json: Value) -> Command {
    serde_json::from_value(json).expect("a command")
}

pub(crate) fn try_run(document: &mut Document, json: Value) -> Result<Outcome, EditError> {
    document.run(command(json))
}

pub(crate) fn run(document: &mut Document, json: Value) {
    document.run(command(json.clone())).unwrap_or_else(|error| panic!("{json}: {error}"));
}

pub(crate) fn run_all(document: &mut Document, commands: &[Value]) {
    commands.iter().for_each(|json| run(document, json.clone()));
}

/// Edits the faces of these objects.
pub(crate) fn edit_faces(document: &mut Document, objects: &[&str]) {
    run(document, json!({ "op": "edit_objects", "objects": objects }));
    run(document, json!({ "op": "set_element_kind", "kind": "face" }));
}

/// A document with one object, all of whose faces are selected.
pub(crate) fn editing_faces(mesh: trigon_mesh::Mesh) -> Document {
    let mut scene = trigon_scene::Scene::new();
    scene.add_object("object", mesh, trigon_scene::Material::default());
    let mut document = Document::new(scene);
    edit_faces(&mut document, &["object"]);
    run(&mut document, json!({ "op": "select_all" }));
    document
}

/// The first edited mesh.
pub(crate) fn edited(document: &Document) -> &trigon_modelling::EditMesh {
    let (id, _) = document.selection().meshes().next().expect("one is edited");
    document.mesh(id).expect("it is there")
}

/// Runs a command. Returns how many faces of the first edited mesh are selected.
pub(crate) fn chosen(document: &mut Document, command: Value) -> usize {
    run(document, command);
    let kind = document.selection().kind();
    let (_, selection) = document.selection().meshes().next().expect("one is edited");
    selection.faces(edited(document), kind).len()
}
