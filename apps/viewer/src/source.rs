//! Where scenes come from: files, alone or in groups, or the built-in scene.

use std::path::{Path, PathBuf};

use regex_lite::Regex;

/// How several models are shown.
#[derive(Clone, Debug)]
pub(crate) enum Grouping {
    /// One after the other.
    OneByOne,
    /// In one scene.
    Together,
    /// Those of a folder in one scene.
    ByFolder,
    /// In one scene what differs only in the groups of this expression.
    ByName(Regex),
}

/// Where a scene comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Source {
    /// The scene that is shown without a file.
    BuiltIn,
    /// Files that are drawn together; at least one.
    Files(Vec<PathBuf>),
}

impl Source {
    /// Files that are shown together, in the order of the first of each group.
    pub(crate) fn group(files: &[PathBuf], grouping: &Grouping) -> Vec<Self> {
        let mut groups: Vec<(String, Vec<PathBuf>)> = Vec::new();
        for (file, index) in files.iter().zip(0..) {
            let name = file.to_string_lossy();
            let key = match grouping {
                Grouping::OneByOne => index.to_string(),
                Grouping::Together => String::new(),
                Grouping::ByFolder => {
                    file.parent().map(|folder| folder.to_string_lossy().into_owned()).unwrap_or_default()
                }
                Grouping::ByName(pattern) => starred(pattern, &name).unwrap_or_else(|| name.into_owned()),
            };
            match groups.iter_mut().find(|(other, _)| *other == key) {
                Some((_, group)) => group.push(file.clone()),
                None => groups.push((key, vec![file.clone()])),
            }
        }
        groups.into_iter().map(|(_, files)| Self::Files(files)).collect()
    }

    /// What stands for it in names of images: the file, or that there are several.
    pub(crate) fn image_subject(&self) -> Option<&Path> {
        match self {
            Self::Files(files) if files.len() > 1 => Some(Path::new("multi_file")),
            _ => self.first_file(),
        }
    }

    /// The first file: it names images and windows.
    pub(crate) fn first_file(&self) -> Option<&Path> {
        match self {
            Self::BuiltIn => None,
            Self::Files(files) => files.first().map(PathBuf::as_path),
        }
    }

    /// What is written on the window.
    #[cfg(feature = "window")]
    pub(crate) fn window_title(&self) -> String {
        format!("{} - trigon", self.title())
    }

    /// For titles and lists.
    pub(crate) fn title(&self) -> String {
        let Self::Files(files) = self else { return "built-in scene".to_owned() };
        match files.as_slice() {
            [file] => name(file),
            [file, rest @ ..] => format!("{} and {} more", name(file), rest.len()),
            [] => String::new(),
        }
    }

    /// The file that a message begins with, if it is one of several; else the title.
    #[cfg(feature = "window")]
    pub(crate) fn title_in(&self, message: &str) -> String {
        let Self::Files(files) = self else { return self.title() };
        let is_meant = |file: &&PathBuf| {
            let rest = message.strip_prefix(&*file.to_string_lossy());
            // Or it is that of another file whose name goes on.
            rest.is_some_and(|rest| rest.starts_with([':', ',']))
        };
        files.iter().find(is_meant).map_or_else(|| self.title(), |file| name(file))
    }
}

fn name(file: &Path) -> String {
    file.file_name().unwrap_or(file.as_os_str()).to_string_lossy().into_owned()
}

/// A name with a star for each group of an expression that is found in it.
fn starred(pattern: &Regex, name: &str) -> Option<String> {
    let found = pattern.captures(name)?;
    let (mut text, mut from) = (String::new(), 0);
    for group in found.iter().skip(1).flatten().filter(|group| !group.is_empty()) {
        // Groups in groups are replaced with the outer one.
        if group.start() >= from {
            text += &name[from..group.start()];
            text.push('*');
            from = group.end();
        }
    }
    Some(text + &name[from..])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_grouped_by_folder_or_by_name() {
        let files: Vec<PathBuf> = ["a/x1.obj", "b/x2.obj", "a/y.obj"].map(PathBuf::from).to_vec();
        let names = |grouping| {
            let groups = Source::group(&files, &grouping).into_iter().map(|source| match source {
                Source::BuiltIn => Vec::new(),
                Source::Files(files) => files.iter().map(|file| file.display().to_string()).collect(),
            });
            groups.collect::<Vec<Vec<String>>>()
        };
        assert_eq!(names(Grouping::OneByOne).len(), 3, "each alone");
        assert_eq!(names(Grouping::Together), [["a/x1.obj", "b/x2.obj", "a/y.obj"]], "all");
        assert_eq!(names(Grouping::ByFolder), [&["a/x1.obj", "a/y.obj"][..], &["b/x2.obj"]], "folders");
        let pattern = Regex::new(r"^(.)/x(\d+)").expect("an expression");
        assert_eq!(names(Grouping::ByName(pattern)), [&["a/x1.obj", "b/x2.obj"][..], &["a/y.obj"]], "x");
    }
}
