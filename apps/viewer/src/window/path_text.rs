//! Paths as people type them: `~` for the home folder, and what Tab adds.

use std::path::{MAIN_SEPARATOR, Path, PathBuf};

use crate::folders::is_model;

/// No more names of a folder are looked at.
const MOST_NAMES: usize = 10_000;

/// What Tab makes of a typed path.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Completion {
    /// The path, as far as all names that fit agree.
    pub(super) text: String,
    /// The names that fit, in their order; folders end in a slash.
    pub(super) names: Vec<String>,
}

/// The path that a text means: without spaces around it, `~` being the home folder.
pub(super) fn path_of(text: &str, home: Option<&Path>) -> PathBuf {
    let text = text.trim();
    match (text.strip_prefix('~'), home) {
        (Some(""), Some(home)) => home.to_owned(),
        (Some(rest), Some(home)) if rest.starts_with(is_separator) => {
            home.join(rest.trim_start_matches(is_separator))
        }
        _ => PathBuf::from(text),
    }
}

fn is_separator(c: char) -> bool {
    c == '/' || c == MAIN_SEPARATOR
}

/// Adds what all names agree in that begin as the last part of the path: folders and files of formats
/// that can be read. Names that begin with a dot only follow a dot.
pub(super) fn complete(text: &str, home: Option<&Path>) -> Completion {
    let text = if text.trim() == "~" { "~/" } else { text.trim_start() };
    let (folder, begun) = text.rfind(is_separator).map_or(("", text), |end| text.split_at(end + 1));
    let names = names_in(&path_of(if folder.is_empty() { "." } else { folder }, home), begun);
    let mut common = names.first().cloned().unwrap_or_else(|| begun.to_owned());
    for name in &names {
        let same = common.chars().zip(name.chars()).take_while(|(one, other)| one == other).count();
        common = common.chars().take(same).collect();
    }
    Completion { text: format!("{folder}{common}"), names }
}

fn names_in(folder: &Path, begun: &str) -> Vec<String> {
    let Ok(entries) = folder.read_dir() else { return Vec::new() };
    let named = entries.take(MOST_NAMES).filter_map(|entry| {
        let path = entry.ok()?.path();
        let name = path.file_name()?.to_str()?.to_owned();
        let is_meant = name.starts_with(begun) && (begun.starts_with('.') || !name.starts_with('.'));
        match is_meant {
            true if path.is_dir() => Some(name + "/"),
            true if is_model(&path) => Some(name),
            _ => None,
        }
    });
    let mut names: Vec<String> = named.collect();
    names.sort();
    names
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn folder() -> tempfile::TempDir {
        let folder = tempfile::tempdir().expect("a folder");
        for name in ["chair.obj", "chair red.glb", "chair.mtl.txt", ".hidden.obj", "table.stl"] {
            fs::write(folder.path().join(name), "").expect("written");
        }
        fs::create_dir(folder.path().join("models")).expect("a folder in it");
        folder
    }

    #[test]
    fn the_home_folder_is_a_tilde() {
        let home = Path::new("/home/me");
        assert_eq!(path_of(" ~/a b.obj ", Some(home)), home.join("a b.obj"), "in it");
        assert_eq!(path_of("~", Some(home)), home, "itself");
        assert_eq!(path_of("~other/a.obj", Some(home)), Path::new("~other/a.obj"), "another name");
        assert_eq!(path_of("~/a.obj", None), Path::new("~/a.obj"), "there is none");
    }

    #[test]
    fn tab_adds_what_all_names_agree_in() {
        let folder = folder();
        let home = Some(folder.path());
        let completed = |text: &str| complete(text, home);
        assert_eq!(completed("~/cha").text, "~/chair", "as far as both go");
        assert_eq!(completed("~/cha").names, ["chair red.glb", "chair.obj"], "no texts");
        assert_eq!(completed("~/chair.").text, "~/chair.obj", "one");
        assert_eq!(completed("~/m").text, "~/models/", "a folder goes on");
        assert_eq!(completed("~").names.len(), 4, "all but what is hidden");
        assert_eq!(completed("~/.h").text, "~/.hidden.obj", "unless a dot was typed");
        assert_eq!(completed("~/x").text, "~/x", "nothing fits");
        let whole = format!("{}/t", folder.path().display());
        assert_eq!(completed(&whole).text, format!("{}/table.stl", folder.path().display()), "without ~");
        assert_eq!(completed("/no/such/folder/x").text, "/no/such/folder/x", "it stays");
    }
}
