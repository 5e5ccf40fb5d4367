//! Recent files, stored in a file of the user.

use std::fs;
use std::path::{Path, PathBuf};

/// As many as are remembered.
const MOST: usize = 10;

/// Files, the last one first.
#[derive(Debug, Default)]
pub(crate) struct Recent {
    /// Where they are kept; `None` where there is no place for it.
    list: Option<PathBuf>,
    files: Vec<PathBuf>,
}

impl Recent {
    /// What is remembered of former times in a file of this folder.
    pub(crate) fn load(folder: Option<&Path>) -> Self {
        let list = folder.map(|folder| folder.join("edited"));
        let text = list.as_ref().and_then(|list| fs::read_to_string(list).ok()).unwrap_or_default();
        let files = text.lines().filter(|line| !line.is_empty()).take(MOST).map(PathBuf::from).collect();
        Self { list, files }
    }

    /// The files, the last one first.
    pub(crate) fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// A file was opened. That it cannot be remembered keeps nobody from working on it.
    pub(crate) fn add(&mut self, file: &Path) {
        let file = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
        self.files.retain(|other| *other != file);
        self.files.insert(0, file);
        self.files.truncate(MOST);
        let Some(list) = &self.list else { return };
        let lines = self.files.iter().filter_map(|file| file.to_str()).filter(|name| !name.contains('\n'));
        let text = lines.fold(String::new(), |text, line| text + line + "\n");
        drop(list.parent().map(fs::create_dir_all));
        let draft = list.with_extension("new");
        drop(fs::write(&draft, text).and_then(|()| fs::rename(&draft, list)));
    }
}

/// The folder where the editor keeps what it remembers between two runs.
pub(crate) fn state_folder() -> Option<PathBuf> {
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
        let mut recent = Recent::load(Some(folder.path()));
        assert!(recent.files().is_empty(), "nothing yet");
        (0..12).for_each(|n| recent.add(Path::new(&format!("/{n}.glb"))));
        recent.add(Path::new("/5.glb"));
        let again = Recent::load(Some(folder.path()));
        assert_eq!(again.files(), recent.files(), "kept for the next time");
        assert_eq!(again.files().len(), MOST, "not for ever");
        assert_eq!(again.files()[..2], [PathBuf::from("/5.glb"), "/11.glb".into()], "the last one first");
        Recent::load(None).add(Path::new("/a.glb"));
    }
}
