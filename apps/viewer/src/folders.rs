//! Folders on the command line are replaced by the models in them.

use std::path::{Path, PathBuf};

use trigon_io::Format;

/// As many files as anybody goes through by hand; a link to a folder above may lead round.
const MOST_FILES: usize = 100_000;

/// The files, with those in folders by their names; of a folder that are those whose
/// endings tell a format. With `recursive` also those of the folders in it.
///
/// # Errors
/// When a folder cannot be read, or has no model in it.
pub(crate) fn expanded(files: &[PathBuf], recursive: bool) -> Result<Vec<PathBuf>, String> {
    let mut all = Vec::new();
    for file in files {
        if !file.is_dir() {
            all.push(file.clone());
            continue;
        }
        let before = all.len();
        collect(file, recursive, &mut all)?;
        if all.len() == before {
            let more =
                if recursive { "" } else { ", or add --recursive-dir-add if they are in folders in it" };
            return Err(format!(
                "{}: there is no model in the folder; name files{more} (--list-readers lists the formats)",
                file.display()
            ));
        }
    }
    Ok(all)
}

fn collect(folder: &Path, recursive: bool, all: &mut Vec<PathBuf>) -> Result<(), String> {
    let entries = std::fs::read_dir(folder)
        .map_err(|error| format!("{}: cannot be read ({error})", folder.display()))?;
    let mut entries: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    entries.sort();
    for entry in entries {
        if entry.is_dir() {
            let is_link = entry.is_symlink();
            if recursive && !is_link {
                collect(&entry, recursive, all)?;
            }
        } else if is_model(&entry) && all.len() < MOST_FILES {
            all.push(entry);
        }
    }
    Ok(())
}

/// Whether the ending of a file tells a format.
pub(crate) fn is_model(file: &Path) -> bool {
    let ending = file.extension().map(|ending| ending.to_string_lossy());
    ending.is_some_and(|ending| Format::from_extension(&ending).is_some())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn models_of_folders_take_their_place() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |name: &str| folder.path().join(name);
        fs::create_dir(path("deep")).expect("a folder");
        for name in ["b.obj", "a.STL", "b.mtl", "notes.txt", "deep/c.ply"] {
            fs::write(path(name), "").expect("written");
        }
        let files = [PathBuf::from("first.obj"), folder.path().to_owned()];
        let flat = expanded(&files, false).expect("models");
        assert_eq!(flat, [PathBuf::from("first.obj"), path("a.STL"), path("b.obj")], "models by name");
        let deep = expanded(&files, true).expect("models");
        assert_eq!(deep.last(), Some(&path("deep/c.ply")), "and in folders in it");
        fs::create_dir(path("empty")).expect("a folder");
        let why = expanded(&[path("empty")], false).expect_err("nothing");
        assert!(why.contains("no model") && why.contains("--recursive-dir-add"), "{why}");
    }
}
