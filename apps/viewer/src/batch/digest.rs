//! What a file holds, in short: its length and its SHA-256, as `sha256sum` writes it.

use std::collections::HashMap;
use std::fmt::Write;
use std::fs::{File, Metadata};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// What a file held.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct FileDigest {
    /// Its name, as the job has it.
    pub(super) file: String,
    pub(super) bytes: u64,
    /// 64 hexadecimal digits.
    pub(super) sha256: String,
}

/// Digests of models and their textures, which many jobs read.
#[derive(Default)]
pub(super) struct InputDigests(HashMap<PathBuf, Known>);

/// A digest, and the file as it was then.
struct Known {
    modified: Option<SystemTime>,
    digest: FileDigest,
}

impl FileDigest {
    /// Of a file that is stored at a path under this name.
    pub(super) fn of(path: &Path, name: &Path) -> io::Result<Self> {
        let (mut file, mut sha, mut bytes) = (File::open(path)?, Sha256::new(), 0);
        let mut buffer = vec![0; 1 << 16];
        loop {
            let read = file.read(&mut buffer)?;
            if read == 0 {
                break;
            }
            sha.update(&buffer[..read]);
            bytes += read as u64;
        }
        Ok(Self { file: name.to_string_lossy().into_owned(), bytes, sha256: hexadecimal(sha) })
    }

    /// Whether the file is there and holds the same.
    pub(super) fn is_current(&self) -> bool {
        let path = Path::new(&self.file);
        let has_length = path.metadata().is_ok_and(|metadata| metadata.len() == self.bytes);
        has_length && Self::of(path, path).is_ok_and(|now| now == *self)
    }
}

impl InputDigests {
    /// Whether a file that was read is there and holds the same.
    pub(super) fn is_current(&mut self, read: &FileDigest) -> bool {
        self.of(Path::new(&read.file)).is_ok_and(|now| now == *read)
    }

    /// Of a file that is read again only if it has changed.
    pub(super) fn of(&mut self, path: &Path) -> io::Result<FileDigest> {
        let metadata = path.metadata()?;
        let modified = metadata.modified().ok();
        if let Some(known) = self.0.get(path).filter(|known| known.is_still(&metadata)) {
            return Ok(known.digest.clone());
        }
        let digest = FileDigest::of(path, path)?;
        self.0.insert(path.to_owned(), Known { modified, digest: digest.clone() });
        Ok(digest)
    }
}

impl Known {
    fn is_still(&self, metadata: &Metadata) -> bool {
        self.modified.is_some()
            && metadata.modified().ok() == self.modified
            && metadata.len() == self.digest.bytes
    }
}

/// The SHA-256 of a text.
pub(super) fn text_digest(text: &str) -> String {
    hexadecimal(Sha256::new_with_prefix(text))
}

fn hexadecimal(sha: Sha256) -> String {
    sha.finalize().iter().fold(String::new(), |mut text, byte| {
        // Writing to a string does not fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The vectors of FIPS 180-4.
    #[test]
    fn digests_are_those_of_the_standard() {
        assert_eq!(text_digest(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
        assert_eq!(text_digest("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a");
        std::fs::write(&path, "abc".repeat(100_000)).expect("written");
        let digest = FileDigest::of(&path, &path).expect("a file");
        assert_eq!(
            (digest.bytes, &digest.sha256),
            (300_000, &text_digest(&"abc".repeat(100_000))),
            "in parts"
        );
        assert!(digest.is_current(), "nothing has changed");
        std::fs::write(&path, "abd".repeat(100_000)).expect("written");
        assert!(!digest.is_current(), "the same length, other bytes");
        std::fs::remove_file(&path).expect("removed");
        assert!(!digest.is_current(), "it is gone");
    }
}
