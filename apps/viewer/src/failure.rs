//! Why a command failed, by exit code.

use thiserror::Error;

/// Why a command ended early.
#[derive(Debug, Error)]
pub(crate) enum Failure {
    /// The flags make no sense for this model: exit code 2.
    #[error("{0}")]
    Usage(String),
    /// A correct file with nothing to draw: exit code 1.
    #[error("{0}")]
    Empty(String),
    /// An image is not the one that it should be: exit code 3.
    #[error("{0}")]
    Mismatch(String),
    /// Something could not be done: exit code 1.
    #[error("{0}")]
    Work(Box<dyn std::error::Error + Send + Sync>),
    /// Some images failed, of which everything has been said: their worst exit code.
    #[error("some images failed")]
    Reported(u8),
}

impl Failure {
    /// Something could not be done; `what` says which file, why, and the remedy.
    pub(crate) fn work(what: impl Into<Box<dyn std::error::Error + Send + Sync>>) -> Self {
        Self::Work(what.into())
    }

    /// The exit code that `--help` promises.
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::Work(_) | Self::Empty(_) => 1,
            Self::Usage(_) => 2,
            Self::Mismatch(_) => 3,
            Self::Reported(code) => *code,
        }
    }
}
