//! Opening files: the system's dialog, or a typed path if there is none, and recent files.

use std::path::PathBuf;
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::thread;

use trigon_window::{RecentFiles, egui};

use super::path_text::{complete, path_of};

/// So many names that Tab has found are listed.
const MOST_NAMES: usize = 6;

/// What asks a user for files.
pub(super) trait FileDialog {
    /// Shows itself; `None` if the user changed his mind, or there is no dialog to be
    /// shown. Called on a thread of its own.
    fn pick(&self) -> Option<Vec<PathBuf>>;
}

/// The system's own dialog: on Linux that of the desktop portal.
pub(super) struct SystemDialog;

impl FileDialog for SystemDialog {
    fn pick(&self) -> Option<Vec<PathBuf>> {
        rfd::FileDialog::new().set_title("Open a model").pick_files()
    }
}

/// The window in which files are opened.
#[derive(Default)]
pub(super) struct OpenWindow {
    shown: bool,
    path: String,
    /// Whether it was not shown yet.
    is_new: bool,
    /// The names that Tab has found, where they are several.
    names: Vec<String>,
    /// A dialog under way.
    dialog: Option<Receiver<Option<Vec<PathBuf>>>>,
    /// What the user should know.
    note: &'static str,
}

impl OpenWindow {
    /// Shows or hides it. Shown, its field has the keyboard.
    pub(super) fn toggle(&mut self) {
        self.shown = !self.shown;
        (self.is_new, self.note, self.names) = (true, "", Vec::new());
        self.path.clear();
    }

    pub(super) fn is_shown(&self) -> bool {
        self.shown
    }

    /// Asks for files by a dialog; `wake` is called when it is closed.
    pub(super) fn browse(
        &mut self,
        dialog: impl FileDialog + Send + 'static,
        wake: impl FnOnce() + Send + 'static,
    ) {
        let (sender, receiver) = channel();
        let spawned = thread::Builder::new().name("trigon-dialog".into()).spawn(move || {
            // Nobody waits for it any more when this fails.
            let _ = sender.send(dialog.pick());
            wake();
        });
        self.dialog = spawned.is_ok().then_some(receiver);
    }

    /// What a dialog ended with, once.
    pub(super) fn picked(&mut self) -> Vec<PathBuf> {
        let ended = match self.dialog.as_ref().map(Receiver::try_recv) {
            None | Some(Err(TryRecvError::Empty)) => return Vec::new(),
            Some(Ok(files)) => files,
            Some(Err(TryRecvError::Disconnected)) => None,
        };
        self.dialog = None;
        self.note = "no file was chosen; if the system shows no dialog, type a path";
        self.shown &= ended.is_none();
        ended.unwrap_or_default()
    }

    /// Shows it, if it is to be seen, on what no panel covers. Returns the files to be opened.
    pub(super) fn show(
        &mut self,
        ui: &egui::Ui,
        recent: &RecentFiles,
        browse: impl FnOnce(&mut Self),
    ) -> Vec<PathBuf> {
        let (context, free) = (ui.ctx(), ui.available_rect_before_wrap());
        let mut files = Vec::new();
        let (mut shown, mut wants_dialog) = (self.shown, false);
        let width = (free.width() - 48.0).clamp(160.0, 520.0);
        let window = egui::Window::new("Open").open(&mut shown).collapsible(false).resizable(false);
        let window = window.constrain_to(free).max_width(width).fade_in(false);
        window.anchor(egui::Align2::CENTER_CENTER, [0.0; 2]).show(context, |ui| {
            ui.horizontal(|ui| {
                let entered = self.field(ui, (width - 160.0).max(80.0));
                let open = ui.add_enabled(!self.path.is_empty(), egui::Button::new("Open")).clicked();
                if (open || entered) && !self.path.trim().is_empty() {
                    files.push(path_of(&self.path, std::env::home_dir().as_deref()));
                }
                wants_dialog = ui.add_enabled(self.dialog.is_none(), egui::Button::new("Browse…")).clicked();
            });
            for name in self.names.iter().take(MOST_NAMES) {
                ui.weak(name);
            }
            if self.names.len() > MOST_NAMES {
                ui.weak(format!("and {} more", self.names.len() - MOST_NAMES));
            }
            if !self.note.is_empty() {
                ui.label(self.note);
            }
            if !recent.files().is_empty() {
                ui.separator();
                ui.label("opened before");
            }
            let height = (free.height() - 220.0).max(60.0);
            egui::ScrollArea::vertical().max_height(height).show(ui, |ui| {
                for file in recent.files() {
                    if ui.add(egui::Button::new(file.display().to_string()).truncate()).clicked() {
                        files.push(file.clone());
                    }
                }
            });
        });
        let escaped = context.input(|input| input.key_pressed(egui::Key::Escape));
        self.shown = self.shown && shown && files.is_empty() && !escaped;
        if wants_dialog {
            browse(self);
        }
        files
    }

