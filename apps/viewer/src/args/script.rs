//! Command scripts: F3D's commands, one per line, as changes to the command line.

use std::path::PathBuf;

use super::names;

/// The meaning of one line of a script.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Step {
    /// Add these flags.
    Edit(Vec<String>),
    /// Toggle a switch.
    Toggle(String),
    /// Undo changes to a flag.
    Reset(String),
    /// Move a number one step up, or down.
    Increase(String, bool),
    /// Switch to the next of several values.
    Cycle(String),
    /// Print the value of a flag.
    Print(String),
    /// Print what is in the model.
    SceneInfo,
    /// Write an image; without a name, to that of screenshots.
    Screenshot { file: Option<String>, background: bool },
    /// Skip this many files.
    Go(isize),
    /// Append files.
    Add(Vec<PathBuf>),
    /// An alias for the beginning of a line.
    Alias(String, String),
    /// Say this.
    Say(String),
    /// Do nothing, for the given reason.
    Ignored(&'static str),
    /// Skip the rest of the script.
    Stop,
}

/// A number that `increase` and `decrease` change.
#[derive(Clone, Copy)]
pub(crate) struct Steps {
    pub(crate) flag: &'static str,
    pub(crate) least: f64,
    pub(crate) most: f64,
    pub(crate) step: f64,
    /// The value from which steps begin if the flag has none.
    pub(crate) unset: f64,
}

/// All of them.
pub(crate) const STEPS: [Steps; 10] = [
    Steps { flag: "light-intensity", least: 0.0, most: 1e6, step: 0.1, unset: 1.0 },
    Steps { flag: "opacity", least: 0.0, most: 1.0, step: 0.05, unset: 1.0 },
    Steps { flag: "roughness", least: 0.0, most: 1.0, step: 0.05, unset: 1.0 },
    Steps { flag: "metallic", least: 0.0, most: 1.0, step: 0.05, unset: 1.0 },
    Steps { flag: "line-width", least: 0.5, most: 100.0, step: 0.5, unset: 1.0 },
    Steps { flag: "point-size", least: 0.5, most: 100.0, step: 0.5, unset: 1.0 },
    Steps { flag: "point-sprites-size", least: 0.1, most: 100.0, step: 0.5, unset: 1.0 },
    Steps { flag: "normal-glyphs-scale", least: 0.1, most: 10.0, step: 0.1, unset: 1.0 },
    Steps { flag: "font-scale", least: 0.5, most: 4.0, step: 0.1, unset: 1.0 },
    Steps { flag: "exposure", least: -20.0, most: 20.0, step: 0.25, unset: 0.0 },
];

/// The meaning of a script, line by line; `aliases` replace beginnings of lines.
///
/// # Errors
/// The number of a line, and its error.
pub(crate) fn steps(text: &str) -> Result<Vec<(usize, Step)>, (usize, String)> {
    let mut aliases: Vec<(String, String)> = Vec::new();
    let mut steps = Vec::new();
    for (line, number) in text.lines().zip(1..) {
        let words = split(line).map_err(|why| (number, why.to_owned()))?;
        let replaced = words.first().and_then(|first| aliases.iter().find(|(name, _)| name == first));
        let words = match replaced {
            Some((_, command)) => {
                let mut whole = split(command).map_err(|why| (number, why.to_owned()))?;
                whole.extend_from_slice(&words[1..]);
                whole
            }
            None => words,
        };
        if words.is_empty() {
            continue;
        }
        match step(&words).map_err(|why| (number, why))? {
            Step::Alias(name, command) => aliases.push((name, command)),
            step => steps.push((number, step)),
        }
    }
    Ok(steps)
}

