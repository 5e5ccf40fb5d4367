//! Every key of the cheat sheet and every panel, in windows of three sizes: nothing ends the program, no
//! panel covers another, and none leaves the window. With `TRIGON_REPLAY_IMAGES=FOLDER` a screenshot of each
//! is written, to be looked at.

use std::sync::{Arc, Mutex};

use trigon_camera::Camera;
use trigon_io::{Pixels, write_png};
use trigon_scene::{Cancel, Frame, RenderSettings, Scene};
use trigon_window::Drawer;

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
const TOGGLES: [&str; 16] = [
    "ambient_occlusion",
    "armature",
    "axis",
    "environment.background",
    "environment.light",
    "file.name",
    "frame_time",
    "frame_time.stages",
    "grid",
    "metadata",
    "normal_glyphs",
    "notifications",
    "point_sprites",
    "quality.difference",
    "shadows",
    "tone_mapping",
];

/// What undoes a key that changes the image, so that the next one is seen alone.
const UNDONE_BY: [(&str, &str); 16] = [
    ("opacity.less", "Ctrl+P"),
    ("edges", "E"),
    ("wireframe", "Shift+E Shift+E"),
    ("samples", "A A A"),
    ("orthographic", "5"),
    ("orbit_style", "K"),
    ("up.z", "Alt+Y"),
    ("display.next", "Shift+C"),
    ("display.previous", "C"),
    ("display.matcap", "Shift+M"),
    ("display.depth", "Ctrl+D"),
    ("animation.next", "W W"),
    ("text.larger", "Ctrl+-"),
    ("text.smaller", "Ctrl+="),
    ("object.move", "Ctrl+Z"),
    ("object.turn", "Ctrl+Z"),
];

/// The corners of a cube, and the two triangles of each of its sides.
const BOX: [[f32; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [1.0, 1.0, 1.0],
];
const FACES: [[u8; 6]; 6] = [
    [0, 2, 3, 0, 3, 1],
    [4, 5, 7, 4, 7, 6],
    [0, 1, 5, 0, 5, 4],
    [2, 6, 7, 2, 7, 3],
    [0, 4, 6, 0, 6, 2],
    [1, 3, 7, 1, 7, 5],
];

/// A red box on a blue one, which looks different from every side. The red one moves in a second, or turns around.
const BOXES: &str = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
"nodes":[{"name":"lower","mesh":0,"scale":[2,1,1.5]},{"name":"upper","mesh":1,"translation":[0,1,0]}],
"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.8,1],"metallicFactor":0}},
{"pbrMetallicRoughness":{"baseColorFactor":[0.8,0.1,0.1,1],"metallicFactor":0}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]},
{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":1}]}],
"buffers":[{"byteLength":196,"uri":"boxes.bin"}],
"bufferViews":[{"buffer":0,"byteLength":96},{"buffer":0,"byteOffset":96,"byteLength":36},
{"buffer":0,"byteOffset":132,"byteLength":8},{"buffer":0,"byteOffset":140,"byteLength":24},
{"buffer":0,"byteOffset":164,"byteLength":32}],
"accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},
{"bufferView":1,"componentType":5121,"count":36,"type":"SCALAR"},
{"bufferView":2,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[1]},
{"bufferView":3,"componentType":5126,"count":2,"type":"VEC3"},
{"bufferView":4,"componentType":5126,"count":2,"type":"VEC4"}],
"animations":[{"name":"Slide","samplers":[{"input":2,"output":3}],
"channels":[{"sampler":0,"target":{"node":1,"path":"translation"}}]},
{"name":"Turn","samplers":[{"input":2,"output":4}],
"channels":[{"sampler":0,"target":{"node":1,"path":"rotation"}}]}]}"#;

/// Writes the boxes and their buffer.
fn written_boxes(folder: &Path) -> PathBuf {
    let values = [0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0_f32];
    let mut bytes: Vec<u8> = BOX.iter().flatten().flat_map(|value| value.to_le_bytes()).collect();
    bytes.extend(FACES.iter().flatten());
    bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    written(folder, "boxes.bin", bytes);
    written(folder, "boxes.gltf", BOXES)
}

