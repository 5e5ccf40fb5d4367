//! Every example of options and commands in F3D's user documentation (03-OPTIONS,
//! 05-ANIMATIONS, 06-CONFIGURATION_FILE, 07-COMMANDS, 08-PARSING and what other pages show),
//! one row each: what trigon does with it, held by its effect on the image, on the output
//! or on the exit code.

mod examples;
mod models;

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

use Expected::{Changes, Exit, InWindow, Keeps, Refused, Says, Shows, Warned, Writes};
use examples::{COMMANDS, OPTIONS, Row};
use models::{BINDINGS, CORNER, DOTS_PLY, TYPICAL, bones, quad, room, slide};

/// What an example does.
#[derive(Clone, Copy, Debug)]
enum Expected {
    /// Same: the image differs from the one without it, of the same file.
    Changes,
    /// Same: the image is that without it, because it names the default, or what F3D's flag
    /// turns on is always on.
    Keeps,
    /// Same: what it does is seen in the window, where replayed sessions hold it; the image is that without it.
    InWindow,
    /// Same: the image is that of these flags, which differs from the one without.
    Shows(&'static str),
    /// Same: standard output holds this.
    Says(&'static str),
    /// Same: it writes this file.
    Writes(&'static str),
    /// Same: it ends with this code, and says this.
    Exit(i32, &'static str),
    /// A flag of graphics cards and plugins: does nothing, with a warning that names it.
    Warned,
    /// Ends with 2 and this reason.
    Refused(&'static str),
}

/// The sessions of the window that use F3D's flags.
const REPLAYS: [&str; 2] = [
    include_str!("../../src/window/viewer/replays/flags.rs"),
    include_str!("../../src/window/viewer/replays/broken_files.rs"),
];

/// A folder with all that the examples name, removed at the end.
struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        let folder = Self(tempfile::tempdir().expect("a temporary folder"));
        for name in ["folder", "nest", "nest/deep", "config.d"] {
            fs::create_dir(folder.path(name)).expect("a folder");
        }
        for (name, contents) in [
            ("box.obj", CORNER),
            ("model.vtp.obj", CORNER),
            ("folder/inside.obj", CORNER),
            ("nest/deep/inner.obj", CORNER),
            ("part1.obj", CORNER),
            ("part2.obj", "v 2 0 0\nv 3 0 0\nv 2 1 0\nf 1 2 3\n"),
            ("empty.obj", ""),
            ("dots.ply", DOTS_PLY),
            ("turn.txt", "# A comment\nroll_camera 90\nprint_scene_info # Another comment\n"),
            ("blue.json", r#"[{"options": {"background-color": "blue"}}]"#),
            ("config.d/1.json", r#"[{"options": {"background-color": "red"}}]"#),
            ("config.d/2.json", r#"[{"options": {"render.background.color": "blue"}}]"#),
            ("regex.json", r#"[{"match": ".*vt.\\.obj", "options": {"edges": true}}]"#),
            ("glob.json", r#"[{"match-type": "glob", "match": "**/*.{o,g}bj", "options": {"edges": true}}]"#),
            (
                "exact.json",
                r#"[{"match-type": "exact", "match": "/path/to/file.mhd", "options": {"edges": true}}]"#,
            ),
            ("imperative.json", r#"[{"options": {"!edges": true}}]"#),
            ("bindings.json", BINDINGS),
            (
                "thumbnail.json",
                r#"[{"options": {"no-background": true, "anti-aliasing": "ssaa", "verbose": "quiet"}}]"#,
            ),
            ("typical.json", TYPICAL),
            (
                "state.json",
                r#"{"format": "trigon state 1", "files": ["box.obj"], "options": {"style": "edges"}}"#,
            ),
            ("slide.gltf", &slide()),
            ("quad.gltf", &quad("")),
            ("camera.gltf", &quad(r#", {"camera": 0, "translation": [0, 0, 9]}"#)),
            ("back.gltf", &quad("").replace("\"doubleSided\": true", "\"doubleSided\": false")),
            ("bones.gltf", &bones()),
        ] {
            fs::write(folder.path(name), contents).expect("written");
        }
        for name in ["room.hdr", "room with spaces.hdr"] {
            fs::write(folder.path(name), room()).expect("written");
        }
        let paint: Vec<u8> = (0..64).flat_map(|i: u8| [i * 4, 255 - i * 4, 200, 255]).collect();
        let pixels = trigon_io::Pixels::Rgba8(&paint);
        trigon_io::write_png(folder.path("paint.png"), 8, 8, pixels).expect("written");
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn run(&self, words: &str) -> Output {
        let mut words = split(words);
        let input = words.iter().position(|word| word == "<").map(|at| words.split_off(at).remove(1));
        let mut command = Command::new(env!("CARGO_BIN_EXE_trigon-viewer"));
        command.args(&words).current_dir(self.0.path());
        for variable in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
            command.env_remove(variable);
        }
        command.env("XDG_CONFIG_HOME", self.path("no-config"));
        if let Some(name) = input {
            command.stdin(fs::File::open(self.path(&name)).expect("it is there"));
        }
        command.output().expect("the viewer starts")
    }

    /// The pixels of an image.
    fn image(&self, words: &str) -> Result<(trigon_io::RgbaImage, String), String> {
        let size = if words.contains("--resolution") { "" } else { "--resolution=60,40" };
        let output = self.run(&format!("{size} {words} --output=image.png"));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        if output.status.code() != Some(0) {
            return Err(format!("`{words}` said: {said}"));
        }
        let image = trigon_io::load_image(self.path("image.png"), &trigon_io::Limits::default());
        Ok((image.expect("an image"), said))
    }

    /// Whether two command lines show the same.
    fn same(&self, one: &str, other: &str) -> Result<bool, String> {
        Ok(self.image(one)?.0 == self.image(other)?.0)
    }

    /// Whether a run ends with a code and says something.
    fn ends(&self, words: &str, code: i32, part: &str) -> Result<(), String> {
        let small = if words.contains("--output") && !words.contains("--resolution") {
            "--resolution=60,40"
        } else {
            ""
        };
        let output = self.run(&format!("{small} {words}"));
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let (said, out) = (text(&output.stderr), text(&output.stdout));
        let is_said = said.contains(part) || (code == 0 && out.contains(part));
        let is_fine = output.status.code() == Some(code) && is_said && !said.contains("panicked");
        holds(is_fine, || {
            format!("`{words}` ended with {:?}, not with {part:?}: {said}", output.status.code())
        })
    }

    /// What a row says, or why that is not so.
    fn check(&self, file: &str, words: &str, plain: &str, expected: Expected) -> Result<(), String> {
        let whole = format!("{file} {words}");
        match expected {
            Changes => holds(!self.same(&whole, plain)?, || "it changes nothing".to_owned()),
            Keeps => holds(self.same(&whole, plain)?, || "it changes something".to_owned()),
            InWindow => {
                let flag = words.split(['=', ' ']).next().unwrap_or_default();
                holds(REPLAYS.iter().any(|text| text.contains(flag)), || "no session replays it".to_owned())?;
                holds(self.same(&whole, plain)?, || "it changes something".to_owned())
            }
            Shows(flags) => {
                let shown = format!("{file} {flags}");
                let is_plain = self.same(&shown, plain)? && !plain.contains("-time");
                holds(!is_plain, || format!("{flags} shows nothing"))?;
                holds(self.same(&whole, &shown)?, || format!("it is not what {flags} shows"))
            }
            Says(part) => self.ends(&whole, 0, part),
            Writes(path) => {
                // Old ones would hide that nothing is written.
                let _ = fs::remove_file(self.path(path));
                self.ends(&whole, 0, "")?;
                holds(self.path(path).is_file(), || format!("{path} is not written"))
            }
            Exit(code, part) => self.ends(&whole, code, part),
            Warned => {
                let said = self.image(&whole)?.1;
                holds(said.contains(" is ignored: "), || format!("no warning: {said}"))?;
                holds(self.same(&whole, plain)?, || "it changes something".to_owned())
            }
            Refused(reason) => self.ends(&whole, 2, reason),
        }
    }
}

fn holds(condition: bool, otherwise: impl FnOnce() -> String) -> Result<(), String> {
    if condition { Ok(()) } else { Err(otherwise()) }
}

/// Words, with what stands in single quotes as one.
fn split(text: &str) -> Vec<String> {
    let parts = text.split('\'').enumerate();
    let words = parts.flat_map(|(index, part)| match index % 2 {
        0 => part.split_whitespace().map(str::to_owned).collect(),
        _ => vec![part.to_owned()],
    });
    words.collect()
}

/// Without the flag, but with what it needs to show anything, and as large.
fn plain(file: &str, words: &str) -> String {
    let needed = |word: &&str| {
        let last = words.split_whitespace().last();
        let is_base =
            ["--axis", "--grid", "--edges", "--filename", "--normal-glyphs", "-o", "--hdri-file=room.hdr"];
        let tuned = [
            "--camera-position=2,",
            "--camera-focal-point=2,",
            "--texture-",
            "--metallic=0",
            "--view",
            "--light-intensity=4",
            "--config",
        ];
        Some(*word) != last && (is_base.contains(word) || tuned.iter().any(|part| word.starts_with(part)))
    };
    let needed: Vec<&str> = words.split_whitespace().filter(needed).collect();
    let size = if words.contains("--resolution=300") { " --resolution=60,40" } else { "" };
    let needed = needed.join(" ");
    let needed =
        if needed.contains("--config") || needed.contains("--texture-material") { "" } else { &needed };
    format!("{file} {needed}{size}")
}

#[test]
fn every_documented_option_does_what_it_does_in_f3d_or_says_why_not() {
    let folder = Folder::new();
    folder.run("box.obj --resolution=200,120 --output=box_before.png");
    let failed = OPTIONS.iter().filter_map(|&(name, file, words, expected)| {
        let checked = folder.check(file, words, &plain(file, words), expected);
        checked.err().map(|why| format!("{name}: {why}"))
    });
    let failed: Vec<String> = failed.collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn every_documented_command_does_what_it_does_in_f3d_or_says_why_not() {
    let folder = Folder::new();
    let failed = COMMANDS.iter().filter_map(|&(name, file, script, expected)| {
        fs::write(folder.path("script.txt"), script).expect("written");
        let mut words = "--command-script=script.txt".to_owned();
        if !matches!(expected, Changes | Keeps | Shows(_) | Warned) {
            words += " --resolution=60,40 --output=o.png";
        }
        // The first of those jumps is at the start.
        let time = if script.contains("jump_to") { " --animation-time=0" } else { "" };
        let checked = folder.check(file, &words, &format!("{file}{time}"), expected);
        checked.err().map(|why| format!("{name}: {why}"))
    });
    let failed: Vec<String> = failed.collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// At least seven of ten do the same; warned are flags of graphics cards and plugins alone.
#[test]
fn most_examples_work_and_only_those_of_cards_and_plugins_are_warned_of() {
    let rows = || OPTIONS.iter().chain(COMMANDS);
    let refused = rows().filter(|row| matches!(row.3, Refused(_) | Exit(2, _))).count();
    let warned: Vec<&Row> = rows().filter(|row| matches!(row.3, Warned)).collect();
    let (all, warned_count) = (rows().count(), warned.len());
    let same = all - refused - warned_count;
    assert!(same * 10 >= all * 7, "{same} of {all} are the same");
    let said = format!("{same} of {all} are the same, {refused} are refused, {warned_count} are warned of");
    let guide = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/viewer.md"));
    assert!(guide.expect("the guide").contains(&said), "docs/viewer.md does not say: {said}");
    for (name, _, words, _) in warned {
        // Only cards draw volumes.
        let cards = ["plugins", "rendering-backend", "raytracing", "volume", "-r", "-d", "-v", "-i"];
        assert!(cards.iter().any(|part| words.contains(part)), "{name}: {words}");
    }
}
