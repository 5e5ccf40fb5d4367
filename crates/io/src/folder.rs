//! The model's folder: the only place from which other files are opened.
//!
//! A model names its buffers, materials and textures. These names are untrusted:
//! `../../etc/passwd`, `/dev/zero`, `file:///…`, a symbolic link to another place. A name is
//! resolved inside the model's folder, and the result, with links followed, must still lie in it
//! and be a regular file; reading stops at a limit.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::options::Limits;
use super::refusal::is_lfs_pointer;
use crate::error::LoadError;
use crate::refusal::{Refusal, relative_path};
use crate::root::Root;

/// How exactly a name must match.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Lookup {
    /// Exactly: for buffers, whose bytes become geometry.
    Exact,
    /// Exactly, or otherwise with `\` as `/`, in another case, or by its last parts: for textures
    /// and material libraries named on another machine.
    Forgiving,
}

/// A file that was found and read.
#[derive(Debug)]
pub(crate) struct Found {
    pub(crate) bytes: Vec<u8>,
    pub(crate) path: PathBuf,
    /// Whether another spelling than the model's was used.
    pub(crate) respelled: bool,
}

/// Receives the fraction of a file that has been read, 0 to 1, and may cancel.
pub(crate) type Follow<'a> = &'a dyn Fn(f32) -> Result<(), Refusal>;

/// Ignores progress and never cancels.
pub(crate) fn to_the_end(_: f32) -> Result<(), Refusal> {
    Ok(())
}

/// A folder to read from, and a record of what was read.
#[derive(Debug)]
pub(crate) struct Folder {
    root: Root,
    /// The same folder as the caller named it, for messages and lists.
    shown: PathBuf,
    limits: Limits,
    total: u64,
    read: Vec<PathBuf>,
    known: HashSet<PathBuf>,
    /// The names in each folder that was searched, by their lower case: a model may lack thousands
    /// of images.
    listings: HashMap<PathBuf, HashMap<String, String>>,
}

impl Folder {
    /// The folder that contains a model.
    pub(crate) fn of(model: &Path, limits: &Limits) -> io::Result<Self> {
        let parent = model.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Ok(Self {
            root: Root::Disk(fs::canonicalize(parent)?),
            shown: model.parent().unwrap_or(parent).to_owned(),
            ..Self::none(limits)
        })
    }

    /// The folder that contains a model, among files in memory by their paths.
    pub(crate) fn in_memory(model: &Path, files: BTreeMap<String, Vec<u8>>, limits: &Limits) -> Self {
        let shown = model.parent().unwrap_or(Path::new("")).to_owned();
        Self { root: Root::in_memory(&shown, files), shown, ..Self::none(limits) }
    }

    /// No folder: every name is refused.
    pub(crate) fn none(limits: &Limits) -> Self {
        Self {
            root: Root::Nowhere,
            shown: PathBuf::new(),
            limits: limits.clone(),
            total: 0,
            read: Vec::new(),
            known: HashSet::new(),
            listings: HashMap::new(),
        }
    }

    /// Every file that was read, in order, without repetition.
    pub(crate) fn into_files(self) -> Vec<PathBuf> {
        self.read
    }

    /// Reads the file that the user named: the one path that is not confined. `follow` receives the
    /// fraction that has been read, 0 to 1, and may cancel.
    pub(crate) fn read_model(&mut self, path: &Path, follow: Follow<'_>) -> Result<Vec<u8>, LoadError> {
        let bytes = self.read_regular(path, follow).map_err(|refusal| refusal.of_model(path))?;
        self.note(path.to_owned());
        Ok(bytes)
    }

    /// The bytes of the file that the user named, from memory.
    pub(crate) fn accepted_model(&mut self, path: &Path, bytes: Vec<u8>) -> Result<Vec<u8>, LoadError> {
        let bytes = self.accepted(bytes).map_err(|refusal| refusal.of_model(path))?;
        self.note(path.to_owned());
        Ok(bytes)
    }