    /// The field of the path: Tab completes it. Returns whether Enter was pressed in it.
    fn field(&mut self, ui: &mut egui::Ui, width: f32) -> bool {
        let id = egui::Id::unique("path of a model");
        let has_keyboard = ui.memory(|memory| memory.has_focus(id));
        let tab = |input: &mut egui::InputState| input.consume_key(egui::Modifiers::NONE, egui::Key::Tab);
        if has_keyboard && ui.input_mut(tab) {
            let completion = complete(&self.path, std::env::home_dir().as_deref());
            self.path = completion.text;
            self.names = if completion.names.len() > 1 { completion.names } else { Vec::new() };
            put_cursor_at_end(ui.ctx(), id, &self.path);
        }
        let field = egui::TextEdit::singleline(&mut self.path).hint_text("path of a model (Tab completes)");
        let typed = ui.add(field.id(id).lock_focus(true).desired_width(width));
        ui.ctx().accesskit_node_builder(typed.id, |node| node.set_label("path of a model"));
        if std::mem::take(&mut self.is_new) {
            typed.request_focus();
        }
        if typed.changed() {
            self.names.clear();
        }
        typed.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter))
    }
}

fn put_cursor_at_end(context: &egui::Context, id: egui::Id, text: &str) {
    let Some(mut state) = egui::TextEdit::load_state(context, id) else { return };
    let end = egui::text::CCursor::new(text.chars().count());
    state.cursor.set_char_range(Some(egui::text::CCursorRange::one(end)));
    state.store(context, id);
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::Sender;

    /// A dialog whose user decides when the test does.
    struct Decided(Receiver<Option<Vec<PathBuf>>>);

    impl FileDialog for Decided {
        fn pick(&self) -> Option<Vec<PathBuf>> {
            self.0.recv().expect("the test decides")
        }
    }

    /// A window with a dialog that waits for a decision, and what is told when it closes.
    fn asking() -> (OpenWindow, Sender<Option<Vec<PathBuf>>>, Receiver<()>) {
        let ((decide, decision), (wake, woken)) = (channel(), channel());
        let mut window = OpenWindow { shown: true, ..OpenWindow::default() };
        window.browse(Decided(decision), move || wake.send(()).expect("the test waits"));
        (window, decide, woken)
    }

    fn ended(decision: Option<Vec<PathBuf>>) -> (OpenWindow, Vec<PathBuf>) {
        let (mut window, decide, woken) = asking();
        decide.send(decision).expect("the dialog waits");
        woken.recv().expect("it closes");
        let files = window.picked();
        (window, files)
    }

    #[test]
    fn nothing_is_picked_while_a_dialog_is_open() {
        let (mut window, decide, woken) = asking();
        assert!(window.picked().is_empty() && window.dialog.is_some(), "its user has not decided");
        decide.send(Some(vec!["a.obj".into()])).expect("the dialog waits");
        woken.recv().expect("it closes");
        assert_eq!(window.picked(), [PathBuf::from("a.obj")], "and now has");
        assert!(window.picked().is_empty() && window.dialog.is_none(), "once");
    }

    #[test]
    fn dialogs_answer_with_files_or_leave_the_window_open() {
        let files = vec![PathBuf::from("a.obj"), "b.glb".into()];
        let (window, picked) = ended(Some(files.clone()));
        assert_eq!(picked, files, "both");
        assert!(!window.shown, "there is nothing more to ask");
        let (window, picked) = ended(None);
        assert!(picked.is_empty(), "none");
        assert!(window.shown && !window.note.is_empty(), "a path can be typed instead");
    }
}
