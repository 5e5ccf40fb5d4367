//! An open, editable document: a scene, selections, commands as data, exact history, scripts.
//!
//! This crate never draws and never opens a window: an editor, a script or a test drives it by
//! [`Command`]s and draws [`Document::scene`]. The operations on meshes themselves are in
//! [`trigon_modelling`].

mod command;
mod display;
mod document;
mod document_file;
mod error;
mod objects;
mod recovery;
mod revision;
mod script;
mod selection;
mod state;
mod storage;
#[cfg(test)]
mod tests;

pub use command::*;
pub use display::{DisplayMarks, PICK_RADIUS, Picks, X_RAY};
pub use document::{Document, Entry, Event, History};
pub use document_file::{DocumentFile, ExportError};
pub use error::EditError;
pub use recovery::{RecoveryLog, RecoveryStatus, RecoveryWriter, UnreadableRecovery};
pub use script::{Script, ScriptProgress};
pub use selection::{
    ElementKind, ElementKinds, Elements, MeshSelection, Selection, Similarity, border_edges, edge_loop,
    edge_ring, face_loop, faces_of_material, faces_towards, non_manifold_edges, sharp_edges, shortest_path,
    similar,
};
pub use state::SceneChange;
pub use storage::{
    Disk, SaveError, SetError, SetFile, SetState, Storage, backup_path, finish_set, save, save_set,
};

/// Re-exports of the crates below, so that programs need no other dependency.
pub use {trigon_mesh as mesh, trigon_modelling as modelling, trigon_scene as scene};

/// Runs the README's example as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
