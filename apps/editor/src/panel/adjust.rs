//! The panel for adjusting the last command (F9), and the history list, latest entry first: a click undoes or
//! redoes up to an entry.

use trigon_document::{Command, Document, Entry};
use trigon_window::egui;
use trigon_window::egui::Ui;

use super::ShownDocument;
use super::form::KeyOrder;
use super::{form, parameters};
use crate::request::Request;

/// Shows the last command with its parameters. A change requests the same command with other parameters
/// instead.
pub(crate) fn adjust(ui: &mut Ui, shown: ShownDocument<'_>, requests: &mut Vec<Request>) {
    let document = shown.document;
    let Some(entry) = document.history().done().last() else {
        ui.add(egui::Label::new("Nothing was done yet.").wrap());
        return;
    };
    let command = entry.command();
    ui.add(egui::Label::new(egui::RichText::new(command.name()).strong()).wrap());
    // Positions in the history: another command is no edit of the one before.
    let entry_index = document.history().done().len() + document.history().dropped();
    ui.push_id((command.name(), entry_index), |ui| {
        requests.extend(changed(ui, shown, command).map(Request::Adjust));
    });
}

/// Shows the parameters of a command. Returns the command with those that a user changed.
pub(super) fn changed(ui: &mut Ui, shown: ShownDocument<'_>, command: &Command) -> Option<Command> {
    let mut value = serde_json::to_value(command).expect("commands have string keys");
    let schema = form::of_command(value["op"].as_str()?)?;
    let is_changed = parameters::group(ui, shown, schema, &mut value, &KeyOrder::of(command));
    // A text that a command does not take, such as no name at all, changes nothing.
    serde_json::from_value(value).ok().filter(|_| is_changed)
}

/// The maximum number of entries listed on each side of the current one.
const MOST: usize = 50;

/// Shows the list. A click requests as many undos or redos as lead to that entry.
pub(crate) fn history(ui: &mut Ui, document: &Document, requests: &mut Vec<Request>) {
    let history = document.history();
    let (done, undone) = (history.done(), history.undone());
    for (index, entry) in undone.iter().enumerate().take(MOST).rev() {
        if line(ui, entry, false).on_hover_text("Redoes everything up to here").clicked() {
            requests.extend(std::iter::repeat_n(Request::Redo, index + 1));
        }
    }
    for (undos, entry) in done.iter().rev().enumerate().take(MOST) {
        if line(ui, entry, undos == 0).on_hover_text("Undoes everything after this").clicked() {
            requests.extend(std::iter::repeat_n(Request::Undo, undos));
        }
    }
    let more = done.len().saturating_sub(MOST) + history.dropped();
    match (done.len(), more) {
        (0, 0) => drop(ui.weak("Nothing was done yet.")),
        (_, 0) if ui.selectable_label(false, "Start").clicked() => {
            requests.extend(std::iter::repeat_n(Request::Undo, done.len()));
        }
        (_, 0) => {}
        _ => drop(ui.weak(format!("and {more} before"))),
    }
}

fn line(ui: &mut Ui, entry: &Entry, is_now: bool) -> egui::Response {
    ui.selectable_label(is_now, entry.command().name())
}

#[cfg(test)]
mod tests {
    use super::super::testing::Case;
    use super::super::unit::Unit;
    use super::*;
    use egui_kittest::kittest::Queryable;
    use serde_json::{Value, json};
    use trigon_document::mesh::primitives;
    use trigon_document::scene::{Material, Scene};

    use crate::up::Up;

    fn document() -> Document {
        let mut scene = Scene::new();
        scene.add_object("Cube", primitives::cube(2.0), Material::default());
        Document::new(scene)
    }

    /// The panel after some commands.
    fn case(width: f32, commands: &[Value]) -> Case<()> {
        let mut case = Case::new([width, 600.0], document(), (), |ui, shown, (), requests| {
            adjust(ui, shown, requests);
        });
        commands.iter().for_each(|json| case.command(json.clone()));
        case
    }

