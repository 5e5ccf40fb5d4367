//! Which files of a crate need which, and the circles among them.
//!
//! A file needs another if it names one of its items: in a path, or by importing it. Re-exports are followed
//! to the file that defines the item, and count for nothing themselves. Tests are left out.

mod circles;
mod collect;
mod module;
mod resolve;
mod signatures;

pub use circles::{Circle, circles};
pub use module::Crate;
pub use signatures::long_signatures;
