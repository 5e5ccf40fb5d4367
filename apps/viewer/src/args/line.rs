//! The whole command line: the words as typed, the flags that configuration files add for a file,
//! and the changes that a command script made since.

use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

use clap::error::{ContextKind, ErrorKind};
use clap::parser::ValueSource;
use clap::{ArgMatches, CommandFactory, FromArgMatches};
use trigon_camera::UpAxis;
use trigon_io::Format;

#[cfg(feature = "window")]
use super::config::KeyBinding;
use super::config::{Config, ConfigSetting};
use super::raw::RawArgs;
use super::{names, words};
use crate::state::State;

/// All words from which flags are read.
#[derive(Clone, Debug, Default)]
pub(crate) struct CommandLine {
    /// Without the program's name.
    typed: Vec<OsString>,
    config: Config,
    /// The state file, if one was named.
    state: Option<PathBuf>,
    /// Later ones override earlier ones.
    edits: Vec<String>,
}

impl CommandLine {
    /// Reads words without the program's name, and the configuration files that they name.
    ///
    /// # Errors
    /// The words are invalid; with a suggestion if there is one.
    pub(crate) fn new(typed: impl IntoIterator<Item = OsString>) -> Result<Self, clap::Error> {
        let command = RawArgs::command();
        let typed = words::prepared(&command, typed).map_err(conflict)?;
        let line = Self { typed, ..Self::default() };
        let raw = line.raw(None)?;
        let line = match &raw.statefile {
            None => line,
            Some(file) => {
                let state = State::read(file).map_err(conflict)?;
                let mut typed = state.words(!(raw.files.is_empty() && raw.input.is_empty()));
                let in_file = |error: clap::Error| conflict(format!("{}: {}", file.display(), plain(&error)));
                parsed(words_after_name(&typed)).map_err(in_file)?;
                typed.extend(line.typed);
                Self { typed, state: Some(file.clone()), ..Self::default() }
            }
        };
        if raw.no_config == Some(true) {
            return Ok(line);
        }
        let config = Config::read(raw.config.as_deref()).map_err(conflict)?;
        Ok(Self { config, ..line })
    }

    /// The flags for a file, `None` for the built-in scene.
    ///
    /// # Errors
    /// The flags are invalid.
    pub(crate) fn raw(&self, file: Option<&Path>) -> Result<RawArgs, clap::Error> {
        RawArgs::from_arg_matches(&self.matches(file)?)
    }

    /// Entries of configuration files that have no effect.
    pub(crate) fn warnings(&self) -> &[String] {
        &self.config.warnings
    }

    /// The keys of configuration files for a file, `None` for the built-in scene.
    #[cfg(feature = "window")]
    pub(crate) fn bindings(&self, file: Option<&Path>) -> Vec<KeyBinding> {
        self.config.bindings(file)
    }

    /// The configuration and state files that it was read from.
    pub(crate) fn files(&self) -> impl Iterator<Item = &PathBuf> {
        self.config.files.iter().chain(&self.state)
    }

    /// Whether files may have different flags.
    pub(crate) fn differs_by_file(&self) -> bool {
        !self.config.files.is_empty()
    }

    /// The same with more flags, which override the others.
    pub(crate) fn with(&self, edits: impl IntoIterator<Item = String>) -> Self {
        let mut line = self.clone();
        line.edits.extend(edits);
        line
    }

    /// The same without the changes to a flag.
    pub(crate) fn without(&self, flag: &str) -> Self {
        let mut line = self.clone();
        line.edits.retain(|edit| flag_of(edit) != flag);
        line.edits.push(format!("--unset={flag}"));
        line
    }

    /// The words as typed, and the changes since.
    pub(crate) fn text(&self) -> String {
        let typed = self.typed.iter().map(|word| word.to_string_lossy().into_owned());
        typed.chain(self.edits.iter().cloned()).collect::<Vec<_>>().join(" ")
    }

    /// The last change, to be read: "edges: true".
    #[cfg(feature = "window")]
    pub(crate) fn last_change(&self) -> String {
        let last = self.edits.last().map(String::as_str).unwrap_or_default();
        last.trim_start_matches('-').replacen('=', ": ", 1)
    }

