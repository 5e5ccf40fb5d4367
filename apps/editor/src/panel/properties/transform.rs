//! Location, rotation and scale of an object.

use trigon_document::mesh::math::{DQuat, DVec3};
use trigon_document::scene::{Node, NodeId, Transform};
use trigon_document::{Document, ObjectName, Rotation, SetTransform, TransformSpace};
use trigon_window::egui::Ui;

use super::super::row::{choice, plain, vector};
use super::super::submit::submit;
use super::super::unit::Unit;
use super::ShownObject;
use crate::request::Request;

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
    let ShownObject { document, id, node } = object;
    choose_space(ui, state);
    let (scale, rotation, location) = parts(document, id, node, state.space);
    let unchanged =
        SetTransform { object: Some(ObjectName::of(id)), space: state.space, ..SetTransform::default() };
    let mut values = location.to_array();
    let hover = "Position of the object's origin.";
    if let Some((_, response)) = vector(ui, "Location", hover, &mut values, &plain(Unit::Metres)) {
        let command = SetTransform { location: Some(values), ..unchanged.clone() };
        submit(ui, document, &response, command.into(), requests);
    }
    let forms = [
        (RotationForm::Euler, "XYZ Euler", "Rotations about x, then y, then z."),
        (RotationForm::Quaternion, "Quaternion", "Imaginary part x, y, z and real part w."),
    ];
    choice(ui, "Rotation as", "How the rotation is shown.", &mut state.shown, &forms);
    if let Some((rotation, response)) = show_rotation(ui, state, rotation) {
        let command = SetTransform { rotation: Some(rotation), ..unchanged.clone() };
        submit(ui, document, &response, command.into(), requests);
    }
    let mut values = scale.to_array();
    let hover = "Scale along its own axes; negative values mirror.";
    if let Some((_, response)) = vector(ui, "Scale", hover, &mut values, &plain(Unit::None)) {
        let command = SetTransform { scale: Some(values), ..unchanged };
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
) -> Option<(Rotation, trigon_window::egui::Response)> {
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
            let (_, response) = vector(ui, "Rotation", hover, &mut state.typed, &plain(Unit::Degrees))?;
            Some((Rotation::Euler { angles: state.typed }, response))
        }
        RotationForm::Quaternion => {
            let mut xyzw = rotation.to_array();
            let hover = "The imaginary part x, y, z and the real part w.";
            let (_, response) = vector(ui, "Rotation", hover, &mut xyzw, &plain(Unit::None))?;
            Some((Rotation::Quaternion { xyzw }, response))
        }
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
