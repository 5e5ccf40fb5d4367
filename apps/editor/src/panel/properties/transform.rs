//! Location, rotation and scale of an object, and the parameters of a light.

use trigon_document::mesh::math::{DQuat, DVec3};
use trigon_document::scene::{Light, LightKind, Node, NodeId, Transform};
use trigon_document::{Document, LightShape, ObjectName, Rotation, SetLight, SetTransform, TransformSpace};
use trigon_window::egui;
use trigon_window::egui::Ui;

use super::object::ShownObject;
use crate::panel::parameters::check_box;
use crate::panel::row::{AXES, choice, color, hovered, number, plain, positive, row, submit, vector};
use crate::panel::unit::Unit;
use crate::request::Request;
use crate::up::Up;

/// How transforms are shown.
#[derive(Debug, Default)]
pub(super) struct TransformState {
    space: TransformSpace,
    shown: RotationForm,
    /// Angles as they were typed: many mean the same rotation.
    typed: [f64; 3],
}

/// As what a rotation is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum RotationForm {
    #[default]
    Euler,
    Quaternion,
}

/// Two rotations whose quaternions differ by no more than this are the same: roundings of angles.
const SAME_ROTATION: f64 = 1e-9;

/// Shows them, and requests changes.
pub(super) fn transform(
    ui: &mut Ui,
    object: ShownObject<'_>,
    state: &mut TransformState,
    requests: &mut Vec<Request>,
) {
    let ShownObject { document, id, node, up } = object;
    choose_space(ui, state);
    let (scale, rotation, location) = parts(document, id, node, state.space);
    let unchanged =
        SetTransform { object: Some(ObjectName::of(id)), space: state.space, ..SetTransform::default() };
    let mut values = up.shown(location).to_array();
    let hover = "Position of the object's origin.";
    if let Some((_, response)) = vector(ui, "Location", hover, &mut values, &plain(Unit::Metres), AXES) {
        let command = SetTransform { location: Some(up.stored(values.into()).into()), ..unchanged.clone() };
        submit(ui, document, &response, command.into(), requests);
    }
    let forms = [
        (RotationForm::Euler, "XYZ Euler", "Rotations about x, then y, then z."),
        (RotationForm::Quaternion, "Quaternion", "Imaginary part x, y, z and real part w."),
    ];
    choice(ui, "Rotation as", "How the rotation is shown.", &mut state.shown, &forms);
    if let Some((rotation, response)) = show_rotation(ui, state, rotation, up) {
        let command = SetTransform { rotation: Some(rotation), ..unchanged.clone() };
        submit(ui, document, &response, command.into(), requests);
    }
    let mut values = up.exchanged(scale).to_array();
    let hover = "Scale along its own axes; negative values mirror.";
    if let Some((_, response)) = vector(ui, "Scale", hover, &mut values, &plain(Unit::None), AXES) {
        let command = SetTransform { scale: Some(up.exchanged(values.into()).into()), ..unchanged };
        submit(ui, document, &response, command.into(), requests);
    }
}

fn choose_space(ui: &mut Ui, state: &mut TransformState) {
    let spaces = [
        (TransformSpace::Local, "Local", "Relative to the parent."),
        (TransformSpace::World, "World", "Relative to the world."),
    ];
    choice(ui, "Space", "The space of the values.", &mut state.space, &spaces);
}

fn show_rotation(
    ui: &mut Ui,
    state: &mut TransformState,
    rotation: DQuat,
    up: Up,
) -> Option<(Rotation, egui::Response)> {
    let rotation = up.shown_rotation(rotation);
    match state.shown {
        RotationForm::Euler => {
            // Typed angles stay as they are as long as they mean this rotation.
            let typed = Rotation::Euler { angles: state.typed }.to_quaternion();
            if typed.dot(rotation).abs() < 1.0 - SAME_ROTATION
                && let Rotation::Euler { angles } = Rotation::euler(rotation)
            {
                state.typed = angles;
            }
            let hover = "Rotations about the axes x, then y, then z.";
            let (_, response) = vector(ui, "Rotation", hover, &mut state.typed, &plain(Unit::Degrees), AXES)?;
            let typed = Rotation::Euler { angles: state.typed };
            Some((stored(typed, up), response))
        }
        RotationForm::Quaternion => {
            let mut xyzw = rotation.to_array();
            let hover = "The imaginary part x, y, z and the real part w.";
            let (_, response) = vector(ui, "Rotation", hover, &mut xyzw, &plain(Unit::None), AXES)?;
            Some((stored(Rotation::Quaternion { xyzw }, up), response))
        }
    }
}

/// A shown rotation as the document has it. What needs no change keeps the form in which it was typed.
fn stored(shown: Rotation, up: Up) -> Rotation {
    match up {
        Up::Y => shown,
        Up::Z => Rotation::Quaternion { xyzw: up.stored_rotation(shown.to_quaternion()).to_array() },
    }
}

/// Scale, rotation and translation of an object in a space; of a map that shears, those without
/// the shear.
fn parts(document: &Document, id: NodeId, node: &Node, space: TransformSpace) -> (DVec3, DQuat, DVec3) {
    match (space, node.transform) {
        (TransformSpace::Local, Transform::Decomposed { translation, rotation, scale }) => {
            (scale, rotation, translation)
        }
        (TransformSpace::Local, Transform::Affine(affine)) => affine.to_scale_rotation_translation(),
        (TransformSpace::World, _) => document.nodes().world_transform(id).to_scale_rotation_translation(),
    }
}

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
    if let Some(response) = color(ui, "Color", "Its color.", &mut chosen) {
        let command = SetLight { color: Some(chosen), ..unchanged.clone() };
        submit(ui, document, &response, command.into(), requests);
    }
    intensity(ui, document, light, &unchanged, requests);
    if shape != LightShape::Directional {
        range(ui, document, light, &unchanged, requests);
    }
    radius(ui, document, light, &unchanged, requests);
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

/// How large it is for its shadows.
fn radius(ui: &mut Ui, document: &Document, light: Light, unchanged: &SetLight, requests: &mut Vec<Request>) {
    let (unit, hover) = match light.kind {
        LightKind::Directional => (
            Unit::None,
            "How large its disc is at a distance of one metre, for soft shadows: 0.00465 for the sun.",
        ),
        _ => (Unit::Metres, "How large it is, for soft shadows. 0 makes them sharp."),
    };
    let mut value = f64::from(light.radius);
    let form = positive(f64::INFINITY, unit);
    let response = row(ui, "Radius", hover, |ui, width| number(ui, width, &mut value, &form, ""));
    if response.changed() {
        let command = SetLight { radius: Some(value as f32), ..unchanged.clone() };
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
