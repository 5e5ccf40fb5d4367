//! Loading on a thread of its own, so that the window stays alive and a load that nobody waits for any more ends
//! early.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::thread;

use trigon_edit::Document;
use trigon_io::{LoadOptions, Warning};

/// What a load ends with: a document, or why there is none.
pub(crate) type Outcome = Result<(Document, Vec<Warning>), String>;

/// A load under way. Dropping it cancels it.
#[derive(Debug)]
pub(crate) struct Loading {
    pub(crate) path: PathBuf,
    outcome: Receiver<Outcome>,
    is_cancelled: Arc<AtomicBool>,
}

impl Loading {
    /// Starts to load; `wake` is called at the end.
    pub(crate) fn start(path: PathBuf, wake: impl FnOnce() + Send + 'static) -> Self {
        let is_cancelled = Arc::new(AtomicBool::new(false));
        let (sender, outcome) = channel();
        let (theirs, file) = (Arc::clone(&is_cancelled), path.clone());
        thread::spawn(move || {
            // Nobody waits for it any more when this fails.
            drop(sender.send(load(&file, &theirs)));
            wake();
        });
        Self { path, outcome, is_cancelled }
    }

    /// What it ended with; `None` while it runs.
    pub(crate) fn outcome(&self) -> Option<Outcome> {
        match self.outcome.try_recv() {
            Ok(outcome) => Some(outcome),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err(NO_RESULT.into())),
        }
    }

    /// The same, once it is there.
    #[cfg(test)]
    pub(crate) fn wait(&self) -> Outcome {
        self.outcome.recv().unwrap_or_else(|_| Err(NO_RESULT.into()))
    }
}

const NO_RESULT: &str = "loading ended without a result; this is a defect of trigon";

fn load(path: &Path, is_cancelled: &AtomicBool) -> Outcome {
    let follow = |_| match is_cancelled.load(Ordering::Relaxed) {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    };
    let options = LoadOptions { progress: Some(&follow), ..LoadOptions::default() };
    Document::open(path, &options).map_err(|error| error.to_string())
}

impl Drop for Loading {
    fn drop(&mut self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
    }
}
