//! What happens to a window, as the session sees it.

use std::path::PathBuf;

use trigon_math::DVec2;

use super::key::{Key, Modifiers, PointerButton};

/// Whether something went down or came up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Press {
    Down,
    Up,
}

/// Tells one key of the keyboard from all others, whatever the modifiers make
/// of it: a release has to find the press that it belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct KeyCode(pub(crate) u64);

/// A key that went down.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct KeyPress {
    pub(crate) code: KeyCode,
    /// By the user's layout.
    pub(crate) logical: Option<Key>,
    /// By its place on a US keyboard, where the layout hides digits behind
    /// Shift or has no Latin letters.
    pub(crate) physical: Option<Key>,
}

/// Everything that can happen to a window from outside. Positions and sizes
/// are physical pixels from the top-left corner.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum InputEvent {
    PointerMoved(DVec2),
    Button(PointerButton, Press),
    /// Lines away from the user, normalised.
    Wheel(f64),
    /// Logarithm of the factor by which fingers spread.
    Pinch(f64),
    KeyDown(KeyPress),
    KeyUp(KeyCode),
    Modifiers(Modifiers),
    FocusLost,
    FileDropped(PathBuf),
    Resized {
        width: u32,
        height: u32,
    },
    /// Physical pixels per logical one.
    Scaled(f64),
    /// The window is covered, minimised, or seen again.
    Hidden,
    Shown,
    CloseRequested,
}
