//! The selected elements of meshes: positions and marks.

use trigon_document::mesh::math::DVec3;
use trigon_document::modelling::EditMesh;
use trigon_document::{Command, Crease, Document, MeshSelection, ResetVertices, Selection, Translate};
use trigon_window::egui::{self, Response, Ui};

use super::super::row::{AXES, number, plain, positive, row, vector};
use super::super::unit::Unit;
use crate::panel::ShownDocument;
use crate::panel::row::{is_same_drag, submit};
use crate::request::Request;

/// Above so many selected elements their values are not computed: it would take longer than a frame.
const MOST_SHOWN: usize = 100_000;

/// Means of what is selected, kept while it is unchanged.
#[derive(Debug, Default)]
pub(super) struct Values {
    /// Of which revision of the document.
    vertices: Option<(u64, Mean<DVec3>)>,
    /// Of which elements and marks, and which of them were selected: while vertices are dragged, both stay the
    /// same. To find the edges between thousands of vertices takes longer than all else in this tab.
    edges: Option<(u64, Selection, Mean<f64>)>,
}

/// The mean of a value over a number of elements.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Mean<T> {
    value: T,
    count: u32,
}

/// Shows it, and requests changes.
pub(super) fn elements(
    ui: &mut Ui,
    shown: ShownDocument<'_>,
    known: &mut Values,
    requests: &mut Vec<Request>,
) {
    let document = shown.document;
    let count: usize = document.selection().meshes().map(|(_, selection)| selection.len()).sum();
    if count == 0 {
        ui.add(egui::Label::new("Select vertices, edges or faces to see their values.").wrap());
        return;
    }
    if count > MOST_SHOWN {
        ui.add(egui::Label::new("Too many are selected to show their values.").wrap());
    } else {
        let (middle, mean_crease) = (known.middle(document), known.crease(document));
        if middle.count > 0 {
            median(ui, shown, middle, requests);
        }
        if mean_crease.count > 0 {
            crease(ui, document, mean_crease, requests);
        }
    }
    let hover = "Moves the selected vertices back to where they were created or loaded";
    if ui.add(egui::Button::new("Reset to original positions").wrap()).on_hover_text(hover).clicked() {
        requests.push(Request::Run(ResetVertices {}.into()));
    }
}

impl Values {
    /// The middle of the selected vertices, in metres in the space of their mesh.
    fn middle(&mut self, document: &Document) -> Mean<DVec3> {
        let revision = document.revision();
        self.vertices.take_if(|(known, _)| *known != revision);
        self.vertices.get_or_insert_with(|| (revision, middle(document))).1
    }

    /// The crease of the selected edges.
    fn crease(&mut self, document: &Document) -> Mean<f64> {
        let (revision, selection) = (document.marks_revision(), document.selection());
        self.edges.take_if(|(known, selected, _)| (*known, &*selected) != (revision, selection));
        let mean = || (revision, selection.clone(), mean_crease(document));
        self.edges.get_or_insert_with(mean).2
    }
}

/// The meshes in which something is selected.
fn selected(document: &Document) -> impl Iterator<Item = (&EditMesh, &MeshSelection)> {
    let meshes = document.selection().meshes().filter(|(_, selected)| !selected.is_empty());
    meshes.filter_map(|(id, selected)| Some((document.mesh(id)?, selected)))
}

fn middle(document: &Document) -> Mean<DVec3> {
    let mut mean = Mean::default();
    for (mesh, selected) in selected(document) {
        for vertex in selected.vertices(mesh, document.selection().kind()) {
            mean.value += mesh.position(vertex).as_dvec3();
            mean.count += 1;
        }
    }
    mean.value /= f64::from(mean.count.max(1));
    mean
}

fn mean_crease(document: &Document) -> Mean<f64> {
    let mut mean = Mean::default();
    for (mesh, selected) in selected(document) {
        for edge in selected.edges(mesh, document.selection().kind()) {
            mean.value += f64::from(mesh.crease(edge));
            mean.count += 1;
        }
    }
    mean.value /= f64::from(mean.count.max(1));
    mean
}

/// The middle of the selected vertices, or the one selected vertex.
fn median(ui: &mut Ui, shown: ShownDocument<'_>, middle: Mean<DVec3>, requests: &mut Vec<Request>) {
    let ShownDocument { document, up } = shown;
    let mut typed = up.shown(middle.value).to_array();
    let label = if middle.count == 1 { "Vertex" } else { "Median" };
    let hover = "In the space of the mesh: the vertex, or the mean of the selected ones.";
    if let Some((_, response)) = vector(ui, label, hover, &mut typed, &plain(Unit::Metres), AXES) {
        let offset = up.stored(typed.into()) - middle.value + moved_before(ui, document, &response);
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
fn crease(ui: &mut Ui, document: &Document, mean: Mean<f64>, requests: &mut Vec<Request>) {
    let mut shown = mean.value;
    let label = if mean.count == 1 { "Crease" } else { "Mean crease" };
    let hover = "How sharp the selected edges stay in subdivision: 0 is smooth, 1 is sharp.";
    let form = positive(1.0, Unit::None);
    let response = row(ui, label, hover, |ui, width| number(ui, width, &mut shown, &form, ""));
    if response.changed() {
        submit(ui, document, &response, Crease { crease: shown as f32 }.into(), requests);
    }
}
