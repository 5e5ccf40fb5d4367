//! The menus File and Help.

use super::{Action, Does::*, Needs, actions};
use crate::request::{FileAction, UiRequest};

actions! {
    "File" "file.new" "New" "Ctrl+N" Nothing File(FileAction::New) => "Starts a new document with a cube.";
    "File" "file.open" "Open…" "Ctrl+O" Nothing File(FileAction::Open) => "Opens another file.";
    "File" "file.save" "Save" "Ctrl+S" Nothing File(FileAction::Save) => "Saves the document to its file, a GLB that other programs open too.";
    "File" "file.save_as" "Save As…" "Ctrl+Shift+S" Nothing File(FileAction::SaveAs) => "Saves the document under another name.";
    "File" "file.import" "Import…" "" Nothing File(FileAction::Import) => "Adds the objects of a file to the scene.";
    "File" "file.export" "Export…" "" Nothing File(FileAction::Export) => "Writes the scene for other programs; the document keeps its own file.";
    "File" "file.quit" "Quit" "Ctrl+Q" Nothing File(FileAction::Quit) => "Closes the editor, asking about unsaved changes.";

    "Help" "help.search" "Find Command…" "F3" Nothing Ui(UiRequest::Search) => "Finds any command by name.";
    "Help" "help.sheet" "Keys and Mouse" "F1" Nothing Ui(UiRequest::Help) => "Shows all keys.";
}
