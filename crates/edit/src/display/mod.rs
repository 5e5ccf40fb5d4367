//! What a document looks like in a view, and what a user points at there.
//!
//! `marks` turns the selection and the marks of edges into render settings; `pick` turns a
//! point or a region of a picture into a command that selects. Both need the scene's
//! types alone: no window, no input device. They are in this crate because the numbers of
//! elements that are edited are not those of the scene's meshes, and only a
//! [`Document`](crate::Document) knows both.

mod element;
mod marked;
mod marks;
mod pick;

pub(crate) use marked::MarkedElements;
pub use marks::{DisplayMarks, X_RAY};
pub use pick::{PICK_RADIUS, Picks};
