//! The folder of screenshots: one in the user's Pictures folder, or the working folder if there is
//! none.

use std::fs;
use std::path::{Path, PathBuf};

use trigon_scene::Frame;

use crate::args::{Subject, Template};
use crate::failure::Failure;
use crate::inputs::Inputs;
use crate::outlet::write_file;

/// Writes a screenshot of a model (`None` for the built-in scene) under a name
/// that is not in use, and returns the name.
pub(super) fn save(
    frame: &Frame,
    template: &Template,
    model: Option<&Path>,
    inputs: &Inputs,
) -> Result<PathBuf, Failure> {
    let path = template.unused_in(&folder(), Subject { model, ..Subject::default() });
    if let Some(folder) = path.parent() {
        // What fails here is said when the file is written.
        let _ = fs::create_dir_all(folder);
    }
    inputs.refuse(&path)?;
    write_file(&path, frame)?;
    Ok(path)
}

/// `~/Pictures/trigon-viewer` if there is a folder for images.
fn folder() -> PathBuf {
    let images = std::env::home_dir().map(|home| home.join("Pictures")).filter(|folder| folder.is_dir());
    let own = images.map(|images| images.join("trigon-viewer"));
    own.filter(|own| fs::create_dir_all(own).is_ok()).unwrap_or_default()
}
