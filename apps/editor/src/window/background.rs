//! Work on a thread of its own, so that the window stays responsive.

use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::thread;

/// Work under way. Dropping it leaves the work alone; nobody gets its result then.
#[derive(Debug)]
pub(crate) struct Background<T> {
    result: Receiver<Result<T, String>>,
    without_result: &'static str,
}

impl<T: Send + 'static> Background<T> {
    /// Starts some work; `wake` is called at its end. `without_result` is what is said if it ends without a result, as
    /// when the system has no thread left.
    pub(crate) fn start(
        work: impl FnOnce() -> Result<T, String> + Send + 'static,
        wake: impl FnOnce() + Send + 'static,
        without_result: &'static str,
    ) -> Self {
        let (sender, result) = channel();
        let begun = thread::Builder::new().spawn(move || {
            // Nobody waits for it any more when this fails.
            drop(sender.send(work()));
            wake();
        });
        // Without a thread the sender is gone, which `result` finds.
        drop(begun);
        Self { result, without_result }
    }

    /// What it ended with; `None` while it goes on.
    pub(crate) fn result(&self) -> Option<Result<T, String>> {
        match self.result.try_recv() {
            Ok(result) => Some(result),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err(self.without_result.into())),
        }
    }

    /// The same, once it is there.
    #[cfg(test)]
    pub(crate) fn wait(&self) -> Result<T, String> {
        self.result.recv().unwrap_or_else(|_| Err(self.without_result.into()))
    }
}
