//! The whole program, run as a user runs it: images, streams, messages, exit
//! codes. No display, no network.

mod batch;
mod comparing;
mod facts;
mod frontier;
mod glass;
mod moments;
mod outputs;
mod up;
mod views;

use std::collections::BTreeSet;
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

#[test]
fn every_flag_about_the_image_changes_it() {
    let folder = Folder::new();
    let stream = |flags: &str| {
        let output = folder.run(&format!("corner.obj --output - --resolution 60,40 {flags}"));
        assert!(output.status.success(), "`{flags}`: {}", String::from_utf8_lossy(&output.stderr));
        output.stdout
    };
    let plain = stream("");
    for flags in [
        "--up=+Z",
        "--edges",
        "--style=wireframe",
        "--style=hidden-line",
        "--anti-aliasing=none",
        "--samples=4",
        "--anti-aliasing=msaa",
        "--view=front",
        "--camera-direction=1,0,0",
        "--camera-position=3,4,5",
        "--camera-focal-point=1,1,1",
        "--camera-view-up=1,1,0",
        "--camera-view-angle=60",
        "--camera-zoom-factor=2",
        "--camera-azimuth-angle=30",
        "--camera-elevation-angle=30",
        "--camera-orthographic",
        "--opacity=50%",
        "--metallic=1",
        "--roughness=0.2",
        "--point-sprites",
        "--shadows",
        "--ambient-occlusion",
        "--light-intensity=0.5",
    ] {
        assert!(stream(flags) != plain, "`{flags}` changes nothing");
    }
    let pixels = |flags: &str| {
        folder.said(&format!("corner.obj --output o.png --resolution 60,40 --verbose=error {flags}"), 0);
        image(&folder.path("o.png")).rgba
    };
    let count =
        |flags: &str, color: [u8; 4]| pixels(flags).chunks(4).filter(|pixel| **pixel == color).count();
    let (all, model) = (60 * 40, 60 * 40 - count("--no-background", [0; 4]));
    assert!((200..2000).contains(&model), "the model takes a part of the image: {model} pixels");
    // Edges of the model are mixed with what is behind them.
    assert_eq!(count("--background-color=navy", [0, 0, 128, 255]), all - model, "navy where no model is");
    let inner = model - 120;
    assert!((inner..=model).contains(&count("--color=green --unlit", [0, 128, 0, 255])), "a green model");
    folder.write(
        "tile.obj",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n",
    );
    let colors_of_tile = |flags: &str| {
        let flags = format!("--view=front --unlit --no-background --anti-aliasing=none {flags}");
        folder.said(&format!("tile.obj --output t.png --resolution 60,40 {flags}"), 0);
        image(&folder.path("t.png")).rgba.chunks(4).map(<[u8]>::to_vec).collect::<BTreeSet<_>>().len()
    };
    let colors = [colors_of_tile(""), colors_of_tile("--checkerboard")];
    assert_eq!(colors, [2, 3], "the background, and one or two colors");
    // The camera sees the outside of the corner from one side, and its inside from the other.
    let hidden = ["1,1,1", "-1,-1,-1"].map(|direction| {
        count(&format!("--no-background --backface-type=hidden --camera-direction={direction}"), [0; 4])
    });
    assert!(hidden.contains(&all) && hidden.iter().any(|count| *count < all), "{hidden:?}");
    for flags in
        ["--threads=1", NARROW, "--edges=false", "--samples=3", "--style=surface", "--camera-index=-1"]
    {
        assert!(stream(flags) == plain, "`{flags}` is the default");
    }
    assert!(stream("--edges --line-width=5") != stream("--edges"), "width of edges");
    let soft = [
        "",
        " --light-radius=0.5",
        " --light-radius=0.5 --shadow-rays=3",
        " --light-radius=0.5 --shadow-sampling=shared",
    ];
    let soft = soft.map(|flags| stream(&format!("--shadows=rays{flags}")));
    assert!(soft.iter().enumerate().all(|(at, one)| !soft[..at].contains(one)), "soft shadows");
}

#[test]
fn a_preset_is_some_settings_at_once() {
    let folder = Folder::new();
    let drawn = |flags: &str| {
        folder.said(&format!("corner.obj --output o.png --resolution 60,40 {flags}"), 0);
        image(&folder.path("o.png"))
    };
    assert!(drawn("--preset=draft") == drawn("--anti-aliasing=none"), "one sample");
    assert!(drawn("--preset=standard") == drawn("--samples=2"), "2×2");
    assert!(drawn("--preset=standard --samples=3") == drawn(""), "what is said for itself wins");
    assert!(drawn("--preset=reference") != drawn("--samples=4"), "sixteen times as many");
}

