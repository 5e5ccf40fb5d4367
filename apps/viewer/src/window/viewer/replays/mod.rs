//! The viewer worked by mouse and keyboard in a window without a display: what somebody who has just
//! installed it would try.

mod bindings;
mod broken_files;
mod every_key;
mod first_contact;
mod flags;
mod guide;

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use trigon_camera::{Orbit, Projector, Viewport};
use trigon_math::DVec2;
use trigon_window::{Chord, HeadlessWindow, Key, Modifiers, PointerButton, RecentFiles, Stage};

use super::Viewer;
use crate::args::{CommandLine, Request};
use crate::report::{Level, Reporter};
use crate::source::Source;

const SIZE: Viewport = Viewport { width: 800, height: 500 };

/// Where only words matter: drawn sooner.
const SMALL: Viewport = Viewport { width: 480, height: 320 };

/// A triangle.
const OBJ: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// A triangle that moves 1 m along X in a second.
const GLTF: &str = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"buffers":[{"byteLength":68,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAA="}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":8},{"buffer":0,"byteOffset":44,"byteLength":24}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[1]},{"bufferView":2,"componentType":5126,"count":2,"type":"VEC3"}],
"animations":[{"name":"Walk","samplers":[{"input":1,"output":2}],"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}]}]}"#;

/// A viewer of files, with the flags of a command line, that remembers nothing of other runs.
fn viewer(flags: &str, files: &[PathBuf]) -> Viewer {
    let words = ["--no-config", "--refine=false", "--samples=1"].map(OsString::from).into_iter();
    let words = words.chain(flags.split_whitespace().map(OsString::from));
    let line = CommandLine::new(words.chain(files.iter().map(OsString::from))).expect("flags");
    let file = files.first().map(PathBuf::as_path);
    let request = Request::from_line(&line, file).expect("consistent flags");
    let sources = Source::all(&request);
    let mut viewer = Viewer::new(request, sources, Reporter::new(Level::Quiet));
    viewer.recent = RecentFiles::default();
    viewer
}

/// A viewer of a triangle, and the folder with its file.
fn simple() -> (tempfile::TempDir, Viewer) {
    let folder = tempfile::tempdir().expect("a folder");
    let file = written(folder.path(), "simple.obj", OBJ);
    (folder, viewer("", &[file]))
}

/// Opens its window and waits until nothing is loaded any more.
fn open(viewer: &mut Viewer, size: Viewport) -> HeadlessWindow<'_> {
    let mut window = HeadlessWindow::open(stage(viewer), viewer, size);
    loaded(&mut window);
    window
}

/// Its window before it opens.
fn stage(viewer: &Viewer) -> Stage {
    let mut stage = Stage::new(viewer.sources[0].window_title());
    super::super::set_stage(&mut stage, &viewer.request);
    stage
}

/// Waits until nothing is loaded any more.
fn loaded(window: &mut HeadlessWindow<'_>) {
    while says(window, "loading ") {
        window.wait();
    }
}

/// Whether something of the interface says this, among other words.
fn says(window: &HeadlessWindow<'_>, text: &str) -> bool {
    window.all_widgets().iter().any(|widget| widget.label.contains(text))
}

/// All that the interface says, for messages of tests.
fn said(window: &HeadlessWindow<'_>) -> Vec<String> {
    window.all_widgets().into_iter().map(|widget| widget.label).collect()
}

fn key(window: &mut HeadlessWindow<'_>, chord: &str) {
    window.key(chord.parse::<Chord>().expect("a chord"));
}

fn type_text(window: &mut HeadlessWindow<'_>, text: &str) {
    text.chars().for_each(|c| window.key(Chord::new(Modifiers::NONE, Key::Character(c))));
}

fn click(window: &mut HeadlessWindow<'_>, button: PointerButton, at: DVec2) {
    window.move_to(at);
    window.press(button);
    window.release(button);
}

fn press_button(window: &mut HeadlessWindow<'_>, label: &str) {
    let found = window.widgets(label);
    let widget = found.first().unwrap_or_else(|| panic!("no {label:?} in {:?}", said(window)));
    let at = widget.center;
    click(window, PointerButton::Left, at);
}

fn written(folder: &Path, name: &str, contents: impl AsRef<[u8]>) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, contents).expect("it can be written");
    path
}
