//! Paths as lines of text files, whatever their names contain.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use percent_encoding::{AsciiSet, CONTROLS, percent_decode_str, percent_encode};

/// Line breaks and the escape itself.
const ESCAPED: &AsciiSet = &CONTROLS.add(b'%');

/// An absolute path as a line of UTF-8, for files that are read in other folders, too. Line breaks, percent signs and
/// what is not UTF-8 are written as in addresses: `%0A`, `%25`.
#[must_use]
pub fn path_to_line(path: &Path) -> String {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let name = path.as_os_str().as_encoded_bytes();
    match std::str::from_utf8(name) {
        // Letters stay as they are, so that the list can be read.
        Ok(text) => text.chars().map(escaped).collect(),
        Err(_) => percent_encode(name, ESCAPED).to_string(),
    }
}

fn escaped(letter: char) -> String {
    let mut bytes = [0; 4];
    match letter.encode_utf8(&mut bytes).as_bytes() {
        [byte] => percent_encode(&[*byte], ESCAPED).to_string(),
        _ => letter.to_string(),
    }
}

/// The path that [`path_to_line`] wrote.
#[must_use]
pub fn path_from_line(line: &str) -> PathBuf {
    let bytes: Vec<u8> = percent_decode_str(line).collect();
    from_bytes(&bytes)
}

#[cfg(unix)]
fn from_bytes(bytes: &[u8]) -> PathBuf {
    use std::os::unix::ffi::OsStrExt;
    OsStr::from_bytes(bytes).into()
}

/// Names that are no Unicode are not found again on other systems.
#[cfg(not(unix))]
fn from_bytes(bytes: &[u8]) -> PathBuf {
    OsStr::new(&*String::from_utf8_lossy(bytes)).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_one_line_and_comes_back() {
        for name in
            ["/models/a chair.glb", "/Stühle/椅子.glb", "/100%/a%20b.glb", "/two\nlines\r.glb", "/\u{7f}\t"]
        {
            let line = path_to_line(Path::new(name));
            assert_eq!(line.lines().count(), 1, "{line}");
            assert_eq!(path_from_line(&line), Path::new(name), "{line}");
        }
        assert_eq!(path_to_line(Path::new("/Stühle/a b.glb")), "/Stühle/a b.glb", "it can be read");
        let relative = path_from_line(&path_to_line(Path::new("chair.glb")));
        assert_eq!(relative, std::env::current_dir().expect("a folder").join("chair.glb"), "from any folder");
    }

    #[cfg(unix)]
    #[test]
    fn names_that_are_not_utf8_come_back() {
        use std::os::unix::ffi::OsStrExt;
        let name = Path::new(OsStr::from_bytes(b"/models/caf\xe9 %\n.glb"));
        let line = path_to_line(name);
        assert_eq!(line, "/models/caf%E9 %25%0A.glb", "as in addresses");
        assert_eq!(path_from_line(&line), name);
    }
}
