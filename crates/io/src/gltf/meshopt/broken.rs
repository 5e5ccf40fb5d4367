//! What is wrong with a compressed view.

/// Why a stream is none.
pub(crate) type Broken = &'static str;
