//! The command line that draws the window's picture.

use trigon_window::egui;

#[derive(Default)]
pub(super) struct CommandPanel {
    command: String,
    /// Whether it draws the same bytes.
    is_exact: bool,
    /// Whether it is yet to be copied.
    is_new: bool,
}

impl CommandPanel {
    pub(super) fn new(command: String, is_exact: bool) -> Self {
        Self { command, is_exact, is_new: true }
    }

    pub(super) fn show(&mut self, ui: &mut egui::Ui) {
        let is_asked = ui.button("Copy again").clicked();
        if std::mem::take(&mut self.is_new) || is_asked {
            ui.ctx().copy_text(self.command.clone());
        }
        let said = if self.is_exact {
            "On the clipboard. It writes this picture, with the same bytes."
        } else {
            "On the clipboard. It writes nearly this picture: no flag asks for as many samples of both kinds."
        };
        ui.add(egui::Label::new(said).wrap());
        ui.separator();
        egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            ui.add(egui::Label::new(egui::RichText::new(&self.command).monospace()).wrap());
        });
    }
}
