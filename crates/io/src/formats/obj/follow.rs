//! Progress and cancellation while parts are built.

use crate::error::LoadError;

/// Is told which share of the elements has been built, and may end it.
pub(super) type Follow<'a> = &'a dyn Fn(f32) -> Result<(), LoadError>;

/// So many elements are built before [`Follow`] is asked again: some milliseconds.
pub(super) const STRIDE: usize = 1 << 17;
