//! The selected elements of meshes: positions and marks.

use trigon_edit::mesh::math::DVec3;
use trigon_edit::{Command, Crease, Document, ResetVertices, Translate};
use trigon_window::egui::{self, Response, Ui};

use super::super::row::{number, plain, positive, row, vector};
use super::super::submit::{is_same_drag, submit};
use super::super::unit::Unit;
use crate::request::Request;

/// Above so many selected elements their values are not computed: it would take longer than a frame.
const MOST_SHOWN: usize = 100_000;

/// Means of what is selected.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Values {
    /// Of the selected vertices, in metres in the space of their mesh.
    middle: DVec3,
    vertices: u32,
    /// Of the selected edges.
    crease: f64,
    edges: u32,
}

/// Shows it, and requests changes.
pub(super) fn elements(
    ui: &mut Ui,
    document: &Document,
    known: &mut Option<(u64, Values)>,
    requests: &mut Vec<Request>,
) {
    let count: usize = document.selection().meshes().map(|(_, selection)| selection.len()).sum();
    if count == 0 {
        ui.add(egui::Label::new("Select vertices, edges or faces to see their values.").wrap());
        return;
    }
    if count > MOST_SHOWN {
        ui.add(egui::Label::new("Too many are selected to show their values.").wrap());
    } else {
        known.take_if(|(revision, _)| *revision != document.revision());
        let (_, values) = *known.get_or_insert_with(|| (document.revision(), values(document)));
        if values.vertices > 0 {
            median(ui, document, values, requests);
        }
        if values.edges > 0 {
            crease(ui, document, values, requests);
        }
    }
    let hover = "Moves the selected vertices back to where they were created or loaded";
    if ui.add(egui::Button::new("Reset to original positions").wrap()).on_hover_text(hover).clicked() {
        requests.push(Request::Run(ResetVertices {}.into()));
    }
}

fn values(document: &Document) -> Values {
    let selection = document.selection();
    let (mut values, kind) = (Values::default(), selection.kind());
    for (id, selected) in selection.meshes().filter(|(_, selected)| !selected.is_empty()) {
        let Some(mesh) = document.mesh(id) else { continue };
        for vertex in selected.vertices(mesh, kind) {
            values.middle += mesh.position(vertex).as_dvec3();
            values.vertices += 1;
        }
        for edge in selected.edges(mesh, kind) {
            values.crease += f64::from(mesh.crease(edge));
            values.edges += 1;
        }
    }
    values.middle /= f64::from(values.vertices.max(1));
    values.crease /= f64::from(values.edges.max(1));
    values
}

/// The middle of the selected vertices, or the one selected vertex.
fn median(ui: &mut Ui, document: &Document, values: Values, requests: &mut Vec<Request>) {
    let mut shown = values.middle.to_array();
    let label = if values.vertices == 1 { "Vertex" } else { "Median" };
    let hover = "In the space of the mesh: the vertex, or the mean of the selected ones.";
    if let Some((_, response)) = vector(ui, label, hover, &mut shown, &plain(Unit::Metres)) {
        let offset = DVec3::from(shown) - values.middle + moved_before(ui, document, &response);
        let command = Translate { offset: offset.into(), ..Translate::default() };
        submit(ui, document, &response, command.into(), requests);
    }
}

/// How far the same drag has moved them already: its next command replaces that move.
fn moved_before(ui: &Ui, document: &Document, response: &Response) -> DVec3 {
    match document.history().done().last().map(|entry| entry.command()) {
        Some(Command::Translate(last)) if is_same_drag(ui, response) => DVec3::from(last.offset),
        _ => DVec3::ZERO,
    }
}

/// The crease that the selected edges have, or the mean of several.
fn crease(ui: &mut Ui, document: &Document, values: Values, requests: &mut Vec<Request>) {
    let mut shown = values.crease;
    let label = if values.edges == 1 { "Crease" } else { "Mean crease" };
    let hover = "How sharp the selected edges stay in subdivision: 0 is smooth, 1 is sharp.";
    let form = positive(1.0, Unit::None);
    let response = row(ui, label, hover, |ui, width| number(ui, width, &mut shown, &form, ""));
    if response.changed() {
        submit(ui, document, &response, Crease { crease: shown as f32 }.into(), requests);
    }
}
