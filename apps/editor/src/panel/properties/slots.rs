//! The list of an object's material slots, and what is done with the chosen one.

use trigon_document::scene::{Arena, Material, MaterialId};
use trigon_document::{
    AddMaterial, AssignMaterial, ElementKind, MaterialName, ObjectName, SelectByMaterial, SetElementKind,
    SetMaterialSlot,
};
use trigon_window::egui::{self, Align, Button, Color32, Layout, Sense, Ui};

use super::object::ShownObject;
use crate::panel::row::{row, srgb};
use crate::request::Request;

/// The side of a slot's colour, in points.
const SWATCH: f32 = 14.0;

/// Shows the slots, of which one is chosen.
pub(super) fn slots(ui: &mut Ui, shown: ShownObject<'_>, slot: &mut usize, requests: &mut Vec<Request>) {
    let ShownObject { document, id, node, .. } = shown;
    let materials = &document.nodes().materials;
    *slot = (*slot).min(node.materials.len().saturating_sub(1));
    for (at, &id) in node.materials.iter().enumerate() {
        if line(ui, materials, id, at == *slot).clicked() {
            *slot = at;
        }
    }
    ui.horizontal_wrapped(|ui| {
        let is_editing = document.selection().is_editing();
        let help = match is_editing {
            true => "Adds a slot with a new material, and chooses it: Assign gives it to faces",
            false => "Gives the chosen slot, and so its faces, a new material",
        };
        if ui.button("New").on_hover_text(help).clicked() {
            new_material(shown, slot, requests);
        }
        for_faces(ui, shown, *slot, requests);
    });
    let Some(&current) = node.materials.get(*slot) else { return };
    if let Some(chosen) = choose_material(ui, materials, current) {
        let (object, material) = (Some(ObjectName::of(id)), MaterialName::of(chosen));
        requests.push(Request::Run(SetMaterialSlot { object, slot: *slot as u32, material }.into()));
    }
}

/// A new material: in edit mode for faces that will be chosen, in object mode for those of the slot.
fn new_material(shown: ShownObject<'_>, slot: &mut usize, requests: &mut Vec<Request>) {
    let ShownObject { document, id, node, .. } = shown;
    let object = Some(ObjectName::of(id));
    if document.selection().is_editing() || node.materials.is_empty() {
        requests.push(Request::Run(AddMaterial { object, ..AddMaterial::default() }.into()));
        *slot = node.materials.len();
    } else {
        requests.push(Request::Run(
            AddMaterial { slot: Some(*slot as u32), object, ..AddMaterial::default() }.into(),
        ));
    }
}

/// A slot: its colour and its name.
fn line(ui: &mut Ui, materials: &Arena<Material>, id: MaterialId, is_chosen: bool) -> egui::Response {
    ui.horizontal(|ui| {
        let (rect, _) = ui.allocate_exact_size(egui::Vec2::splat(SWATCH), Sense::hover());
        if let Some(material) = materials.get(id) {
            let [red, green, blue] = srgb(material.base_color.truncate().to_array());
            ui.painter().rect_filled(rect, 2.0, Color32::from_rgb(red, green, blue));
        }
        let layout = Layout::top_down_justified(Align::LEFT);
        ui.with_layout(layout, |ui| ui.add(Button::selectable(is_chosen, name(materials, id)).truncate()))
            .inner
    })
    .inner
}

/// What the chosen slot does to faces, in edit mode.
fn for_faces(ui: &mut Ui, shown: ShownObject<'_>, slot: usize, requests: &mut Vec<Request>) {
    let selection = shown.document.selection();
    if !selection.is_editing() || shown.node.materials.is_empty() {
        return;
    }
    let material = slot as u32;
    let has_faces = selection.meshes().any(|(_, elements)| !elements.is_empty());
    let assign = ui.add_enabled(has_faces, Button::new("Assign"));
    let assign = assign.on_disabled_hover_text("Select faces first");
    if assign.on_hover_text("Gives the selected faces this slot").clicked() {
        requests.push(Request::Run(AssignMaterial { material }.into()));
    }
    if ui.button("Select").on_hover_text("Selects the faces of this slot").clicked() {
        if !selection.kinds().contains(ElementKind::Face) {
            requests.push(Request::Run(SetElementKind { kind: ElementKind::Face, extend: false }.into()));
        }
        requests.push(Request::Run(SelectByMaterial { material }.into()));
    }
}

fn name(materials: &Arena<Material>, id: MaterialId) -> String {
    match materials.get(id) {
        Some(material) if !material.name.is_empty() => material.name.clone(),
        Some(_) => format!("Material {}", id.index()),
        None => "Default".to_owned(),
    }
}

/// All materials of the scene. Their names are made only while the list is open: there may be
/// thousands.
fn choose_material(ui: &mut Ui, materials: &Arena<Material>, current: MaterialId) -> Option<MaterialId> {
    let mut chosen = None;
    row(ui, "Material", "The material in this slot.", |ui, width| {
        let list = egui::ComboBox::from_id_salt("material").width(width).truncate();
        let shown = list.selected_text(name(materials, current)).show_ui(ui, |ui| {
            for (id, _) in materials.iter() {
                if ui.selectable_label(id == current, name(materials, id)).clicked() && id != current {
                    chosen = Some(id);
                }
            }
        });
        shown.response
    });
    chosen
}
