//! The viewer's own keys, which are F3D's where F3D has the command: a row for each.

use std::str::FromStr;

use trigon_window::{Action, Binding, Keymap, MenuEntry};

/// One row for each: its variant, the heading under which the list of keys has it, its name in the keymap, its
/// key, and what the list says.
macro_rules! commands {
    ($($variant:ident: $section:literal, $name:literal, $chord:literal, $description:literal;)*) => {
        /// What the viewer's own keys do.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) enum Command {
            $($variant,)*
        }

        impl Command {
            const ALL: &[Self] = &[$(Self::$variant,)*];

            fn binding(self) -> Binding {
                match self {
                    $(Self::$variant => row($section, $name, $chord, $description),)*
                }
            }
        }
    };
}

commands! {
    PreviousFile: "Files", "file.previous", "Left", "previous, next file";
    NextFile: "Files", "file.next", "Right", "previous, next file";
    PreviousFileSameView: "Files", "file.previous.same_view", "Ctrl+Left", "the same, keeping the view";
    NextFileSameView: "Files", "file.next.same_view", "Ctrl+Right", "the same, keeping the view";
    Reload: "Files", "file.reload", "Up", "load the file again";
    Open: "Files", "file.open", "Ctrl+O", "open files";
    PlayOrPause: "Animation", "animation.play", "Space", "play, pause animations";
    PlayBackward: "Animation", "animation.play.backward", "Ctrl+Shift+Space", "play them backwards";
    CycleAnimation: "Animation", "animation.next", "W", "next animation, all, none";
    AddFolder: "Files", "file.folder", "Down", "go through all models of the folder";
    CancelLoading: "Files", "file.cancel", "Ctrl+.", "cancel loading";
    ResetView: "View", "reset_view", "Enter", "reset the view";
    ToggleName: "Display", "file.name", "N", "name of the file";
    ToggleMetadata: "Display", "metadata", "M", "counts and sizes";
    ToggleDifference: "Display", "quality.difference", "D", "difference from the reference";
    ToggleQuality: "Display", "quality", "Shift+D", "accuracy and what it costs";
    Brighter: "Display", "light.brighter", "L", "brighter, darker light";
    Darker: "Display", "light.darker", "Shift+L", "brighter, darker light";
    AmbientOcclusion: "Display", "ambient_occlusion", "Q", "ambient occlusion";
    Shadows: "Display", "shadows", "S", "shadows";
    ToneMapping: "Display", "tone_mapping", "T", "tone mapping";
    EnvironmentLight: "Display", "environment.light", "F", "light from all around (sky or HDRI)";
    EnvironmentBackground: "Display", "environment.background", "J", "sky or HDRI behind the model";
    Spheres: "Display", "point_sprites", "O", "vertices as spheres";
    MoreOpaque: "Display", "opacity.more", "Ctrl+P", "more, less opaque";
    LessOpaque: "Display", "opacity.less", "Ctrl+Shift+P", "more, less opaque";
    Bones: "Inspect", "armature", "Shift+A", "bones";
    Normals: "Inspect", "normal_glyphs", "Ctrl+N", "normals as lines";
    Notifications: "Window", "notifications", "Ctrl+K", "messages about keys";
    UpY: "View", "up.y", "Alt+Y", "+Y up, +Z up";
    UpZ: "View", "up.z", "Alt+Z", "+Y up, +Z up";
    Screenshot: "Files", "screenshot", "F12", "save a screenshot";
    ScreenshotWithoutBackground: "Files", "screenshot.no_background", "Ctrl+F12", "the same without background";
    Tree: "Inspect", "scene.tree", "Shift+H", "scene tree: hide, show, select, look at";
    Pixel: "Inspect", "pixel.explain", "I", "explain the pixel at the pointer; a click, another";
    Effects: "Inspect", "effects.plan", "Shift+P", "effects, and why they are on or off";
    StageTimes: "Inspect", "frame_time.stages", "Shift+Z", "frame time of each stage";
    Axes: "Inspect", "axis", "X", "directions of the axes";
    Grid: "Inspect", "grid", "G", "grid below the model";
    Displays: "Inspect", "display", "V", "what faces show: materials, values of them, depth";
    NextDisplay: "Inspect", "display.next", "C", "the next, the one before";
    PreviousDisplay: "Inspect", "display.previous", "Shift+C", "the next, the one before";
    Matcap: "Inspect", "display.matcap", "Shift+M", "one clay for all (matcap)";
    Depth: "Inspect", "display.depth", "Ctrl+D", "depth in grey";
    Measure: "Inspect", "measure", "R", "measure: clicks snap to vertices, edges and faces";
    Copy: "Inspect", "command.copy", "Ctrl+C", "copy the command line that draws this image";
    SaveState: "Inspect", "state.save", "Ctrl+S", "save, load files, camera and settings";
    LoadState: "Inspect", "state.load", "Ctrl+L", "save, load files, camera and settings";
    Blink: "Inspect", "compare.blink", "B", "with --compare: one model, the other";
    Heat: "Inspect", "compare.heat", "Shift+B", "with --compare: where they differ, side by side";
}

fn row(section: &'static str, name: &'static str, chord: &str, description: &'static str) -> Binding {
    let (chord, action) = (chord.parse().expect("a chord of the table"), Action::Command);
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
        entry("wireframe", "Faces, wires, hidden lines"),
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
        Self::ALL.iter().copied().find(|command| command.binding().name == name).ok_or(())
    }
}

/// The window's keys and the viewer's own. The left, right and up arrows
/// belong to files, as in F3D, and so does the down arrow.
pub(super) fn keymap() -> Keymap {
    let mut keymap = Keymap::default();
    for &command in Command::ALL {
        keymap.add(command.binding());
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
        for &command in Command::ALL {
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
        let chord = "Shift+Left".parse().expect("a chord");
        assert!(keymap().find(chord).is_some(), "Shift and an arrow orbit");
    }
}
