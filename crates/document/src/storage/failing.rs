//! An in-memory disk that records every step, can fail at one, and can lose unsynced data: for
//! testing saving and recovery.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use super::Storage;

/// One operation of a program.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Step {
    /// A file is truncated and then written, or appended to.
    Write {
        path: PathBuf,
        bytes: Vec<u8>,
        appends: bool,
    },
    Sync(PathBuf),
    Link {
        from: PathBuf,
        to: PathBuf,
    },
    Rename {
        from: PathBuf,
        to: PathBuf,
    },
    Remove(PathBuf),
    SyncFolder,
}

#[derive(Debug, Default)]
pub(crate) struct FailingDisk {
    log: Vec<Step>,
    fails_at: Option<usize>,
    dies_at: Option<usize>,
    has_failed: bool,
    has_no_links: bool,
}

/// The files by their names.
pub(crate) type Files = BTreeMap<PathBuf, Vec<u8>>;

impl FailingDisk {
    pub(crate) fn without_links() -> Self {
        Self { has_no_links: true, ..Self::default() }
    }

    pub(crate) fn log(&self) -> &[Step] {
        &self.log
    }

    /// The operation with this number fails without effect.
    pub(crate) fn fail_at(&mut self, step: usize) {
        self.fails_at = Some(step);
    }

    /// From the operation with this number on all fail without effect.
    pub(crate) fn die_at(&mut self, step: usize) {
        self.dies_at = Some(step);
    }

    /// Whether one has failed on request.
    pub(crate) fn has_failed(&self) -> bool {
        self.has_failed
    }

    /// A disk with these files, all synced.
    pub(crate) fn with_files(files: &Files) -> Self {
        let mut disk = Self::default();
        for (path, bytes) in files {
            disk.log.push(Step::Write { path: path.clone(), bytes: bytes.clone(), appends: false });
            disk.log.push(Step::Sync(path.clone()));
        }
        disk.log.push(Step::SyncFolder);
        disk
    }

    pub(crate) fn files(&self) -> Files {
        DiskState::after(&self.log).visible()
    }

    fn step(&mut self, step: Step) -> io::Result<()> {
        let is_dead = self.dies_at.is_some_and(|step| self.log.len() >= step);
        if is_dead || self.fails_at == Some(self.log.len()) {
            self.fails_at = None;
            self.has_failed = true;
            return Err(io::Error::other("the disk is full"));
        }
        self.log.push(step);
        Ok(())
    }

    fn require(&self, path: &Path) -> io::Result<()> {
        self.read(path).map(drop)
    }
}

impl Storage for FailingDisk {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        self.files().remove(path).ok_or_else(|| io::ErrorKind::NotFound.into())
    }

    fn exists(&self, path: &Path) -> bool {
        self.files().contains_key(path)
    }

    fn create(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        if self.exists(path) {
            return Err(io::ErrorKind::AlreadyExists.into());
        }
        self.step(Step::Write { path: path.into(), bytes: bytes.into(), appends: false })
    }

    fn append(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        self.step(Step::Write { path: path.into(), bytes: bytes.into(), appends: true })
    }

    fn sync(&mut self, path: &Path) -> io::Result<()> {
        self.require(path)?;
        self.step(Step::Sync(path.into()))
    }

    fn link(&mut self, from: &Path, to: &Path) -> io::Result<()> {
        self.require(from)?;
        if self.has_no_links || self.exists(to) {
            return Err(io::ErrorKind::Unsupported.into());
        }
        self.step(Step::Link { from: from.into(), to: to.into() })
    }

    fn rename(&mut self, from: &Path, to: &Path) -> io::Result<()> {
        self.require(from)?;
        self.step(Step::Rename { from: from.into(), to: to.into() })
    }

    fn remove(&mut self, path: &Path) -> io::Result<()> {
        self.require(path)?;
        self.step(Step::Remove(path.into()))
    }

    fn sync_folder(&mut self, _: &Path) -> io::Result<()> {
        self.step(Step::SyncFolder)
    }
}

