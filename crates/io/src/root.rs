//! Where the files of a model lie: on the disk, in memory, or nowhere.

use std::collections::{BTreeMap, HashMap};
use std::fs;
use std::path::{Path, PathBuf};

use crate::refusal::relative_path;

/// The folder of a model.
#[derive(Debug)]
pub(crate) enum Root {
    /// None: the model came from a stream.
    Nowhere,
    /// A folder of the disk, canonical.
    Disk(PathBuf),
    /// The files in it, by their paths from it.
    Memory(BTreeMap<PathBuf, Vec<u8>>),
}

impl Root {
    /// Those of the files that lie in a folder. What no model can name is left out.
    pub(crate) fn in_memory(folder: &Path, files: BTreeMap<String, Vec<u8>>) -> Self {
        let inside = files.into_iter().filter_map(|(name, bytes)| {
            let path = relative_path(&name).ok()?;
            Some((path.strip_prefix(folder).ok()?.to_owned(), bytes))
        });
        Self::Memory(inside.collect())
    }

    /// The names in a folder in it by their lower case; of several with the same, the first in alphabetical
    /// order. Empty if it cannot be listed.
    pub(crate) fn names(&self, folder: &Path) -> HashMap<String, String> {
        // A folder with more entries than this is not searched to its end.
        const MOST_ENTRIES: usize = 100_000;
        let mut names: Vec<String> = match self {
            Self::Nowhere => Vec::new(),
            Self::Disk(root) => {
                let entries =
                    fs::read_dir(root.join(folder)).into_iter().flatten().take(MOST_ENTRIES).flatten();
                entries.filter_map(|entry| entry.file_name().into_string().ok()).collect()
            }
            Self::Memory(files) => {
                let inside = files.keys().filter_map(|path| path.strip_prefix(folder).ok());
                let names = inside.filter_map(|path| path.iter().next()?.to_str());
                names.take(MOST_ENTRIES).map(str::to_owned).collect()
            }
        };
        names.sort_unstable_by(|a, b| b.cmp(a));
        names.into_iter().map(|name| (name.to_lowercase(), name)).collect()
    }
}
