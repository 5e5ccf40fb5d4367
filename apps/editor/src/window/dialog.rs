//! The file chooser: the system's dialog, or a typed path if there is none, and recent files. Here is also
//! how files of other programs are read and written: which axis is up in them, and their unit.

use std::path::PathBuf;
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::thread;

use trigon_document::{MaterialName, TextureSlot};
use trigon_io::{ExportOptions, UpAxis};
use trigon_window::egui::Key;
use trigon_window::{RecentFiles, egui};

use crate::arguments::Arguments;
use crate::request::{FileAction, FileRequest};

/// What a file is chosen for.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) enum Purpose {
    #[default]
    Open,
    SaveAs,
    Import,
    Export,
    /// An image for a material.
    Texture(MaterialName, TextureSlot),
}

/// The window, shown or not.
#[derive(Debug, Default)]
pub(crate) struct FileWindow {
    pub(crate) exchange: Exchange,
    purpose: Option<Purpose>,
    path: String,
    /// The system's dialog, while it is open.
    dialog: Option<(Purpose, Receiver<Option<PathBuf>>)>,
    note: &'static str,
}

impl Purpose {
    /// That of an entry of the menu File.
    pub(crate) fn of(action: FileAction) -> Option<Self> {
        match action {
            FileAction::Open => Some(Self::Open),
            FileAction::SaveAs => Some(Self::SaveAs),
            FileAction::Import => Some(Self::Import),
            FileAction::Export => Some(Self::Export),
            FileAction::New | FileAction::Save | FileAction::Quit => None,
        }
    }

    fn request(self, path: PathBuf) -> FileRequest {
        match self {
            Self::Open => FileRequest::Open(path),
            Self::SaveAs => FileRequest::SaveAs(path),
            Self::Import => FileRequest::Import(path),
            Self::Export => FileRequest::Export(path),
            Self::Texture(material, slot) => FileRequest::Texture { material, slot, path },
        }
    }

    fn title(&self) -> &'static str {
        match self {
            Self::Open => "Open",
            Self::SaveAs => "Save As",
            Self::Import => "Import",
            Self::Export => "Export",
            Self::Texture(..) => "Open Image",
        }
    }

    /// Asks by the system's dialog: on Linux that of the desktop portal.
    fn ask(self) -> Option<PathBuf> {
        let dialog = rfd::FileDialog::new().set_title(self.title());
        match self {
            Self::SaveAs => dialog.add_filter("glTF", &["glb"]).save_file(),
            Self::Export => trigon_io::writers()
                .fold(dialog, |dialog, writer| dialog.add_filter(writer.extensions[0], writer.extensions))
                .save_file(),
            Self::Open | Self::Import | Self::Texture(..) => dialog.pick_file(),
        }
    }
}

impl FileWindow {
    /// Shows itself.
    pub(crate) fn ask(&mut self, purpose: Purpose, suggestion: String) {
        (self.purpose, self.path, self.note) = (Some(purpose), suggestion, "");
    }

    /// Whether it is shown.
    pub(crate) fn is_open(&self) -> bool {
        self.purpose.is_some()
    }

    /// Hides it, and returns whether it was shown.
    pub(crate) fn close(&mut self) -> bool {
        self.purpose.take().is_some()
    }

    /// Opens a dialog on its own thread; `wake` is called when it is closed.
    fn browse(
        &mut self,
        purpose: Purpose,
        dialog: impl FnOnce() -> Option<PathBuf> + Send + 'static,
        wake: impl FnOnce() + Send + 'static,
    ) {
        let (sender, receiver) = channel();
        let requested = thread::Builder::new().name("trigon-dialog".into()).spawn(move || {
            // Nobody waits for it any more when this fails.
            drop(sender.send(dialog()));
            wake();
        });
        self.dialog = requested.ok().map(|_| (purpose, receiver));
    }

