//! Lines of command scripts on keys: what configuration files bind, and what the viewer's own keys share with them.

use trigon_window::{Action, Binding, Chord, Key, Keymap, Modifiers};

use super::commands;
use crate::args::{KeyBinding, Step, flag_named, split, step};

/// What a line does in the window.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Line {
    /// What a key of the window does.
    Key(Binding),
    /// A step of a script.
    Step(Step),
}

/// Lines that do what a key does, with the flags' names of options, and the name of what the key does.
const KEYS: [(&str, &str); 48] = [
    ("add_current_directories", "file.folder"),
    ("cycle anti-aliasing", "samples"),
    ("cycle interaction-style", "orbit_style"),
    ("cycle_animation", "animation.next"),
    ("decrease light-intensity", "light.darker"),
    ("decrease_light_intensity", "light.darker"),
    ("exit", "quit"),
    ("increase light-intensity", "light.brighter"),
    ("increase_light_intensity", "light.brighter"),
    ("load_next_file_group", "file.next"),
    ("load_next_file_group false", "file.next"),
    ("load_next_file_group keep_camera", "file.next.same_view"),
    ("load_next_file_group true", "file.next.same_view"),
    ("load_previous_file_group", "file.previous"),
    ("load_previous_file_group false", "file.previous"),
    ("load_previous_file_group keep_camera", "file.previous.same_view"),
    ("load_previous_file_group true", "file.previous.same_view"),
    ("load_statefile", "state.load"),
    ("load_statefile_dialog", "state.load"),
    ("open_file_dialog", "file.open"),
    ("reload_current_file_group", "file.reload"),
    ("reset_camera", "reset_view"),
    ("save_statefile", "state.save"),
    ("save_statefile_dialog", "state.save"),
    ("set up +Y", "up.y"),
    ("set up +Z", "up.z"),
    ("set_camera back", "view.back"),
    ("set_camera bottom", "view.bottom"),
    ("set_camera front", "view.front"),
    ("set_camera isometric", "view.isometric"),
    ("set_camera left", "view.left"),
    ("set_camera right", "view.right"),
    ("set_camera top", "view.top"),
    ("stop_interactor", "quit"),
    ("take_minimal_screenshot", "screenshot.no_background"),
    ("take_screenshot", "screenshot"),
    ("toggle axis", "axis"),
    ("toggle camera-orthographic", "orthographic"),
    ("toggle display-depth", "display.depth"),
    ("toggle edges", "edges"),
    ("toggle filename", "file.name"),
    ("toggle fps", "frame_time"),
    ("toggle grid", "grid"),
    ("toggle hdri-skybox", "environment.background"),
    ("toggle metadata", "metadata"),
    ("toggle scene-hierarchy", "scene.tree"),
    ("toggle_animation", "animation.play"),
    ("toggle_animation_backward", "animation.play.backward"),
];

/// What a line does: F3D's commands with its names of options or with flags, and the names of keys in the keymap.
///
/// # Errors
/// There is no such command, or it does nothing in a window; with the reason.
pub(super) fn meaning(line: &str) -> Result<Line, String> {
    let words = split(line).map_err(str::to_owned)?;
    let plain = with_flags(&words).join(" ");
    let keymap = commands::keymap();
    let name = KEYS.iter().find(|(text, _)| *text == plain).map_or(plain.as_str(), |(_, name)| name);
    let is_meant = |binding: &&Binding| binding.name == name && !matches!(binding.action, Action::Hold(_));
    if let Some(binding) = keymap.bindings().iter().find(is_meant) {
        return Ok(Line::Key(binding.clone()));
    }
    match step(&words)? {
        Step::Alias(..) => Err("alias is for scripts; bind the whole line".to_owned()),
        step => Ok(Line::Step(step)),
    }
}