    /// Reads another file of the model, below `within` (a folder relative to the model's; empty for
    /// the model's own).
    pub(crate) fn read(&mut self, within: &Path, name: &str, lookup: Lookup) -> Result<Found, Refusal> {
        let mut refusal = match self.read_exact(within, name) {
            Ok(found) => return Ok(found),
            Err(refusal) => refusal,
        };
        if lookup == Lookup::Exact
            || refusal.is_of_a_file_that_is_there()
            || matches!(refusal, Refusal::NoFolder)
        {
            return Err(refusal);
        }
        for (within, spelling) in self.other_spellings(within, name) {
            match self.read_exact(&within, &spelling) {
                Ok(found) => return Ok(Found { respelled: true, ..found }),
                Err(found_but) if found_but.is_of_a_file_that_is_there() => refusal = found_but,
                Err(_) => {}
            }
        }
        Err(refusal)
    }

    /// The folder of a file that was read, relative to the model's.
    pub(crate) fn relative_folder(&self, file: &Path) -> PathBuf {
        let inside = file.strip_prefix(&self.shown).unwrap_or(Path::new(""));
        inside.parent().unwrap_or(Path::new("")).to_owned()
    }

    /// The path at which a name would be looked up.
    pub(crate) fn would_be(&self, within: &Path, name: &str) -> PathBuf {
        self.shown.join(within).join(name)
    }

    /// Every path at which [`Folder::read`] looks for a name, in order.
    pub(crate) fn tried(&mut self, within: &Path, name: &str) -> Vec<PathBuf> {
        let mut tried = vec![self.would_be(within, name)];
        for (within, spelling) in self.other_spellings(within, name) {
            let path = self.would_be(&within, &spelling);
            if !tried.contains(&path) {
                tried.push(path);
            }
        }
        tried
    }

    /// Counts bytes that did not come from a separate file.
    pub(crate) fn account(&mut self, bytes: u64) -> Result<(), Refusal> {
        self.total = self.total.saturating_add(bytes);
        if self.total > self.limits.total_bytes {
            Err(Refusal::TooLarge(self.total, self.limits.total_bytes))
        } else {
            Ok(())
        }
    }

    fn read_exact(&mut self, within: &Path, name: &str) -> Result<Found, Refusal> {
        let relative = |name| Ok(within.join(relative_path(name)?));
        let (bytes, path) = match &self.root {
            Root::Nowhere => return Err(Refusal::NoFolder),
            Root::Disk(root) => {
                let path = fs::canonicalize(root.join(relative(name)?)).map_err(Refusal::from_io)?;
                let inside = path.strip_prefix(root).map_err(|_| Refusal::Outside)?.to_owned();
                (self.read_regular(&path, &to_the_end)?, inside)
            }
            Root::Memory(files) => {
                let path = relative(name)?;
                let bytes = files.get(&path).ok_or(Refusal::Missing)?.clone();
                (self.accepted(bytes)?, path)
            }
        };
        let path = self.shown.join(path);
        self.note(path.clone());
        Ok(Found { bytes, path, respelled: false })
    }

    fn read_regular(&mut self, path: &Path, follow: Follow<'_>) -> Result<Vec<u8>, Refusal> {
        // Before opening: opening a FIFO would wait for a writer.
        if !fs::metadata(path).map_err(Refusal::from_io)?.is_file() {
            return Err(Refusal::NotAFile);
        }
        let file = File::open(path).map_err(Refusal::from_io)?;
        let length = file.metadata().map_err(Refusal::Read)?.len();
        let limit = self.limit();
        if length > limit {
            return Err(Refusal::TooLarge(length, limit));
        }
        // One more than the limit, to notice a file that grew.
        let bytes = read_in_pieces(file.take(limit.saturating_add(1)), length, follow)?;
        self.accepted(bytes)
    }

