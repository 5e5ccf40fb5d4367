//! Numbers for states of documents: data computed from a state is valid as long as its number is the same.

use std::sync::atomic::{AtomicU64, Ordering};

/// A number that no document of this program had before.
pub(crate) fn next_revision() -> u64 {
    static LAST: AtomicU64 = AtomicU64::new(0);
    LAST.fetch_add(1, Ordering::Relaxed) + 1
}