/// Words with a flag's name in place of an option's.
fn with_flags(words: &[String]) -> Vec<String> {
    const OF_OPTIONS: [&str; 5] = ["set", "toggle", "cycle", "increase", "decrease"];
    let mut words = words.to_vec();
    if let [action, option, ..] = words.as_mut_slice()
        && OF_OPTIONS.contains(&action.as_str())
        && let Ok(flag) = flag_named(option)
    {
        *option = flag.to_owned();
    }
    words
}

/// The keys of configuration files, as they are bound now.
#[derive(Default)]
pub(super) struct Bound {
    bindings: Vec<KeyBinding>,
    lines: Vec<Vec<Line>>,
}

impl Bound {
    /// What the names of such keys begin with in the keymap.
    const PREFIX: &str = "configuration.";

    /// Binds these in place of those before. Returns what could not be bound, and why.
    pub(super) fn bind(&mut self, keymap: &mut Keymap, bindings: Vec<KeyBinding>) -> Vec<String> {
        if self.bindings == bindings {
            return Vec::new();
        }
        *keymap = commands::keymap();
        self.lines.clear();
        let mut unbound = Vec::new();
        // Those of any modifiers go where no other is.
        let (any, exact): (Vec<_>, Vec<_>) = bindings.iter().partition(|binding| any(&binding.key).is_some());
        for binding in exact.into_iter().chain(any) {
            if let Err(why) = self.bind_one(keymap, binding) {
                unbound.push(format!("bindings: {}: {why}", binding.key));
            }
        }
        self.bindings = bindings;
        unbound
    }

    fn bind_one(
        &mut self,
        keymap: &mut Keymap,
        KeyBinding { key, lines }: &KeyBinding,
    ) -> Result<(), String> {
        const MODIFIERS: [Modifiers; 3] = [Modifiers::CTRL, Modifiers::SHIFT, Modifiers::ALT];
        let mut meanings = Vec::new();
        for line in lines {
            meanings.push(meaning(line)?);
        }
        let is_own = |keymap: &Keymap, chord| {
            keymap.find(chord).is_some_and(|found| found.name.starts_with(Self::PREFIX))
        };
        let mut chords = Vec::new();
        if let Some(key) = any(key) {
            let chord = chord(key)?;
            let with = |modifiers| Chord::new(modifiers, chord.key);
            let others = MODIFIERS.into_iter().chain([Modifiers::CTRL | Modifiers::SHIFT]).map(with);
            chords.extend(Some(chord).filter(|&chord| !is_own(keymap, chord)));
            chords.extend(others.filter(|&chord| keymap.find(chord).is_none()));
        } else {
            chords.push(chord(key)?);
        }
        for chord in chords {
            keymap.add(Binding {
                name: format!("{}{}", Self::PREFIX, self.lines.len()).into(),
                chord,
                action: Action::Command,
                description: lines.join("; ").into(),
                section: "Configuration".into(),
            });
        }
        self.lines.push(meanings);
        Ok(())
    }

    /// The lines of a key, by its name in the keymap.
    pub(super) fn lines(&self, name: &str) -> &[Line] {
        let index = name.strip_prefix(Self::PREFIX).and_then(|number| number.parse::<usize>().ok());
        index.and_then(|index| self.lines.get(index)).map_or(&[], Vec::as_slice)
    }
}

/// The key of a binding for any modifiers.
fn any(key: &str) -> Option<&str> {
    let (first, rest) = key.split_at_checked(4)?;
    first.eq_ignore_ascii_case("any+").then_some(rest).filter(|rest| !rest.is_empty())
}