    /// Bytes that the next file may have.
    fn limit(&self) -> u64 {
        self.limits.file_bytes.min(self.limits.total_bytes.saturating_sub(self.total))
    }

    /// Counts the bytes of a file, unless they are too many, or are not the file itself.
    fn accepted(&mut self, bytes: Vec<u8>) -> Result<Vec<u8>, Refusal> {
        let (length, limit) = (bytes.len() as u64, self.limit());
        if length > limit {
            return Err(Refusal::TooLarge(length, limit));
        }
        self.total += length;
        if is_lfs_pointer(&bytes) { Err(Refusal::LfsPointer) } else { Ok(bytes) }
    }

    fn note(&mut self, path: PathBuf) {
        if self.known.insert(path.clone()) {
            self.read.push(path);
        }
    }

    /// Guesses at what the author meant. Every result is confined like the original.
    fn other_spellings(&mut self, within: &Path, name: &str) -> Vec<(PathBuf, String)> {
        // This many folders of another machine are tried as folders here.
        const MOST_PARTS: usize = 8;
        let slashed = name.replace('\\', "/");
        // `C:/models/textures/a.png` may be `textures/a.png` here, or `a.png`.
        let starts = slashed.rmatch_indices('/').map(|(at, _)| at + 1).take(MOST_PARTS);
        let mut ends: Vec<&str> = starts.map(|start| &slashed[start..]).chain([slashed.as_str()]).collect();
        ends.reverse();
        let mut list = Vec::new();
        for end in ends {
            list.push((within.to_owned(), end.to_owned()));
            list.extend(self.other_case(within, end).map(|found| (PathBuf::new(), found)));
        }
        list
    }

    /// The path below the root that differs from the name only in the case of
    /// its letters.
    fn other_case(&mut self, within: &Path, name: &str) -> Option<String> {
        let mut found = within.to_owned();
        for part in relative_path(name).ok()?.components() {
            let part = part.as_os_str().to_str()?.to_lowercase();
            let listing =
                self.listings.entry(found.clone()).or_insert_with_key(|folder| self.root.names(folder));
            found.push(listing.get(&part)?);
        }
        Some(found.to_str()?.to_owned())
    }
}