    /// What a dialog ended with, once.
    pub(crate) fn picked(&mut self) -> Option<FileRequest> {
        let ended = match self.dialog.as_ref()?.1.try_recv() {
            Err(TryRecvError::Empty) => return None,
            Err(TryRecvError::Disconnected) => None,
            Ok(path) => path,
        };
        let (purpose, _) = self.dialog.take()?;
        self.note = "no file was chosen; if the system shows no dialog, type a path";
        let path = ended?;
        self.purpose = None;
        Some(purpose.request(path))
    }

    /// Shows it if it is open. Returns what was chosen; `wake` is called when a dialog is closed.
    pub(crate) fn show(
        &mut self,
        context: &egui::Context,
        recent: &RecentFiles,
        wake: impl FnOnce() + Send + 'static,
    ) -> Option<FileRequest> {
        let purpose = self.purpose.clone()?;
        let (mut chosen, mut browses, mut is_open) = (None, false, true);
        let window = egui::Window::new(purpose.title()).open(&mut is_open).collapsible(false);
        window.anchor(egui::Align2::CENTER_CENTER, [0.0; 2]).default_width(460.0).show(context, |ui| {
            (chosen, browses) = self.fields(ui, &purpose);
            self.exchange.show(ui, &purpose);
            if !self.note.is_empty() {
                ui.label(self.note);
            }
            if matches!(purpose, Purpose::Open | Purpose::Import) && !recent.files().is_empty() {
                ui.separator();
                ui.label("recent");
                for file in recent.files() {
                    if ui.button(file.display().to_string()).clicked() {
                        chosen = Some(file.clone());
                    }
                }
            }
        });
        if browses {
            let requested = purpose.clone();
            self.browse(purpose.clone(), move || requested.ask(), wake);
        }
        if !is_open || chosen.is_some() {
            self.purpose = None;
        }
        chosen.map(|path| purpose.request(path))
    }

    /// The typed path, and the button that opens the dialog. Returns the entered path, and whether to browse.
    fn fields(&mut self, ui: &mut egui::Ui, purpose: &Purpose) -> (Option<PathBuf>, bool) {
        ui.horizontal(|ui| {
            let field = egui::TextEdit::singleline(&mut self.path).hint_text("path of a file");
            let typed = ui.add(field.desired_width(300.0));
            ui.ctx().accesskit_node_builder(typed.id, |node| node.set_label("path of a file"));
            let entered = typed.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            if !entered && ui.memory(|memory| memory.focused().is_none()) {
                typed.request_focus();
            }
            let has_path = !self.path.trim().is_empty();
            let pressed = ui.add_enabled(has_path, egui::Button::new(purpose.title())).clicked();
            let path = ((pressed || entered) && has_path).then(|| PathBuf::from(self.path.trim()));
            let browses = ui.add_enabled(self.dialog.is_none(), egui::Button::new("Browse…")).clicked();
            (path, browses)
        })
        .inner
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;

    /// A window whose dialog has ended so.
    fn ended(decision: Option<PathBuf>) -> (FileWindow, Option<FileRequest>) {
        let ((decide, decided), (wake, woken)) = (channel(), channel());
        let mut window = FileWindow::default();
        window.ask(Purpose::Import, String::new());
        let dialog = move || decided.recv().expect("the test decides");
        window.browse(Purpose::Import, dialog, move || wake.send(()).expect("the test waits"));
        assert_eq!(window.picked(), None, "its user has not decided");
        decide.send(decision).expect("the dialog waits");
        woken.recv().expect("it closes");
        let picked = window.picked();
        (window, picked)
    }

    #[test]
    fn dialogs_answer_with_a_file_or_leave_the_window_open() {
        let (mut window, picked) = ended(Some("a.obj".into()));
        assert_eq!(picked, Some(FileRequest::Import("a.obj".into())), "for what it was asked for");
        assert!(!window.close() && window.picked().is_none(), "once, and nothing more is asked");
        let (mut window, picked) = ended(None);
        assert_eq!(picked, None, "none");
        assert!(!window.note.is_empty() && window.close(), "a path can be typed instead");
    }
}
