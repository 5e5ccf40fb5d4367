//! Events of a window, as the session receives them.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};
use trigon_math::DVec2;

use super::key::{Key, Modifiers, PointerButton};

/// Whether something went down or came up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Press {
    Down,
    Up,
}

/// Tells one key of the keyboard from all others, whatever the modifiers make
/// of it: a release has to find the press that it belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub(crate) struct KeyCode(pub(crate) u64);

/// A key that went down.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct KeyPress {
    pub(crate) code: KeyCode,
    /// By the user's layout.
    pub(crate) logical: Option<Key>,
    /// By its place on a US keyboard, where the layout hides digits behind
    /// Shift or has no Latin letters.
    pub(crate) physical: Option<Key>,
    /// Whether it has been down for a while: then only an application that takes keys hears of it.
    #[serde(default, skip_serializing_if = "is_first")]
    pub(crate) repeat: bool,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks in this form")]
fn is_first(repeat: &bool) -> bool {
    !repeat
}

/// Everything that can happen to a window from outside. Positions and sizes
/// are physical pixels from the top-left corner.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) enum InputEvent {
    PointerMoved(#[serde(with = "position")] DVec2),
    Button(PointerButton, Press),
    /// Lines away from the user, normalized.
    Wheel(f64),
    /// Logarithm of the factor by which fingers spread.
    Pinch(f64),
    KeyDown(KeyPress),
    KeyUp(KeyCode),
    Modifiers(Modifiers),
    FocusLost,
    FocusGained,
    /// A file is dragged over the window and not dropped yet.
    FileHovered(PathBuf),
    /// What was dragged over the window has left it.
    HoverEnded,
    FileDropped(PathBuf),
    /// Something as the interface takes it; what is for the camera, too, comes beside it.
    Interface(egui::Event),
    Resized {
        width: u32,
        height: u32,
    },
    /// Physical pixels per logical one.
    Scaled(f64),
    /// The window is covered, minimized, or seen again.
    Hidden,
    Shown,
    CloseRequested,
}

impl InputEvent {
    /// Whether it says only where the pointer is.
    pub(crate) fn is_movement(&self) -> bool {
        matches!(self, Self::PointerMoved(_) | Self::Interface(egui::Event::PointerMoved(_)))
    }

    /// Whether it is somebody's doing, not the window system's.
    pub(crate) fn is_by_hand(&self) -> bool {
        !matches!(
            self,
            Self::Resized { .. } | Self::Scaled(_) | Self::Hidden | Self::Shown | Self::CloseRequested
        )
    }
}

/// A position as two numbers.
mod position {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};
    use trigon_math::DVec2;

    pub(super) fn serialize<S: Serializer>(position: &DVec2, serializer: S) -> Result<S::Ok, S::Error> {
        position.to_array().serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<DVec2, D::Error> {
        <[f64; 2]>::deserialize(deserializer).map(DVec2::from_array)
    }
}
