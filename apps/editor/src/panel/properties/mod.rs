//! The tab *Properties*: exact values of the active object, or of selected elements.

mod elements;
mod groups;
mod material;
mod modifiers;
mod object;
mod preview;
mod slots;
#[cfg(test)]
mod tests;
mod transform;

use trigon_document::{ObjectName, RenameObject};
use trigon_window::egui::{self, CollapsingHeader, Ui};

use super::ShownDocument;
use super::row::{row, text};
use crate::request::Request;
use object::ShownObject;

/// The state of the tab: the requested image.
#[derive(Debug, Default)]
pub(crate) struct PropertiesState {
    transform: transform::TransformState,
    /// Of the selected elements.
    elements: elements::Values,
    material: material::MaterialState,
}

/// Shows it.
pub(crate) fn properties(
    ui: &mut Ui,
    shown: ShownDocument<'_>,
    state: &mut PropertiesState,
    requests: &mut Vec<Request>,
) {
    let ShownDocument { document, up } = shown;
    if document.selection().is_editing() {
        section(ui, "Selected elements", |ui| {
            elements::elements(ui, shown, &mut state.elements, requests);
        });
    }
    let active = document.selection().active;
    let Some((id, node)) = active.and_then(|id| Some((id, document.nodes().node(id)?))) else {
        ui.add(egui::Label::new("Select an object to see its properties.").wrap());
        return;
    };
    let object = ShownObject { document, id, node, up };
    if !document.selection().is_editing() && !document.selection().objects.contains(&id) {
        ui.weak("Nothing is selected; this is the active object.");
    }
    ui.push_id(id, |ui| {
        let mut name = node.name.clone();
        if row(ui, "Name", "", |ui, width| text(ui, width, &mut name)).changed() {
            requests.push(Request::Run(RenameObject { object: ObjectName::of(id), name }.into()));
        }
        section(ui, "Transform", |ui| {
            transform::transform(ui, object, &mut state.transform, requests);
        });
        if let Some(light) = node.light.as_deref().copied() {
            section(ui, "Light", |ui| transform::light(ui, object, light, requests));
        }
        let groups = groups::names(object);
        if !groups.is_empty() {
            section(ui, "Vertex Groups", |ui| groups::groups(ui, object, &groups, requests));
        }
        if node.mesh.is_some() {
            section(ui, "Modifiers", |ui| modifiers::modifiers(ui, object, requests));
            section(ui, "Material", |ui| {
                material::material(ui, object, &mut state.material, requests);
            });
        }
    });
}

fn section(ui: &mut Ui, title: &str, contents: impl FnOnce(&mut Ui)) {
    CollapsingHeader::new(title).default_open(true).show_unindented(ui, contents);
}
