//! The viewer's own keys: those of F3D for files.

use std::str::FromStr;

use super::overlay_commands::OverlayCommand;
use trigon_window::{Action, Binding, Chord, Key, Keymap, MenuEntry, Modifiers};

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

    /// Its name in the keymap, its key, and what the cheat sheet says under which heading.
    fn binding(self) -> Binding {
        let ctrl = |key| Chord::new(Modifiers::CTRL, key);
        let shift = |key| Chord::new(Modifiers::SHIFT, Key::Character(key));
        let alt = |key| Chord::new(Modifiers::ALT, Key::Character(key));
        let backward = Chord::new(Modifiers::CTRL | Modifiers::SHIFT, Key::Space);
        let files = "previous, next file";
        let same_view = "the same, keeping the view";
        match self {
            Self::PreviousFile => row("Files", "file.previous", Key::Left, files),
            Self::NextFile => row("Files", "file.next", Key::Right, files),
            Self::PreviousFileSameView => row("Files", "file.previous.same_view", ctrl(Key::Left), same_view),
            Self::NextFileSameView => row("Files", "file.next.same_view", ctrl(Key::Right), same_view),
            Self::Reload => row("Files", "file.reload", Key::Up, "load the file again"),
            Self::Open => row("Files", "file.open", ctrl(Key::Character('o')), "open files"),
            Self::CancelLoading => row("Files", "file.cancel", ctrl(Key::Character('.')), "cancel loading"),
            Self::Screenshot => row("Files", "screenshot", Key::Function(12), "save a screenshot"),
            Self::ScreenshotWithoutBackground => row(
                "Files",
                "screenshot.no_background",
                ctrl(Key::Function(12)),
                "the same without background",
            ),
            Self::PlayOrPause => row("Animation", "animation.play", Key::Space, "play, pause animations"),
            Self::PlayBackward => {
                row("Animation", "animation.play.backward", backward, "play them backwards")
            }
            Self::CycleAnimation => row("Animation", "animation.next", 'w', "next animation, all, none"),
            Self::ResetView => row("View", "reset_view", Key::Enter, "reset the view"),
            Self::UpY => row("View", "up.y", alt('y'), "+Y up, +Z up"),
            Self::UpZ => row("View", "up.z", alt('z'), "+Y up, +Z up"),
            Self::ToggleName => row("Display", "file.name", 'n', "name of the file"),
            Self::ToggleMetadata => row("Display", "metadata", 'm', "counts and sizes"),
            Self::ToggleDifference => {
                row("Display", "quality.difference", 'd', "difference from the reference")
            }
            Self::ToggleQuality => row("Display", "quality", shift('d'), "accuracy and what it costs"),
            Self::Brighter => row("Display", "light.brighter", 'l', "brighter, darker light"),
            Self::Darker => row("Display", "light.darker", shift('l'), "brighter, darker light"),
        }
    }
}

fn row(
    section: &'static str,
    name: &'static str,
    chord: impl Into<Chord>,
    description: &'static str,
) -> Binding {
    let (chord, action) = (chord.into(), Action::Command);
    Binding { name: name.into(), chord, action, description: description.into(), section: section.into() }
}

/// What is used most, in the order of the menu.
const MENU: [MenuEntry; 21] = {
    const fn entry(name: &'static str, label: &'static str) -> MenuEntry {
        MenuEntry::Command { name, label }
    }
    [
        entry("file.open", "Open…"),
        entry("file.reload", "Load again"),
        entry("screenshot", "Save a screenshot"),
        MenuEntry::Line,
        entry("reset_view", "Reset the view"),
        entry("view.front", "Front view"),
        entry("view.right", "Right view"),
        entry("view.top", "Top view"),
        entry("view.isometric", "Isometric view"),
        entry("orthographic", "Perspective / orthographic"),
        MenuEntry::Line,
        entry("edges", "Edges"),
        entry("wireframe", "Surface / wireframe / hidden lines"),
        entry("metadata", "Counts and sizes"),
        entry("quality", "Accuracy and what it costs"),
        entry("undo", "Undo moving an object"),
        MenuEntry::Line,
        entry("animation.play", "Play, pause"),
        entry("full_screen", "Full screen"),
        entry("cheat_sheet", "Keys and commands"),
        entry("quit", "Quit"),
    ]
};

impl FromStr for Command {
    type Err = ();

    fn from_str(name: &str) -> Result<Self, ()> {
        Self::ALL.into_iter().find(|command| command.binding().name == name).ok_or(())
    }
}

/// The window's keys and the viewer's own. The left, right and up arrows
/// belong to files, as in F3D; the down arrow alone would orbit to one side.
pub(super) fn keymap() -> Keymap {
    let mut keymap = Keymap::default();
    keymap.unbind(Key::Down);
    for command in Command::ALL {
        keymap.add(command.binding());
    }
    for command in OverlayCommand::ALL {
        let (name, chord, description) = command.binding();
        keymap.add(row("Inspect", name, chord, description));
    }
    keymap.set_menu(MENU);
    keymap
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_is_found_by_its_key_and_its_name() {
        let keymap = keymap();
        for command in Command::ALL {
            let binding = command.binding();
            assert_eq!(binding.name.parse(), Ok(command), "{}", binding.name);
            assert_eq!(keymap.find(binding.chord), Some(&binding), "{}", binding.chord);
        }
    }

    #[test]
    fn every_entry_of_the_menu_does_what_a_key_does() {
        let keymap = keymap();
        assert_eq!(keymap.menu().count(), MENU.len(), "all of them are bound");
    }

    #[test]
    fn a_search_finds_keys_by_other_words() {
        let sheet = keymap().sheet();
        let found = |search: &str| {
            let rows = sheet.iter().filter(|row| row.matches(search));
            rows.map(|row| row.description.as_str()).collect::<Vec<_>>()
        };
        for (search, expected) in [
            ("rotate", "orbit"),
            ("save", "save a screenshot"),
            ("refresh", "load the file again"),
            ("statistics", "counts and sizes"),
            ("quality", "accuracy and what it costs"),
            ("fps", "frame time"),
        ] {
            assert!(found(search).contains(&expected), "{search}: {:?}", found(search));
        }
        assert!(found("rotate").len() < sheet.len() / 2, "not everything: {:?}", found("rotate"));
    }

    #[test]
    fn orbiting_by_keys_is_still_possible() {
        let chord = Chord::new(Modifiers::SHIFT, Key::Left);
        assert!(keymap().find(chord).is_some(), "Shift and an arrow orbit");
    }
}
