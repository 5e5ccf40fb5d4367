//! Parameters of a light.

use trigon_document::scene::{Light, LightKind};
use trigon_document::{Document, LightShape, ObjectName, SetLight};
use trigon_window::egui::{self, Ui};

use super::super::parameters::check_box;
use super::super::row::{choice, color, hovered, number, positive, row};
use super::super::submit::submit;
use super::super::unit::Unit;
use super::ShownObject;
use crate::request::Request;

/// What the range is when a limit is switched on, in metres.
const USUAL_RANGE: f32 = 10.0;

/// Shows it, and requests changes.
pub(super) fn light(ui: &mut Ui, object: ShownObject<'_>, light: Light, requests: &mut Vec<Request>) {
    let ShownObject { document, id, .. } = object;
    let unchanged = SetLight { object: Some(ObjectName::of(id)), ..SetLight::default() };
    let Some(mut shape) = shape_of(light.kind) else {
        ui.add(egui::Label::new("Ambient light, the same from all directions").wrap());
        return;
    };
    let kinds = [
        (LightShape::Point, "Point", "Shines from a point in all directions."),
        (LightShape::Directional, "Directional", "Shines from far away, like the sun."),
        (LightShape::Spot, "Spot", "Shines in a cone."),
    ];
    if choice(ui, "Kind", "", &mut shape, &kinds).changed() {
        requests.push(Request::Run(SetLight { light: Some(shape), ..unchanged.clone() }.into()));
    }
    let mut chosen = light.color.to_array();
    if let Some(response) = color(ui, "Colour", "Its colour.", &mut chosen) {
        let command = SetLight { color: Some(chosen), ..unchanged.clone() };
        submit(ui, document, &response, command.into(), requests);
    }
    intensity(ui, document, light, &unchanged, requests);
    if shape != LightShape::Directional {
        range(ui, document, light, &unchanged, requests);
    }
    if let LightKind::Spot { inner, outer } = light.kind {
        cone(ui, document, [inner, outer], &unchanged, requests);
    }
}

fn shape_of(kind: LightKind) -> Option<LightShape> {
    match kind {
        LightKind::Point => Some(LightShape::Point),
        LightKind::Directional => Some(LightShape::Directional),
        LightKind::Spot { .. } => Some(LightShape::Spot),
        LightKind::Ambient => None,
    }
}

fn intensity(
    ui: &mut Ui,
    document: &Document,
    light: Light,
    unchanged: &SetLight,
    requests: &mut Vec<Request>,
) {
    let hover = "1 shows a white surface as white; for points and spots, from one metre away.";
    let mut strength = f64::from(light.intensity);
    let form = positive(f64::INFINITY, Unit::None);
    let response = row(ui, "Intensity", hover, |ui, width| number(ui, width, &mut strength, &form, ""));
    if response.changed() {
        let command = SetLight { intensity: Some(strength as f32), ..unchanged.clone() };
        submit(ui, document, &response, command.into(), requests);
    }
}

/// How far it shines, if there is a limit.
fn range(ui: &mut Ui, document: &Document, light: Light, unchanged: &SetLight, requests: &mut Vec<Request>) {
    let mut is_limited = light.range.is_finite();
    let hover = "Whether the light ends at its range.";
    if hovered(check_box(ui, &mut is_limited, "Limited range"), hover).changed() {
        let range = Some(if is_limited { USUAL_RANGE } else { 0.0 });
        requests.push(Request::Run(SetLight { range, ..unchanged.clone() }.into()));
    }
    if !light.range.is_finite() {
        return;
    }
    let mut value = f64::from(light.range);
    let form = positive(f64::INFINITY, Unit::Metres);
    let hover = "The light does not shine beyond this distance.";
    let response = row(ui, "Range", hover, |ui, width| number(ui, width, &mut value, &form, ""));
    if response.changed() {
        let command = SetLight { range: Some(value as f32), ..unchanged.clone() };
        submit(ui, document, &response, command.into(), requests);
    }
}

/// The two angles of a spot.
fn cone(
    ui: &mut Ui,
    document: &Document,
    angles: [f32; 2],
    unchanged: &SetLight,
    requests: &mut Vec<Request>,
) {
    let form = positive(90.0, Unit::Degrees);
    let shown = [
        ("Inner angle", "The angle from the axis at which the light begins to fade."),
        ("Outer angle", "The angle from the axis beyond which there is no light."),
    ];
    for (index, (label, hover)) in shown.into_iter().enumerate() {
        let mut degrees = f64::from(angles[index]).to_degrees();
        let response = row(ui, label, hover, |ui, width| number(ui, width, &mut degrees, &form, ""));
        if response.changed() {
            let given = Some(degrees as f32);
            let command = match index {
                0 => SetLight { inner_angle: given, ..unchanged.clone() },
                _ => SetLight { outer_angle: given, ..unchanged.clone() },
            };
            submit(ui, document, &response, command.into(), requests);
        }
    }
}
