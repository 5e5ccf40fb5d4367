//! How files of other programs are read and written: which axis is up in them, their unit, and what of the document
//! they get.

use std::path::Path;

use trigon_document::Document;
use trigon_document::scene::{NodeId, Scene};
use trigon_io::{Format, UpAxis, writers};
use trigon_window::egui;
use trigon_window::egui::{ComboBox, Ui};
use trigon_window::scene::math::{Bounds3, DMat3, DVec3};

use crate::arguments::Arguments;
use crate::export::{ExportChoices, format_by_ending, states_unit};
use crate::panel::written;

/// The choices in the file window. They stay until the editor is closed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Exchange {
    /// How large what can be exported is.
    pub(crate) extents: Extents,
    /// The same without modifiers.
    pub(crate) edited_extents: Extents,
    /// In files that are opened and imported; none for that of their format.
    pub(crate) import_up: Option<UpAxis>,
    pub(crate) export: ExportChoices,
}

/// Widths, heights and depths, in metres; none where there is nothing.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Extents {
    pub(crate) all: Option<DVec3>,
    pub(crate) selected: Option<DVec3>,
}

impl Extents {
    /// Of the visible objects of a scene: all of them, and those that are selected with what hangs on them.
    fn of(scene: &Scene, selected: &[NodeId]) -> Self {
        let size = |bounds: Bounds3| (!bounds.is_empty()).then(|| bounds.size());
        let of_selected = selected.iter().flat_map(|&id| scene.visible_points_below(id));
        Self {
            all: size(Bounds3::from_points(scene.visible_points())),
            selected: size(Bounds3::from_points(of_selected)),
        }
    }
}

/// In a metre.
const MILLIMETRES: f64 = 1000.0;

/// Units of files, by how many there are in a metre.
const UNITS: [(&str, f64); 4] =
    [("metres", 1.0), ("centimetres", 100.0), ("millimetres", MILLIMETRES), ("inches", 1.0 / 0.0254)];

impl Default for Exchange {
    fn default() -> Self {
        Self::new(&Arguments::default())
    }
}

impl Exchange {
    /// The choices of the command line.
    pub(crate) fn new(arguments: &Arguments) -> Self {
        let export = ExportChoices::new(arguments);
        let [extents, edited_extents] = [Extents::default(); 2];
        Self { extents, edited_extents, import_up: arguments.import_up, export }
    }

    /// Measures what can be exported.
    pub(crate) fn measure(&mut self, document: &mut Document) {
        let selected: Vec<NodeId> = document.selection().objects.iter().copied().collect();
        self.extents = Extents::of(&document.scene_to_render(), &selected);
        self.edited_extents = Extents::of(document.scene(), &selected);
    }

    /// For files that are read.
    pub(super) fn show_import(&mut self, ui: &mut Ui) {
        up_list(ui, &mut self.import_up);
    }

    /// For a file that is written: its format, which is the ending of its name, and what goes into it.
    pub(super) fn show_export(&mut self, ui: &mut Ui, name: &mut String) {
        let format = format_by_ending(Path::new(name)).unwrap_or(Format::Glb);
        if let Some(chosen) = format_list(ui, format) {
            *name = Path::new(name).with_extension(chosen).to_string_lossy().into_owned();
        }
        ui.add(egui::Label::new(held_by(format)).wrap());
        ui.horizontal_wrapped(|ui| {
            ui.checkbox(&mut self.export.selection_only, "Selection only");
            ui.checkbox(&mut self.export.modifiers, "Apply modifiers");
            if has_polygons(format) {
                ui.checkbox(&mut self.export.triangulate, "Triangulate");
            }
            if matches!(format, Format::Ply | Format::Stl) {
                ui.checkbox(&mut self.export.text, "As text");
            }
        });
        up_list(ui, &mut self.export.up);
        if !states_unit(format) {
            unit_list(ui, &mut self.export.scale);
        }
        self.show_size(ui, format);
    }

    /// How many units of the file are a metre.
    fn units_in(&self, format: Format) -> f64 {
        if states_unit(format) { MILLIMETRES } else { self.export.scale }
    }

    /// How large things will be in the file, in its numbers.
    fn show_size(&self, ui: &mut Ui, format: Format) {
        let Extents { all, selected } =
            if self.export.modifiers { self.extents } else { self.edited_extents };
        let extent = if self.export.selection_only { selected } else { all };
        let Some(extent) = extent else { return };
        let up = self.export.up.unwrap_or_else(|| format.up());
        let scale = self.units_in(format);
        let [x, y, z] = size_along(extent * scale, up).map(written);
        let unit = unit_name(scale);
        ui.label(format!("Size in the file: {x} × {y} × {z} ({unit})"));
        if format == Format::Stl {
            ui.weak("STL has no unit. Programs for printing take its numbers as millimetres.");
        }
    }
}

/// A size in a document, in which +Y is up, along the axes of a file.
fn size_along(size: DVec3, up: UpAxis) -> [f64; 3] {
    let frame = up.frame();
    let along = DMat3::from_cols(frame.x_axis.abs(), frame.y_axis.abs(), frame.z_axis.abs()) * size;
    along.to_array()
}

