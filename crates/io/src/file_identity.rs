//! Whether two names are the same file: links, relative paths and other spellings of a name lead to one file.

use std::io;
use std::path::Path;

/// What a file is, whatever names it has. While the file exists, no other one is equal.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct FileIdentity(Identity);

/// The device and the number of the file on it.
#[cfg(unix)]
type Identity = [u64; 2];

/// The path without links: a second name of the same file is not recognized.
#[cfg(not(unix))]
type Identity = std::path::PathBuf;

impl FileIdentity {
    /// Of the file that a path leads to.
    ///
    /// # Errors
    /// There is none, or an error of the operating system.
    pub fn of(path: &Path) -> io::Result<Self> {
        identity(path).map(Self)
    }
}

#[cfg(unix)]
fn identity(path: &Path) -> io::Result<Identity> {
    use std::os::unix::fs::MetadataExt;
    let metadata = std::fs::metadata(path)?;
    Ok([metadata.dev(), metadata.ino()])
}

#[cfg(not(unix))]
fn identity(path: &Path) -> io::Result<Identity> {
    std::fs::canonicalize(path)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn all_names_of_a_file_are_one_identity() {
        let dir = tempfile::tempdir().expect("a temporary folder");
        let at = |name: &str| dir.path().join(name);
        fs::create_dir(at("folder")).expect("a folder");
        fs::write(at("a"), "same").expect("a file");
        fs::write(at("b"), "same").expect("a file");
        let identity = |name: &str| FileIdentity::of(&at(name)).expect("it is there");
        assert_ne!(identity("a"), identity("b"), "equal contents are no identity");
        assert_eq!(identity("a"), identity("folder/../a"), "another way there");
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("../a", at("folder/link")).expect("a link");
            fs::hard_link(at("a"), at("folder/second")).expect("a second name");
            assert_eq!(identity("a"), identity("folder/link"), "through a link");
            assert_eq!(identity("a"), identity("folder/second"), "by another name");
        }
        FileIdentity::of(&at("c")).expect_err("nothing is there");
    }
}