/// The contents of a disk: files by number, and the names that refer to them.
#[derive(Debug, Clone, Default)]
struct DiskState {
    /// For each file its current and its synced contents.
    files: Vec<(Vec<u8>, Vec<u8>)>,
    names: BTreeMap<PathBuf, usize>,
    /// The names as of the last sync of the folder, and the changes since.
    synced_names: BTreeMap<PathBuf, usize>,
    unsynced: Vec<NameChange>,
}

/// A change of names that a crash may lose.
#[derive(Debug, Clone)]
enum NameChange {
    Add(PathBuf, usize),
    Move(PathBuf, PathBuf),
    Remove(PathBuf),
}

impl DiskState {
    fn after(log: &[Step]) -> Self {
        let mut state = Self::default();
        log.iter().for_each(|step| state.apply(step));
        state
    }

    fn apply(&mut self, step: &Step) {
        match step {
            Step::Write { path, bytes, appends } => {
                let file = match self.names.get(path) {
                    Some(&file) => file,
                    None => {
                        self.files.push(Default::default());
                        let file = self.files.len() - 1;
                        self.change(NameChange::Add(path.clone(), file));
                        file
                    }
                };
                let contents = &mut self.files[file].0;
                if !appends {
                    contents.clear();
                }
                contents.extend(bytes);
            }
            Step::Sync(path) => {
                let (contents, synced) = &mut self.files[self.names[path]];
                synced.clone_from(contents);
            }
            Step::Link { from, to } => self.change(NameChange::Add(to.clone(), self.names[from])),
            Step::Rename { from, to } => self.change(NameChange::Move(from.clone(), to.clone())),
            Step::Remove(path) => self.change(NameChange::Remove(path.clone())),
            Step::SyncFolder => {
                self.synced_names.clone_from(&self.names);
                self.unsynced.clear();
            }
        }
    }

    fn change(&mut self, change: NameChange) {
        change.apply(&mut self.names);
        self.unsynced.push(change);
    }

    /// What a running program sees.
    fn visible(&self) -> Files {
        self.names.iter().map(|(name, &file)| (name.clone(), self.files[file].0.clone())).collect()
    }
}

impl NameChange {
    fn apply(&self, names: &mut BTreeMap<PathBuf, usize>) {
        match self {
            Self::Add(path, file) => drop(names.insert(path.clone(), *file)),
            Self::Move(from, to) => {
                if let Some(file) = names.remove(from) {
                    names.insert(to.clone(), file);
                }
            }
            Self::Remove(path) => drop(names.remove(path)),
        }
    }
}

/// The states that a crash after these steps can leave: of the changes of names since the last sync
/// of the folder, any number of the first ones were done; of unsynced contents there is nothing,
/// half, all, or something else of the same length.
pub(crate) fn crashes(log: &[Step]) -> Vec<Files> {
    let state = DiskState::after(log);
    let mut results = Vec::new();
    for done in 0..=state.unsynced.len() {
        let mut names = state.synced_names.clone();
        state.unsynced[..done].iter().for_each(|change| change.apply(&mut names));
        for damage in 0..4 {
            let contents = |file: usize| {
                let (now, synced) = &state.files[file];
                if now == synced {
                    return now.clone();
                }
                let is_longer = now.starts_with(synced);
                let half = if is_longer { (synced.len() + now.len()) / 2 } else { now.len() / 2 };
                match damage {
                    0 => synced.clone(),
                    1 => now[..half].to_vec(),
                    2 => now.clone(),
                    _ => {
                        let kept = if is_longer { synced.len() } else { 0 };
                        let mut torn = now.clone();
                        torn[kept..].iter_mut().for_each(|byte| *byte ^= 0xa5);
                        torn
                    }
                }
            };
            results.push(names.iter().map(|(name, &file)| (name.clone(), contents(file))).collect());
        }
    }
    results
}