#[test]
fn a_time_budget_says_what_it_chose_and_what_that_gives_up() {
    let folder = Folder::new();
    // The longest and the shortest that there is: on any machine an image of this size
    // fits into the one, and none into the other.
    for (time, quality, gave_up) in
        [("3600s", "4×4 samples of 16,", "gave up nothing"), ("0.001ms", "1 sample,", "; gave up ")]
    {
        let flags = format!("--output o.png --capture o.trigon --resolution 60,40 --time-budget={time}");
        let said = folder.said(&format!("corner.obj {flags}"), 0);
        let choice = said.lines().next().expect("a line");
        assert!(choice.contains(quality) && choice.contains(gave_up), "{choice}");
        assert!(choice.contains("; took ") && choice.contains("RMSE"), "time and error: {choice}");
        folder.said("--replay o.trigon", 0);
    }
    let said = folder.said("--output o.png --time-budget=16", 2);
    assert!(said.contains("16ms"), "a unit is missing: {said}");
}

#[test]
fn several_files_are_drawn_together_or_under_several_names() {
    let folder = Folder::new();
    folder.write("b.obj", "v 5 0 0\nv 6 0 0\nv 5 1 0\nf 1 2 3\n");
    // The same faces in one file.
    let together = format!("{CORNER}usemtl none\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 8 9 10\n");
    folder.write("together.obj", &together);
    let said = folder.said("corner.obj b.obj --output {model}_{n:2}.png --resolution 20,20", 0);
    assert_eq!(said.lines().count(), 2, "a line each: {said}");
    folder.said("corner.obj b.obj --output all.png --multi-file-mode=all --resolution 20,20", 0);
    for (name, alone) in [("corner_01.png", "corner.obj"), ("b_01.png", "b.obj"), ("all.png", "together.obj")]
    {
        folder.said(&format!("{alone} --output alone.png --resolution 20,20 --verbose=error"), 0);
        assert!(image(&folder.path(name)) == image(&folder.path("alone.png")), "{name} shows {alone}");
    }
    let shows = |name: &str| image(&folder.path(name)).rgba;
    assert!(shows("corner_01.png") != shows("b_01.png") && shows("all.png") != shows("corner_01.png"));

    let said = folder.said("corner.obj b.obj --output one.png", 2);
    assert!(said.contains("{model}") && said.contains("--multi-file-mode=all"), "both remedies: {said}");
    fs::create_dir(folder.path("other")).expect("a folder");
    fs::copy(folder.path("b.obj"), folder.path("other/b.obj")).expect("a copy");
    let said = folder.said("b.obj other/b.obj --output {model}.png --resolution 20,20", 2);
    assert!(said.contains("two images") && said.contains("{n}"), "no image is lost silently: {said}");
}

#[test]
fn one_bad_file_among_several_fails_the_run_but_not_the_others() {
    let folder = Folder::new();
    let said = folder.said("missing.obj corner.obj --output {model}.png --resolution 20,20", 1);
    assert!(said.contains("missing.obj"), "named: {said}");
    assert!(folder.path("corner.png").is_file(), "the good one is drawn");
}

#[test]
fn failures_are_one_line_that_names_the_file() {
    let folder = Folder::new();
    folder.write("empty.obj", "");
    folder.write("model.stl", "solid x\nendsolid x\n");
    folder.write("model.fbx", "Kaydara FBX Binary");
    folder.write("broken.gltf", "{ \"asset\": ");
    for (flags, words) in [
        ("missing.obj --output o.png", ["missing.obj", "check the name"]),
        ("empty.obj --output o.png", ["empty.obj", "nothing to draw"]),
        ("model.stl --output o.png", ["model.stl", "nothing to draw"]),
        ("model.fbx --output o.png", ["model.fbx", "supported"]),
        ("broken.gltf --output o.png", ["broken.gltf", ""]),
        (
            "corner.obj --output no/such/folder/o.png",
            ["no/such/folder/o.png", "no/such/folder does not exist"],
        ),
        ("corner.obj --output o.png --max-size=0.00001", ["corner.obj", "--max-size"]),
        ("corner.obj --output o.png --camera-index=0", ["--camera-index=0", "no camera"]),
    ] {
        let said = folder.failed(flags);
        assert!(words.iter().all(|word| said.contains(word)), "`{flags}`: {said}");
    }
    assert!(!folder.path("o.png").exists(), "no image of a failure");
}

