//! The whole program, run as a user runs it: images, streams, messages, exit
//! codes. No display, no network.

mod arrays;
mod batch;
mod comparing;
mod facts;
mod files;
mod flags;
mod frontier;
mod glass;
mod messages;
mod moments;
mod outputs;
mod up;
mod views;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A corner of a cube: three quads, one of them red.
const CORNER: &str = "mtllib corner.mtl
v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1
usemtl red\nf 1 4 3 2\nf 1 2 6 5\nf 1 5 7 4\n";

/// A folder with a model in it, removed at the end.
struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        let folder = Self(tempfile::tempdir().expect("a temporary folder"));
        folder.write("corner.obj", CORNER);
        folder.write("corner.mtl", "newmtl red\nKd 1 0 0\n");
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, contents: &str) {
        fs::write(self.path(name), contents).expect("the folder is writable");
    }

    /// Runs the viewer in this folder, without a display.
    fn run(&self, flags: &str) -> Output {
        self.command(flags).output().expect("the viewer starts")
    }

    fn command(&self, flags: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_trigon-viewer"));
        command.args(flags.split_whitespace()).current_dir(self.0.path());
        command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET");
        command
    }

    /// Runs it and expects an exit code; returns what it said.
    fn said(&self, flags: &str, code: i32) -> String {
        let output = self.run(flags);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(code), "`{flags}` said: {said}");
        assert!(!said.contains("panicked"), "`{flags}` panicked: {said}");
        said
    }

    /// Runs it and expects one line about a failure of the work.
    fn failed(&self, flags: &str) -> String {
        let said = self.said(flags, 1);
        let lines: Vec<&str> = said.lines().collect();
        assert_eq!(lines.len(), 1, "`{flags}` says one line: {said}");
        assert!(said.starts_with("trigon-viewer: error: "), "who and what: {said}");
        said
    }
}

/// Width, height and whether there is an alpha channel, by the PNG's header.
fn png_size(bytes: &[u8]) -> (u32, u32) {
    assert!(bytes.starts_with(b"\x89PNG\r\n\x1a\n"), "a PNG, not {:?}", &bytes[..bytes.len().min(20)]);
    let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().expect("four bytes"));
    (number(16), number(20))
}

fn image(path: &Path) -> trigon_io::RgbaImage {
    trigon_io::load_image(path, &trigon_io::Limits::default()).expect("an image")
}

/// The numbers of a NumPy file, behind its header.
fn array(path: &Path) -> Vec<u8> {
    let bytes = fs::read(path).expect("written");
    assert!(bytes.starts_with(b"\x93NUMPY"), "an array");
    bytes[10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]))..].to_owned()
}

/// The least of the SIMD levels that are always built in.
const NARROW: &str = if cfg!(target_arch = "x86_64") {
    "--simd=sse2"
} else if cfg!(target_arch = "aarch64") {
    "--simd=neon"
} else {
    "--simd=scalar"
};

#[test]
fn a_model_becomes_an_image_of_the_size_asked_for() {
    let folder = Folder::new();
    let said = folder.said("corner.obj --output out.png --resolution 120x80", 0);
    assert_eq!(said, "trigon-viewer: wrote out.png (120×80)\n", "one line, no warning");
    let image = image(&folder.path("out.png"));
    assert_eq!((image.width, image.height), (120, 80), "the size");
    let red = image.rgba.chunks(4).filter(|p| p[0] > 60 && p[1] < 60 && p[2] < 60).count();
    assert!((1500..8000).contains(&red), "the model fills a good part of the image: {red} of 9600 pixels");
}

#[test]
fn without_a_file_there_is_the_built_in_scene() {
    let folder = Folder::new();
    folder.said("--output out.png --resolution 100,60 --samples=1", 0);
    let image = image(&folder.path("out.png"));
    let mut colors: Vec<&[u8]> = image.rgba.chunks(4).collect();
    colors.sort_unstable();
    colors.dedup();
    assert!(colors.len() > 500, "it is no plain area: {} colours", colors.len());
}

/// The same bytes on every machine: the README's image, drawn once on one of
/// them, is what the program draws on this one.
#[test]
fn the_image_in_the_readme_is_what_the_program_draws() {
    let folder = Folder::new();
    folder.said("--output teapot.png", 0);
    let shown = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/images/showcase.png");
    assert!(image(&folder.path("teapot.png")) == image(&shown), "draw docs/images/showcase.png again");
}