/// Writes what is to be seen, if somebody wants to look at it.
fn screenshot(window: &HeadlessWindow<'_>, name: &str) {
    let Some(folder) = std::env::var_os("TRIGON_REPLAY_IMAGES") else { return };
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

/// Draws nothing. Large windows are for where panels stand, and a drawn scene would take most of the time.
#[derive(Default)]
struct Blank(Mutex<Frame>);

impl Drawer for Blank {
    fn draw(&self, _: &Scene, _: &Camera, settings: &RenderSettings, _: &Cancel) -> Result<Frame, String> {
        let mut last = self.0.lock().expect("nobody panics with it");
        if [last.width, last.height] != [settings.width, settings.height] {
            *last = blank(settings.width, settings.height);
        }
        Ok(last.clone())
    }

    fn draws_drafts(&self) -> bool {
        true
    }
}

/// A black image of nothing.
fn blank(width: u32, height: u32) -> Frame {
    let count = width as usize * height as usize;
    let color = [0, 0, 0, u8::MAX].repeat(count);
    let (depth, ids) = (Some(vec![f32::INFINITY; count]), vec![u32::MAX; count]);
    let (object_ids, face_ids) = (Some(ids.clone()), Some(ids));
    Frame { width, height, color, depth, object_ids, face_ids, ..Frame::default() }
}

/// A window that shows an animated model, and another one beside it. In large windows the scene is drawn only if
/// somebody wants to look at it.
fn with_window(test: impl Fn(&mut HeadlessWindow<'_>, &str)) {
    let folder = tempfile::tempdir().expect("a folder");
    let files = [written_boxes(folder.path()), written(folder.path(), "other.obj", OBJ)];
    let at = folder.path().display();
    let flags = format!("--screenshot-filename={at}/shot.png --statefile-filename={at}/state.json");
    let is_looked_at = std::env::var_os("TRIGON_REPLAY_IMAGES").is_some();
    for (size, scale) in WINDOWS {
        let mut viewer = viewer(&flags, &files);
        let mut stage = stage(&viewer);
        if size != SIZE && !is_looked_at {
            stage.drawer = Some(Arc::new(Blank::default()));
        }
        let mut window = HeadlessWindow::open(stage, &mut viewer, size);
        loaded(&mut window);
        window.resize(size, scale);
        let name = format!("{}x{}@{scale}", size.width, size.height);
        test(&mut window, &name);
    }
}

/// Undoes what a key did to the image.
fn restore(window: &mut HeadlessWindow<'_>, name: &str, home: Orbit) {
    let undone = UNDONE_BY.iter().filter(|(of, _)| *of == name).flat_map(|(_, by)| by.split(' '));
    undone.for_each(|chord| window.tap(chord.parse().expect("a chord")));
    if window.stage().orbit != home {
        window.tap(Key::Enter.into());
    }
    loaded(window);
}

#[test]
fn every_key_of_the_sheet_does_something_harmless() {
    with_window(|window, name| {
        check_layers(window, name);
        screenshot(window, &format!("{name}-start"));
        let home = window.stage().orbit;
        let bindings = window.stage().keymap.bindings().to_vec();
        assert!(bindings.len() > 60, "all of them: {}", bindings.len());
        for binding in bindings.iter().filter(|binding| binding.name != "quit") {
            if binding.name.starts_with("object") || binding.name == "look_at_selected" {
                key(window, "Tab");
            }
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
            restore(window, &binding.name, home);
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
                // Texts stay where Escape closes nothing. Into the path field the key only typed.
                let is_text = |text: &&&str| ["N", "M", "Z", "D", "X"].contains(*text) && *one != "Ctrl+O";
                for text in [one, other].into_iter().filter(is_text) {
                    key(window, text);
                }
            }
        }
    });
}

/// The lowest part of the model was behind the bar.
#[test]
fn the_bar_of_animations_covered_the_model_in_fitted_views() {
    with_window(|window, name| {
        for view in ["Enter", "1", "3", "7", "9"] {
            key(window, view);
            let bar = window.widgets("Play")[0].center.y * 2.0 - window.stage().viewport().size().y;
            let stage = window.stage();
            let projector = Projector::new(&stage.camera(), stage.viewport());
            let seen = stage.scene.visible_points().filter_map(|point| projector.to_screen(point));
            let lowest = seen.map(|at| at.y).fold(0.0, f64::max);
            assert!(lowest > bar * 0.5, "{name}, {view}: it is seen, down to {lowest}");
            assert!(lowest < bar, "{name}, {view}: down to {lowest}, the bar begins at {bar}");
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
