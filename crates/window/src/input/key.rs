//! Keys, modifiers and buttons, and their names for people.

use std::fmt;
use std::ops::BitOr;
use std::str::FromStr;

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
    /// The key between the right Alt and Ctrl that opens a menu.
    Menu,
    /// F1 to F24.
    Function(u8),
    /// What a key of the number pad types: a digit, or one of `.+-*/`. The key at this place of the main
    /// block is its [`Key::Character`], which applications find where nothing is bound to the pad.
    Numpad(char),
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Character(c) => write!(f, "{}", c.to_uppercase()),
            Self::Function(n) => write!(f, "F{n}"),
            Self::Numpad(c) => write!(f, "Numpad{c}"),
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

/// A text is no chord.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "{0:?} is not a key; write Ctrl, Alt, Shift and one key with + between them, as Ctrl+Shift+Z, F3, Tab, Numpad1"
)]
pub struct ChordError(String);

impl FromStr for Chord {
    type Err = ChordError;

    /// Reads what [`Display`](fmt::Display) writes, in upper or lower case.
    fn from_str(text: &str) -> Result<Self, ChordError> {
        let mut modifiers = Modifiers::NONE;
        let mut rest = text.trim();
        while let Some((modifier, tail)) = split_modifier(rest) {
            modifiers = modifiers | modifier;
            rest = tail;
        }
        let key = key_named(rest).ok_or_else(|| ChordError(text.to_owned()))?;
        Ok(Self::new(modifiers, key))
    }
}

/// The modifier at the beginning, and the rest.
fn split_modifier(text: &str) -> Option<(Modifiers, &str)> {
    let (first, tail) = text.split_once('+').filter(|(_, tail)| !tail.is_empty())?;
    let known = [("ctrl", Modifiers::CTRL), ("alt", Modifiers::ALT), ("shift", Modifiers::SHIFT)];
    let found = known.into_iter().find(|(name, _)| first.trim().eq_ignore_ascii_case(name));
    found.map(|(_, modifier)| (modifier, tail))
}

/// The key of this name.
fn key_named(text: &str) -> Option<Key> {
    const NAMED: [Key; 15] = [
        Key::Enter,
        Key::Escape,
        Key::Tab,
        Key::Space,
        Key::Backspace,
        Key::Delete,
        Key::Home,
        Key::End,
        Key::PageUp,
        Key::PageDown,
        Key::Left,
        Key::Right,
        Key::Up,
        Key::Down,
        Key::Menu,
    ];
    let text = text.trim();
    let only = |text: &str| {
        let mut lower = text.chars().flat_map(char::to_lowercase);
        lower.next().filter(|_| lower.next().is_none())
    };
    let lower = text.to_ascii_lowercase();
    let pad = lower.strip_prefix("numpad").and_then(only).filter(|c| "0123456789.+-*/".contains(*c));
    let function = lower.strip_prefix('f').and_then(|number| number.parse().ok());
    let function = function.filter(|number| (1..=24).contains(number));
    let named = || NAMED.into_iter().find(|key| key.to_string().eq_ignore_ascii_case(text));
    only(text).map(Key::Character).or(pad.map(Key::Numpad)).or(function.map(Key::Function)).or_else(named)
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
        assert_eq!(Chord::from(Key::Numpad('1')).to_string(), "Numpad1", "the pad is another place");
    }

    #[test]
    fn chords_are_read_as_they_are_written() {
        let keys = [Key::Character('h'), Key::Character('+'), Key::Character('.'), Key::Function(12)];
        for key in keys.into_iter().chain([Key::PageUp, Key::Numpad('/'), Key::Numpad('+'), Key::Tab]) {
            for modifiers in [Modifiers::NONE, Modifiers::CTRL, Modifiers::ALT | Modifiers::SHIFT] {
                let chord = Chord::new(modifiers, key);
                assert_eq!(chord.to_string().parse(), Ok(chord), "{chord}");
                assert_eq!(chord.to_string().to_lowercase().parse(), Ok(chord), "{chord} in lower case");
            }
        }
        for wrong in ["", "Ctrl+", "Hyper+A", "F25", "Numpad", "Numpadx", "Enterr"] {
            let error = wrong.parse::<Chord>().expect_err(wrong).to_string();
            assert!(error.contains("Ctrl+Shift+Z"), "{error}");
        }
    }

    #[test]
    fn modifiers_are_sets() {
        let single = [Modifiers::CTRL, Modifiers::ALT, Modifiers::SHIFT];
        for bits in 0..8_usize {
            let held = (0..3).filter(|bit| bits >> bit & 1 != 0);
            let all = held.clone().fold(Modifiers::NONE, |all, bit| all | single[bit]);
            assert_eq!(all.count() as usize, held.clone().count(), "{all}");
            for (bit, one) in single.into_iter().enumerate() {
                assert_eq!(all.contains(one), bits >> bit & 1 != 0, "{one} in {all}");
                assert!((all | one).contains(all) && (all | one).contains(one), "{one} or {all}");
            }
            assert!(all.contains(Modifiers::NONE) && all.contains(all) && all | all == all, "{all}");
        }
    }

    #[test]
    fn every_key_is_read_by_its_name() {
        let named = [
            ("Enter", Key::Enter),
            ("Escape", Key::Escape),
            ("Tab", Key::Tab),
            ("Space", Key::Space),
            ("Backspace", Key::Backspace),
            ("Delete", Key::Delete),
            ("Home", Key::Home),
            ("End", Key::End),
            ("PageUp", Key::PageUp),
            ("PageDown", Key::PageDown),
            ("Left", Key::Left),
            ("Right", Key::Right),
            ("Up", Key::Up),
            ("Down", Key::Down),
            ("Menu", Key::Menu),
        ];
        for (name, key) in named {
            assert_eq!(name.parse(), Ok(Chord::from(key)), "{name}");
            assert_eq!(format!(" ctrl + {name}").parse(), Ok(Chord::new(Modifiers::CTRL, key)), "{name}");
            assert_eq!(key.to_string(), name);
        }
        for number in 1..=24 {
            assert_eq!(format!("F{number}").parse(), Ok(Chord::from(Key::Function(number))));
        }
        for typed in "0123456789.+-*/".chars() {
            assert_eq!(format!("Numpad{typed}").parse(), Ok(Chord::from(Key::Numpad(typed))));
        }
        for wrong in ["F0", "F25", "F-1", "Numpad10", "Alt+", "Alt+Shift+", "ab"] {
            assert!(wrong.parse::<Chord>().is_err(), "{wrong}");
        }
    }
}