#[test]
fn a_dash_writes_the_image_and_nothing_else_to_standard_output() {
    let folder = Folder::new();
    let output = folder.run("corner.obj --output - --resolution 64,48");
    assert!(output.status.success(), "{output:?}");
    assert_eq!(png_size(&output.stdout), (64, 48), "a PNG");
    assert!(output.stdout.ends_with(b"IEND\xaeB\x60\x82"), "up to its end");
    assert!(output.stderr.is_empty(), "nothing to say: {:?}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn a_reader_that_leaves_early_is_no_panic() {
    let folder = Folder::new();
    for flags in ["--output - --resolution 300,300", "--list-readers"] {
        let mut child =
            folder.command(flags).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("starts");
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("it ends");
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(!said.contains("panicked"), "{flags}: {said}");
    }
}

/// The contents tell the format, or --force-reader does.
#[test]
fn a_model_may_come_through_standard_input() {
    let folder = Folder::new();
    for flags in ["- --no-render", "- --no-render --force-reader=obj"] {
        let input = fs::File::open(folder.0.path().join("corner.obj")).expect("it is there");
        let output = folder.command(flags).stdin(input).output().expect("the viewer starts");
        let facts = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(output.status.success() && facts.contains("faces     3"), "{flags}: {output:?}");
    }
    let said = folder.said("corner.obj --force-reader=ply --output o.png", 1);
    assert!(said.contains("not a PLY file"), "{said}");
    let said = folder.said("corner.obj --force-reader=doc --output o.png", 2);
    assert!(said.contains("obj, gltf, glb, ply, stl, off"), "{said}");
}

#[test]
fn lists_and_facts_go_to_standard_output() {
    let folder = Folder::new();
    let listed = |flags: &str| {
        let output = folder.run(flags);
        assert!(output.status.success(), "{flags}: {output:?}");
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    let readers = listed("--list-readers");
    assert!(
        [".obj", ".gltf", ".glb", ".ply", ".stl", ".off"].iter().all(|ending| readers.contains(ending)),
        "{readers}"
    );
    let facts = listed("corner.obj --no-render");
    assert!(facts.contains("faces     3") && facts.contains("1 x 1 x 1"), "{facts}");
    assert!(listed("--version").starts_with("trigon-viewer "), "its name");
    assert!(listed("--help").contains("Exit codes"), "documented");
}

#[test]
fn the_same_model_gives_the_same_bytes() {
    let folder = Folder::new();
    let bytes = |flags: &str| folder.run(&format!("--output - --resolution 150,90 {flags}")).stdout;
    let one = bytes("--threads=1");
    assert_eq!(png_size(&one), (150, 90), "an image");
    for flags in ["--threads=2", "--threads=7", NARROW, &format!("{NARROW} --threads=3")] {
        assert!(one == bytes(flags), "{flags}");
    }
}

/// It was "0.0 MiB, more than --max-size=0.0000095367431640625 allows".
#[test]
fn a_small_limit_is_named_in_readable_numbers() {
    let folder = Folder::new();
    folder.write("big.obj", &" ".repeat(4096));
    let said = folder.failed("big.obj --max-size=0.001 --output big.png");
    assert!(said.contains("is 0.003906 MiB"), "the size: {said}");
    assert!(said.contains("--max-size=9.995e-4"), "the limit, in whole bytes: {said}");
}

/// Only the exit code showed it.
#[cfg(target_os = "linux")]
#[test]
fn a_list_that_cannot_be_written_says_so() {
    let full = fs::OpenOptions::new().write(true).open("/dev/full").expect("Linux has it");
    let output = Folder::new().command("--list-readers").stdout(full).output().expect("the viewer starts");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "said: {said}");
    assert!(said.contains("standard output cannot be written"), "said: {said}");
}

#[test]
fn a_turntable_becomes_files_or_one_that_moves() {
    let folder = Folder::new();
    let draw = "corner.obj --resolution 40,30 --turntable=4 --frame-rate=10";
    let said = folder.said(&format!("{draw} --output view_{{frame:2}}.png"), 0);
    assert_eq!(said.lines().count(), 4, "a line each: {said}");
    let views =
        ["view_00.png", "view_01.png", "view_02.png", "view_03.png"].map(|name| image(&folder.path(name)));
    assert!((1..4).all(|view| views[view] != views[0]), "each from another side");
    let said = folder.said(&format!("{draw} --output all.gif"), 0);
    assert!(said.contains("wrote all.gif (40×30, 4 frames)"), "{said}");
    folder.said(&format!("{draw} --output all.apng"), 0);
    let [gif, apng] = ["all.gif", "all.apng"].map(|name| fs::read(folder.path(name)).expect("written"));
    assert!(gif.starts_with(b"GIF89a") && gif.windows(11).any(|part| part == b"NETSCAPE2.0"), "endless");
    assert!(apng.windows(4).any(|part| part == b"acTL"), "it moves");
    assert!(image(&folder.path("all.apng")) == views[0], "and its first frame is that of the files");
}

#[test]
fn images_are_written_as_their_endings_say() {
    let folder = Folder::new();
    for (name, start) in [
        ("o.jpg", &b"\xff\xd8\xff"[..]),
        ("o.jpeg", b"\xff\xd8\xff"),
        ("o.webp", b"RIFF"),
        ("o.png", b"\x89PNG"),
    ] {
        folder.said(&format!("corner.obj --resolution 40,30 --output {name}"), 0);
        assert!(fs::read(folder.path(name)).expect("written").starts_with(start), "{name}");
    }
    assert!(image(&folder.path("o.webp")) == image(&folder.path("o.png")), "WebP loses nothing");
}

#[test]
fn a_check_lists_faults_with_remedies() {
    let folder = Folder::new();
    let checked = |flags: &str, code: i32| {
        let output = folder.run(&format!("{flags} --check"));
        assert_eq!(output.status.code(), Some(code), "{flags}: {output:?}");
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    let said = checked("corner.obj", 0);
    assert!(
        said.starts_with("corner.obj: no faults\n  note: mesh \"corner\": 6 open edges"),
        "a sound model: {said}"
    );
    folder.write(
        "chrome.gltf",
        &moments::SLIDE.replace(r#""POSITION": 0}"#, r#""POSITION": 0}, "material": 0"#).replacen(
            '{',
            r#"{"materials": [{"doubleSided": true, "pbrMetallicRoughness": {"roughnessFactor": 0}}],"#,
            1,
        ),
    );
    let said = checked("chrome.gltf", 0);
    assert!(
        said.starts_with("chrome.gltf: no faults\n  note: ")
            && said.contains("note: scene: everything is polished metal"),
        "{said}"
    );
    fs::create_dir(folder.path("mtl")).expect("a folder");
    folder.write("mtl/gone.mtl", "newmtl a\nmap_Kd C:\\maps\\wood.png\n");
    folder.write(
        "gone.obj",
        "mtllib mtl/gone.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n",
    );
    let said = checked("gone.obj", 1);
    for path in ["mtl/maps/wood.png", "mtl/wood.png", " wood.png"] {
        assert!(said.contains(path) && said.contains("missing-file"), "every path: {said}");
    }
    folder.write("wild.gltf", r#"{"asset": {"version": "2.0"}, "extensionsRequired": ["EXT_wild"], "extensionsUsed": ["EXT_wild"]}"#);
    let said = checked("wild.gltf", 1);
    assert!(said.contains("EXT_wild") && said.contains("not-loaded"), "an extension: {said}");
    folder.write("empty.obj", "");
    let said = checked("corner.obj empty.obj", 1);
    assert!(
        said.contains("corner.obj: no faults") && said.contains("nothing-to-draw"),
        "each by itself: {said}"
    );
}

/// What --capture wrote is drawn again without the model, and told from another.
#[test]
fn a_capture_is_replayed_without_its_model() {
    let folder = Folder::new();
    let flags = "corner.obj --resolution 60x40 --shadows --sky --capture corner.trigon --output first.png";
    let said = folder.said(flags, 0);
    assert!(said.contains("wrote first.png") && said.contains("captured corner.trigon ("), "{said}");
    fs::remove_file(folder.path("corner.obj")).expect("the model was there");
    let replay = format!("--replay corner.trigon --threads=1 {NARROW} --output again.png");
    let said = folder.said(&replay, 0);
    assert!(said.contains("corner.trigon: the same image, "), "{said}");
    let [first, again] = ["first.png", "again.png"].map(|name| image(&folder.path(name)).rgba);
    assert!(first == again, "the same image");

    let path = folder.path("corner.trigon");
    let mut capture = trigon_io::Capture::read(&path, &trigon_io::Limits::default()).expect("a capture");
    capture.color[4 * (60 * 20 + 30)] ^= 8;
    capture.write(&path).expect("the folder is writable");
    let said = folder.said("--replay corner.trigon", 3);
    assert!(said.contains("1 of 2400 pixels, the first at (30, 20)"), "{said}");
    assert!(said.contains("captured by trigon ") && said.contains("its hash was "), "{said}");

    folder.write("corner.trigon", "no capture");
    assert!(folder.failed("--replay corner.trigon").contains("it is not a capture"), "another file");
    folder.said("--replay corner.trigon corner.obj", 2);
    assert!(folder.said("a.obj b.obj --capture c.trigon", 2).contains("--capture stores one"), "two models");
}
