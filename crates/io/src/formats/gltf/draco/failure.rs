//! Why a mesh is not decoded.

use crate::formats::gltf::broken::Broken;

/// Why a mesh is not decoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Failure {
    /// The stream is invalid.
    Broken(Broken),
    /// It is of a kind that is not read.
    Foreign(&'static str),
    /// It stands for more than the [`Budget`](super::Budget) allows.
    TooLarge,
}

impl From<Broken> for Failure {
    fn from(broken: Broken) -> Self {
        Self::Broken(broken)
    }
}
