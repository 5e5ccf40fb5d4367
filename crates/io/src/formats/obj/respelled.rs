//! Files that were found under a different spelling of their names.

use std::path::Path;

use crate::error::Place;
use crate::folder::Found;
use crate::import::Import;

/// Warns of it. `from` and `place` are the file and the line that have the name.
pub(super) fn note_respelled(import: &mut Import<'_>, name: &str, found: &Found, from: &Path, place: Place) {
    if found.respelled {
        let what = format!("{name} was not found; \"{}\" is used instead", found.path.display());
        import.warnings.push_about(from, place, what, "correct the name there");
    }
}
