//! Reading ahead.

use std::hint::black_box;

/// Reads values that are needed soon, from places all over the memory. A processor waits for many of them at once if
/// nothing else is done meanwhile, and finds them nearby afterwards; one after the other, each would take as long.
pub(crate) fn prefetch(values: impl Iterator<Item = u32>) {
    black_box(values.fold(0, |all, value| all ^ value));
}
