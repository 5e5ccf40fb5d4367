//! Ending a drawing before it is done.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Ends drawings early, from any thread. Clones are the same token; once cancelled
/// it stays so.
#[derive(Clone, Debug, Default)]
pub struct Cancel(Arc<AtomicBool>);

impl Cancel {
    /// Drawings that were given this token end: a worker finishes its tile, or a few
    /// thousand vertices or triangles, and begins no other.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether [`cancel`](Self::cancel) was called.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
