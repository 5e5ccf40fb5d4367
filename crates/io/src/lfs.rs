//! Git LFS pointers: three lines of text that stand in a repository for a large file, until it is fetched.

/// What helps.
pub(crate) const REMEDY: &str = "fetch the real file with `git lfs pull`";

/// How a pointer begins: with the address of its specification, or with the one of the time before its release.
const STARTS: [&[u8]; 2] = [b"version https://git-lfs", b"version https://hawser"];

/// Whether a file is a pointer, whatever its name says.
pub(crate) fn is_lfs_pointer(bytes: &[u8]) -> bool {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    STARTS.iter().any(|start| text.starts_with(start))
}