/// The meaning of one line.
pub(crate) fn step(words: &[String]) -> Result<Step, String> {
    let (action, rest) = words.split_first().ok_or("the line is empty")?;
    let one = || match rest {
        [value] => Ok(value.as_str()),
        _ => Err(format!("{action} takes one word")),
    };
    let angle =
        |kind: &str| Ok::<_, String>(Step::Edit(vec![format!("--camera-turn={kind}:{}", number(one()?)?)]));
    let jump = |kind: &str| {
        Ok::<_, String>(Step::Edit(vec![format!("--animation-jump={kind}:{}", number(one()?)?)]))
    };
    Ok(match action.as_str() {
        "set" => match rest {
            [name, values @ ..] if !values.is_empty() => Step::Edit(names::set(name, &values.join(","))?),
            _ => return Err("set takes an option and a value".to_owned()),
        },
        "toggle" => Step::Toggle(names::flag(one()?)?.to_owned()),
        "reset" => Step::Reset(names::flag(one()?)?.to_owned()),
        "increase" | "decrease" => {
            let flag = names::flag(one()?)?;
            if !STEPS.iter().any(|steps| steps.flag == flag) {
                let known: Vec<&str> = STEPS.iter().map(|steps| steps.flag).collect();
                return Err(format!("{flag} has no steps; there are {}", known.join(", ")));
            }
            Step::Increase(flag.to_owned(), action == "increase")
        }
        "increase_light_intensity" => Step::Increase("light-intensity".to_owned(), true),
        "decrease_light_intensity" => Step::Increase("light-intensity".to_owned(), false),
        "cycle" => Step::Cycle(names::flag(one()?)?.to_owned()),
        "print" => Step::Print(names::flag(one()?)?.to_owned()),
        "print_scene_info" | "print_mesh_info" | "print_coloring_info" => Step::SceneInfo,
        "print_options_info" | "print_config_info" => Step::Print(String::new()),
        "roll_camera" => angle("roll")?,
        "elevation_camera" => angle("elevation")?,
        "azimuth_camera" => angle("azimuth")?,
        "reset_camera" => Step::Edit(vec!["--camera-turn=reset".to_owned()]),
        "set_camera" => {
            Step::Edit(vec![format!("--view={}", side(one()?)?), "--camera-turn=reset".to_owned()])
        }
        "jump_to_frame" => jump("frame")?,
        "jump_to_frame_relative" => jump("frame-by")?,
        "jump_to_keyframe" => jump("keyframe")?,
        "jump_to_keyframe_relative" => jump("keyframe-by")?,
        "jump_to_time" => jump("time")?,
        "jump_to_time_relative" => jump("time-by")?,
        "toggle_animation" => Step::Toggle("animation-autoplay".to_owned()),
        "toggle_animation_backward" => {
            Step::Edit(vec!["--animation-speed-factor=-1".to_owned(), "--animation-autoplay".to_owned()])
        }
        "cycle_verbose_level" => Step::Cycle("verbose".to_owned()),
        "toggle_volume_rendering" => Step::Ignored(
            "toggle_volume_rendering is ignored: there are no volumes in the formats that are read",
        ),
        "take_screenshot" | "take_minimal_screenshot" => {
            if rest.len() > 1 {
                return Err(format!("{action} takes one name"));
            }
            Step::Screenshot { file: rest.first().cloned(), background: action == "take_screenshot" }
        }
        "load_next_file_group" => Step::Go(1),
        "load_previous_file_group" => Step::Go(-1),
        "reload_current_file_group" => Step::Go(0),
        "add_files" | "add_files_or_set_hdri" => added(rest, action == "add_files_or_set_hdri"),
        "set_hdri" => Step::Edit(vec![format!("--hdri-file={}", one()?), "--hdri-skybox".to_owned()]),
        "alias" => match rest {
            [name, command @ ..] if !command.is_empty() => Step::Alias(name.clone(), command.join(" ")),
            _ => return Err("alias takes a name and a command".to_owned()),
        },
        "clear" => Step::Edit(Vec::new()),
        "help" => Step::Say(format!("commands: {}", KNOWN.join(", "))),
        "exit" | "stop_interactor" => Step::Stop,
        other => return Err(unknown(other)),
    })
}

/// What `help` lists.
const KNOWN: [&str; 38] = [
    "set",
    "toggle",
    "reset",
    "increase",
    "decrease",
    "cycle",
    "print",
    "print_scene_info",
    "print_mesh_info",
    "print_options_info",
    "print_config_info",
    "roll_camera",
    "elevation_camera",
    "azimuth_camera",
    "reset_camera",
    "set_camera",
    "jump_to_frame",
    "jump_to_frame_relative",
    "jump_to_keyframe",
    "jump_to_keyframe_relative",
    "jump_to_time",
    "jump_to_time_relative",
    "toggle_animation",
    "toggle_animation_backward",
    "cycle_verbose_level",
    "take_screenshot",
    "take_minimal_screenshot",
    "load_next_file_group",
    "load_previous_file_group",
    "reload_current_file_group",
    "add_files",
    "add_files_or_set_hdri",
    "set_hdri",
    "alias",
    "clear",
    "help",
    "exit",
    "stop_interactor",
];

/// F3D commands that trigon lacks, with the reason.
const REFUSED: [(&str, &str); 12] = [
    ("cycle_animation", "write set animation-indices and a number or a name"),
    ("cycle_coloring", "simulation values are not shown as colours"),
    ("add_current_directories", "name the folder on the command line"),
    ("remove_current_file_group", "name the files that are to be shown on the command line"),
    ("remove_file_groups", "name the files that are to be shown on the command line"),
    ("set_reader_option", "readers have no options; leave the line out"),
    ("open_file_dialog", "a script cannot wait for input; write add_files"),
    ("save_statefile", NO_STATE),
    ("load_statefile", NO_STATE),
    ("save_statefile_dialog", NO_STATE),
    ("load_statefile_dialog", NO_STATE),
    ("save_statefile_to_clipboard", NO_STATE),
];

