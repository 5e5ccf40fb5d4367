//! How much decoding may cost.

use super::failure::Failure;

/// A word is about what one number of a mesh takes, in memory or in time. Meshes that were
/// exported take 5 to 30 words per byte of their stream; large flat grids take up to 200.
const WORDS_PER_BYTE: u64 = 256;

/// The allowance for small files: 512 MiB.
const WORDS_ALWAYS: u64 = 1 << 27;

/// Counts what decoding costs, in words of four bytes. All meshes of a file share one, since a
/// file may refer to the same few bytes thousands of times.
#[derive(Default)]
pub(crate) struct Budget {
    spent: u64,
    limit: u64,
}

impl Budget {
    /// Sets the limit to what a file of some size may cost.
    pub(crate) fn allow(&mut self, file_bytes: usize) {
        self.limit = (file_bytes as u64).saturating_mul(WORDS_PER_BYTE).max(WORDS_ALWAYS);
    }

    /// Counts words that are about to be allocated or visited.
    pub(super) fn spend(&mut self, words: usize) -> Result<(), Failure> {
        self.spent = self.spent.saturating_add(words as u64);
        if self.spent <= self.limit { Ok(()) } else { Err(Failure::TooLarge) }
    }
}
