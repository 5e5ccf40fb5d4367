//! The command line that draws the window's image.

use trigon_window::egui;

#[derive(Default)]
pub(super) struct CommandPanel {
    command: String,
    /// Why it does not draw the same bytes.
    differs: Option<&'static str>,
    /// Whether it is yet to be copied.
    is_new: bool,
}

impl CommandPanel {
    pub(super) fn new(command: String, differs: Option<&'static str>) -> Self {
        Self { command, differs, is_new: true }
    }

    pub(super) fn show(&mut self, ui: &mut egui::Ui) {
        let is_requested = ui.button("Copy again").clicked();
        if std::mem::take(&mut self.is_new) || is_requested {
            ui.ctx().copy_text(self.command.clone());
        }
        let said = match self.differs {
            None => "On the clipboard. It writes this image, with the same bytes.".to_owned(),
            Some(why) => format!("On the clipboard. It writes nearly this image: {why}."),
        };
        ui.add(egui::Label::new(said).wrap());
        ui.separator();
        egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            ui.add(egui::Label::new(egui::RichText::new(&self.command).monospace()).wrap());
        });
    }
}
