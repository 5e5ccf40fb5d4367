//! Names for keys, modifiers and buttons, and how people read them.

use std::fmt;
use std::ops::BitOr;

use serde::{Deserialize, Serialize};

/// A key by what it means on the user's keyboard, not by where it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Key {
    /// What the key types without modifiers, in lower case.
    Character(char),
    /// Enter, on either side.
    Enter,
    /// Escape.
    Escape,
    /// Tab.
    Tab,
    /// The space bar.
    Space,
    /// Backspace.
    Backspace,
    /// Delete.
    Delete,
    /// Home.
    Home,
    /// End.
    End,
    /// Page up.
    PageUp,
    /// Page down.
    PageDown,
    /// Cursor left.
    Left,
    /// Cursor right.
    Right,
    /// Cursor up.
    Up,
    /// Cursor down.
    Down,
    /// F1 to F24.
    Function(u8),
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Character(c) => write!(f, "{}", c.to_uppercase()),
            Self::Function(n) => write!(f, "F{n}"),
            named => write!(f, "{named:?}"),
        }
    }
}

/// Which modifier keys are down. On macOS the command key counts as [`Modifiers::CTRL`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
pub struct Modifiers(u8);

impl Modifiers {
    /// None of them.
    pub const NONE: Self = Self(0);
    /// Control, or command on macOS.
    pub const CTRL: Self = Self(1);
    /// Alt, or option.
    pub const ALT: Self = Self(2);
    /// Shift.
    pub const SHIFT: Self = Self(4);

    /// Whether all of `others` are down.
    #[must_use]
    pub fn contains(self, others: Self) -> bool {
        self.0 & others.0 == others.0
    }

    /// How many they are.
    pub(crate) fn count(self) -> u32 {
        self.0.count_ones()
    }
}

impl BitOr for Modifiers {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl fmt::Display for Modifiers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (modifier, name) in [(Self::CTRL, "Ctrl+"), (Self::ALT, "Alt+"), (Self::SHIFT, "Shift+")] {
            if self.contains(modifier) {
                f.write_str(name)?;
            }
        }
        Ok(())
    }
}

/// A key together with exactly these modifiers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Chord {
    /// All that have to be down, and no other.
    pub modifiers: Modifiers,
    /// The key.
    pub key: Key,
}

impl Chord {
    /// A key with these modifiers.
    #[must_use]
    pub const fn new(modifiers: Modifiers, key: Key) -> Self {
        Self { modifiers, key }
    }
}

impl From<Key> for Chord {
    fn from(key: Key) -> Self {
        Self::new(Modifiers::NONE, key)
    }
}

impl From<char> for Chord {
    /// The key that types this character, alone.
    fn from(c: char) -> Self {
        Self::new(Modifiers::NONE, Key::Character(c))
    }
}

impl fmt::Display for Chord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.modifiers, self.key)
    }
}

/// A button of the mouse.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum PointerButton {
    /// The first one.
    Left,
    /// The second one.
    Right,
    /// The wheel.
    Middle,
}

impl fmt::Display for PointerButton {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self:?}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chords_read_as_people_write_them() {
        let chord = Chord::new(Modifiers::SHIFT | Modifiers::CTRL, Key::Character('h'));
        assert_eq!(chord.to_string(), "Ctrl+Shift+H", "modifiers in the usual order");
        assert_eq!(Chord::from(Key::PageUp).to_string(), "PageUp", "named keys by name");
        assert_eq!(Chord::from(Key::Function(12)).to_string(), "F12", "function keys by number");
    }
}