/// A key as F3D writes it.
fn chord(key: &str) -> Result<Chord, String> {
    let key = match key.split_at_checked(5) {
        Some((first, rest)) if first.eq_ignore_ascii_case("none+") && !rest.is_empty() => rest,
        _ => key,
    };
    if key.eq_ignore_ascii_case("drop") {
        return Err("what is dropped is always opened".to_owned());
    }
    match key.rsplit_once('+') {
        _ if key.eq_ignore_ascii_case("return") => Ok(Key::Enter.into()),
        Some((modifiers, last)) if last.eq_ignore_ascii_case("return") => {
            format!("{modifiers}+Enter").parse::<Chord>().map_err(|error| error.to_string())
        }
        _ => key.parse::<Chord>().map_err(|error| error.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn binding(key: &str, lines: &[&str]) -> KeyBinding {
        KeyBinding { key: key.to_owned(), lines: lines.iter().map(|&line| line.to_owned()).collect() }
    }

    #[test]
    fn lines_that_do_what_keys_do_name_keys() {
        for (line, name) in KEYS {
            let Ok(Line::Key(binding)) = meaning(line) else { panic!("{line}: {:?}", meaning(line)) };
            assert_eq!(binding.name, name, "{line}");
        }
        assert!(KEYS.is_sorted(), "each once");
    }

    #[test]
    fn options_have_f3ds_names_or_those_of_flags_and_keys_their_own() {
        for (line, name) in [
            ("toggle render.show_edges", "edges"),
            ("toggle edges", "edges"),
            ("set scene.up.direction +Z", "up.z"),
            ("cycle render.effect.antialiasing.mode", "samples"),
            ("quality", "quality"),
            ("measure", "measure"),
        ] {
            let Ok(Line::Key(binding)) = meaning(line) else { panic!("{line}: {:?}", meaning(line)) };
            assert_eq!(binding.name, name, "{line}");
        }
        let toggle = Step::Toggle("unlit".to_owned());
        assert_eq!(meaning("toggle model.unlit"), Ok(Line::Step(toggle)), "no key does that");
        for (line, why) in [
            ("dance", "no command"),
            ("orbit", "no command"),
            ("alias a exit", "scripts"),
            ("toggle x", "not an option"),
        ] {
            assert!(meaning(line).is_err_and(|error| error.contains(why)), "{line}: {:?}", meaning(line));
        }
    }

    #[test]
    fn keys_of_any_modifiers_go_where_nothing_is() {
        let mut keymap = commands::keymap();
        let mut bound = Bound::default();
        let bindings = [
            binding("Any+3", &["roll_camera -90"]),
            binding("Shift+3", &["toggle ui.axis"]),
            binding("None+I", &["toggle ui.axis", "toggle ui.metadata"]),
        ];
        assert_eq!(bound.bind(&mut keymap, bindings.to_vec()), [""; 0], "all of them");
        for (key, description) in [
            ("3", "roll_camera -90"),
            ("Shift+3", "toggle ui.axis"),
            ("Ctrl+Shift+3", "roll_camera -90"),
            ("Ctrl+3", "back, left, bottom view"),
            ("I", "toggle ui.axis; toggle ui.metadata"),
        ] {
            let found = keymap.find(key.parse().expect("a key"));
            assert_eq!(found.map(|binding| binding.description.as_ref()), Some(description), "{key}");
        }
        let name = keymap.find('i'.into()).map(|binding| binding.name.clone()).expect("bound");
        assert_eq!(bound.lines(&name).len(), 2, "both lines");
        assert_eq!(bound.bind(&mut keymap, Vec::new()), [""; 0], "of another file");
        assert_eq!(keymap, commands::keymap(), "they are gone");
    }

    #[test]
    fn what_cannot_be_bound_says_why() {
        for (key, line, why) in [
            ("Drop", "exit", "always opened"),
            ("Hyper+A", "exit", "is not a key"),
            ("A", "dance", "no command dance"),
            ("A", "cycle_coloring array", "simulation"),
        ] {
            let mut keymap = commands::keymap();
            let unbound = Bound::default().bind(&mut keymap, vec![binding(key, &[line])]);
            assert!(unbound.len() == 1 && unbound[0].contains(why), "{key}, {line}: {unbound:?}");
            assert_eq!(keymap, commands::keymap(), "{key}, {line}: nothing is bound");
        }
        let mut keymap = commands::keymap();
        assert!(Bound::default().bind(&mut keymap, vec![binding("Ctrl+Return", &["exit"])]).is_empty());
        assert!(keymap.find("Ctrl+Enter".parse().expect("a key")).is_some(), "F3D's name of it");
    }
}
