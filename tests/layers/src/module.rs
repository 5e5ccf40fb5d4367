//! The modules of a crate as they stand in its files.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

/// A path of names, as `crate`, `tile`, `Area`.
pub(crate) type Names = Vec<String>;

/// One module.
#[derive(Debug, Default)]
pub(crate) struct Module {
    /// The file that it stands in: an index into [`Crate::files`].
    pub(crate) file: usize,
    pub(crate) parent: Option<usize>,
    pub(crate) children: BTreeMap<String, usize>,
    /// Items that are defined here.
    pub(crate) items: BTreeSet<String>,
    /// What `use` declarations bring in, by the name that it has here.
    pub(crate) imports: BTreeMap<String, Names>,
    /// Modules of which everything is brought in.
    pub(crate) globs: Vec<Names>,
    /// Paths that stand in code, and private imports.
    pub(crate) references: Vec<Names>,
}

/// A crate's modules and files.
#[derive(Debug)]
pub struct Crate {
    /// The folder `src`.
    pub(crate) root: PathBuf,
    /// Paths relative to it.
    pub(crate) files: Vec<PathBuf>,
    /// The first one is the crate's root.
    pub(crate) modules: Vec<Module>,
}

impl Crate {
    /// How many files were read.
    #[must_use]
    pub fn file_count(&self) -> usize {
        self.files.len()
    }

    /// The folder of a file. A file `tile.rs` beside a folder `tile` is the head of that folder.
    pub(crate) fn folder(&self, file: usize) -> PathBuf {
        let path = &self.files[file];
        let own = path.with_extension("");
        if self.root.join(&own).is_dir() { own } else { path.parent().map(PathBuf::from).unwrap_or_default() }
    }
}
