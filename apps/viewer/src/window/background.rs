//! Loading on its own thread, so that the window stays responsive and an abandoned load ends early.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::thread;

use trigon_io::Warning;
use trigon_window::Waker;

use crate::args::Request;
use crate::failure::Failure;
use crate::loading;
use crate::model::{Model, Source};

/// What a load ends with.
pub(super) type Outcome = Result<(Model, Vec<Warning>), Failure>;

/// What the two threads share.
#[derive(Default)]
struct Shared {
    cancelled: AtomicBool,
    percent: AtomicU32,
}

/// A load under way. Dropping it cancels it.
pub(super) struct Loading {
    shared: Arc<Shared>,
    outcome: Receiver<Outcome>,
}

impl Loading {
    /// Starts to load; `waker` is woken at every percent, and at the end.
    pub(super) fn start(source: Source, request: Request, waker: Waker) -> Self {
        let shared = Arc::new(Shared::default());
        let (sender, outcome) = channel();
        let theirs = Arc::clone(&shared);
        thread::spawn(move || {
            let outcome = request.for_source(&source).and_then(|request| {
                loading::load(&source, &request, &|fraction| theirs.follow(fraction, &waker))
            });
            // Nobody waits for it any more when this fails.
            let _ = sender.send(outcome);
            waker.wake();
        });
        Self { shared, outcome }
    }

    /// How far it is, 0 to 100.
    pub(super) fn percent(&self) -> u32 {
        self.shared.percent.load(Ordering::Relaxed)
    }

    /// What it ended with; `None` while it runs.
    pub(super) fn outcome(&self) -> Option<Outcome> {
        match self.outcome.try_recv() {
            Ok(outcome) => Some(outcome),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => {
                Some(Err(Failure::work("loading ended without a result; this is a bug in trigon")))
            }
        }
    }
}

impl Shared {
    fn follow(&self, fraction: f32, waker: &Waker) -> ControlFlow<()> {
        let percent = (fraction * 100.0) as u32;
        if self.percent.swap(percent, Ordering::Relaxed) != percent {
            waker.wake();
        }
        if self.cancelled.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

impl Drop for Loading {
    fn drop(&mut self) {
        self.shared.cancelled.store(true, Ordering::Relaxed);
    }
}