fn unit_name(scale: f64) -> String {
    let known = UNITS.iter().find(|(_, units)| *units == scale);
    known.map_or_else(|| format!("{scale} per metre"), |(name, _)| (*name).to_owned())
}

/// The formats that can be written. Returns the ending of another one that was chosen.
fn format_list(ui: &mut Ui, current: Format) -> Option<&'static str> {
    let mut chosen = None;
    let text = |name: &str, ending: &str| format!("{name} (.{ending})");
    let named = writers().find(|writer| writer.format == current);
    let selected = named.map_or_else(String::new, |writer| text(writer.name, writer.extensions[0]));
    ComboBox::from_label("Format").selected_text(selected).width(220.0).show_ui(ui, |ui| {
        for writer in writers() {
            let is_current = writer.format == current;
            if ui.selectable_label(is_current, text(writer.name, writer.extensions[0])).clicked() {
                chosen = Some(writer.extensions[0]);
            }
        }
    });
    chosen
}

/// What a format holds, and what it does not.
fn held_by(format: Format) -> &'static str {
    match format {
        Format::Obj => {
            "Keeps polygons, texture coordinates, normals, and materials with their images. Loses the tree of objects, lights, cameras and marks of edges."
        }
        Format::Ply => {
            "Keeps polygons, normals, texture coordinates and colors of vertices, as one mesh. Loses materials, objects, lights and cameras."
        }
        Format::Stl => "Keeps triangles alone, as one mesh, for printing: +Z is up. Loses everything else.",
        Format::ThreeMf => {
            "Keeps triangles, objects with their copies, colors and names of materials, for printing: in true size, in millimeters, +Z is up. Loses polygons, images, normals, lights and cameras."
        }
        Format::Off => "Keeps polygons alone, as one mesh. Loses everything else.",
        _ => "Keeps objects, materials, images, lights and cameras. Loses polygons: they become triangles.",
    }
}

fn has_polygons(format: Format) -> bool {
    matches!(format, Format::Obj | Format::Ply | Format::Off)
}

fn up_list(ui: &mut Ui, up: &mut Option<UpAxis>) {
    let name =
        |up: Option<UpAxis>| up.map_or_else(|| "as usual in the format".to_owned(), |up| up.to_string());
    let axes = ["+X", "-X", "+Y", "-Y", "+Z", "-Z"].into_iter().map(|axis| axis.parse().ok());
    ComboBox::from_label("up axis of the file").selected_text(name(*up)).show_ui(ui, |ui| {
        for choice in std::iter::once(None).chain(axes) {
            ui.selectable_value(up, choice, name(choice));
        }
    });
}

fn unit_list(ui: &mut Ui, scale: &mut f64) {
    ComboBox::from_label("unit of the file").selected_text(unit_name(*scale)).show_ui(ui, |ui| {
        for (name, units) in UNITS {
            ui.selectable_value(scale, units, name);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A unit that was chosen for an STL enlarged a 3MF, which is in millimetres by itself.
    #[test]
    fn a_unit_that_was_chosen_for_another_format_leaves_a_3mf_in_true_size() {
        let mut document = Document::default();
        let cube = r#"{ "op": "add_object", "object": { "shape": "cube", "edge": 2 } }"#;
        document.run(serde_json::from_str(cube).expect("a command")).expect("it can be done");
        let mut exchange = Exchange::default();
        let bytes = |export: ExportChoices, format: Format| {
            let options = export.for_format(format).options(&document);
            document.export("model", format, &options).expect("it can be written").files.remove(0).bytes
        };
        let [stl, three_mf] = [Format::Stl, Format::ThreeMf].map(|format| bytes(exchange.export, format));
        exchange.export.scale = UNITS[1].1;
        assert_eq!(exchange.units_in(Format::ThreeMf), 1000.0, "as its size is shown");
        assert_eq!(bytes(exchange.export, Format::ThreeMf), three_mf);
        assert_eq!(exchange.units_in(Format::Stl), 100.0);
        assert_ne!(bytes(exchange.export, Format::Stl), stl);
    }

    /// The size had the axes of the document, and modifiers were left out.
    #[test]
    fn sizes_are_along_the_axes_of_the_file_and_after_modifiers() {
        assert_eq!(size_along(DVec3::new(1.0, 2.0, 3.0), UpAxis::Z), [1.0, 3.0, 2.0]);
        assert_eq!(size_along(DVec3::new(1.0, 2.0, 3.0), UpAxis::Y), [1.0, 2.0, 3.0]);
        let commands = [
            r#"{ "op": "add_object", "object": { "shape": "cube", "edge": 2 } }"#,
            r#"{ "op": "add_modifier", "modifier": { "kind": "array", "count": 3, "relative_offset": [1, 0, 0] } }"#,
        ];
        let mut document = Document::default();
        for command in commands {
            document.run(serde_json::from_str(command).expect("a command")).expect("it can be done");
        }
        let mut exchange = Exchange::default();
        exchange.measure(&mut document);
        let Extents { all, selected } = exchange.extents;
        assert_eq!(all, Some(DVec3::new(6.0, 2.0, 2.0)), "three cubes");
        assert_eq!(exchange.edited_extents.all, Some(DVec3::splat(2.0)), "and one without the modifier");
        assert_eq!(selected, all, "the new object is selected");
    }
}
