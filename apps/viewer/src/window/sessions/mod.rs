//! The viewer worked by mouse and keys alone, in windows without a display.

mod command;
mod comparing;
mod overlays;

use std::ffi::OsString;

use trigon_camera::Viewport;
use trigon_math::DVec2;
use trigon_window::{Chord, HeadlessWindow, Key, Modifiers, PointerButton, Stage};

use super::set_stage;
use super::viewer::Viewer;
use crate::args::{CommandLine, Request};
use crate::report::{Level, Reporter};
use crate::source::Source;

/// The smallest window that is looked after.
const SMALL: Viewport = Viewport { width: 800, height: 500 };

/// Opens a window with these flags, waits for its model, and works it.
fn with_window(flags: &str, size: Viewport, work: impl FnOnce(&mut HeadlessWindow<'_>)) {
    let words = ["--no-config", "--refine=false", "--samples=1"].into_iter().chain(flags.split_whitespace());
    let line = CommandLine::new(words.map(OsString::from)).expect("flags that make sense");
    let request = Request::from_line(&line, None).expect("consistent flags");
    let mut stage = Stage::new("test");
    set_stage(&mut stage, &request);
    let sources = Source::all(&request);
    let mut viewer = Viewer::new(request, sources, Reporter::new(Level::Quiet));
    let mut window = HeadlessWindow::open(stage, &mut viewer, size);
    while window.stage().scene.nodes().is_empty() {
        window.wait();
    }
    // Any key ends the line that says how to begin; this one does nothing else.
    window.key(Key::Function(9).into());
    // Until messages are gone.
    (0..10).for_each(|_| window.move_to(DVec2::ZERO));
    work(&mut window);
}

fn key(window: &mut HeadlessWindow<'_>, key: char) {
    window.key(Key::Character(key).into());
}

fn shift(window: &mut HeadlessWindow<'_>, key: char) {
    window.key(Chord::new(Modifiers::SHIFT, Key::Character(key)));
}

fn click_at(window: &mut HeadlessWindow<'_>, at: DVec2) {
    window.move_to(at);
    window.press(PointerButton::Left);
    window.release(PointerButton::Left);
}

/// Clicks the only widget of a name.
fn click(window: &mut HeadlessWindow<'_>, label: &str) {
    let found = window.widgets(label);
    let [widget] = &found[..] else { panic!("{} widgets are called {label:?}", found.len()) };
    click_at(window, widget.center);
}

/// Whether some text on the interface holds a part.
fn says(window: &HeadlessWindow<'_>, part: &str) -> bool {
    window.all_widgets().iter().any(|widget| widget.label.contains(part))
}
