//! Files that a model names beside itself, under any spelling.

use std::path::Path;

use crate::error::Location;
use crate::folder::{Found, Lookup};
use crate::import::Import;
use crate::refusal::Refusal;

/// Where a file names another.
#[derive(Clone, Copy)]
pub(crate) struct Mention<'a> {
    /// The file that does.
    pub(crate) file: &'a Path,
    pub(crate) line: u64,
    /// The name.
    pub(crate) name: &'a str,
}

/// Warns if a file was found under a different spelling of its name. `what` is the file and its name.
pub(crate) fn note_respelled(import: &mut Import<'_>, what: &str, found: &Found, from: Mention<'_>) {
    if found.respelled {
        let what = format!("{what} was not found; \"{}\" is used instead", found.path.display());
        import.warnings.push_about(from.file, Location::Line(from.line), what, "correct the name there");
    }
}

/// Reads an image that a file names: beside that file, or else beside the model.
pub(crate) fn find_image(import: &mut Import<'_>, from: Mention<'_>) -> Option<Found> {
    let (here, name) = (Path::new(""), from.name);
    let beside = import.folder.relative_folder(from.file);
    let mut result = import.folder.read(&beside, name, Lookup::Forgiving);
    if matches!(result, Err(Refusal::Missing)) && !beside.as_os_str().is_empty() {
        result = import.folder.read(here, name, Lookup::Forgiving);
    }
    match result {
        Ok(found) => {
            note_respelled(import, &format!("texture \"{name}\""), &found, from);
            Some(found)
        }
        Err(refusal) => {
            let what = format!("texture \"{name}\" is not drawn: {refusal}");
            let mut tried = import.folder.tried(&beside, name);
            if !beside.as_os_str().is_empty() {
                tried.extend(import.folder.tried(here, name));
            }
            let location = Location::Line(from.line);
            import.warnings.push_unusable(from.file, location, what, refusal.remedy(), tried);
            None
        }
    }
}
