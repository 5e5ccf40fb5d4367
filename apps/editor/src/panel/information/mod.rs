//! The tab *Information*: the selection, counts, dimensions, measurements, and keys.

mod counts;
mod measures;
#[cfg(test)]
mod tests;

use trigon_document::modelling::PRINT_MATERIALS;
use trigon_document::{Document, ElementKind};
use trigon_window::egui::{self, CollapsingHeader, Grid, Ui};

use super::ShownDocument;
use super::row::{choice, is_narrow, written};
use counts::{Counts, counted};
use measures::{Finding, measured, weight};

/// The state of the tab: what was counted and measured last, and of what closed bodies are weighed.
#[derive(Debug, Default)]
pub(crate) struct InformationState {
    counts: Option<(u64, Counts)>,
    /// The revision in the last pass.
    shown_revision: u64,
    measures: Option<(u64, Vec<Finding>)>,
    /// An index in [`PRINT_MATERIALS`].
    material: usize,
}

/// Shows it. `controls` are keys and what they do, as the keymap has them now.
pub(crate) fn information(
    ui: &mut Ui,
    shown: ShownDocument<'_>,
    state: &mut InformationState,
    controls: &[(String, String)],
) {
    let document = shown.document;
    let revision = document.revision();
    if state.counts.as_ref().is_none_or(|(known, _)| *known != revision) {
        // While something is dragged, each pass has another revision: counted is when it rests.
        if std::mem::replace(&mut state.shown_revision, revision) == revision || state.counts.is_none() {
            state.counts = Some((revision, counted(document)));
        } else {
            ui.ctx().request_repaint();
        }
    }
    state.measures.take_if(|(known, _)| *known != revision);
    if let Some((_, counts)) = &state.counts {
        ui.add(egui::Label::new(selected(document, counts)).wrap());
        section(ui, "Counts", |ui| show_counts(ui, counts));
        section(ui, "Dimensions", |ui| show_dimensions(ui, shown, counts));
    }
    section(ui, "Measures", |ui| show_measures(ui, document, state));
    section(ui, "Controls", |ui| show_controls(ui, controls));
}

fn section(ui: &mut Ui, title: &str, contents: impl FnOnce(&mut Ui)) {
    CollapsingHeader::new(title).default_open(true).show_unindented(ui, contents);
}

/// "Cube and 2 more objects", "3 faces".
fn selected(document: &Document, counts: &Counts) -> String {
    let selection = document.selection();
    if selection.is_editing() {
        let count: usize = selection.meshes().map(|(_, selection)| selection.len()).sum();
        let [one, many] = match selection.kind() {
            ElementKind::Vertex => ["vertex", "vertices"],
            ElementKind::Edge => ["edge", "edges"],
            ElementKind::Face => ["face", "faces"],
        };
        return format!("Selected: {count} {}", if count == 1 { one } else { many });
    }
    let active = selection.active.filter(|id| selection.objects.contains(id));
    let name = active.and_then(|id| document.nodes().node(id)).map(|node| node.name.as_str());
    match (counts.selected_objects, name) {
        (0, _) => "Nothing is selected.".to_owned(),
        (1, Some(name)) => format!("Selected: {name}"),
        (1, None) => "Selected: one object".to_owned(),
        (count, Some(name)) => format!("Selected: {name} and {} more", count - 1),
        (count, None) => format!("Selected: {count} objects"),
    }
}

fn show_counts(ui: &mut Ui, counts: &Counts) {
    let rows = [
        ("Objects", counts.objects, counts.selected_objects),
        ("Vertices", counts.scene.vertices, counts.selected.vertices),
        ("Edges", counts.scene.edges, counts.selected.edges),
        ("Faces", counts.scene.faces, counts.selected.faces),
        ("Triangles", counts.scene.triangles, counts.selected.triangles),
    ];
    let rows = rows.map(|(name, all, selected)| [name.to_owned(), all.to_string(), selected.to_string()]);
    table(ui, ["Scene", "Selected"], &rows);
}

