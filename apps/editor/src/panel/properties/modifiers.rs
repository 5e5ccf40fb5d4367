//! The modifiers of the active object's mesh, in their order, with their parameters.

use trigon_document::modelling::StackedModifier;
use trigon_document::{
    AddModifier, ApplyModifier, Command, Modifier, MoveModifier, ObjectName, RemoveModifier, SetModifier,
    ShowModifier,
};
use trigon_window::egui::{Button, Response, Ui};

use super::object::ShownObject;
use crate::icon::Icon;
use crate::panel::ShownDocument;
use crate::panel::form::{self, KeyOrder};
use crate::panel::parameters;
use crate::request::Request;

/// Shows them, and what adds one.
pub(super) fn modifiers(ui: &mut Ui, shown: ShownObject<'_>, requests: &mut Vec<Request>) {
    let ShownObject { document, id, node, .. } = shown;
    let object = ObjectName::of(id);
    let mut run = |command: Command| requests.push(Request::Run(command));
    ui.menu_button("Add Modifier", |ui| {
        for modifier in Modifier::of_each_kind() {
            if ui.button(modifier.name()).clicked() {
                run(AddModifier { object: Some(object.clone()), modifier, index: None }.into());
                ui.close();
            }
        }
    });
    let stack = node.mesh.and_then(|mesh| document.mesh(mesh)).map_or(&[][..], |mesh| mesh.modifiers());
    let states: Vec<_> = node.mesh.map_or_else(Vec::new, |mesh| document.modifier_states(mesh).collect());
    for (index, stacked) in stack.iter().enumerate() {
        ui.push_id(index, |ui| {
            ui.separator();
            if let Some(command) = header(ui, &object, stacked, index, stack.len()) {
                run(command);
            }
            let shortfall = || states.get(index).and_then(|state| state.shortfall());
            if let Some(text) = missing(shown, &stacked.modifier).or_else(shortfall) {
                ui.colored_label(ui.visuals().warn_fg_color, text);
            }
            if let Some(modifier) = changed(ui, shown, stacked, index) {
                run(SetModifier { object: Some(object.clone()), index: index as u32, modifier }.into());
            }
        });
    }
}

/// The name, whether it is on, and what is done with it as a whole.
fn header(
    ui: &mut Ui,
    object: &ObjectName,
    stacked: &StackedModifier,
    index: usize,
    count: usize,
) -> Option<Command> {
    let (object, at) = (Some(object.clone()), index as u32);
    let mut chosen = None;
    ui.horizontal_wrapped(|ui| {
        let eye = if stacked.is_on { Icon::Shown } else { Icon::Hidden };
        let name = stacked.modifier.name();
        let switch = ui.add(Button::selectable(stacked.is_on, (eye.atom(), name)));
        if switch.on_hover_text("Switches the modifier on or off").clicked() {
            chosen = Some(ShowModifier { object: object.clone(), index: at, on: !stacked.is_on }.into());
        }
        let named = |response: Response, what: &str| response.accessible_name(format!("{what} {name}"));
        let moved = |to: u32| MoveModifier { object: object.clone(), index: at, to }.into();
        let up = ui.add_enabled(index > 0, Button::new("Up").small());
        if named(up, "Move up").clicked() {
            chosen = Some(moved(at - 1));
        }
        let down = ui.add_enabled(index + 1 < count, Button::new("Down").small());
        if named(down, "Move down").clicked() {
            chosen = Some(moved(at + 1));
        }
        let apply = named(ui.small_button("Apply"), "Apply");
        if apply.on_hover_text("Changes the mesh as the modifier says, and removes it").clicked() {
            chosen = Some(ApplyModifier { object: object.clone(), index: at }.into());
        }
        if named(ui.small_button("Remove"), "Remove").clicked() {
            chosen = Some(RemoveModifier { object: object.clone(), index: at }.into());
        }
    });
    chosen
}

/// What a modifier lacks, so that it does nothing.
fn missing(shown: ShownObject<'_>, modifier: &Modifier) -> Option<String> {
    let mut nodes = shown.document.nodes().nodes().iter();
    match (modifier.object(), modifier) {
        (Some(name), _) => {
            let is_there = nodes.any(|(_, node)| node.name == name && node.mesh.is_some());
            (!is_there).then(|| format!("There is no object {name} with a mesh: choose another one."))
        }
        (None, Modifier::Boolean(_)) => Some("Choose the other object.".into()),
        (None, _) => None,
    }
}

/// Shows the parameters. Returns the modifier with those that a user changed.
fn changed(ui: &mut Ui, shown: ShownObject<'_>, stacked: &StackedModifier, index: usize) -> Option<Modifier> {
    let set = SetModifier { object: None, index: index as u32, modifier: stacked.modifier.clone() };
    let order = KeyOrder::of(&set.into());
    let property = &form::of_command("set_modifier")?["properties"]["modifier"];
    let mut value = serde_json::to_value(&stacked.modifier).expect("modifiers have string keys");
    let within = ShownDocument { document: shown.document, up: shown.up };
    let is_changed = parameters::of_variant(ui, within, property, &mut value, order.within("modifier"));
    serde_json::from_value(value).ok().filter(|_| is_changed)
}
