//! Checks of the source code: which files of a crate need which, and the circles among them; signatures; identifiers;
//! and whether the patches of `docs/extending` still apply.
//!
//! A file needs another if it names one of its items: in a path, or by importing it. Re-exports are followed
//! to the file that defines the item, and count for nothing themselves. Tests are left out.

mod circles;
mod collect;
mod glossary;
mod module;
mod patch;
mod resolve;
mod signatures;
mod workspace;

pub use circles::{Circle, circles, folder_circles};
pub use glossary::NameFaults;
pub use module::Crate;
pub use patch::{FilePatch, Patch};
pub use signatures::long_signatures;
pub use workspace::{packages, rust_files, workspace};
