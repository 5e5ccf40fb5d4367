//! The file window: folders, names and recent files, and the way to the system's own dialog. Here is also
//! how files of other programs are read and written.

mod exchange;
mod folder;

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::thread;

use trigon_document::{MaterialName, TextureSlot};
use trigon_io::readers;
use trigon_window::egui::{Align, Button, Context, Id, Key, Layout, Modal, Popup, ScrollArea, TextEdit, Ui};
use trigon_window::{RecentFiles, egui};

pub(crate) use exchange::Exchange;
use folder::Folder;

use super::images;
use super::images::IMAGE_FORMATS;
use crate::request::{FileAction, FileRequest, ImageKind};

/// In points.
const WIDTH: f32 = 560.0;
const LIST_HEIGHT: f32 = 220.0;
const RECENT_HEIGHT: f32 = 90.0;

/// The endings of images that can be textures.
pub(crate) const IMAGES: [&str; 4] = ["png", "jpg", "jpeg", "webp"];

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
    /// An image to model after.
    Reference,
    /// An image that was made of the scene.
    Image(ImageKind),
}

impl Purpose {
    /// That of an entry of the menu File.
    pub(crate) fn of(action: FileAction) -> Option<Self> {
        match action {
            FileAction::Open => Some(Self::Open),
            FileAction::SaveAs => Some(Self::SaveAs),
            FileAction::Import => Some(Self::Import),
            FileAction::Export => Some(Self::Export),
            FileAction::Reference => Some(Self::Reference),
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
            Self::Reference => FileRequest::Reference(path),
            Self::Image(kind) => FileRequest::SaveImage { kind, path },
        }
    }

    fn title(&self) -> &'static str {
        match self {
            Self::Open => "Open",
            Self::SaveAs => "Save As",
            Self::Import => "Import",
            Self::Export => "Export",
            Self::Texture(..) | Self::Reference => "Open Image",
            Self::Image(ImageKind::Screenshot) => "Save Screenshot",
            Self::Image(ImageKind::Render) => "Save Image",
            Self::Image(ImageKind::UvLayout) => "Save UV Layout",
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
            Self::Image(_) => IMAGE_FORMATS
                .iter()
                .fold(dialog, |dialog, (name, endings)| dialog.add_filter(*name, endings))
                .save_file(),
            Self::Open | Self::Import | Self::Texture(..) | Self::Reference => dialog.pick_file(),
        }
    }

    /// The endings of the files that are meant.
    fn endings(&self) -> Vec<&'static str> {
        match self {
            Self::Open | Self::Import => readers().flat_map(|reader| reader.extensions).copied().collect(),
            Self::SaveAs => vec!["glb"],
            Self::Export => trigon_io::writers().flat_map(|writer| writer.extensions).copied().collect(),
            Self::Texture(..) | Self::Reference => IMAGES.to_vec(),
            Self::Image(_) => IMAGE_FORMATS.iter().flat_map(|(_, endings)| *endings).copied().collect(),
        }
    }

    fn writes(&self) -> bool {
        matches!(self, Self::SaveAs | Self::Export | Self::Image(_))
    }
}

/// The window, shown or not.
#[derive(Debug, Default)]
pub(crate) struct FileWindow {
    pub(crate) exchange: Exchange,
    purpose: Option<Purpose>,
    /// Where files are chosen from; it stays for the next time.
    folder: Folder,
    /// The name or the path that is typed.
    path: String,
    /// The file that was clicked, whose name no text may hold.
    clicked: Option<OsString>,
    /// Whether files that the editor does not read are shown, too.
    shows_all: bool,
    /// The system's dialog, while it is open.
    dialog: Option<(Purpose, Receiver<Option<PathBuf>>)>,
    note: &'static str,
}

impl FileWindow {
    /// Shows itself, with a file that is chosen if nothing else is.
    pub(crate) fn ask(&mut self, purpose: Purpose, suggestion: &Path) {
        let folder = suggestion.parent().filter(|folder| !folder.as_os_str().is_empty());
        let folder = folder.unwrap_or(self.folder.path()).to_owned();
        self.folder = Folder::read(&folder);
        self.path = suggestion.file_name().unwrap_or_default().to_string_lossy().into_owned();
        (self.purpose, self.clicked, self.note) = (Some(purpose), None, "");
    }

    /// Whether it is shown.
    pub(crate) fn is_open(&self) -> bool {
        self.purpose.is_some()
    }

    /// Hides it, and returns whether it was shown. What the system's dialog ends with counts no more.
    pub(crate) fn close(&mut self) -> bool {
        self.dialog = None;
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
        self.note = "the system's dialog chose no file, or there is none";
        let path = ended?;
        self.purpose = None;
        Some(purpose.request(path))
    }

