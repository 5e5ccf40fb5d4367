//! Keys of configuration files, and the viewer's own that change flags.

use trigon_scene::{Background, Shadows, ToneMapping};

use super::*;

/// A viewer of a triangle with a configuration file.
fn configured(folder: &Path, json: &str) -> Viewer {
    let files = [("a.obj", OBJ), ("b.obj", OBJ)].map(|(name, text)| written(folder, name, text));
    let config = written(folder, "config.json", json);
    let words =
        ["--refine=false".to_owned(), "--samples=1".to_owned(), format!("--config={}", config.display())];
    let words = words.into_iter().map(OsString::from).chain(files.iter().map(OsString::from));
    let line = CommandLine::new(words).expect("flags");
    let request = Request::from_line(&line, Some(&files[0])).expect("flags that fit");
    let sources = Source::all(&request);
    let mut viewer = Viewer::new(request, sources, Reporter::new(Level::Quiet));
    viewer.recent = RecentFiles::default();
    viewer
}

#[test]
fn keys_of_configuration_files_execute_f3ds_commands() {
    let folder = tempfile::tempdir().expect("a folder");
    let json = r#"[{"bindings": {
        "O": "set_camera isometric",
        "Any+3": "roll_camera -90",
        "Ctrl+O": ["toggle render.grid.enable", "toggle scene.camera.orthographic"],
        "Shift+Y": "set model.color.opacity 0.5",
        "Y": "set render.background.color red",
        "U": "add_files b.obj c.obj",
        "Ctrl+U": "toggle model.nothing"
    }}, {"match": ".*b.obj", "bindings": {"O": "set_camera top", "Return": "exit"}}]"#;
    let mut viewer = configured(folder.path(), json);
    let mut window = open(&mut viewer, SMALL);
    assert!(says(&window, "Ctrl+U: ") && says(&window, "not an option"), "{:?}", said(&window));
    let home = window.stage().orbit;
    key(&mut window, "9");
    let isometric = window.stage().orbit;
    key(&mut window, "Enter");
    assert_eq!(window.stage().orbit, home, "Enter is only of the other file");
    key(&mut window, "O");
    assert_eq!(window.stage().orbit, isometric, "in place of the spheres");
    key(&mut window, "Shift+3");
    assert_ne!(window.stage().orbit, isometric, "rolled, with any modifier");
    key(&mut window, "Ctrl+O");
    assert!(window.stage().orbit.is_orthographic(), "the second line");
    assert!(window.stage().scene.nodes().iter().any(|(_, node)| node.name == "grid"), "and the first");
    assert!(!says(&window, "path of a model"), "nothing is opened");
    key(&mut window, "Y");
    assert!(matches!(window.stage().settings.background, Background::Color(color) if color.x > 0.9), "red");
    key(&mut window, "Shift+Y");
    loaded(&mut window);
    let opacity = window.stage().scene.materials.iter().map(|(_, material)| material.base_color.w).next();
    assert_eq!(opacity, Some(0.5), "the model is loaded again");
    assert!(window.stage().scene.nodes().iter().any(|(_, node)| node.name == "grid"), "and keeps its grid");
    key(&mut window, "H");
    assert!(says(&window, "set_camera isometric"), "the list of keys has them: {:?}", said(&window));
    key(&mut window, "Escape");
    key(&mut window, "Right");
    loaded(&mut window);
    key(&mut window, "7");
    let top = window.stage().orbit;
    key(&mut window, "9");
    key(&mut window, "O");
    assert_eq!(window.stage().orbit, top, "that of the other file");
    key(&mut window, "Enter");
    assert!(window.is_closed(), "exit");
}

#[test]
fn keys_change_flags_and_keep_what_other_keys_and_panels_have_set() {
    let (_folder, mut viewer) = simple();
    let mut window = open(&mut viewer, SMALL);
    for chord in ["E", "L", "T", "Q", "S", "J"] {
        key(&mut window, chord);
    }
    let settings = window.stage().settings.clone();
    assert_eq!(settings.effects.tone_mapping, ToneMapping::KhronosPbrNeutral, "T");
    assert!(settings.effects.ambient_occlusion.is_some(), "Q");
    assert!(matches!(settings.effects.shadows, Shadows::Maps { .. }), "S");
    assert!(settings.effects.environment.is_some(), "J lights by a sky");
    assert_eq!(settings.background, Background::Environment, "and shows it");
    assert!(settings.light_intensity > 1.0, "L stays");
    for chord in ["T", "Q", "S", "J"] {
        key(&mut window, chord);
    }
    let settings = window.stage().settings.clone();
    assert_eq!(settings.effects.tone_mapping, ToneMapping::None, "T again");
    assert!(settings.effects.ambient_occlusion.is_none() && settings.effects.environment.is_none());
    assert_eq!(settings.effects.shadows, Shadows::Off, "S again");
    key(&mut window, "Ctrl+K");
    key(&mut window, "E");
    key(&mut window, "Ctrl+N");
    loaded(&mut window);
    assert!(window.stage().scene.nodes().iter().any(|(_, node)| node.name == "normals"), "normals");
    assert!(!says(&window, "normal-glyphs: true"), "no messages");
    for chord in ["Ctrl+K", "Ctrl+N", "O"] {
        key(&mut window, chord);
        loaded(&mut window);
    }
    assert!(says(&window, "point-sprites: sphere"), "{:?}", said(&window));
    assert!(window.stage().scene.visible_points().count() > 3, "balls");
}

#[test]
fn a_sky_that_is_shown_and_hidden_again_leaves_the_light_as_it_was() {
    let (_folder, mut viewer) = simple();
    let mut window = open(&mut viewer, SMALL);
    let has_light = |window: &HeadlessWindow<'_>| window.stage().settings.effects.environment.is_some();
    for (before, is_lit) in [("", false), ("F", true), ("F", false), ("F", true)] {
        if !before.is_empty() {
            key(&mut window, before);
        }
        assert_eq!(has_light(&window), is_lit, "after {before:?}");
        key(&mut window, "J");
        assert!(has_light(&window), "a sky lights what stands in it");
        key(&mut window, "J");
        assert_eq!(has_light(&window), is_lit, "after {before:?}, J and J");
    }
}

#[test]
fn the_down_arrow_goes_through_the_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    let names = ["a.obj", "b.obj", "c.obj"];
    let files = names.map(|name| written(folder.path(), name, OBJ));
    let mut viewer = viewer("", &files[1..2]);
    let mut window = open(&mut viewer, SMALL);
    key(&mut window, "Down");
    loaded(&mut window);
    assert!(says(&window, "(2/3) b.obj"), "{:?}", said(&window));
    key(&mut window, "Right");
    loaded(&mut window);
    assert_eq!(window.stage().title(), "c.obj - trigon", "the next one");
}
