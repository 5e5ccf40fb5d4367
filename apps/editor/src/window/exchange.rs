//! How files of other programs are read and written: which axis is up in them, and their unit.

use trigon_io::{ExportOptions, UpAxis};
use trigon_window::egui;

use super::dialog::Purpose;
use crate::arguments::Arguments;

/// The choices in the file window. They stay until the editor is closed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Exchange {
    /// In files that are opened and imported; none for that of their format.
    pub(crate) import_up: Option<UpAxis>,
    /// In files that are exported, likewise.
    pub(crate) export_up: Option<UpAxis>,
    /// Units of exported files per metre.
    pub(crate) scale: f64,
}

/// Units of files, by how many there are in a metre.
const UNITS: [(&str, f64); 4] =
    [("metres", 1.0), ("centimetres", 100.0), ("millimetres", 1000.0), ("inches", 1.0 / 0.0254)];

impl Default for Exchange {
    fn default() -> Self {
        Self { import_up: None, export_up: None, scale: 1.0 }
    }
}

impl Exchange {
    /// The choices of the command line.
    pub(crate) fn new(arguments: &Arguments) -> Self {
        Self {
            import_up: arguments.import_up,
            export_up: arguments.up,
            scale: arguments.scale.unwrap_or(1.0),
        }
    }

    pub(crate) fn export_options(&self) -> ExportOptions<'static> {
        ExportOptions { up: self.export_up, scale: self.scale, ..ExportOptions::default() }
    }

    /// The lists for what a file is chosen for.
    pub(crate) fn show(&mut self, ui: &mut egui::Ui, purpose: &Purpose) {
        match purpose {
            Purpose::Open | Purpose::Import => up_list(ui, &mut self.import_up),
            Purpose::Export => {
                up_list(ui, &mut self.export_up);
                unit_list(ui, &mut self.scale);
            }
            Purpose::SaveAs | Purpose::Texture(..) => {}
        }
    }
}

fn up_list(ui: &mut egui::Ui, up: &mut Option<UpAxis>) {
    let name =
        |up: Option<UpAxis>| up.map_or_else(|| "as usual in the format".to_owned(), |up| up.to_string());
    let axes = ["+X", "-X", "+Y", "-Y", "+Z", "-Z"].into_iter().map(|axis| axis.parse().ok());
    egui::ComboBox::from_label("up axis of the file").selected_text(name(*up)).show_ui(ui, |ui| {
        for choice in std::iter::once(None).chain(axes) {
            ui.selectable_value(up, choice, name(choice));
        }
    });
}

fn unit_list(ui: &mut egui::Ui, scale: &mut f64) {
    let known = UNITS.iter().find(|(_, units)| units == scale);
    let name = known.map_or_else(|| format!("{scale} per metre"), |(name, _)| (*name).to_owned());
    egui::ComboBox::from_label("unit of the file").selected_text(name).show_ui(ui, |ui| {
        for (name, units) in UNITS {
            ui.selectable_value(scale, units, name);
        }
    });
}