#[test]
fn warnings_are_lines_and_can_be_silenced() {
    let folder = Folder::new();
    fs::remove_file(folder.path("corner.mtl")).expect("it was there");
    let said = folder.said("corner.obj --output o.png --resolution 20,20", 0);
    let warning = said.lines().next().expect("a line");
    assert!(warning.starts_with("trigon-viewer: warning: ") && warning.contains("corner.mtl"), "{said}");
    let said = folder.said("corner.obj --output o.png --resolution 20,20 --verbose=error", 0);
    assert_eq!(said, "", "silenced");
    let said = folder.said("missing.obj --output o.png --verbose=quiet", 1);
    assert_eq!(said, "", "the exit code has to do");
    let said = folder.said("corner.obj --output o.png --resolution 20,20 --raytracing", 0);
    assert!(said.contains("--raytracing is ignored"), "a flag of a GPU: {said}");
}

#[test]
fn an_image_that_shows_nothing_of_the_model_says_so() {
    let folder = Folder::new();
    let away = "--camera-position 9,9,9 --camera-focal-point 20,20,20 --output o.png --resolution 20,20";
    let said = folder.said(&format!("corner.obj {away}"), 0);
    assert!(said.contains("the model is not in view"), "{said}");
}

/// A level that only other processors have.
const ELSEWHERE: &str = if cfg!(target_arch = "aarch64") { "--simd=sse2" } else { "--simd=neon" };

#[test]
fn a_senseless_command_line_exits_with_2() {
    let folder = Folder::new();
    for (flags, words) in [
        ("--resolutoin 10,10", "--resolution"),
        ("--resolution 0,10", "1 to 16384"),
        ("--output o.tiff", ".png"),
        ("--outputs depth corner.obj", "--output"),
        ("--output - --outputs depth corner.obj", "standard output"),
        ("--output o.exr --outputs depth.png corner.obj", "without an ending"),
        ("--output o.png --outputs dept corner.obj", "triangle-ids"),
        ("--camera-position 1,2,3 --camera-focal-point 1,2,3 --output o.png", "same point"),
        ("corner.obj --camera-position 0.5,0.5,0.5 --output o.png", "view direction is undefined"),
        ("--background-color=blurple", "CSS name"),
        ("--simd=mmx", "mmx is not available here; write one of"),
        (ELSEWHERE, "is not available here; write one of"),
    ] {
        let said = folder.said(flags, 2);
        assert!(said.contains(words), "`{flags}`: {said}");
    }
}

#[test]
fn without_a_display_the_message_says_how_to_get_an_image() {
    let folder = Folder::new();
    let said = folder.failed("corner.obj");
    assert!(said.contains("--output image.png"), "the remedy: {said}");
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
/// The numbers of a NumPy file, behind its header.
fn array(path: &Path) -> Vec<u8> {
    let bytes = fs::read(path).expect("written");
    assert!(bytes.starts_with(b"\x93NUMPY"), "an array");
    bytes[10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]))..].to_owned()
}

#[test]
fn outputs_are_written_next_to_the_image_or_in_it() {
    let folder = Folder::new();
    let draw = "corner.obj --resolution 30,20 --view=front";
    let said = folder.said(&format!("{draw} --output o.png --outputs depth,object-ids,depth.png"), 0);
    let names = ["o.png", "o.depth.npy", "o.object-ids.npy", "o.depth.png"];
    let lines = names.map(|name| format!("trigon-viewer: wrote {name} (30×20)\n"));
    assert_eq!(said, lines.concat(), "a line for each file");
    let (depths, ids) = (array(&folder.path("o.depth.npy")), array(&folder.path("o.object-ids.npy")));
    let millimetres = fs::read(folder.path("o.depth.png")).expect("written");
    assert_eq!((depths.len(), ids.len(), png_size(&millimetres)), (2400, 2400, (30, 20)), "all pixels");
    let number = |bytes: &[u8], x: usize, y: usize| {
        let at = 4 * (y * 30 + x);
        u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes"))
    };
    assert_eq!([number(&ids, 0, 0), number(&ids, 15, 10)], [u32::MAX, 0], "background and model");
    assert_eq!(f32::from_bits(number(&depths, 0, 0)), f32::INFINITY, "background");
    assert!((0.5..10.0).contains(&f32::from_bits(number(&depths, 15, 10))), "metres");

    let said = folder.said(&format!("{draw} --output o.exr --outputs depth,normals"), 0);
    assert_eq!(said, "trigon-viewer: wrote o.exr (30×20)\n", "one file");
    let bytes = fs::read(folder.path("o.exr")).expect("written");
    for word in [&b"N.X\0"[..], b"Z\0", b"A\0"] {
        assert!(bytes.windows(word.len()).any(|window| window == word), "the channel {word:?}");
    }
}

