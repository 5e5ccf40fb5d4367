//! The editor's window: its state, and everything around the 3D view.
//!
//! Keys, menus, panels and tools make [`Request`](crate::request::Request)s; [`Editor`] executes
//! them on the document; [`onto_stage`] brings the document onto the stage.

mod actions;
mod background;
mod button_start;
mod dialog;
mod dropped;
mod editor;
mod file_version;
mod files;
mod gizmo_cache;
mod handler;
mod image_requests;
mod images;
mod interface;
mod keys;
mod loading;
mod modal;
mod navigation;
mod onto_stage;
mod open_file;
mod panels;
mod panes;
mod pick;
mod placing;
mod pointing;
mod popup;
mod preferences;
mod recovery;
mod running;
mod settings;
mod surfaces;
#[cfg(test)]
mod tests;
mod uv_tool;

use std::path::PathBuf;

use trigon_document::Document;
use trigon_window::{Application, Handler, Stage, WindowError, state_folder};

use self::dialog::Exchange;
use crate::arguments::Arguments;
use editor::Editor;
use keys::Keys;

/// The default keymap, as a file that users may change.
pub(crate) fn keymap() -> String {
    keys::print()
}

/// Opens the window, and returns when it is closed.
pub(crate) fn run(arguments: &Arguments) -> Result<(), String> {
    if !display_is_named() {
        return Err(
            "there is no display to open a window on; run a script instead: trigon-editor --run script.json"
                .into(),
        );
    }
    let (keys, notes) = keys_of_user()?;
    notes.iter().for_each(|note| crate::report("warning", note));
    let mut application = Application::new("trigon");
    let mut editor = Editor::new(keys, state_folder(), arguments.files.clone());
    editor.notes = notes;
    editor.dialog.exchange = Exchange::new(arguments);
    if let Some(bytes) = arguments.memory {
        editor.document.set_memory(bytes);
    }
    settings::prepare(&mut application.stage);
    application.run_with(&mut editor).map_err(|error| match error {
        WindowError::NoDisplay { .. } => format!("{error}; run a script instead: --run script.json"),
        other => other.to_string(),
    })
}

/// The editor on a document, and the stage that shows it, as the program opens them: for a window without a
/// display that a program drives. Recovery files are written to this folder, if there is one.
#[must_use]
pub fn measured_editor(document: Document, folder: Option<PathBuf>) -> (Stage, Box<dyn Handler>) {
    let mut stage = Stage::new("trigon");
    let mut editor = Editor::new(Keys::default(), folder, Vec::new());
    settings::prepare(&mut stage);
    editor.take_document(document, None);
    (stage, Box::new(editor))
}

/// The keys of the user's file, if there is one, and what in it is not known.
fn keys_of_user() -> Result<(Keys, Vec<String>), String> {
    let Some(path) = keys::file().filter(|path| path.exists()) else { return Ok(Default::default()) };
    let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let (keys, warnings) = Keys::from_json(&text).map_err(|error| format!("{}, {error}", path.display()))?;
    Ok((keys, warnings.into_iter().map(|warning| format!("{}, {warning}", path.display())).collect()))
}

/// Opening a large document only to find that there is no display helps nobody. Other systems always have one,
/// or say so later.
fn display_is_named() -> bool {
    let named = |variable| std::env::var_os(variable).is_some_and(|value| !value.is_empty());
    !cfg!(target_os = "linux") || named("DISPLAY") || named("WAYLAND_DISPLAY")
}
