//! Loading and saving on threads of their own, so that the window stays responsive. An abandoned load ends
//! early; the document is written as it was when saving began.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use trigon_document::{Document, DocumentFile, Storage, save};
use trigon_io::{LoadOptions, Loaded, Progress, UpAxis, Warning, load};

use super::background::Background;
use super::file_version::FileVersion;
use super::open_file::Next;

/// What becomes of the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LoadPurpose {
    /// It takes the place of the document.
    Open,
    /// What it holds is added to the document.
    Import,
}

/// What a load ends with, if it ends well.
#[derive(Debug)]
pub(crate) enum Found {
    Document(Box<Document>, Vec<Warning>),
    Import(Box<Loaded>),
}

/// What a load ends with, or why there is nothing.
pub(crate) type Outcome = Result<Found, String>;

/// A load under way. Dropping it cancels it.
#[derive(Debug)]
pub(crate) struct Loading {
    pub(crate) path: PathBuf,
    /// What was on the disk before it was read.
    pub(crate) version: Option<FileVersion>,
    purpose: LoadPurpose,
    work: Background<Found>,
    state: Arc<State>,
}

/// What both threads know.
#[derive(Debug, Default)]
struct State {
    is_cancelled: AtomicBool,
    percent: AtomicU32,
}

impl Loading {
    /// Starts to load, with this axis up in the file or that of its format; `wake` is called at the end, and when there is progress to be shown.
    pub(crate) fn start(
        path: PathBuf,
        purpose: LoadPurpose,
        up: Option<UpAxis>,
        wake: impl Fn() + Send + Sync + 'static,
    ) -> Self {
        let state = Arc::new(State::default());
        let version = FileVersion::of(&path);
        let (theirs, file, wake) = (Arc::clone(&state), path.clone(), Arc::new(wake));
        let at_end = Arc::clone(&wake);
        let read = move || {
            let options = LoadOptions { up, ..LoadOptions::default() };
            read(&file, purpose, options, &theirs, &*wake)
        };
        let work = Background::start(read, move || at_end(), NO_RESULT);
        Self { path, version, purpose, work, state }
    }

    /// What it ended with; `None` while it runs.
    pub(crate) fn outcome(&self) -> Option<Outcome> {
        self.work.result()
    }

    /// What is being done, for people.
    pub(crate) fn text(&self) -> String {
        let doing = match self.purpose {
            LoadPurpose::Open => "Opening",
            LoadPurpose::Import => "Importing",
        };
        format!("{doing} {}: {} %", self.path.display(), self.state.percent.load(Ordering::Relaxed))
    }

    /// What it ended with, once that is there.
    #[cfg(test)]
    pub(crate) fn wait(&self) -> Outcome {
        self.work.wait()
    }
}

const NO_RESULT: &str = "loading ended without a result; this is a bug in trigon";

fn read(
    path: &Path,
    purpose: LoadPurpose,
    options: LoadOptions<'_>,
    state: &State,
    wake: &(impl Fn() + Sync),
) -> Outcome {
    let follow = |progress: Progress| {
        if state.is_cancelled.load(Ordering::Relaxed) {
            return ControlFlow::Break(());
        }
        let percent = (progress.fraction * 100.0) as u32;
        if state.percent.swap(percent, Ordering::Relaxed) != percent {
            wake();
        }
        ControlFlow::Continue(())
    };
    let options = LoadOptions { progress: Some(&follow), ..options };
    let found = match purpose {
        LoadPurpose::Open => Document::open(path, &options)
            .map(|(document, warnings)| Found::Document(Box::new(document), warnings)),
        LoadPurpose::Import => load(path, &options).map(|loaded| Found::Import(Box::new(loaded))),
    };
    found.map_err(|error| error.to_string())
}

impl Drop for Loading {
    fn drop(&mut self) {
        self.state.is_cancelled.store(true, Ordering::Relaxed);
    }
}

/// What is to be saved where, and what follows.
#[derive(Debug)]
pub(crate) struct SaveOrder {
    pub(crate) path: PathBuf,
    /// Whether somebody was asked about what the file will not hold.
    pub(crate) accepts_losses: bool,
    /// Whether what another program has written there is replaced.
    pub(crate) overwrites: bool,
    /// What follows once it is saved.
    pub(crate) next: Option<Next>,
}

/// How a save ended.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Saved {
    Written,
    /// Nothing was written, as the file would not hold this.
    WouldLose(Vec<String>),
    /// Why nothing was written.
    Failed(String),
}

/// A save under way.
#[derive(Debug)]
pub(crate) struct Saving {
    pub(crate) order: SaveOrder,
    work: Background<Saved>,
}

impl Saving {
    /// Starts to save; `wake` is called at the end.
    pub(crate) fn start(
        order: SaveOrder,
        document: DocumentFile,
        mut storage: Box<dyn Storage + Send>,
        wake: impl FnOnce() + Send + 'static,
    ) -> Self {
        let (path, accepts_losses) = (order.path.clone(), order.accepts_losses);
        let write = move || write(&document, &path, accepts_losses, &mut *storage);
        Self { order, work: Background::start(write, wake, NO_SAVING_RESULT) }
    }

    /// What it ended with; `None` while it runs.
    pub(crate) fn outcome(&self) -> Option<Saved> {
        self.work.result().map(|saved| saved.unwrap_or_else(Saved::Failed))
    }

    /// The same, once it is there.
    #[cfg(test)]
    pub(crate) fn wait(&self) -> Saved {
        self.work.wait().unwrap_or_else(Saved::Failed)
    }
}

const NO_SAVING_RESULT: &str = "saving ended without a result; this is a bug in trigon";

fn write(
    document: &DocumentFile,
    path: &Path,
    accepts_losses: bool,
    storage: &mut dyn Storage,
) -> Result<Saved, String> {
    let native = document.to_native();
    let file = native.encode().map_err(|error| error.to_string())?;
    let losses = file.what_would_be_lost();
    if !losses.is_empty() && !accepts_losses {
        return Ok(Saved::WouldLose(losses.iter().map(ToString::to_string).collect()));
    }
    save(storage, path, &file.to_bytes()).map_err(|error| error.to_string())?;
    Ok(Saved::Written)
}
