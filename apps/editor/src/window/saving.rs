//! Saving on its own thread. The document is written as it was when saving began; the window continues
//! meanwhile, and closing the document waits.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::thread;

use trigon_document::{DocumentFile, Storage, save};

use super::open_file::Next;

/// What is to be saved where, and what follows.
#[derive(Debug)]
pub(crate) struct SaveOrder {
    pub(crate) path: PathBuf,
    /// Whether somebody was asked about what the file will not hold.
    pub(crate) accepts_losses: bool,
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
    outcome: Receiver<Saved>,
}

impl Saving {
    /// Starts to save; `wake` is called at the end.
    pub(crate) fn start(
        order: SaveOrder,
        document: DocumentFile,
        mut storage: Box<dyn Storage + Send>,
        wake: impl FnOnce() + Send + 'static,
    ) -> Self {
        let (sender, outcome) = channel();
        let (path, accepts_losses) = (order.path.clone(), order.accepts_losses);
        thread::spawn(move || {
            let written = write(&document, &path, accepts_losses, &mut *storage);
            // Nobody waits for it any more when this fails.
            drop(sender.send(written.unwrap_or_else(Saved::Failed)));
            wake();
        });
        Self { order, outcome }
    }

    /// What it ended with; `None` while it runs.
    pub(crate) fn outcome(&self) -> Option<Saved> {
        match self.outcome.try_recv() {
            Ok(outcome) => Some(outcome),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Saved::Failed(NO_RESULT.into())),
        }
    }

    /// The same, once it is there.
    #[cfg(test)]
    pub(crate) fn wait(&self) -> Saved {
        self.outcome.recv().unwrap_or_else(|_| Saved::Failed(NO_RESULT.into()))
    }
}

const NO_RESULT: &str = "saving ended without a result; this is a bug in trigon";

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
