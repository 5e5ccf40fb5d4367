//! Errors in compressed views.

/// Why a stream is invalid.
pub(crate) type Broken = &'static str;
