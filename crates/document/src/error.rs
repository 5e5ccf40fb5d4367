//! Why a command failed.

use thiserror::Error;
use trigon_modelling::Refusal;
use trigon_scene::SceneError;

/// Why a command failed. The document is unchanged.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum EditError {
    /// No object has this name or number.
    #[error(
        "there is no object {0}; `trigon-editor --run` takes names as the outliner shows them, or numbers"
    )]
    NoSuchObject(String),
    /// No material has this name or number.
    #[error("there is no material {0}; the properties of an object list its materials")]
    NoSuchMaterial(String),
    /// An image cannot be used; the reason.
    #[error("{0}")]
    Texture(String),
    /// A file cannot be read; the reason.
    #[error("{0}")]
    Import(String),
    /// What is selected cannot be copied; the reason.
    #[error("{0}")]
    Copy(String),
    /// The command needs something selected.
    #[error("{command} needs {needed}: select first")]
    NothingSelected {
        /// The command's name.
        command: &'static str,
        /// What is required, as "at least one face".
        needed: &'static str,
    },
    /// The command needs edit mode.
    #[error("{0} works on the elements of a mesh: enter edit mode first")]
    NotEditing(&'static str),
    /// The command needs object mode.
    #[error("{0} works on whole objects: leave edit mode first")]
    Editing(&'static str),
    /// An object would be placed or scaled by a number that no file holds.
    #[error(
        "object \"{0}\" would be placed or scaled beyond 3.4e38, the largest number of a coordinate: use a smaller value"
    )]
    Overflow(String),
    /// A mesh operation failed because of one of several objects.
    #[error("object \"{name}\": {refusal}")]
    OfObject {
        /// The object's name.
        name: String,
        /// The reason.
        refusal: Refusal,
    },
    /// A mesh operation failed.
    #[error(transparent)]
    Mesh(#[from] Refusal),
    /// A change of the scene failed.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// There is nothing to undo, redo, repeat or adjust.
    #[error("there is nothing to {0}")]
    Nothing(&'static str),
    /// A script is invalid.
    #[error("{position}: {what}")]
    Script {
        /// The command or the line.
        position: String,
        /// What is wrong, and what is expected.
        what: String,
    },
}
