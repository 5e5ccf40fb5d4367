//! Preprocesses the words as typed: values of switches that stand as separate words, F3D's `-D` and
//! `-R`, and suggestions for unknown flags.

use std::ffi::{OsStr, OsString};
use std::path::Path;

use clap::{Arg, Command};

use super::names;
use super::values;

/// The words after the program's name, with each value of a switch attached to it, and F3D library
/// options translated.
///
/// `--edges true model.glb` sets a switch, as in F3D's scripts, unless there is a file of that
/// name. Anything that is not a value of the preceding flag stays a file.
///
/// # Errors
/// `-D` or `-R` has an invalid value.
pub(crate) fn prepared(
    command: &Command,
    words: impl IntoIterator<Item = OsString>,
) -> Result<Vec<OsString>, String> {
    let mut prepared: Vec<OsString> = Vec::new();
    let mut words = words.into_iter().peekable();
    while let Some(word) = words.next() {
        let text = word.to_str().unwrap_or_default();
        if text == "--" {
            prepared.push(word);
            prepared.extend(words);
            return Ok(prepared);
        }
        if let Some(defined) = library_flag(text, &mut || words.next())? {
            prepared.extend(defined.into_iter().map(OsString::from));
            continue;
        }
        let value = words.peek().filter(|value| takes(command, text, value)).cloned();
        prepared.push(match value {
            Some(value) => {
                words.next();
                joined(&word, &value)
            }
            None => word,
        });
    }
    Ok(prepared)
}

fn joined(flag: &OsStr, value: &OsStr) -> OsString {
    let mut whole = flag.to_owned();
    whole.push("=");
    whole.push(value);
    whole
}

/// Whether a word is the value of the preceding flag, which also works without one.
fn takes(command: &Command, flag: &str, value: &OsStr) -> bool {
    let Some(value) = value.to_str().filter(|value| !Path::new(value).exists()) else { return false };
    let Some(argument) = argument(command, flag).filter(|argument| is_optional(argument)) else {
        return false;
    };
    let choices = argument.get_possible_values();
    if choices.is_empty() {
        values::switch(value).is_ok()
    } else {
        choices.iter().any(|choice| choice.matches(value, true)) || values::switch(value).is_ok()
    }
}

/// The flag that a word is, if it is one without a value.
fn argument<'a>(command: &'a Command, flag: &str) -> Option<&'a Arg> {
    let long = flag.strip_prefix("--");
    let short = flag.strip_prefix('-').and_then(|rest| rest.chars().next_back());
    command.get_arguments().find(|argument| match long {
        Some(long) => argument.get_long() == Some(long),
        None => short.is_some() && argument.get_short() == short,
    })
}

/// Whether a flag may stand without its value, which then needs an equals sign.
fn is_optional(argument: &Arg) -> bool {
    argument.is_require_equals_set()
}

/// `-Dname=value`, `-Rname` and their long forms, as flags.
fn library_flag(
    word: &str,
    next: &mut dyn FnMut() -> Option<OsString>,
) -> Result<Option<Vec<String>>, String> {
    let mut value = |short: &str, long: &str| {
        if word == short || word == long {
            return Some(next().and_then(|value| value.into_string().ok()).unwrap_or_default());
        }
        let rest = word.strip_prefix(long).and_then(|rest| rest.strip_prefix('='));
        let rest = rest.or_else(|| word.strip_prefix(short).filter(|_| !word.starts_with("--")));
        rest.map(str::to_owned)
    };
    if let Some(defined) = value("-D", "--define") {
        let (name, set) = defined.split_once('=').ok_or_else(|| {
            format!("-D {defined}: write a name and a value, such as -Drender.grid.enable=true")
        })?;
        return names::set(name, set).map(Some);
    }
    if let Some(name) = value("-R", "--reset") {
        return names::flag(&name).map(|flag| Some(vec![format!("--unset={flag}")]));
    }
    Ok(None)
}

