//! User input (keys, pointer, wheel), independent of the window system. `translate` is the only file here
//! that knows winit.

mod event;
mod key;
mod offer;
mod pointer;
pub(crate) mod translate;
mod wheel;

pub(crate) use event::{InputEvent, KeyCode, KeyPress, Press};
pub use key::{Chord, ChordError, Key, Modifiers, PointerButton};
pub use offer::{Hands, Input, InputOwner, Taken};
pub(crate) use pointer::{Gesture, Pointer};
pub(crate) use wheel::{WheelDelta, wheel_lines};