    /// Shows it if it is open. Returns what was chosen; `wake` is called when a dialog is closed.
    pub(crate) fn show(
        &mut self,
        context: &Context,
        recent: &RecentFiles,
        wake: impl FnOnce() + Send + 'static,
    ) -> Option<FileRequest> {
        let purpose = self.purpose.clone()?;
        // Escape closes a list that is open in it first.
        let escaped = !Popup::is_any_open(context) && context.input(|input| input.key_pressed(Key::Escape));
        let mut did = Did::Nothing;
        Modal::new(Id::unique("file window")).show(context, |ui| {
            ui.set_width(WIDTH.min(context.content_rect().width() - 40.0));
            ui.heading(purpose.title());
            did = self.location(ui).or(self.list(ui, &purpose)).or(self.name(ui, &purpose));
            self.options(ui, &purpose);
            if let Some(file) = recent_list(ui, &purpose, recent) {
                did = Did::Choose(file);
            }
            did = std::mem::replace(&mut did, Did::Nothing).or(self.buttons(ui, &purpose));
        });
        match did {
            _ if escaped => drop(self.close()),
            Did::Nothing => {}
            Did::Cancel => drop(self.close()),
            Did::Enter(folder) => self.enter(&folder),
            Did::AskSystem => {
                let requested = purpose.clone();
                self.browse(purpose, move || requested.ask(), wake);
            }
            Did::Choose(path) if path.is_dir() => {
                self.enter(&path);
                self.path.clear();
            }
            Did::Choose(path) => {
                self.close();
                self.folder = path.parent().map_or_else(Folder::default, Folder::read);
                return Some(purpose.request(path));
            }
        }
        None
    }

    fn enter(&mut self, folder: &Path) {
        self.folder = Folder::read(folder);
        self.clicked = None;
    }

    /// The file that is named now; none while nothing is typed.
    fn named(&self) -> Option<PathBuf> {
        let typed = self.path.trim();
        let clicked = self.clicked.as_ref().filter(|name| name.to_string_lossy() == self.path);
        let name = clicked.map_or(Path::new(typed), |name| Path::new(name));
        (!name.as_os_str().is_empty()).then(|| self.folder.path().join(name))
    }

    /// Which folder is shown, and the way to others.
    fn location(&self, ui: &mut Ui) -> Did {
        let mut did = Did::Nothing;
        ui.horizontal(|ui| {
            let above = self.folder.path().parent();
            if ui.add_enabled(above.is_some(), Button::new("Up")).on_hover_text("The folder above").clicked()
            {
                did = above.map_or(Did::Nothing, |folder| Did::Enter(folder.to_owned()));
            }
            let home = std::env::home_dir();
            if ui.add_enabled(home.is_some(), Button::new("Home")).clicked() {
                did = home.map_or(Did::Nothing, Did::Enter);
            }
            ui.add(egui::Label::new(self.folder.path().display().to_string()).truncate());
        });
        did
    }

    /// Folders, which a click enters, and files, which a click names and a double click chooses.
    fn list(&mut self, ui: &mut Ui, purpose: &Purpose) -> Did {
        let (mut did, mut clicked) = (Did::Nothing, None);
        let all = self.shows_all;
        let endings = if all { Vec::new() } else { purpose.endings() };
        let entries: Vec<_> = self.folder.shown(&endings).collect();
        let height = ui.spacing().interact_size.y;
        egui::Frame::canvas(ui.style()).show(ui, |ui| {
            let area = ScrollArea::vertical().id_salt(self.folder.path()).auto_shrink(false);
            area.max_height(LIST_HEIGHT).show_rows(ui, height, entries.len().max(1), |ui, range| {
                if entries.is_empty() {
                    ui.weak("nothing of the kind is here");
                }
                ui.with_layout(Layout::top_down_justified(Align::LEFT), |ui| {
                    for entry in entries.get(range).unwrap_or_default() {
                        let name = entry.name.to_string_lossy();
                        let text = if entry.is_file { name.to_string() } else { format!("{name}/") };
                        let is_named = entry.is_file && name == self.path;
                        let row = ui.add(Button::selectable(is_named, text).truncate());
                        let path = || self.folder.path().join(&entry.name);
                        if row.clicked() && !entry.is_file {
                            did = Did::Enter(path());
                        } else if row.double_clicked() && !purpose.writes() {
                            did = Did::Choose(path());
                        } else if row.clicked() {
                            clicked = Some(entry.name.clone());
                        }
                    }
                });
            });
        });
        if !self.folder.note().is_empty() {
            ui.label(self.folder.note());
        }
        if let Some(name) = clicked {
            self.path = name.to_string_lossy().into_owned();
            self.clicked = Some(name);
        }
        ui.checkbox(&mut self.shows_all, "All files");
        did
    }