/// A suggestion for an unknown flag, if there is one: other programs' names, and short forms.
pub(crate) fn meant(flag: &str) -> Option<&'static str> {
    let name = flag.trim_start_matches('-').split('=').next().unwrap_or_default();
    Some(match name {
        "bg" | "bg-color" | "bgcolor" | "background" | "bg-colour" | "background-colour" => {
            "--background-color=COLOR"
        }
        "transparent" | "alpha" | "no-bg" => "--no-background",
        "quiet" | "silent" => "--verbose=quiet",
        "debug" => "--verbose=debug",
        "width" | "height" | "size" | "w" | "geometry" => "--resolution=W,H",
        "out" | "save" | "screenshot" | "export" | "render" => "--output=FILE.png",
        "axes" | "trihedron" => "--axis",
        "fov" | "vfov" => "--camera-view-angle=DEGREES",
        "ortho" | "orthographic" => "--camera-orthographic",
        "azimuth" => "--camera-azimuth-angle=DEGREES",
        "elevation" => "--camera-elevation-angle=DEGREES",
        "zoom" => "--camera-zoom-factor=FACTOR",
        "eye" | "position-camera" => "--camera-position=X,Y,Z",
        "target" | "lookat" | "look-at" => "--camera-focal-point=X,Y,Z",
        "wire" | "wireframe" => "--style=wireframe",
        "aa" | "msaa" | "antialiasing" => "--anti-aliasing=ssaa or --anti-aliasing=msaa",
        "spp" => "--samples=N",
        "hdr" | "hdri" | "env" | "envmap" => "--hdri-file=FILE.hdr",
        "ao" | "ssao" => "--ambient-occlusion",
        "shadow" => "--shadows",
        "info" | "stats" | "statistics" => "--no-render, or --json",
        "validate" | "lint" => "--check",
        "colour" => "--color=COLOR",
        "frames" | "views" | "spin" => "--turntable=N",
        "fps-limit" | "framerate" => "--frame-rate=N",
        "time" => "--animation-time=SECONDS",
        "format" | "reader" => "--force-reader=FORMAT",
        "ref" => "--reference=FILE.png",
        "aov" | "aovs" | "depth" | "normals" => "--outputs=depth,normals",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::super::RawArgs;
    use super::*;

    fn words(text: &str) -> Result<String, String> {
        let words = text.split_whitespace().map(OsString::from);
        let prepared = prepared(&RawArgs::command(), words)?;
        Ok(prepared.join(OsStr::new(" ")).to_string_lossy().into_owned())
    }

    /// After `--camera-orthographic true`, the message was about two files.
    #[test]
    fn a_switch_takes_the_word_behind_it() {
        for (typed, expected) in [
            ("--camera-orthographic true a.obj", "--camera-orthographic=true a.obj"),
            ("-e no a.obj -q", "-e=no a.obj -q"),
            ("--anti-aliasing fxaa a.obj", "--anti-aliasing=fxaa a.obj"),
            ("--verbose debug", "--verbose=debug"),
            ("-e a.obj", "-e a.obj"),
            ("--color true", "--color true"),
            ("-- --edges true", "-- --edges true"),
        ] {
            assert_eq!(words(typed).as_deref(), Ok(expected), "{typed}");
        }
    }

    #[test]
    fn names_of_the_library_become_flags() {
        assert_eq!(words("-Drender.grid.enable=true").as_deref(), Ok("--grid=true"), "attached");
        assert_eq!(words("--define=scene.up_direction=+Z").as_deref(), Ok("--up=+Z"), "long");
        assert_eq!(words("-R render.grid.enable").as_deref(), Ok("--unset=grid"), "reset");
        assert!(words("-Drender.grid").expect_err("no value").contains("name and a value"), "says how");
    }

    #[test]
    fn every_proposal_is_a_flag() {
        let command = RawArgs::command();
        for flag in
            ["--bg-color", "--quiet", "--fov", "--aa", "--save", "--hdr", "--validate", "--depth", "--wire"]
        {
            let proposal = meant(flag).expect("something is meant");
            let named = proposal.split(['=', ',', ' ']).find_map(|word| word.strip_prefix("--"));
            let known = command.get_arguments().any(|argument| argument.get_long() == named);
            assert!(known, "{flag}: {proposal}");
        }
    }
}
