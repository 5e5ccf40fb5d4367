//! The viewer's own keys: those of F3D for files.

use std::str::FromStr;

use super::overlay_commands::OverlayCommand;
use trigon_window::{Action, Chord, Key, Keymap, Modifiers};

/// What the viewer's own keys do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Command {
    PreviousFile,
    NextFile,
    PreviousFileSameView,
    NextFileSameView,
    Reload,
    Open,
    PlayOrPause,
    PlayBackward,
    CycleAnimation,
    CancelLoading,
    ResetView,
    ToggleName,
    ToggleMetadata,
    ToggleDifference,
    ToggleQuality,
    Brighter,
    Darker,
    UpY,
    UpZ,
    Screenshot,
    ScreenshotWithoutBackground,
}

impl Command {
    const ALL: [Self; 21] = [
        Self::PreviousFile,
        Self::NextFile,
        Self::PreviousFileSameView,
        Self::NextFileSameView,
        Self::Reload,
        Self::Open,
        Self::PlayOrPause,
        Self::PlayBackward,
        Self::CycleAnimation,
        Self::CancelLoading,
        Self::ResetView,
        Self::ToggleName,
        Self::ToggleMetadata,
        Self::ToggleDifference,
        Self::ToggleQuality,
        Self::Brighter,
        Self::Darker,
        Self::UpY,
        Self::UpZ,
        Self::Screenshot,
        Self::ScreenshotWithoutBackground,
    ];

    /// Its name in the keymap, its key, and what the cheat sheet says.
    fn binding(self) -> (&'static str, Chord, &'static str) {
        let ctrl = |key| Chord::new(Modifiers::CTRL, key);
        let shift = |key| Chord::new(Modifiers::SHIFT, Key::Character(key));
        match self {
            Self::PreviousFile => ("file.previous", Key::Left.into(), "previous, next file"),
            Self::NextFile => ("file.next", Key::Right.into(), "previous, next file"),
            Self::PreviousFileSameView => {
                ("file.previous.same_view", ctrl(Key::Left), "the same, keeping the view")
            }
            Self::NextFileSameView => ("file.next.same_view", ctrl(Key::Right), "the same, keeping the view"),
            Self::Reload => ("file.reload", Key::Up.into(), "reload the file"),
            Self::Open => ("file.open", ctrl(Key::Character('o')), "open files"),
            Self::PlayOrPause => ("animation.play", Key::Space.into(), "play, pause animations"),
            Self::PlayBackward => (
                "animation.play.backward",
                Chord::new(Modifiers::CTRL | Modifiers::SHIFT, Key::Space),
                "play them backwards",
            ),
            Self::CycleAnimation => ("animation.next", 'w'.into(), "next animation, all, none"),
            Self::CancelLoading => ("file.cancel", ctrl(Key::Character('.')), "cancel loading"),
            Self::ResetView => ("reset_view", Key::Enter.into(), "reset the view"),
            Self::ToggleName => ("file.name", 'n'.into(), "file name"),
            Self::ToggleMetadata => ("metadata", 'm'.into(), "counts and sizes"),
            Self::ToggleDifference => ("quality.difference", 'd'.into(), "difference from the reference"),
            Self::ToggleQuality => ("quality", shift('d'), "accuracy and its cost"),
            Self::Brighter => ("light.brighter", 'l'.into(), "brighter, darker light"),
            Self::Darker => ("light.darker", shift('l'), "brighter, darker light"),
            Self::UpY => ("up.y", ctrl(Key::Character('y')), "+Y up, +Z up"),
            Self::UpZ => ("up.z", ctrl(Key::Character('z')), "+Y up, +Z up"),
            Self::Screenshot => ("screenshot", Key::Function(12).into(), "screenshot"),
            Self::ScreenshotWithoutBackground => {
                ("screenshot.no_background", ctrl(Key::Function(12)), "screenshot without background")
            }
        }
    }
}

impl FromStr for Command {
    type Err = ();

    fn from_str(name: &str) -> Result<Self, ()> {
        Self::ALL.into_iter().find(|command| command.binding().0 == name).ok_or(())
    }
}

/// The window's keys and the viewer's own. The left, right and up arrows
/// belong to files, as in F3D; the down arrow alone would orbit to one side.
pub(super) fn keymap() -> Keymap {
    let mut keymap = Keymap::default();
    keymap.unbind(Key::Down);
    for command in Command::ALL {
        let (name, chord, description) = command.binding();
        keymap.bind(chord, name, Action::Command, description);
    }
    for command in OverlayCommand::ALL {
        let (name, chord, description) = command.binding();
        keymap.bind(chord, name, Action::Command, description);
    }
    keymap
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_is_found_by_its_key_and_its_name() {
        let keymap = keymap();
        for command in Command::ALL {
            let (name, chord, _) = command.binding();
            assert_eq!(name.parse(), Ok(command), "{name}");
            let bound = keymap.find(chord).map(|binding| binding.name.as_ref());
            assert_eq!(bound, Some(name), "{chord}");
        }
    }

    #[test]
    fn orbiting_by_keys_is_still_possible() {
        let chord = Chord::new(Modifiers::SHIFT, Key::Left);
        assert!(keymap().find(chord).is_some(), "Shift and an arrow orbit");
    }
}