    /// The name, which Enter chooses.
    fn name(&mut self, ui: &mut Ui, purpose: &Purpose) -> Did {
        let field = TextEdit::singleline(&mut self.path).hint_text("name or path of a file");
        let mut typed = field.desired_width(f32::INFINITY).show(ui);
        let response = &typed.response;
        response.ctx.accesskit_node_builder(response.id, |node| node.set_label("path of a file"));
        // In a list that is open Enter is for that.
        let is_free = !Popup::is_any_open(ui.ctx());
        let entered = is_free && response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        if !entered && ui.memory(|memory| memory.focused().is_none()) {
            response.request_focus();
        }
        crate::panel::select_all_at_first(&mut typed);
        if purpose.writes() && self.named().is_some_and(|path| path.is_file()) {
            let text = match purpose {
                Purpose::Image(_) => "This file exists: it is replaced.",
                _ => "This file exists: it is replaced, and its old contents get the ending .bak.",
            };
            ui.colored_label(ui.visuals().warn_fg_color, text);
        }
        self.named().filter(|_| entered).map_or(Did::Nothing, Did::Choose)
    }

    fn options(&mut self, ui: &mut Ui, purpose: &Purpose) {
        match purpose {
            Purpose::Open | Purpose::Import => self.exchange.show_import(ui),
            Purpose::Export => self.exchange.show_export(ui, &mut self.path),
            Purpose::Image(_) => images::show_formats(ui, &mut self.path),
            Purpose::SaveAs | Purpose::Texture(..) | Purpose::Reference => {}
        }
        if !self.note.is_empty() {
            ui.label(self.note);
        }
    }

    fn buttons(&self, ui: &mut Ui, purpose: &Purpose) -> Did {
        let mut did = Did::Nothing;
        ui.add_space(8.0);
        ui.horizontal(|ui| {
            let path = self.named();
            let replaces = purpose.writes() && path.as_ref().is_some_and(|path| path.is_file());
            let title = if replaces { "Replace" } else { purpose.title() };
            if ui.add_enabled(path.is_some(), Button::new(title)).clicked() {
                did = path.map_or(Did::Nothing, Did::Choose);
            }
            if ui.button("Cancel").clicked() {
                did = Did::Cancel;
            }
            let system = ui.add_enabled(self.dialog.is_none(), Button::new("System Dialog…"));
            if system.on_hover_text("Chooses by the dialog of the desktop instead").clicked() {
                did = Did::AskSystem;
            }
        });
        did
    }
}

/// Files that were opened lately; the one that was clicked.
fn recent_list(ui: &mut Ui, purpose: &Purpose, recent: &RecentFiles) -> Option<PathBuf> {
    if !matches!(purpose, Purpose::Open | Purpose::Import) || recent.files().is_empty() {
        return None;
    }
    let mut chosen = None;
    ui.separator();
    ui.label("recent");
    ScrollArea::vertical().id_salt("recent").max_height(RECENT_HEIGHT).show(ui, |ui| {
        for file in recent.files() {
            if ui.add(Button::new(file.display().to_string()).truncate()).clicked() {
                chosen = Some(file.clone());
            }
        }
    });
    chosen
}

/// What was done in the window.
#[derive(Debug, PartialEq)]
enum Did {
    Nothing,
    Cancel,
    Enter(PathBuf),
    Choose(PathBuf),
    AskSystem,
}

impl Did {
    /// The first of two that is something.
    fn or(self, other: Self) -> Self {
        if self == Self::Nothing { other } else { self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A window whose dialog has ended so.
    fn ended(decision: Option<PathBuf>) -> (FileWindow, Option<FileRequest>) {
        let ((decide, decided), (wake, woken)) = (channel(), channel());
        let mut window = FileWindow::default();
        window.ask(Purpose::Import, Path::new(""));
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

    /// A dialog that was left by Escape must not write what the system's dialog says later.
    #[test]
    fn nothing_is_written_after_escape() {
        let (decide, decided) = channel();
        let mut window = FileWindow::default();
        window.ask(Purpose::SaveAs, Path::new("chair.glb"));
        let (wake, woken) = channel();
        let dialog = move || decided.recv().expect("the test decides");
        window.browse(Purpose::SaveAs, dialog, move || wake.send(()).expect("the test waits"));
        assert!(window.close(), "it was open");
        decide.send(Some("late.glb".into())).expect("the dialog waits");
        woken.recv().expect("it closes");
        assert_eq!(window.picked(), None, "nobody asks any more");
    }
}