/// Rows of a name and two values under their titles; in a narrow panel the values stand below the name.
fn table(ui: &mut Ui, titles: [&str; 2], rows: &[[String; 3]]) {
    if is_narrow(ui) {
        for [name, one, two] in rows {
            let [first, second] = titles.map(str::to_lowercase);
            ui.add(egui::Label::new(format!("{name}: {first} {one}, {second} {two}")).wrap());
        }
        return;
    }
    Grid::new(titles).num_columns(3).spacing([10.0, 2.0]).show(ui, |ui| {
        for text in ["", titles[0], titles[1]] {
            ui.weak(text);
        }
        ui.end_row();
        for row in rows {
            row.iter().for_each(|text| drop(ui.label(text)));
            ui.end_row();
        }
    });
}

fn show_dimensions(ui: &mut Ui, shown: ShownDocument<'_>, counts: &Counts) {
    let ShownDocument { document, up } = shown;
    let whose = if document.selection().is_editing() {
        "Of the selected, in the space of the mesh:"
    } else {
        "Of the selected, in the world:"
    };
    let nothing = counts.bounds.is_empty();
    ui.add(egui::Label::new(if nothing { "Nothing with a size is selected." } else { whose }).wrap());
    if nothing {
        return;
    }
    let [a, b] = [counts.bounds.min, counts.bounds.max].map(|corner| up.shown(corner));
    let (from, size) = (a.min(b), up.exchanged(counts.bounds.size()));
    let rows = [0, 1, 2].map(|axis| {
        let name = ["X", "Y", "Z"][axis];
        [name.to_owned(), meters(size[axis]), meters(from[axis])]
    });
    table(ui, ["Size", "From"], &rows);
}

/// Short enough for three columns.
fn meters(value: f64) -> String {
    format!("{} m", written((value * 1e4).round() / 1e4))
}

fn show_measures(ui: &mut Ui, document: &Document, state: &mut InformationState) {
    let hover = "Lengths, angles, areas and volumes of the selection, and possible faults";
    if ui.add(egui::Button::new("Measure selection").wrap()).on_hover_text(hover).clicked() {
        state.measures = Some((document.revision(), measured(document)));
    }
    let Some((_, findings)) = &state.measures else { return };
    if findings.iter().any(|finding| finding.filled.is_some()) {
        material_list(ui, &mut state.material);
    }
    for finding in findings {
        let text = format!("{}: {}", finding.name, finding.value);
        let text = egui::RichText::new(text);
        let text = if finding.is_problem { text.color(ui.visuals().warn_fg_color) } else { text };
        ui.add(egui::Label::new(text).wrap());
        if let Some(volume) = finding.filled {
            show_weight(ui, volume, state.material);
        }
    }
}

/// What closed bodies are weighed of.
fn material_list(ui: &mut Ui, chosen: &mut usize) {
    let densities = PRINT_MATERIALS.map(|material| format!("{} g/cm³", written(material.density / 1e3)));
    let named = PRINT_MATERIALS.iter().zip(&densities).enumerate();
    let names: Vec<_> =
        named.map(|(index, (material, density))| (index, material.name, &density[..])).collect();
    choice(ui, "Material", "What closed bodies are weighed of.", chosen, &names);
}

/// The weight of a body of some cubic metres.
fn show_weight(ui: &mut Ui, volume: f64, material: usize) {
    let Some(material) = PRINT_MATERIALS.get(material) else { return };
    let text = format!("Weight: {}", weight(volume * material.density));
    let hover = "Filled, without supports. A unit of the model is a metre: scale a model that was drawn in millimetres by 0.001.";
    ui.add(egui::Label::new(text).wrap()).on_hover_text(hover);
}

fn show_controls(ui: &mut Ui, controls: &[(String, String)]) {
    for (keys, what) in controls {
        ui.horizontal_wrapped(|ui| {
            ui.strong(keys);
            ui.label(what);
        });
    }
}
