//! The command line that the window copies, and its state files.

use trigon_camera::Viewport;
use trigon_window::{Chord, HeadlessWindow, Key, Modifiers};

use super::{click, key, shift, with_window};
use crate::args::{CommandLine, Mode, Request};
use crate::image;
use crate::report::{Level, Reporter};
use crate::state::State;

/// As large as the images that are compared.
const SIZE: Viewport = Viewport { width: 240, height: 160 };

fn ctrl(window: &mut HeadlessWindow<'_>, key: char) {
    window.key(Chord::new(Modifiers::CTRL, Key::Character(key)));
}

/// The command line that the window shows after Ctrl+C.
fn copied(window: &mut HeadlessWindow<'_>) -> String {
    ctrl(window, 'c');
    let texts = window.all_widgets().into_iter().map(|widget| widget.label);
    let command = texts.into_iter().find(|text| text.starts_with("trigon-viewer "));
    window.key(Key::Escape.into());
    command.expect("it is shown")
}

/// The words of a command line without the program, quotes taken off.
fn words(command: &str) -> Vec<String> {
    command.split(' ').skip(1).map(|word| word.trim_matches('\'').to_owned()).collect()
}

/// What a command line draws, with another place for its image.
fn drawn_by(command: &str) -> trigon_io::RgbaImage {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("view.png");
    let mut words = words(command);
    words.retain(|word| !word.starts_with("--output="));
    words.push(format!("--output={}", path.display()));
    let line = CommandLine::new(words.iter().map(Into::into)).expect("it makes sense");
    let request = Request::from_line(&line, None).expect("it makes sense");
    let Mode::Image { output, .. } = &request.mode else { panic!("no image: {command}") };
    assert_eq!(image::run(&request, output.as_ref(), None, Reporter::new(Level::Error)), 0, "{command}");
    trigon_io::load_image(&path, &trigon_io::Limits::default()).expect("written")
}

/// The same image as the window's own screenshot, whatever was done in the window before.
#[test]
fn the_copied_command_line_draws_the_same_bytes() {
    let folder = tempfile::tempdir().expect("a folder");
    let shot = folder.path().join("shot{n}.png");
    let flags = format!("--grid --up=+Y --color=#80c0ff --screenshot-filename={}", shot.display());
    let mut number = 0;
    with_window(&flags, SIZE, |window| {
        let mut compare = |window: &mut HeadlessWindow<'_>, what: &str| {
            number += 1;
            window.key(Key::Function(12).into());
            let path = folder.path().join(format!("shot{number}.png"));
            let shot = trigon_io::load_image(&path, &trigon_io::Limits::default()).expect("a screenshot");
            let command = copied(window);
            let drawn = drawn_by(&command);
            assert!(drawn == shot, "{what}: {command}");
        };
        compare(window, "as it begins");
        window.key(Chord::new(Modifiers::SHIFT, Key::Left));
        window.key(Key::PageUp.into());
        key(window, '8');
        compare(window, "another view");
        key(window, 'e');
        key(window, 'l');
        shift(window, 'l');
        key(window, 'a');
        compare(window, "edges, light and samples");
        shift(window, 'e');
        key(window, '5');
        compare(window, "a wireframe without perspective");
        shift(window, 'e');
        shift(window, 'e');
        shift(window, 'm');
        compare(window, "clay");
        shift(window, 'm');
        key(window, 'g');
        key(window, 'x');
        key(window, 'n');
        compare(window, "axes and a name, and no grid");
        key(window, 'g');
        window.key(Chord::new(Modifiers::ALT, Key::Character('z')));
        compare(window, "a grid, and z up");
        key(window, 'g');
        shift(window, 'h');
        click(window, "Hide teapot");
        window.key(Key::Escape.into());
        compare(window, "without the teapot");
        window.key(Key::Tab.into());
        window.key(Chord::new(Modifiers::ALT, Key::Right));
        window.key(Chord::new(Modifiers::ALT | Modifiers::SHIFT, Key::Up));
        compare(window, "with an object that was moved and turned");
    });
}

/// The place of a node in the tree.
fn number_of(window: &HeadlessWindow<'_>, id: trigon_scene::NodeId) -> usize {
    window.stage().scene.tree().iter().position(|(node, _)| *node == id).expect("it is in the scene")
}

#[test]
fn states_are_saved_and_loaded() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("view.json");
    let flags = format!("--statefile-filename={}", path.display());
    with_window(&flags, SIZE, |window| {
        key(window, '8');
        shift(window, 'm');
        window.key(Key::Tab.into());
        window.key(Chord::new(Modifiers::ALT, Key::Right));
        let moved = window.stage().selection.expect("selected");
        let position_of =
            |window: &HeadlessWindow<'_>, id| window.stage().scene.node(id).map(|node| node.transform);
        let (number, placed) = (number_of(window, moved), position_of(window, moved));
        let (orbit, display) = (window.stage().orbit, window.stage().settings.display);
        ctrl(window, 's');
        let state = State::read(&path).expect("saved");
        assert!(state.flags.contains(&"--display=matcap".to_owned()), "{state:?}");
        key(window, '1');
        shift(window, 'm');
        assert_ne!((window.stage().orbit, window.stage().settings.display), (orbit, display), "elsewhere");
        ctrl(window, 'l');
        window.wait();
        let again = window.stage().orbit;
        assert_eq!(window.stage().settings.display, display, "as it was");
        let again_moved = window.stage().scene.tree()[number].0;
        assert_eq!(position_of(window, again_moved), placed, "what was moved is where it was");
        assert!(copied(window).contains("--place-node="), "and stays in the command line");
        assert!(again.target().distance(orbit.target()) < 1e-9, "there");
        assert!(again.orientation().dot(orbit.orientation()).abs() > 1.0 - 1e-12, "turned as it was");
        std::fs::write(&path, "{}").expect("writable");
        ctrl(window, 'l');
        assert!(super::says(window, "is no state file"), "what is broken is told");
    });
}
