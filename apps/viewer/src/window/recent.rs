//! Recent files, stored in a file of the user.

use std::fs;
use std::path::{Path, PathBuf};

/// As many as are remembered.
const MOST: usize = 10;

/// Files opened before, the last one first.
#[derive(Debug, Default)]
pub(super) struct Recent {
    /// Where they are kept; `None` where there is no place for it.
    list: Option<PathBuf>,
    files: Vec<PathBuf>,
}

impl Recent {
    /// What is remembered of former times.
    pub(super) fn load() -> Self {
        Self::load_from(state_folder().map(|folder| folder.join("trigon").join("recent")))
    }

    fn load_from(list: Option<PathBuf>) -> Self {
        let text = list.as_ref().and_then(|list| fs::read_to_string(list).ok()).unwrap_or_default();
        let files = text.lines().filter(|line| !line.is_empty()).take(MOST).map(PathBuf::from).collect();
        Self { list, files }
    }

    /// The files, the last one first.
    pub(super) fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// A file was opened. That it cannot be remembered keeps nobody from looking at it.
    pub(super) fn add(&mut self, file: &Path) {
        let file = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
        self.files.retain(|other| *other != file);
        self.files.insert(0, file);
        self.files.truncate(MOST);
        let Some(list) = &self.list else { return };
        let lines = self.files.iter().filter_map(|file| file.to_str()).filter(|name| !name.contains('\n'));
        let text = lines.fold(String::new(), |text, line| text + line + "\n");
        let _ = list.parent().map(fs::create_dir_all);
        let draft = list.with_extension("new");
        let _ = fs::write(&draft, text).and_then(|()| fs::rename(&draft, list));
    }
}

/// Where programs keep what they remember.
fn state_folder() -> Option<PathBuf> {
    let variable = |name| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let home = |path: &str| std::env::home_dir().map(|home| home.join(path));
    if cfg!(target_os = "windows") {
        variable("LOCALAPPDATA")
    } else if cfg!(target_os = "macos") {
        home("Library/Application Support")
    } else {
        variable("XDG_STATE_HOME").or_else(|| home(".local/state"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_files_are_remembered_once_each() {
        let folder = tempfile::tempdir().expect("a folder");
        let list = Some(folder.path().join("deep").join("recent"));
        let mut recent = Recent::load_from(list.clone());
        assert!(recent.files().is_empty(), "nothing yet");
        (0..12).for_each(|n| recent.add(Path::new(&format!("/{n}.obj"))));
        recent.add(Path::new("/5.obj"));
        let again = Recent::load_from(list);
        assert_eq!(again.files(), recent.files(), "kept for the next time");
        assert_eq!(again.files().len(), MOST, "not for ever");
        assert_eq!(again.files()[..2], [PathBuf::from("/5.obj"), "/11.obj".into()], "the last one first");
        Recent::load_from(None).add(Path::new("/a.obj"));
    }
}