const NO_STATE: &str = "state files are for the window (Ctrl+S, Ctrl+L) and for --statefile";

fn unknown(action: &str) -> String {
    if let Some((_, why)) = REFUSED.iter().find(|(name, _)| *name == action) {
        return format!("{action}: {why}");
    }
    if action.ends_with("_statefile_from_clipboard") {
        return format!("{action}: {NO_STATE}");
    }
    format!("there is no command {action}; there are {}", KNOWN.join(", "))
}

fn added(files: &[String], may_light: bool) -> Step {
    let lights = |file: &&String| may_light && file.to_lowercase().ends_with(".hdr");
    match files.iter().find(lights) {
        Some(file) => Step::Edit(vec![format!("--hdri-file={file}"), "--hdri-skybox".to_owned()]),
        None => Step::Add(files.iter().map(PathBuf::from).collect()),
    }
}

fn number(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| format!("{text} is not a number"))
}

fn side(text: &str) -> Result<&'static str, String> {
    const SIDES: [&str; 7] = ["front", "back", "left", "right", "top", "bottom", "isometric"];
    match SIDES.into_iter().find(|side| *side == text) {
        Some("isometric") => Ok("iso"),
        Some(side) => Ok(side),
        None => Err(format!("set_camera takes {}", SIDES.join(", "))),
    }
}

/// The words of a line: quotes `'"` and backticks group words, a backslash escapes the next
/// character, and `#` begins a comment.
pub(crate) fn split(line: &str) -> Result<Vec<String>, &'static str> {
    let (mut words, mut word, mut quote) = (Vec::new(), None::<String>, None);
    let mut characters = line.chars();
    while let Some(character) = characters.next() {
        match (character, quote) {
            ('\\', _) => {
                let next = characters.next().ok_or("a backslash at the end")?;
                word.get_or_insert_default().push(next);
            }
            (_, Some(open)) if character == open => quote = None,
            (_, Some(_)) => word.get_or_insert_default().push(character),
            ('\'' | '"' | '`', None) => {
                quote = Some(character);
                word.get_or_insert_default();
            }
            ('#', None) => break,
            (space, None) if space.is_whitespace() => words.extend(word.take()),
            (_, None) => word.get_or_insert_default().push(character),
        }
    }
    words.extend(word);
    if quote.is_some() { Err("a quote is not closed") } else { Ok(words) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_split_as_by_a_shell() {
        for (line, expected) in [
            ("set scene.up.direction +Z", &["set", "scene.up.direction", "+Z"][..]),
            (
                r#"set render.hdri.file "/a/with spaces.png""#,
                &["set", "render.hdri.file", "/a/with spaces.png"],
            ),
            ("set f '/a/b c'", &["set", "f", "/a/b c"]),
            (r#"set f "/a'b'c""#, &["set", "f", "/a'b'c"]),
            (r#"set f a\ b\'c\""#, &["set", "f", "a b'c\""]),
            ("roll_camera 90 # a comment", &["roll_camera", "90"]),
            (r"set f \#1", &["set", "f", "#1"]),
            (r"set f C:\\a", &["set", "f", r"C:\a"]),
            (r"set scene.up.direction +\Z", &["set", "scene.up.direction", "+Z"]),
            ("# only a comment", &[]),
            ("set f ''", &["set", "f", ""]),
        ] {
            assert_eq!(split(line).expect("whole"), expected, "{line}");
        }
        assert!(split("set f \"+Z").is_err() && split("set f +Z\\").is_err(), "unfinished");
    }

    #[test]
    fn a_mistake_names_its_line() {
        for (text, line, word) in [
            ("roll_camera 90\nroll_camera", 2, "one word"),
            ("\n\ndance", 3, "no command dance"),
            ("set_camera up", 1, "isometric"),
            ("roll_camera far", 1, "not a number"),
            ("toggle render.nothing", 1, "not an option"),
            ("increase up", 1, "light-intensity"),
            ("save_statefile a", 1, "--statefile"),
            ("set up 'x", 1, "not closed"),
        ] {
            let (at, why) = steps(text).expect_err("a mistake");
            assert!(at == line && why.contains(word), "{text:?}: {at}, {why}");
        }
    }

    #[test]
    fn aliases_stand_for_beginnings() {
        let steps = steps("alias turn roll_camera\nturn 90").expect("fine");
        assert_eq!(steps, [(2, Step::Edit(vec!["--camera-turn=roll:90".to_owned()]))], "with the rest");
    }

    #[test]
    fn everything_that_help_lists_is_known() {
        for name in KNOWN {
            let known = step(&[name.to_owned()]).err().is_none_or(|why| !why.contains("no command"));
            assert!(known, "{name}");
        }
    }
}
