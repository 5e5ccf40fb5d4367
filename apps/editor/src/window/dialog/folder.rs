//! What is in a folder, for choosing a file from it.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

/// More would be a list that nobody reads.
const MOST: usize = 5000;

/// A folder as it was read last.
#[derive(Debug, Default)]
pub(super) struct Folder {
    path: PathBuf,
    /// Folders first, each kind by name; without hidden ones.
    entries: Vec<Entry>,
    /// Why it cannot be read, or what is missing.
    note: String,
}

/// Something in a folder.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Entry {
    pub(super) is_file: bool,
    /// In lower case, for sorting.
    order: String,
    pub(super) name: OsString,
}

impl Folder {
    /// Reads a folder; of a relative path the one that the program was started in counts.
    pub(super) fn read(path: &Path) -> Self {
        let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        let listed = match fs::read_dir(&path) {
            Ok(listed) => listed,
            Err(error) => {
                let note = format!("{}: {error}", path.display());
                // The nearest folder that is there.
                let folder = path.ancestors().skip(1).find(|folder| folder.is_dir());
                return match folder {
                    Some(folder) => Self { note, ..Self::read(folder) },
                    None => Self { note, path, entries: Vec::new() },
                };
            }
        };
        let visible =
            listed.flatten().filter(|entry| !entry.file_name().as_encoded_bytes().starts_with(b"."));
        let mut entries: Vec<Entry> = visible
            .take(MOST)
            .map(|entry| {
                // A link counts as what it leads to.
                let is_file = !entry.path().is_dir();
                let name = entry.file_name();
                Entry { is_file, order: name.to_string_lossy().to_lowercase(), name }
            })
            .collect();
        entries.sort();
        let note = if entries.len() < MOST { String::new() } else { format!("only {MOST} are shown") };
        Self { path, entries, note }
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    pub(super) fn note(&self) -> &str {
        &self.note
    }

    /// Folders, and the files whose names end in one of these; all files if there is none.
    pub(super) fn shown(&self, endings: &[&str]) -> impl Iterator<Item = &Entry> {
        self.entries.iter().filter(move |entry| {
            let ending = || Path::new(&entry.order).extension().unwrap_or_default().to_string_lossy();
            !entry.is_file || endings.is_empty() || endings.contains(&&*ending())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_come_first_and_files_by_their_endings() {
        let folder = tempfile::tempdir().expect("a folder");
        for name in ["b.obj", "A.GLB", "c.txt", ".hidden.glb"] {
            fs::write(folder.path().join(name), "").expect("written");
        }
        fs::create_dir(folder.path().join("models")).expect("made");
        let read = Folder::read(folder.path());
        let names = |endings: &[&str]| -> Vec<String> {
            read.shown(endings).map(|entry| entry.name.to_string_lossy().into_owned()).collect()
        };
        assert_eq!(names(&["glb", "obj"]), ["models", "A.GLB", "b.obj"], "models");
        assert_eq!(names(&[]), ["models", "A.GLB", "b.obj", "c.txt"], "all that is not hidden");
        assert_eq!(read.note(), "", "all of it");
        let missing = Folder::read(&folder.path().join("not there"));
        assert!(missing.note().contains("not there"), "says so");
        assert_eq!(missing.path(), read.path(), "and shows the nearest folder that is there");
    }
}