/// A plate of 2 m, 10⁶ and 10⁷ m away: f32 in the world would round its positions to 6 cm and to a metre. Seen straight
/// from the front by parallel rays they are as far apart as pixels are.
#[test]
fn positions_far_away_are_relative_to_an_origin_that_is_said() {
    let folder = Folder::new();
    for far in [1e6, 1e7] {
        let corner = |x: f64, y: f64| format!("v {} {} {}\n", far + x, y - far, 0.25 * far);
        let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)].concat();
        folder.write("plate.obj", &format!("{corners}f 1 2 3 4\n"));
        let draw = "plate.obj --view=front --camera-orthographic --resolution 40,40 --outputs positions";
        let said = folder.said(&format!("{draw} --output o.png"), 0);
        assert!(said.contains("wrote o.positions-origin.npy (add it to the positions: "), "{said}");
        let bytes = array(&folder.path("o.positions-origin.npy"));
        let origin: Vec<f64> =
            bytes.as_chunks::<8>().0.iter().map(|number| f64::from_le_bytes(*number)).collect();
        let bytes = array(&folder.path("o.positions.npy"));
        let numbers: Vec<f32> =
            bytes.as_chunks::<4>().0.iter().map(|number| f32::from_le_bytes(*number)).collect();
        let middle = [far, -far, 0.25 * far];
        let at = |x: usize, y: usize| {
            [0, 1, 2].map(|axis| origin[axis] + f64::from(numbers[3 * (40 * y + x) + axis]) - middle[axis])
        };
        let pixel = at(20, 20)[0] - at(19, 20)[0];
        assert!((0.05..0.06).contains(&pixel), "the plate fills nine tenths of 40 pixels: {pixel} m");
        for (x, y) in (4..36).flat_map(|x| (4..36).map(move |y| (x, y))) {
            let expected = [(x as f64 - 19.5) * pixel, (19.5 - y as f64) * pixel, 0.0];
            let off = [0, 1, 2].map(|axis| (at(x, y)[axis] - expected[axis]).abs());
            // What is left of f32 within 4 m of the origin, and of f64 at 10⁷ m, up to 20 times.
            assert!(off.iter().all(|off| *off < 1e-5), "{off:?} at {x}, {y} of {far}");
        }
        folder.said(&format!("{draw} --output o.exr"), 0);
        let word = format!("{} {} {}", origin[0], origin[1], origin[2]);
        let bytes = fs::read(folder.path("o.exr")).expect("written");
        assert!(bytes.windows(word.len()).any(|window| window == word.as_bytes()), "{word} in o.exr");
        let printed = folder.run(&format!("{draw} --output p.png --json")).stdout;
        let facts: serde_json::Value = serde_json::from_slice(&printed).expect("a line of JSON");
        assert_eq!(facts["positions_origin"], serde_json::json!(origin), "the same");
    }
    let said = folder.said("corner.obj --resolution 30,20 --output n.png --outputs positions", 0);
    assert!(
        said.contains("(add it to the positions: 0, 0, 0)"),
        "near the origin they are the world's: {said}"
    );
}

#[test]
fn an_output_that_does_not_fit_its_format_is_refused() {
    let folder = Folder::new();
    let far = "corner.obj --output o.png --resolution 20,20 --verbose=warning --camera-position=90,50,90 --camera-view-angle=1";
    let said = folder.failed(&format!("{far} --outputs depth.png"));
    assert!(said.contains("o.depth.png: ") && said.contains("65.535 m"), "{said}");
    folder.said(&format!("{far} --outputs depth"), 0);
    let said = folder.said(&format!("{far} --outputs uvs.png"), 2);
    assert!(said.contains("uvs.npy"), "16 bits say nothing of it, and that is known before drawing: {said}");
}

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
