//! The tab *Add*: standard objects with their dimensions, lights, empties.

use trigon_document::{AddEmpty, AddLight, AddObject, Command, LeaveEditMode, LightShape, Shape};
use trigon_window::egui::{self, Ui};

use super::adjust::changed;
use super::{ShownDocument, form};
use crate::request::Request;

/// The state of the tab: the requested image.
#[derive(Debug)]
pub(crate) struct AddState {
    command: Command,
    /// Whether its position was typed; otherwise it is that of the cursor.
    is_placed: bool,
}

impl Default for AddState {
    fn default() -> Self {
        Self { command: object(Shape::USUAL[2], [0.0; 3]), is_placed: false }
    }
}

/// Everything that can be added, with its name, at a position in the world in metres.
fn offers(position: [f64; 3]) -> impl Iterator<Item = (String, Command)> {
    let shapes = Shape::USUAL.map(|shape| (shape.name().to_owned(), object(shape, position)));
    let lights = [LightShape::Point, LightShape::Directional, LightShape::Spot].map(|light| {
        let kind = serde_json::to_value(light).expect("it is a name");
        let name = form::label(kind.as_str().unwrap_or_default()) + " light";
        (name.clone(), AddLight { light, name, position, ..AddLight::default() }.into())
    });
    let empty = ("Empty".to_owned(), AddEmpty { position, ..AddEmpty::default() }.into());
    shapes.into_iter().chain(lights).chain([empty])
}

fn object(object: Shape, position: [f64; 3]) -> Command {
    AddObject { object, name: None, position }.into()
}

/// Shows the tab. New objects are placed at `cursor`, in metres in the world, unless another position is
/// typed.
pub(crate) fn add(
    ui: &mut Ui,
    shown: ShownDocument<'_>,
    state: &mut AddState,
    cursor: [f64; 3],
    requests: &mut Vec<Request>,
) {
    if !state.is_placed
        && let Some(position) = position(&mut state.command)
    {
        *position = cursor;
    }
    let chosen = name_of(&state.command);
    ui.horizontal_wrapped(|ui| {
        for (name, command) in offers(cursor) {
            if ui.selectable_label(name == chosen, &name).clicked() {
                *state = AddState { command, is_placed: false };
            }
        }
    });
    ui.separator();
    ui.push_id(&chosen, |ui| {
        if let Some(mut command) = changed(ui, shown, &state.command) {
            state.is_placed |= position(&mut command) != position(&mut state.command);
            state.command = command;
        }
    });
    let button = egui::Button::new(format!("Add {}", chosen.to_lowercase())).wrap();
    if ui.add(button).clicked() {
        if shown.document.selection().is_editing() {
            requests.push(Request::Run(LeaveEditMode {}.into()));
        }
        requests.push(Request::Run(state.command.clone()));
    }
}

/// Where a command adds something.
fn position(command: &mut Command) -> Option<&mut [f64; 3]> {
    match command {
        Command::AddObject(AddObject { position, .. })
        | Command::AddLight(AddLight { position, .. })
        | Command::AddEmpty(AddEmpty { position, .. }) => Some(position),
        _ => None,
    }
}

/// The name of the offer that a command is.
fn name_of(command: &Command) -> String {
    match command {
        Command::AddObject(AddObject { object, .. }) => object.name().to_owned(),
        Command::AddLight(AddLight { light, .. }) => {
            let kind = serde_json::to_value(light).expect("it is a name");
            form::label(kind.as_str().unwrap_or_default()) + " light"
        }
        _ => "Empty".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use egui_kittest::kittest::Queryable;
    use trigon_document::Document;

    use super::super::testing::Case;
    use super::*;

    fn case(width: f32) -> Case<AddState> {
        Case::new([width, 620.0], Document::default(), AddState::default(), |ui, shown, state, requests| {
            add(ui, shown, state, [1.0, 0.0, 0.0], requests);
        })
    }

    #[test]
    fn everything_can_be_added_with_its_measures() {
        let mut case = case(300.0);
        for (name, expected) in offers([1.0, 0.0, 0.0]) {
            case.click(&name);
            case.click(&format!("Add {}", name.to_lowercase()));
            assert_eq!(case.take_requests(), [Request::Run(expected)], "{name}");
        }
        assert_eq!(case.document().nodes().nodes().len(), 19, "all were added");
        case.click("Torus");
        case.type_number("Minor radius", "0.5");
        case.click("Add torus");
        let shape =
            Shape::Torus { major_radius: 1.0, minor_radius: 0.5, major_segments: 48, minor_segments: 12 };
        assert_eq!(case.take_requests(), [Request::Run(object(shape, [1.0, 0.0, 0.0]))], "as typed");
        case.type_number("Position Y", "3");
        case.click("Add torus");
        assert_eq!(
            case.take_requests(),
            [Request::Run(object(shape, [1.0, 3.0, 0.0]))],
            "where it was typed"
        );
        case.image("add");
    }

    #[test]
    fn a_narrow_panel_shows_it_all() {
        let mut case = case(160.0);
        case.harness.get_by_label("Torus").click();
        case.run();
        case.assert_nothing_is_clipped();
        case.image("add_narrow");
    }
}
