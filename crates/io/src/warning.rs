//! Warnings: what a load could not keep, as data for the caller; never printed here.
//!
//! A file with a million bad faces gives one warning with a count: the collector merges warnings
//! with the same file and text.

use std::collections::HashMap;
use std::fmt;
use std::path::{Path, PathBuf};

use crate::error::{Location, printable};

/// Something in a file that is missing, wrong or not supported. Its `Display` is one line.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Warning {
    /// The faulty file.
    pub file: PathBuf,
    /// The first location.
    pub location: Location,
    /// What is wrong with it.
    pub what: String,
    /// A remedy for people.
    pub remedy: String,
    /// How many more of the same there were.
    pub more: usize,
    /// For a file that the model names and that could not be used: every path at which it was
    /// looked for. Empty otherwise.
    pub tried: Vec<PathBuf>,
}

impl Warning {
    /// A warning about a file: where it is, what is wrong, and a remedy. Characters that a terminal would obey are
    /// replaced.
    #[must_use]
    pub fn new(file: &Path, location: Location, what: &str, remedy: &str) -> Self {
        Self {
            file: file.to_owned(),
            location,
            what: printable(what),
            remedy: printable(remedy),
            more: 0,
            tried: Vec::new(),
        }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let file = printable(&self.file.display().to_string());
        write!(f, "{file}{}: {}", self.location, self.what)?;
        if self.more > 0 {
            write!(f, " … and {} more", self.more)?;
        }
        write!(f, "; {}", self.remedy)
    }
}

/// A number with what it counts: `1 vertex`, `2 vertices`.
pub(crate) fn counted(count: usize, kind: &str) -> String {
    let plural = match kind {
        "vertex" => "vertices".to_owned(),
        "index" => "indices".to_owned(),
        "bind matrix" => "bind matrices".to_owned(),
        regular => format!("{regular}s"),
    };
    format!("{count} {}", if count == 1 { kind } else { &plural })
}

/// The maximum number of different warnings; a hostile file can make every one different.
const MOST_WARNINGS: usize = 200;

/// Collects warnings about one model and its other files.
#[derive(Debug)]
pub(crate) struct Warnings {
    file: PathBuf,
    list: Vec<Warning>,
    known: HashMap<(PathBuf, String), usize>,
}

impl Warnings {
    pub(crate) fn about(file: &Path) -> Self {
        Self { file: file.to_owned(), list: Vec::new(), known: HashMap::new() }
    }

    /// A warning about the model's own file.
    pub(crate) fn push(&mut self, location: Location, what: impl Into<String>, remedy: impl Into<String>) {
        let file = self.file.clone();
        self.push_about(&file, location, what, remedy);
    }

    /// A warning about another file of the model.
    pub(crate) fn push_about(
        &mut self,
        file: &Path,
        location: Location,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) {
        self.add(Warning::new(file, location, &what.into(), &remedy.into()));
    }

    /// A warning about a file that could not be used; `tried` is where it was looked for.
    pub(crate) fn push_unusable(
        &mut self,
        file: &Path,
        location: Location,
        what: String,
        remedy: &str,
        tried: Vec<PathBuf>,
    ) {
        self.add(Warning { tried, ..Warning::new(file, location, &what, remedy) });
    }

    /// A warning that occurred `count` times, first at `place`.
    pub(crate) fn push_counted(
        &mut self,
        count: usize,
        location: Location,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) {
        let Some(more) = count.checked_sub(1) else { return };
        self.add(Warning { more, ..Warning::new(&self.file, location, &what.into(), &remedy.into()) });
    }

    /// Adds a warning, or its count to the one with the same file and text, or to the last one if
    /// there are too many.
    fn add(&mut self, warning: Warning) {
        let key = (warning.file.clone(), warning.what.clone());
        if let Some(&index) = self.known.get(&key) {
            self.list[index].more += 1 + warning.more;
        } else if self.list.len() < MOST_WARNINGS {
            self.known.insert(key, self.list.len());
            self.list.push(warning);
        } else if let Some(last) = self.list.last_mut() {
            last.more += 1 + warning.more;
        }
    }

    /// The first warning.
    pub(crate) fn first(&self) -> Option<&Warning> {
        self.list.first()
    }

    pub(crate) fn into_list(self) -> Vec<Warning> {
        self.list
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repeated_warnings_are_counted() {
        let mut warnings = Warnings::about(Path::new("a.obj"));
        for line in 5..47 {
            warnings.push(Location::Line(line), "a face was dropped", "mend it");
        }
        let list = warnings.into_list();
        assert_eq!(list.len(), 1, "folded");
        assert_eq!(
            list[0].to_string(),
            "a.obj, line 5: a face was dropped … and 41 more; mend it",
            "counted"
        );
    }

    #[test]
    fn counts_of_a_known_warning_are_added() {
        let mut warnings = Warnings::about(Path::new("a.obj"));
        warnings.push_counted(3, Location::Line(5), "faces were dropped", "mend them");
        warnings.push_counted(0, Location::Line(6), "faces were dropped", "mend them");
        warnings.push_counted(40, Location::Line(7), "faces were dropped", "mend them");
        assert_eq!(warnings.into_list()[0].more, 42, "43 in all");
    }

    #[test]
    fn what_was_looked_for_is_kept_and_not_shown() {
        let mut warnings = Warnings::about(Path::new("a.obj"));
        let tried = vec![PathBuf::from("maps/a.png"), PathBuf::from("a.png")];
        for (line, tried) in [(2, tried.clone()), (3, Vec::new())] {
            let what = "no image".to_owned();
            warnings.push_unusable(Path::new("a.mtl"), Location::Line(line), what, "mend it", tried);
        }
        let list = warnings.into_list();
        assert_eq!(list[0].tried, tried, "of the first");
        assert_eq!(list[0].to_string(), "a.mtl, line 2: no image … and 1 more; mend it", "one line");
    }

    #[test]
    fn a_flood_of_different_warnings_is_bounded() {
        let mut warnings = Warnings::about(Path::new("a.obj"));
        for line in 0..10_000 {
            warnings.push(Location::Whole, format!("warning {line}"), "mend it");
        }
        warnings.push_counted(7, Location::Whole, "one more", "mend it");
        let list = warnings.into_list();
        assert_eq!(list.len(), MOST_WARNINGS, "bounded");
        assert_eq!(list.iter().map(|warning| 1 + warning.more).sum::<usize>(), 10_007, "none is lost");
    }
}
