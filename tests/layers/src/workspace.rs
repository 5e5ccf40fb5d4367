//! The packages of the workspace and their files.

use std::io;
use std::path::{Path, PathBuf};

/// The folder of the workspace.
#[must_use]
pub fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The folders of all crates and apps, sorted.
///
/// # Errors
/// A folder that cannot be listed.
///
/// # Panics
/// If there are fewer than eleven crates and two apps, so that no check passes because it found nothing.
pub fn packages() -> io::Result<Vec<PathBuf>> {
    let mut packages = Vec::new();
    for part in ["crates", "apps"] {
        for entry in workspace().join(part).read_dir()? {
            packages.push(entry?.path());
        }
    }
    packages.sort();
    assert!(packages.len() >= 13, "eleven crates and two apps: {packages:?}");
    Ok(packages)
}

/// All Rust files in a folder and the folders within it, sorted.
///
/// # Errors
/// A folder that cannot be listed.
pub fn rust_files(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let (mut folders, mut files) = (vec![folder.to_owned()], Vec::new());
    while let Some(folder) = folders.pop() {
        for entry in folder.read_dir()? {
            let path = entry?.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(path);
            }
        }
    }
    files.sort();
    Ok(files)
}
