//! Every key of the cheat sheet and every panel, in windows of three sizes: nothing ends the program, no
//! panel covers another, and none leaves the window. With `TRIGON_REPLAY_PICTURES=FOLDER` a screenshot of each
//! is written, to be looked at.

use trigon_io::{Pixels, write_png};

use super::*;

/// Sizes in physical pixels, and how many of those are one of the display's.
const WINDOWS: [(Viewport, f64); 3] = [
    (SIZE, 1.0),
    (Viewport { width: 1600, height: 1000 }, 1.0),
    (Viewport { width: 1600, height: 1000 }, 2.0),
];

/// Keys that open something, alone and two at a time.
const OPENERS: [&str; 9] = ["H", "Ctrl+O", "Shift+D", "N", "M", "Z", "D", "X", "Tab"];

/// Names of commands that show something that Escape leaves on the screen: the same key hides it.
const TOGGLES: [&str; 7] =
    ["quality.difference", "axis", "grid", "file.name", "metadata", "frame_time", "frame_time.stages"];

/// Writes what is to be seen, if somebody wants to look at it.
fn screenshot(window: &HeadlessWindow<'_>, name: &str) {
    let Some(folder) = std::env::var_os("TRIGON_REPLAY_PICTURES") else { return };
    let Viewport { width, height } = window.stage().viewport();
    let pixels: Vec<u8> = window.pixels().iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
    let name = name.replace(|c: char| !c.is_ascii_alphanumeric() && c != '+' && c != '-', "_");
    let path = Path::new(&folder).join(format!("{name}.png"));
    write_png(path, width, height, Pixels::Rgb8(&pixels)).expect("the folder is there");
}

/// Rounding to whole pixels, and shadows of frames.
const SLACK: f64 = 2.0;

/// Windows, menus and texts lie in the window, and none over another of its kind.
fn check_layers(window: &mut HeadlessWindow<'_>, what: &str) {
    let size = window.stage().viewport().size();
    let mut layers = window.layers();
    // The layer under all panels fills the window.
    layers.retain(|(_, [min, max])| *min != DVec2::ZERO || *max != size);
    for (name, [min, max]) in &layers {
        let is_inside = min.cmpge(DVec2::splat(-SLACK)).all() && max.cmple(size + SLACK).all();
        assert!(is_inside, "{what}: {name:?} leaves the window: {min} to {max}");
    }
    for (i, (name, [min, max])) in layers.iter().enumerate() {
        let covered = layers[..i].iter().find(|(other, [other_min, other_max])| {
            other.order == name.order
                && min.cmplt(*other_max - SLACK).all()
                && other_min.cmplt(*max - SLACK).all()
        });
        assert_eq!(covered, None, "{what}: {name:?} covers it: {min} to {max}");
    }
}

/// A window that shows an animated model, and another one beside it.
fn with_window(test: impl Fn(&mut HeadlessWindow<'_>, &str)) {
    let folder = tempfile::tempdir().expect("a folder");
    let files = [written(folder.path(), "walk.gltf", GLTF), written(folder.path(), "other.obj", OBJ)];
    let at = folder.path().display();
    let flags = format!("--screenshot-filename={at}/shot.png --statefile-filename={at}/state.json");
    for (size, scale) in WINDOWS {
        let mut viewer = viewer(&flags, &files);
        let mut window = open(&mut viewer, size);
        window.resize(size, scale);
        let name = format!("{}x{}@{scale}", size.width, size.height);
        test(&mut window, &name);
    }
}

#[test]
fn every_key_of_the_sheet_does_something_harmless() {
    with_window(|window, name| {
        check_layers(window, name);
        screenshot(window, &format!("{name}-start"));
        let bindings = window.stage().keymap.bindings().to_vec();
        assert!(bindings.len() > 60, "all of them: {}", bindings.len());
        for binding in bindings.iter().filter(|binding| binding.name != "quit") {
            window.tap(binding.chord);
            loaded(window);
            let what = format!("{name}-{}-{}", binding.chord, binding.name);
            check_layers(window, &what);
            screenshot(window, &what);
            assert!(!window.is_closed(), "{what}");
            // What it began or shows, and Escape leaves, ends; then what it opened is closed.
            if TOGGLES.contains(&binding.name.as_ref()) || binding.name.starts_with("animation.play") {
                window.tap(binding.chord);
            }
            (0..2).for_each(|_| window.tap(Key::Escape.into()));
        }
        key(window, "Ctrl+Q");
        assert!(window.is_closed(), "{name}: the last one ends it");
    });
}

#[test]
fn panels_never_cover_each_other() {
    with_window(|window, name| {
        for (i, one) in OPENERS.iter().enumerate() {
            for other in &OPENERS[i + 1..] {
                key(window, one);
                key(window, other);
                let what = format!("{name}-{one}-{other}");
                check_layers(window, &what);
                screenshot(window, &what);
                (0..4).for_each(|_| key(window, "Escape"));
                // Texts stay where Escape closes nothing.
                for text in [one, other].into_iter().filter(|text| ["N", "M", "Z", "D", "X"].contains(text)) {
                    key(window, text);
                }
            }
        }
    });
}

#[test]
fn the_menu_stays_in_the_window() {
    with_window(|window, name| {
        let size = window.stage().viewport().size();
        for (corner, at) in [("left", DVec2::splat(4.0)), ("right", size * DVec2::new(0.99, 0.8))] {
            click(window, PointerButton::Right, at);
            assert!(says(window, "Front view"), "{name}: {:?}", said(window));
            for widget in ["Open…", "Quit"] {
                let at = window.widgets(widget)[0].center;
                let is_inside = at.cmpge(DVec2::ZERO).all() && at.cmplt(size).all();
                assert!(is_inside, "{name}, {corner}: {widget} at {at}");
            }
            check_layers(window, &format!("{name}, {corner}"));
            screenshot(window, &format!("{name}-menu-{corner}"));
            key(window, "Escape");
        }
    });
}

/// Its scroll area ended after 400 points, in windows of any height.
#[test]
fn the_list_of_keys_did_not_use_the_height_of_the_window() {
    let (_folder, mut viewer) = simple();
    let mut window = open(&mut viewer, Viewport { width: 1600, height: 1000 });
    key(&mut window, "H");
    let height = |(_, [min, max]): &(trigon_window::egui::LayerId, [DVec2; 2])| (max - min).y;
    let layers = window.layers();
    let tallest = layers.iter().map(height).filter(|&height| height < 1000.0).fold(0.0, f64::max);
    assert!(tallest > 600.0, "{layers:?}");
}

#[test]
fn the_outline_of_the_selected_object_was_drawn_over_panels() {
    let (_folder, mut viewer) = simple();
    let mut window = open(&mut viewer, SIZE);
    ["Shift+D", "3", "1", "PageUp", "PageUp", "PageUp", "PageUp"]
        .iter()
        .for_each(|chord| key(&mut window, chord));
    let panel = |window: &HeadlessWindow<'_>| -> Vec<[u8; 4]> {
        let pixels = window.pixels();
        (0..400).flat_map(|y| pixels[y * 800..y * 800 + 300].to_vec()).collect()
    };
    let before = panel(&window);
    key(&mut window, "Tab");
    assert!(window.stage().selection.is_some(), "it is selected");
    assert!(panel(&window) == before, "the panel stays as it is");
}
