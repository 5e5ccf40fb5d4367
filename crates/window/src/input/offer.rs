//! Input as the application receives it, before camera and keymap.

use trigon_math::DVec2;

use super::key::{Key, Modifiers, PointerButton};

/// Input that no widget took, offered to [`crate::Handler::input`] before camera and keymap take it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Input {
    /// The pointer is somewhere else. While it drags the camera or a widget, nobody is told.
    PointerMoved,
    /// A button went down. If the application takes it, all moves and the release are offered to the
    /// application alone, over panels too.
    Pressed(PointerButton),
    /// A button came up that the application took when it went down.
    Released(PointerButton),
    /// A button that the application did not take went down and up at one place, which is where
    /// [`Hands::pointer`] is. The modifiers are those of the press.
    Clicked(PointerButton),
    /// The wheel turned, in lines away from the user, within ±10.
    Wheel(f64),
    /// Fingers on a touchpad spread, by the logarithm of the factor.
    Pinch(f64),
    /// A key went down.
    Key {
        /// By the user's layout.
        logical: Option<Key>,
        /// By its place on a US keyboard, where the layout hides digits behind Shift or has no Latin
        /// letters.
        physical: Option<Key>,
        /// Whether it has been down for a while.
        repeat: bool,
    },
    /// A key came up that the application took when it went down.
    KeyReleased {
        /// By the user's layout.
        logical: Option<Key>,
        /// As in [`Input::Key`].
        physical: Option<Key>,
    },
    /// Other modifiers are held now.
    ModifiersChanged,
    /// The window lost the keyboard, and with it all buttons and keys: none of their releases follow.
    FocusLost,
    /// The window has the keyboard again: other programs may have changed files meanwhile.
    FocusGained,
}

/// Where the pointer is and which modifiers are held.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Hands {
    /// In physical pixels from the top-left corner of the window; `None` before it was first seen.
    pub pointer: Option<DVec2>,
    /// Held at this moment.
    pub modifiers: Modifiers,
}

/// Whether the application took what it was offered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Taken {
    /// It is the application's: camera and keymap do not get it, and what changed on the stage is drawn.
    Yes,
    /// Camera and keymap get it.
    No,
}

/// Who is asked first what mouse and keys mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum InputOwner {
    /// The interface: what happens on a panel or in a text field is its own.
    #[default]
    Interface,
    /// The application, wherever the pointer is: while one of its tools runs that follows the pointer.
    /// What it does not take goes to camera and keymap, and nothing to the interface.
    Application,
}
