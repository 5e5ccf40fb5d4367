//! Which outputs a frame is to have.

use crate::fragments::Encoding;

/// What a frame is to leave behind.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) struct RequestedOutputs {
    pub(crate) color: bool,
    pub(crate) depth: bool,
    pub(crate) ids: bool,
    /// The encoding, if bytes of one kind are the only output of colour and there is no
    /// supersampling.
    pub(crate) bytes: Option<Encoding>,
}
