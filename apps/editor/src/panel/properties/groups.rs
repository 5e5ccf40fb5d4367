//! The vertex groups of the active object's mesh: their names, and what is done with them and the selected vertices.

use trigon_document::{
    AddVertexGroup, AssignToVertexGroup, Command, ObjectName, RemoveFromVertexGroup, RemoveVertexGroup,
    RenameVertexGroup, SelectAction, SelectVertexGroup,
};
use trigon_window::egui::{Button, Ui};

use super::object::ShownObject;
use crate::panel::row::{row, text};
use crate::request::Request;

/// The names of the groups, in their order.
pub(super) fn names(shown: ShownObject<'_>) -> Vec<String> {
    let mesh = shown.node.mesh.and_then(|mesh| shown.document.mesh(mesh));
    mesh.map_or_else(Vec::new, |mesh| mesh.vertex_group_names().map(str::to_owned).collect())
}

/// Shows them, and what adds one.
pub(super) fn groups(ui: &mut Ui, shown: ShownObject<'_>, names: &[String], requests: &mut Vec<Request>) {
    let object = ObjectName::of(shown.id);
    let is_edited = shown.node.mesh.is_some_and(|mesh| shown.document.selection().of(mesh).is_some());
    for (index, group) in names.iter().enumerate() {
        ui.push_id(index, |ui| {
            let mut name = group.clone();
            if row(ui, "Vertex group", "", |ui, width| text(ui, width, &mut name)).changed() {
                let (object, group) = (Some(object.clone()), Some(group.clone()));
                requests.push(Request::Run(RenameVertexGroup { object, group, name }.into()));
            }
            if let Some(command) = buttons(ui, &object, group, is_edited) {
                requests.push(Request::Run(command));
            }
        });
    }
    if ui.button("Add Vertex Group").clicked() {
        requests.push(Request::Run(AddVertexGroup { object: Some(object), ..Default::default() }.into()));
    }
}

/// What is done with a group; with vertices alone where they can be selected.
fn buttons(ui: &mut Ui, object: &ObjectName, group: &str, is_edited: bool) -> Option<Command> {
    let named = Some(group.to_owned());
    let select = |action| SelectVertexGroup { group: named.clone(), minimum: 0.0, action }.into();
    let of_vertices: [(&str, Command); 4] = [
        ("Assign", AssignToVertexGroup { group: named.clone(), ..Default::default() }.into()),
        ("Unassign", RemoveFromVertexGroup { group: named.clone() }.into()),
        ("Select", select(SelectAction::Add)),
        ("Deselect", select(SelectAction::Remove)),
    ];
    let remove = RemoveVertexGroup { object: Some(object.clone()), group: named.clone() };
    let all = of_vertices.into_iter().map(|(label, command)| (label, command, is_edited));
    let mut chosen = None;
    ui.horizontal_wrapped(|ui| {
        for (label, command, is_enabled) in all.chain([("Remove", remove.into(), true)]) {
            let button = ui.add_enabled(is_enabled, Button::new(label).small());
            if button.accessible_name(format!("{label} {group}")).clicked() {
                chosen = Some(command);
            }
        }
    });
    chosen
}
