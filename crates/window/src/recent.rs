//! The list of recent files, and the folder where programs keep such lists.

use std::fs;
use std::path::{Path, PathBuf};

use crate::path_line::{path_from_line, path_to_line};

/// The number of files that are remembered.
const MOST: usize = 10;

/// Files that a program opened lately, the last one first. A file of the user remembers them, a
/// [path in each line](path_to_line).
#[derive(Debug, Default)]
pub struct RecentFiles {
    /// `None` remembers nothing beyond this run.
    list: Option<PathBuf>,
    files: Vec<PathBuf>,
}

impl RecentFiles {
    /// The files that `list` names; none if it does not exist. With `None` instead of a list nothing is read or written.
    #[must_use]
    pub fn load(list: Option<PathBuf>) -> Self {
        let text = list.as_ref().and_then(|list| fs::read_to_string(list).ok()).unwrap_or_default();
        let files = text.lines().filter(|line| !line.is_empty()).take(MOST).map(path_from_line).collect();
        Self { list, files }
    }

    /// The files, the last one first.
    #[must_use]
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// Puts a file that was opened in front and writes the list. A list that cannot be written is no reason to stop: the
    /// file is then remembered for this run only.
    pub fn add(&mut self, file: &Path) {
        let file = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
        self.files.retain(|other| *other != file);
        self.files.insert(0, file);
        self.files.truncate(MOST);
        let Some(list) = &self.list else { return };
        let lines = self.files.iter().map(|file| path_to_line(file));
        let text = lines.fold(String::new(), |text, line| text + &line + "\n");
        drop(list.parent().map(fs::create_dir_all));
        let draft = list.with_extension("new");
        drop(fs::write(&draft, text).and_then(|()| fs::rename(&draft, list)));
    }
}

/// The user's folder for what trigon's programs remember between runs: `trigon` in `$XDG_STATE_HOME` or `~/.local/state`, in
/// `~/Library/Application Support` on macOS, in `%LOCALAPPDATA%` on Windows. It may not exist yet; `None` if the user has no
/// home folder.
#[must_use]
pub fn state_folder() -> Option<PathBuf> {
    let variable = |name| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let home = |path: &str| std::env::home_dir().map(|home| home.join(path));
    let folder = if cfg!(target_os = "windows") {
        variable("LOCALAPPDATA")
    } else if cfg!(target_os = "macos") {
        home("Library/Application Support")
    } else {
        variable("XDG_STATE_HOME").or_else(|| home(".local/state"))
    };
    folder.map(|folder| folder.join("trigon"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_files_are_remembered_once_each() {
        let folder = tempfile::tempdir().expect("a folder");
        let list = Some(folder.path().join("deep").join("recent"));
        let mut recent = RecentFiles::load(list.clone());
        assert!(recent.files().is_empty(), "nothing yet");
        (0..12).for_each(|n| recent.add(Path::new(&format!("/{n}.obj"))));
        recent.add(Path::new("/5.obj"));
        let again = RecentFiles::load(list);
        assert_eq!(again.files(), recent.files(), "read again");
        assert_eq!(again.files().len(), MOST, "the oldest are forgotten");
        assert_eq!(again.files()[..2], [PathBuf::from("/5.obj"), "/11.obj".into()], "the last one first");
        // Names that no line could hold are no reason to forget them.
        recent.add(Path::new("/two\nlines.obj"));
        assert_eq!(
            RecentFiles::load(Some(folder.path().join("deep").join("recent"))).files(),
            recent.files()
        );
        RecentFiles::load(None).add(Path::new("/a.obj"));
    }
}
