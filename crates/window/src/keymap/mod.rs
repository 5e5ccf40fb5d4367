//! Key bindings as data: a name, the chord, the action, and the description in the list of keys.

mod action;
mod binding;
mod defaults;
mod held;
mod sheet;
mod synonyms;
#[cfg(test)]
mod tests;

pub use action::{Action, CameraMotion, ClickAction, DragAction, Motion, ObjectMotion};
pub use binding::{Binding, ClickBinding, DragBinding, Keymap, MenuEntry};
pub(crate) use held::{HeldKeys, STEP};
pub use sheet::SheetRow;
pub(crate) use sheet::sheet;
pub use synonyms::matches_search;