/// Reads to the end, checking for cancellation between pieces: a gigabyte takes a while.
fn read_in_pieces(mut from: impl Read, length: u64, follow: Follow<'_>) -> Result<Vec<u8>, Refusal> {
    const PIECE: u64 = 1 << 22;
    let mut bytes = Vec::with_capacity(usize::try_from(length).unwrap_or(0));
    while from.by_ref().take(PIECE).read_to_end(&mut bytes).map_err(Refusal::Read)? > 0 {
        follow(bytes.len() as f32 / length.max(1) as f32)?;
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::LoadErrorKind;

    fn folder_with(files: &[&str]) -> (tempfile::TempDir, Folder) {
        let dir = tempfile::tempdir().expect("a temporary folder");
        for file in files {
            let path = dir.path().join(file);
            fs::create_dir_all(path.parent().expect("below the folder")).expect("a folder");
            fs::write(path, file).expect("a file");
        }
        let folder = Folder::of(&dir.path().join("model.obj"), &Limits::default()).expect("it exists");
        (dir, folder)
    }

    fn read(folder: &mut Folder, name: &str, lookup: Lookup) -> Result<Found, Refusal> {
        folder.read(Path::new(""), name, lookup)
    }

    #[test]
    fn names_that_lead_away_are_refused() {
        let (_dir, mut folder) = folder_with(&["a.png"]);
        for name in [
            "/etc/passwd",
            "../a.png",
            "x/../../a.png",
            "C:\\a.txt",
            "file:///etc/passwd",
            "http://x/a",
            "",
            " ",
            "a\0b",
            "\\\\host\\a",
        ] {
            let refusal = read(&mut folder, name, Lookup::Exact).expect_err("refused");
            assert!(refusal.is_forbidden(), "{name:?}: {refusal}");
        }
    }

    #[test]
    fn the_same_names_do_not_get_out_through_forgiveness() {
        let (_dir, mut folder) = folder_with(&["a.png"]);
        for name in
            ["/etc/passwd", "../../etc/passwd", "..\\..\\etc\\passwd", "file:///etc/passwd", "/dev/zero"]
        {
            read(&mut folder, name, Lookup::Forgiving).expect_err(name);
        }
    }

    #[test]
    fn other_spellings_are_found_inside() {
        let (_dir, mut folder) = folder_with(&["textures/Wood.PNG", "plain.jpg"]);
        for name in [
            "textures\\Wood.PNG",
            "Textures/wood.png",
            "C:\\models\\plain.jpg",
            "/home/x/PLAIN.jpg",
            "C:\\models\\textures\\wood.png",
            "../textures/Wood.PNG",
        ] {
            let found = read(&mut folder, name, Lookup::Forgiving).expect(name);
            assert!(found.respelled, "{name} is not as written");
        }
        read(&mut folder, "textures/wood.png", Lookup::Exact).expect_err("exact means exact");
    }

    /// 10⁴ missing images in a folder of 10⁴ files took minutes when each was searched separately.
    #[test]
    fn a_folder_is_listed_once() {
        let (dir, mut folder) = folder_with(&["b.png", "B.png"]);
        read(&mut folder, "gone.png", Lookup::Forgiving).expect_err("missing");
        fs::write(dir.path().join("Gone.png"), "").expect("a file");
        read(&mut folder, "gone.png", Lookup::Forgiving).expect_err("the list is that of the first search");
    }

    #[cfg(unix)]
    #[test]
    fn links_out_devices_and_folders_are_refused() {
        let (dir, mut folder) = folder_with(&["sub/a.png"]);
        std::os::unix::fs::symlink("/etc", dir.path().join("out")).expect("a link");
        std::os::unix::fs::symlink("/dev/zero", dir.path().join("zero")).expect("a link");
        std::os::unix::fs::symlink("sub/a.png", dir.path().join("inside.png")).expect("a link");
        assert!(
            matches!(
                read(&mut folder, "out/hostname", Lookup::Exact),
                Err(Refusal::Outside | Refusal::Missing)
            ),
            "link to a folder"
        );
        assert!(
            matches!(read(&mut folder, "zero", Lookup::Exact), Err(Refusal::Outside)),
            "link to a device"
        );
        assert!(matches!(read(&mut folder, "sub", Lookup::Exact), Err(Refusal::NotAFile)), "a folder");
        assert_eq!(
            read(&mut folder, "inside.png", Lookup::Exact).expect("stays inside").bytes,
            b"sub/a.png",
            "its target"
        );
        let device =
            folder.read_model(Path::new("/dev/zero"), &to_the_end).expect_err("the model itself is a device");
        assert_eq!(device.kind, LoadErrorKind::Forbidden, "{device}");
        assert!(device.to_string().contains("it is not a regular file"), "{device}");
    }

    #[test]
    fn reading_stops_at_the_limits() {
        let dir = tempfile::tempdir().expect("a temporary folder");
        fs::write(dir.path().join("a"), [0; 100]).expect("a file");
        let limits = Limits { file_bytes: 99, ..Limits::default() };
        let mut folder = Folder::of(&dir.path().join("m"), &limits).expect("it exists");
        assert!(matches!(read(&mut folder, "a", Lookup::Exact), Err(Refusal::TooLarge(100, 99))), "one file");
        let limits = Limits { total_bytes: 150, ..Limits::default() };
        let mut folder = Folder::of(&dir.path().join("m"), &limits).expect("it exists");
        read(&mut folder, "a", Lookup::Exact).expect("the first fits");
        read(&mut folder, "a", Lookup::Exact).expect_err("the second does not");
    }
}
