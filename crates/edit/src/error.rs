//! Why a command did nothing.

use thiserror::Error;
use trigon_mesh::edit::Refusal;
use trigon_scene::SceneError;

/// Why a command was refused. The document is as it was before.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum EditError {
    /// There is no object of this name or number.
    #[error(
        "there is no object {0}; `trigon-editor --run` takes names as the outliner shows them, or numbers"
    )]
    NoSuchObject(String),
    /// There is no material of this name or number.
    #[error("there is no material {0}; the properties of an object list its materials")]
    NoSuchMaterial(String),
    /// A picture cannot be used: why.
    #[error("{0}")]
    Texture(String),
    /// A file cannot be read: why.
    #[error("{0}")]
    Import(String),
    /// The command needs something selected.
    #[error("{command} needs {needed}: select first")]
    NothingSelected {
        /// The command's name.
        command: &'static str,
        /// What it needs, as "at least one face".
        needed: &'static str,
    },
    /// The command is one of edit mode.
    #[error("{0} works on the elements of a mesh: enter edit mode first")]
    NotEditing(&'static str),
    /// The command is one of object mode.
    #[error("{0} works on whole objects: leave edit mode first")]
    Editing(&'static str),
    /// An operation on a mesh was refused.
    #[error(transparent)]
    Mesh(#[from] Refusal),
    /// A change of the scene was refused.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// There is nothing to undo, to do again, to repeat or to adjust.
    #[error("there is nothing to {0}")]
    Nothing(&'static str),
    /// A script is not one.
    #[error("{place}: {what}")]
    Script {
        /// Which command, or which line.
        place: String,
        /// What is wrong, and what is expected.
        what: String,
    },
}