    /// Every command, with values for the parameters that have no default.
    fn all_commands() -> Vec<Command> {
        let variants = form::schema()["oneOf"].as_array().expect("commands");
        let mut commands = Vec::new();
        for variant in variants {
            let op = variant["properties"]["op"]["const"].as_str().expect("each has a name");
            let schema = form::of_command(op).expect("it is known");
            let mut value = json!({ "op": op });
            for name in schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str) {
                let property = &schema["properties"][name];
                value[name] = match form::form(property, Unit::None) {
                    // Bytes as text.
                    form::Form::ReadOnly if !property["contentEncoding"].is_null() => json!(""),
                    // Names of objects and materials.
                    form::Form::ReadOnly => json!(0),
                    form => form::initial(&form),
                };
            }
            value["op"] = op.into();
            commands.push(
                serde_json::from_value(value.clone()).unwrap_or_else(|error| panic!("{value}: {error}")),
            );
        }
        commands
    }

    #[test]
    fn every_command_has_its_panel_and_stays_as_it_is() {
        let commands = all_commands();
        assert!(commands.len() > 70, "{} commands", commands.len());
        for (width, up) in [(160.0, Up::Y), (300.0, Up::Z)] {
            let state = (commands[0].clone(), Vec::new());
            let panel = |ui: &mut Ui,
                         shown: ShownDocument<'_>,
                         state: &mut (Command, Vec<Command>),
                         _: &mut Vec<Request>| {
                let (command, changes) = state;
                ui.push_id(command.name(), |ui| changes.extend(changed(ui, shown, command)));
            };
            let mut case = Case::new([width, 900.0], document(), state, panel);
            case.harness.state_mut().up = up;
            for command in &commands {
                case.harness.state_mut().state.0 = command.clone();
                case.run();
                assert_eq!(case.harness.state().state.1, [], "{}: nobody changed it", command.name());
                case.assert_nothing_is_clipped();
                let value = serde_json::to_value(command).expect("JSON");
                let again: Command = serde_json::from_value(value).expect("as written");
                assert_eq!(again, *command, "through JSON and back");
            }
        }
    }

    #[test]
    fn every_parameter_has_a_form() {
        // Lists, and names of objects and materials, are shown and not edited.
        let read_only = [
            "objects",
            "elements",
            "parts",
            "strokes",
            "from",
            "object",
            "parent",
            "material",
            "orientation",
        ];
        for command in all_commands() {
            let value = serde_json::to_value(&command).expect("JSON");
            let schema = form::of_command(value["op"].as_str().expect("a name")).expect("it is known");
            for (name, property) in schema["properties"].as_object().into_iter().flatten() {
                let form = form::form(property, Unit::None);
                let is_shown_only = matches!(&form, form::Form::ReadOnly)
                    || matches!(&form, form::Form::Optional(inner) if **inner == form::Form::ReadOnly);
                let is_bytes = !property["contentEncoding"].is_null();
                let is_list = read_only.contains(&name.as_str())
                    || !property["const"].is_null()
                    || is_bytes
                    || name == "op";
                assert!(!is_shown_only || is_list, "{}: {name} has no widget", command.name());
            }
        }
    }

    #[test]
    fn a_changed_number_adjusts_the_last_command() {
        let faces = [
            json!({ "op": "edit_objects", "objects": ["Cube"] }),
            json!({ "op": "set_element_kind", "kind": "face" }),
            json!({ "op": "select", "elements": [0] }),
            json!({ "op": "inset", "thickness": 0.25 }),
        ];
        let mut case = case(300.0, &faces);
        let entries = case.document().history().done().len();
        case.type_number("Depth", "0.5");
        let inset = |depth, open_borders| {
            let command =
                json!({ "op": "inset", "thickness": 0.25, "depth": depth, "open_borders": open_borders });
            Request::Adjust(serde_json::from_value(command).expect("a command"))
        };
        assert_eq!(case.take_requests(), [inset(0.5, true)], "typed");
        case.click("Open borders");
        assert_eq!(case.take_requests(), [inset(0.5, false)], "a check box");
        case.choose("Mode", "Individual");
        let chosen = case.take_requests();
        assert!(matches!(&chosen[..], [Request::Adjust(_)]), "from a list: {chosen:?}");
        assert_eq!(case.document().history().done().len(), entries, "in the place of the last");
        case.image("adjust");
    }

    #[test]
    fn optional_values_are_switched_on_and_angles_are_degrees() {
        let mut case = case(
            300.0,
            &[json!({ "op": "select_all" }), json!({ "op": "rotate", "angle": 30.0, "axis": [0, 0, 1] })],
        );
        let angle = case.harness.get_by_role_and_label(egui::Role::SpinButton, "Angle");
        assert_eq!(angle.value().as_deref(), Some("30°"), "in degrees");
        case.click("Center");
        case.type_number("Center X", "2");
        let last = case.take_requests().pop();
        let expected = json!({ "op": "rotate", "angle": 30.0, "axis": [0, 0, 1], "center": [2, 0, 0] });
        let expected = serde_json::from_value(expected).expect("a command");
        assert_eq!(last, Some(Request::Adjust(expected)), "a centre");
        case.click("Proportional");
        assert!(
            case.harness.query_by_role_and_label(egui::Role::SpinButton, "Radius").is_some(),
            "its parameters"
        );
        case.image("adjust_optional");
    }

    #[test]
    fn lists_are_counted() {
        let case = case(
            300.0,
            &[
                json!({ "op": "edit_objects", "objects": ["Cube"] }),
                json!({ "op": "set_element_kind", "kind": "face" }),
                json!({ "op": "select", "elements": [0, 1, 2] }),
            ],
        );
        assert!(case.harness.query_by_label("3 faces").is_some(), "what kind, and how many");
    }

    #[test]
    fn a_click_leads_back_and_forth() {
        let document = Document::new(Scene::new());
        let mut case = Case::new([260.0, 400.0], document, (), |ui, shown, (), requests| {
            history(ui, shown.document, requests);
        });
        for op in ["add_empty", "add_light", "select_all", "delete_objects"] {
            case.command(json!({ "op": op }));
        }
        case.click("Add Light");
        assert_eq!(case.take_requests(), [Request::Undo, Request::Undo], "what came after it");
        assert_eq!(case.document().nodes().nodes().len(), 2, "before they were deleted");
        case.click("Start");
        assert_eq!(case.document().nodes().nodes().len(), 0, "before all");
        case.click("Delete Objects");
        assert_eq!(case.document().history().done().len(), 4, "all again");
        case.image("history");
    }
}