    /// The value of a flag as it was typed, or its default; that of `--up` depends on the file.
    pub(crate) fn value(&self, flag: &str, file: Option<&Path>) -> Option<String> {
        let matches = self.matches(file).ok()?;
        let id = identifier(flag)?;
        let Some(values) = matches.get_raw(&id) else {
            return (flag == "up").then(|| usual_up(file).to_string());
        };
        Some(values.map(OsStr::to_string_lossy).collect::<Vec<_>>().join(","))
    }

    /// The flags that were typed or come from configuration files, one word each, without files, without flags of the
    /// window alone, and without these. Flags that do not change what is shown are left out, too.
    ///
    /// # Errors
    /// When the words make no sense.
    #[cfg(feature = "window")]
    pub(crate) fn flags_but(
        &self,
        decided: &[&str],
        file: Option<&Path>,
    ) -> Result<Vec<String>, clap::Error> {
        /// They are about the program, not about the image.
        const ASIDE: [&str; 20] = [
            "config",
            "no-config",
            "define",
            "reset",
            "unset",
            "command-script",
            "statefile",
            "compare",
            "reference",
            "interaction-record",
            "interaction-play",
            "interaction-style",
            "dpi-aware",
            "fps",
            "notifications",
            "refine",
            "watch",
            "verbose",
            "screenshot-filename",
            "statefile-filename",
        ];
        let (matches, command) = (self.matches(file)?, RawArgs::command());
        let mut words = Vec::new();
        for argument in command.get_arguments() {
            let Some(flag) = argument.get_long() else { continue };
            let id = argument.get_id().as_str();
            let is_typed = matches.value_source(id) == Some(ValueSource::CommandLine);
            let takes_values = argument.get_action().takes_values();
            if !is_typed || !takes_values || decided.contains(&flag) || ASIDE.contains(&flag) {
                continue;
            }
            for values in matches.get_raw_occurrences(id).into_iter().flatten() {
                let values: Vec<_> = values.map(OsStr::to_string_lossy).collect();
                words.push(format!("--{flag}={}", values.join(",")));
            }
        }
        Ok(words)
    }

    /// Whether a flag was typed, or set by a configuration file, for a file.
    pub(crate) fn is_given(&self, flag: &str, file: Option<&Path>) -> bool {
        let source = self.matches(file).ok().and_then(|matches| matches.value_source(flag));
        source.is_some_and(|source| source != ValueSource::DefaultValue)
    }

    /// A flag with the value that follows one in the list of those that it takes, around the
    /// end.
    ///
    /// # Errors
    /// The flag has no such list.
    pub(crate) fn next_value(&self, flag: &str, now: &str) -> Result<String, String> {
        let command = RawArgs::command();
        let argument = command.get_arguments().find(|argument| argument.get_long() == Some(flag));
        let choices = argument.map(clap::Arg::get_possible_values).unwrap_or_default();
        let index = choices.iter().position(|choice| choice.matches(now, true));
        // Without a value it is as the first one says.
        let next = choices.get((index.unwrap_or(0) + 1) % choices.len().max(1));
        let next = next.ok_or_else(|| format!("{flag} does not have a list of values; write set {flag}"))?;
        Ok(format!("--{flag}={}", next.get_name()))
    }

    fn matches(&self, file: Option<&Path>) -> Result<ArgMatches, clap::Error> {
        let settings = self.config.settings(file);
        let (imperative, usual): (Vec<_>, Vec<_>) =
            settings.into_iter().partition(|setting| setting.imperative);
        let mut words = vec![OsString::from(PROGRAM)];
        let mut from_files: Vec<&ConfigSetting> = imperative.iter().collect();
        if !usual.is_empty() {
            let typed = parsed(words_after_name(&self.typed))?;
            let unset = |setting: &ConfigSetting| self.edits.contains(&format!("--unset={}", setting.flag));
            let counts = |setting: &&ConfigSetting| is_free(setting, &typed) && !unset(setting);
            from_files.extend(usual.iter().filter(counts));
            words.extend(from_files[imperative.len()..].iter().copied().map(setting_word));
        }
        // After `--` there are no flags.
        let end = self.typed.iter().position(|word| word == "--").unwrap_or(self.typed.len());
        words.extend_from_slice(&self.typed[..end]);
        words.extend(imperative.iter().map(setting_word));
        words.extend(self.edits.iter().map(OsString::from));
        words.extend_from_slice(&self.typed[end..]);
        parsed(&words).map_err(|error| located(error, &from_files))
    }
}

