//! What keys and buttons do, as data: a name, what is pressed, what it does,
//! and what the cheat sheet says about it.

mod action;
mod binding;
mod defaults;
mod sheet;
mod synonyms;

pub use action::{Action, CameraMotion, ClickAction, DragAction, Motion, ObjectMotion};
pub use binding::{Binding, ClickBinding, DragBinding, Keymap, MenuEntry};
pub use sheet::SheetRow;
pub(crate) use sheet::sheet;
pub use synonyms::matches_search;
