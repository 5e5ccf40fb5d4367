//! Moving, turning and scaling texture coordinates, and laying quads beside each other.

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::{DAffine2, DMat2, DVec2, elementary};
use trigon_modelling::{CornerId, EditMesh, FaceId, QuadLength, UnwrapSettings, Unwrapped, UvElements};

use super::unwrap::{add, warnings};
use super::{Action, Outcome};
use crate::error::EditError;
use crate::selection::{ElementKind, MeshSelection};
use crate::state::{AfterEdit, Change};

const SOMETHING: &str = "at least one selected element";

/// Moves the texture coordinates of the selected elements, and of corners that share them: of whole faces if all their
/// vertices or edges are selected, or else of each selected vertex or edge.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct TranslateUvs {
    /// The set of texture coordinates, from 0.
    pub uv_set: u32,
    /// To the right and upwards, in sides of the image.
    pub offset: [f64; 2],
    /// Whether islands of which some pins are moved and others are not are unwrapped again, around the pins.
    pub live_unwrap: bool,
}

impl Action for TranslateUvs {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let [right, up] = self.offset;
        let map = |_| DAffine2::from_translation(DVec2::new(right, -up));
        let moved = Moved {
            command: "moving texture coordinates",
            uv_set: self.uv_set,
            live_unwrap: self.live_unwrap,
        };
        transform(change, &moved, map)
    }
}

/// Turns the texture coordinates of the selected elements, and of corners that share them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RotateUvs {
    /// The set of texture coordinates, from 0.
    pub uv_set: u32,
    /// Counter-clockwise, in degrees.
    pub angle: f64,
    /// The point that stays, from the upper left corner of the image to the right and downwards. Default: the middle of
    /// the coordinates.
    pub center: Option<[f64; 2]>,
    /// Whether islands of which some pins are moved and others are not are unwrapped again, around the pins.
    pub live_unwrap: bool,
}

impl Action for RotateUvs {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (sin, cos) = elementary::sin_cos(self.angle * (PI / 180.0));
        // v grows downwards.
        let turn = DMat2::from_cols(DVec2::new(cos, -sin), DVec2::new(sin, cos));
        let map = |center| about(turn, self.center, center);
        let moved = Moved {
            command: "turning texture coordinates",
            uv_set: self.uv_set,
            live_unwrap: self.live_unwrap,
        };
        transform(change, &moved, map)
    }
}

/// Scales the texture coordinates of the selected elements, and of corners that share them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ScaleUvs {
    /// The set of texture coordinates, from 0.
    pub uv_set: u32,
    /// The factors of width and height; negative ones mirror, and 0 aligns.
    pub factors: [f64; 2],
    /// The point that stays, from the upper left corner of the image to the right and downwards. Default: the middle of
    /// the coordinates.
    pub center: Option<[f64; 2]>,
    /// Whether islands of which some pins are moved and others are not are unwrapped again, around the pins.
    pub live_unwrap: bool,
}

impl Default for ScaleUvs {
    fn default() -> Self {
        Self { uv_set: 0, factors: [1.0; 2], center: None, live_unwrap: false }
    }
}

impl Action for ScaleUvs {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let scale = DMat2::from_diagonal(self.factors.into());
        let map = |center| about(scale, self.center, center);
        let moved = Moved {
            command: "scaling texture coordinates",
            uv_set: self.uv_set,
            live_unwrap: self.live_unwrap,
        };
        transform(change, &moved, map)
    }
}

/// A map that leaves a point where it is.
fn about(matrix: DMat2, given: Option<[f64; 2]>, middle: DVec2) -> DAffine2 {
    let center = given.map_or(middle, DVec2::from);
    DAffine2 { matrix2: matrix, translation: center - matrix * center }
}

/// What the moves of texture coordinates have in common.
struct Moved {
    command: &'static str,
    uv_set: u32,
    live_unwrap: bool,
}

/// Changes the coordinates of the selected elements of all meshes, by a map that knows the middle of all of them.
fn transform(
    change: &mut Change<'_>,
    moved: &Moved,
    map: impl Fn(DVec2) -> DAffine2,
) -> Result<Outcome, EditError> {
    let (uv_set, kind) = (moved.uv_set as usize, change.selection().kind());
    let map = map(selected_uv_center(change, uv_set));
    let mut unwrapped = Unwrapped::default();
    change.edit_selected(moved.command, SOMETHING, |mesh, selection| {
        let corners = selected_uv_corners(mesh, selection, kind, uv_set);
        mesh.transform_uvs(uv_set, &corners, &map)?;
        if moved.live_unwrap {
            let settings = UnwrapSettings { uv_set, ..UnwrapSettings::default() };
            add(&mut unwrapped, mesh.unwrap_around_moved_pins(&corners, &settings)?);
        }
        Ok(AfterEdit::Keep)
    })?;
    Ok(Outcome { warnings: warnings(&unwrapped), ..Outcome::silent() })
}

/// The middle of the box around what is selected in all meshes; the origin without coordinates, which is then refused.
fn selected_uv_center(change: &Change<'_>, uv_set: usize) -> DVec2 {
    let (selection, kind) = (change.selection(), change.selection().kind());
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for (id, selected) in selection.meshes() {
        let Some(mesh) = change.state().mesh(id) else { continue };
        for corner in selected_uv_corners(mesh, selected, kind, uv_set) {
            let uv = mesh.uv(uv_set, corner).unwrap_or_default().as_dvec2();
            (low, high) = (low.min(uv), high.max(uv));
        }
    }
    if low.x <= high.x { (low + high) / 2.0 } else { DVec2::ZERO }
}

/// The corners of a mesh whose texture coordinates go with the selection of a kind: those of whole faces if all their
/// vertices or edges are selected, or else of each vertex or edge; and corners that share coordinates with them.
#[must_use]
pub fn selected_uv_corners(
    mesh: &EditMesh,
    selection: &MeshSelection,
    kind: ElementKind,
    uv_set: usize,
) -> Vec<CornerId> {
    // An island that is selected as a whole leaves others, with which it shares vertices, where they are.
    let faces = selection.faces(mesh, kind);
    if kind == ElementKind::Face || !faces.is_empty() {
        return mesh.uv_corners(uv_set, UvElements::Faces(&faces));
    }
    match kind {
        ElementKind::Edge => mesh.uv_corners(uv_set, UvElements::Edges(&selection.edges(mesh, kind))),
        _ => mesh.uv_corners(uv_set, UvElements::Vertices(&selection.vertices(mesh, kind))),
    }
}

/// Lays the selected quads beside the active one, which keeps its texture coordinates, as rows and columns.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct FollowActiveQuad {
    /// The set of texture coordinates, from 0.
    pub uv_set: u32,
    /// How far each quad reaches.
    pub length: QuadLength,
}

impl Action for FollowActiveQuad {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let mut count = 0;
        change.edit_selected("following a quad", "a selected face that is active", |mesh, selection| {
            let faces = selection.faces(mesh, kind);
            let active = (kind == ElementKind::Face).then(|| selection.order().last().copied()).flatten();
            let active = active.map(FaceId::new).or(faces.first().copied()).expect("something is selected");
            count += mesh.follow_quad(&faces, active, self.uv_set as usize, self.length)?;
            Ok(AfterEdit::Keep)
        })?;
        Ok(Outcome::counted("laid", count, ["face", "faces"]))
    }
}