/// The name that stands before the flags.
const PROGRAM: &str = "trigon-viewer";

fn words_after_name(words: &[OsString]) -> impl Iterator<Item = OsString> {
    std::iter::once(OsString::from(PROGRAM)).chain(words.iter().cloned())
}

/// The error; if a setting of a configuration file causes it, with the name of that file.
fn located(error: clap::Error, settings: &[&ConfigSetting]) -> clap::Error {
    let wrong = settings.iter().find_map(|setting| {
        let alone = parsed(words_after_name(&[setting_word(setting)])).err()?;
        Some(conflict(format!("{}: {}: {}", setting.file.display(), setting.flag, plain(&alone))))
    });
    wrong.unwrap_or(error)
}

/// The words as flags.
fn parsed(words: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> Result<ArgMatches, clap::Error> {
    RawArgs::command().try_get_matches_from(words).map_err(explained)
}

/// An error with a suggestion, or with the reason why trigon lacks an F3D flag.
fn explained(error: clap::Error) -> clap::Error {
    let unknown = match error.get(ContextKind::InvalidArg) {
        Some(clap::error::ContextValue::String(flag)) if error.kind() == ErrorKind::UnknownArgument => {
            flag.clone()
        }
        _ => return error,
    };
    let name = unknown.trim_start_matches('-').split('=').next().unwrap_or_default().to_owned();
    if let Some(reason) = names::refusal(&name) {
        return conflict(format!("{unknown}: {reason}"));
    }
    match words::meant(&unknown) {
        Some(meant) => conflict(format!("there is no {unknown}; write {meant}")),
        None => error,
    }
}

/// clap's error message on one line.
pub(crate) fn plain(error: &clap::Error) -> String {
    let text = error.to_string();
    let first = text.lines().next().unwrap_or_default();
    first.trim_start_matches("error: ").to_owned()
}

fn conflict(message: impl std::fmt::Display) -> clap::Error {
    RawArgs::command().error(ErrorKind::ArgumentConflict, message)
}

/// The axis that points up in files with this name.
fn usual_up(file: Option<&Path>) -> UpAxis {
    let extension = file.and_then(Path::extension).unwrap_or_default().to_string_lossy();
    Format::from_extension(&extension).map_or(UpAxis::Y, Format::up)
}

/// The flag in a word such as `--up=+Z`, without dashes; empty for other words.
fn flag_of(word: &str) -> &str {
    word.strip_prefix("--").map_or("", |rest| rest.split('=').next().unwrap_or_default())
}

fn setting_word(setting: &ConfigSetting) -> OsString {
    word(&setting.flag, &setting.value)
}

/// A flag with its value as a word. `true` for a flag that takes no such value becomes the flag alone.
pub(super) fn word(flag: &str, value: &str) -> OsString {
    let command = RawArgs::command();
    let argument = command.get_arguments().find(|argument| argument.get_long() == Some(flag));
    let choices = argument.map(clap::Arg::get_possible_values).unwrap_or_default();
    if value == "true" && !choices.is_empty() {
        return format!("--{flag}").into();
    }
    format!("--{flag}={value}").into()
}

/// Whether neither the flag nor a conflicting one was typed.
fn is_free(setting: &ConfigSetting, typed: &ArgMatches) -> bool {
    let is_typed = |id: &str| typed.value_source(id) == Some(ValueSource::CommandLine);
    let unset =
        typed.get_many::<String>("unset").is_some_and(|mut flags| flags.any(|flag| *flag == setting.flag));
    let command = RawArgs::command();
    let argument = command.get_arguments().find(|argument| argument.get_long() == Some(&setting.flag));
    let Some(argument) = argument else { return !unset };
    let contradicted = command.get_arg_conflicts_with(argument);
    let against = command.get_arguments().filter(|other| {
        command.get_arg_conflicts_with(other).iter().any(|conflict| conflict.get_id() == argument.get_id())
    });
    let mut others = contradicted.into_iter().chain(against);
    !unset && !is_typed(argument.get_id().as_str()) && !others.any(|other| is_typed(other.get_id().as_str()))
}

/// clap's name of a flag.
fn identifier(flag: &str) -> Option<String> {
    let command = RawArgs::command();
    let found = command.get_arguments().find(|argument| {
        let aliases = argument.get_all_aliases().unwrap_or_default();
        argument.get_long() == Some(flag) || aliases.contains(&flag)
    })?;
    Some(found.get_id().to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(typed: &str, config: &str) -> CommandLine {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("c.json");
        std::fs::write(&path, config).expect("written");
        let mut words: Vec<OsString> = typed.split_whitespace().map(OsString::from).collect();
        words.push(format!("--config={}", path.display()).into());
        CommandLine::new(words).expect("it makes sense")
    }

    fn value(line: &CommandLine, flag: &str) -> Option<String> {
        line.value(flag, Some(Path::new("/x/a.stl")))
    }

    #[test]
    fn the_command_line_wins_over_files_but_for_what_is_imperative() {
        let config = r#"[{"options": {"edges": true, "up": "+Z", "!grid": true, "anti-aliasing": true}}]"#;
        let plain = line("a.stl", config);
        assert_eq!(value(&plain, "edges").as_deref(), Some("true"), "from the file");
        assert_eq!(value(&plain, "anti-aliasing").as_deref(), Some("ssaa"), "true is its usual value");
        let typed = line("a.stl --edges=no --grid=false --up=+X", config);
        assert_eq!(value(&typed, "edges").as_deref(), Some("no"), "typed");
        assert_eq!(value(&typed, "up").as_deref(), Some("+X"), "typed");
        assert_eq!(value(&typed, "grid").as_deref(), Some("true"), "imperative");
        let reset = line("a.stl -R scene.up_direction", config);
        assert_eq!(value(&reset, "up").as_deref(), Some("+Z"), "the default of STL");
        let other = reset.value("up", Some(Path::new("a.glb")));
        assert_eq!(other.as_deref(), Some("+Y"), "that of all others");
    }

    /// A direction in a file and a camera on the command line were reported as conflicting.
    #[test]
    fn what_is_typed_takes_the_place_of_what_contradicts_it() {
        let config = r#"[{"options": {"camera-direction": "-1,-0.5,-1"}}]"#;
        assert_eq!(value(&line("a.stl", config), "camera-direction").as_deref(), Some("-1,-0.5,-1"), "alone");
        for typed in ["--view=top", "--camera-index=0", "--camera-direction=+X"] {
            let line = line(typed, config);
            line.raw(None).expect("no contradiction");
            assert_ne!(value(&line, "camera-direction").as_deref(), Some("-1,-0.5,-1"), "{typed}");
        }
    }

    #[test]
    fn scripts_have_the_last_word() {
        let edited = line("a.stl --up=+X", "[]").with(["--up=-Z".to_owned()]);
        assert_eq!(value(&edited, "up").as_deref(), Some("-Z"), "the script's");
        assert_eq!(value(&edited.without("up"), "up").as_deref(), Some("+X"), "as it was typed");
    }

    #[test]
    fn unknown_flags_say_what_is_meant() {
        for (typed, expected) in [
            ("--bg-color red", "--background-color"),
            ("--quiet", "--verbose=quiet"),
            ("--final-shader x", "no GPU"),
            ("-s", "simulation values"),
            ("--resolutoin 1,1", "--resolution"),
        ] {
            let words = typed.split_whitespace().map(OsString::from);
            let message = CommandLine::new(words).expect_err("unknown").to_string();
            assert!(message.contains(expected), "{typed}: {message}");
        }
    }
}
