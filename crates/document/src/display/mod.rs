//! How a document is displayed in a view, and what a user points at.
//!
//! `selection_marks` turns the selection and the marks of edges into render settings; `pick` turns a point or
//! a region of an image into a command that selects. Both need only the scene's types: no window, no input
//! device. Both are in this crate because edited elements have other numbers than those of the scene's
//! meshes, and only a [`Document`](crate::Document) knows both.

mod element;
mod pick;
mod selected;
mod selection_marks;

pub use pick::{PICK_RADIUS, Picks};
pub use selection_marks::{DisplayMarks, X_RAY};
