//! What keys and buttons do, as data: a name, what is pressed, what it does,
//! and what the cheat sheet says about it.

mod action;
mod binding;
mod defaults;
mod sheet;

pub use action::{Action, CameraMotion, ClickAction, DragAction, Motion, ObjectMotion};
pub use binding::{Binding, ClickBinding, DragBinding, Keymap};
pub(crate) use sheet::{SheetRow, sheet};
