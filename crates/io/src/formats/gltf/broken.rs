//! Errors in compressed data.

/// Why compressed data is invalid.
pub(crate) type Broken = &'static str;
