//! Opening, finding help, the menu, paths, questions: by mouse and keys alone.

use trigon_scene::ShadingModel;
use trigon_window::Widget;
use trigon_window::egui::accesskit::Role;

use super::*;

#[test]
fn one_line_says_how_to_begin_until_somebody_has() {
    let (_folder, mut viewer) = simple();
    let mut window = open(&mut viewer, SIZE);
    let hint = "Drag: orbit";
    assert!(says(&window, hint), "{:?}", said(&window));
    window.move_to(SIZE.size() * 0.5);
    assert!(says(&window, hint), "a movement is no beginning");
    window.wheel(1.0);
    assert!(!says(&window, hint), "this is one");
}

#[test]
fn files_over_the_window_show_where_they_go() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = written(folder.path(), "a.obj", OBJ);
    let (_folder, mut viewer) = simple();
    let mut window = open(&mut viewer, SIZE);
    let before = window.pixels();
    window.hover(std::slice::from_ref(&file));
    assert!(window.pixels() != before, "a frame");
    window.drop_files(&[file]);
    loaded(&mut window);
    assert_eq!(window.stage().title(), "a.obj - trigon", "dropped");
}

#[test]
fn the_menu_opens_by_a_right_click_and_by_keys_and_does_what_keys_do() {
    let (_folder, mut viewer) = simple();
    let mut window = open(&mut viewer, SIZE);
    click(&mut window, PointerButton::Right, DVec2::new(600.0, 100.0));
    assert!(says(&window, "Save a screenshot"), "{:?}", said(&window));
    press_button(&mut window, "Front view");
    let front = window.stage().orbit;
    assert!(!says(&window, "Save a screenshot"), "chosen, and closed");
    key(&mut window, "7");
    assert_ne!(window.stage().orbit, front, "another side");
    key(&mut window, "1");
    assert_eq!(window.stage().orbit, front, "what 1 does");
    for chord in ["Menu", "Shift+F10"] {
        key(&mut window, chord);
        assert!(says(&window, "Front view"), "{chord}");
        key(&mut window, "Escape");
        assert!(!says(&window, "Front view"), "{chord}, Escape");
    }
    key(&mut window, "Menu");
    key(&mut window, "Enter");
    assert!(says(&window, "path of a model"), "Enter chooses the first entry: {:?}", said(&window));
}

#[test]
fn the_list_of_keys_is_searched_and_chosen_from() {
    let (_folder, mut viewer) = simple();
    let mut window = open(&mut viewer, SIZE);
    key(&mut window, "H");
    let at = window.widgets("search keys and commands")[0].center;
    click(&mut window, PointerButton::Left, at);
    type_text(&mut window, "statistics");
    assert!(says(&window, "counts and sizes") && !says(&window, "isometric view"), "{:?}", said(&window));
    press_button(&mut window, "counts and sizes");
    assert!(says(&window, "vertices"), "chosen: {:?}", said(&window));
    key(&mut window, "Escape");
    key(&mut window, "Escape");
    key(&mut window, "H");
    assert!(says(&window, "isometric view"), "not searched any more: {:?}", said(&window));
}

/// The letters of "save" toggled shadows and more.
#[test]
fn what_is_typed_when_the_list_of_keys_opens_is_searched() {
    let (_folder, mut viewer) = simple();
    let mut window = open(&mut viewer, SIZE);
    let (settings, orbit) = (window.stage().settings.clone(), window.stage().orbit);
    key(&mut window, "H");
    type_text(&mut window, "save");
    assert!(!says(&window, "isometric view"), "only what is searched for is listed: {:?}", said(&window));
    assert!(window.stage().settings == settings, "no letter is a key");
    key(&mut window, "Down");
    key(&mut window, "Left");
    assert_eq!(window.stage().orbit, orbit, "and no arrow turns the camera");
    key(&mut window, "Escape");
    assert!(!says(&window, "Keys and commands"), "Escape closes it at once: {:?}", said(&window));
    key(&mut window, "S");
    assert!(window.stage().settings != settings, "then letters are keys again");
}

#[test]
fn the_list_of_keys_leaves_nothing_behind() {
    let (_folder, mut viewer) = simple();
    let mut window = open(&mut viewer, SIZE);
    // The first key takes away the line about the mouse and keys.
    key(&mut window, "Escape");
    let plain = window.pixels();
    key(&mut window, "H");
    type_text(&mut window, "save");
    assert!(window.pixels() != plain, "it is there");
    key(&mut window, "Escape");
    assert!(window.pixels() == plain, "and gone without a trace");
}

#[test]
fn a_path_is_typed_at_once_and_completed() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["chair.obj", "charm.obj"] {
        written(folder.path(), name, OBJ);
    }
    let (_folder, mut viewer) = simple();
    let mut window = open(&mut viewer, SIZE);
    key(&mut window, "Ctrl+O");
    type_text(&mut window, &format!("{}/c", folder.path().display()));
    key(&mut window, "Tab");
    assert!(says(&window, "chair.obj") && says(&window, "charm.obj"), "both: {:?}", said(&window));
    type_text(&mut window, "i");
    key(&mut window, "Tab");
    key(&mut window, "Enter");
    loaded(&mut window);
    assert_eq!(window.stage().title(), "chair.obj - trigon", "{:?}", said(&window));
    key(&mut window, "Ctrl+O");
    assert!(says(&window, "path of a model"), "open again");
    key(&mut window, "Escape");
    assert!(!says(&window, "path of a model"), "Escape closes it at once: {:?}", said(&window));
}

#[test]
fn escape_closes_every_panel() {
    let folder = tempfile::tempdir().expect("a folder");
    let broken = written(folder.path(), "broken.obj", "v");
    let (_folder, mut viewer) = simple();
    let mut window = open(&mut viewer, SIZE);
    for (chord, label) in [
        ("H", "Keys and commands"),
        ("Ctrl+O", "path of a model"),
        ("Shift+D", "samples per pixel"),
        ("Menu", "Front view"),
    ] {
        key(&mut window, chord);
        assert!(says(&window, label), "{chord}: {:?}", said(&window));
        key(&mut window, "Escape");
        assert!(!says(&window, label), "{chord} and Escape: {:?}", said(&window));
    }
    window.drop_files(&[broken]);
    loaded(&mut window);
    assert!(says(&window, "broken.obj is not shown"), "{:?}", said(&window));
    key(&mut window, "Escape");
    assert!(!says(&window, "broken.obj is not shown"), "{:?}", said(&window));
}

/// Selects the first object and moves it.
fn move_object(window: &mut HeadlessWindow<'_>) {
    key(window, "Tab");
    key(window, "Alt+Right");
    assert_eq!(window.stage().moved_nodes().len(), 1, "it was moved");
}

#[test]
fn loading_again_asks_first_if_objects_were_moved() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut viewer = viewer("", &[written(folder.path(), "a.obj", OBJ)]);
    let mut window = open(&mut viewer, SIZE);
    let start = window.stage().scene.bounds();
    key(&mut window, "Up");
    loaded(&mut window);
    assert!(!says(&window, "Load the file again?"), "nothing would be lost");
    move_object(&mut window);
    let moved = window.stage().scene.bounds();
    key(&mut window, "Up");
    assert!(says(&window, "Load the file again?"), "{:?}", said(&window));
    key(&mut window, "Escape");
    assert!(!says(&window, "Load the file again?"), "Escape keeps it");
    assert_eq!(window.stage().scene.bounds(), moved, "as it was moved");
    key(&mut window, "Ctrl+Z");
    assert_eq!(window.stage().scene.bounds(), start, "Ctrl+Z puts it back");
    key(&mut window, "Ctrl+Shift+Z");
    assert_eq!(window.stage().scene.bounds(), moved, "Ctrl+Shift+Z moves it again");
    key(&mut window, "Up");
    key(&mut window, "Enter");
    loaded(&mut window);
    assert_eq!(window.stage().scene.bounds(), start, "Enter loads it");
    assert_eq!(window.stage().moved_nodes().len(), 0, "and nothing is moved");
}

#[test]
fn up_axes_have_other_keys_than_undo() {
    let (_folder, mut viewer) = simple();
    let mut window = open(&mut viewer, SIZE);
    key(&mut window, "Alt+Z");
    assert!(says(&window, "+Z is up"), "{:?}", said(&window));
    key(&mut window, "Ctrl+Z");
    assert!(says(&window, "no object was moved"), "{:?}", said(&window));
}

#[test]
fn the_step_of_the_ladder_is_lit_and_arrows_change_a_setting() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut viewer = viewer("--preset=default", &[written(folder.path(), "a.obj", OBJ)]);
    viewer.request.settings.samples_per_axis = 3;
    let mut window = open(&mut viewer, SIZE);
    key(&mut window, "Shift+D");
    let lit = |window: &HeadlessWindow<'_>| {
        let steps = ["draft", "standard", "default", "high", "reference"];
        let is_lit = |name: &&str| window.widgets(name).iter().any(|widget| widget.is_on == Some(true));
        steps.into_iter().filter(is_lit).collect::<Vec<_>>()
    };
    assert_eq!(lit(&window), ["default"], "{:?}", window.all_widgets());
    press_button(&mut window, "draft");
    assert_eq!(window.stage().settings.samples_per_axis, 1, "as drafts have");
    assert_eq!(lit(&window), ["draft"], "the step");
    key(&mut window, "F6");
    // From the buttons an arrow leads to the lists, and in a list to the next option.
    let before = window.stage().settings.clone();
    for _ in 0..30 {
        if window.stage().settings != before {
            break;
        }
        key(&mut window, "Tab");
        key(&mut window, "Down");
    }
    assert_ne!(window.stage().settings, before, "an arrow chose another option");
}

/// Each arrow changed the model while somebody was looking for an entry.
#[test]
fn arrows_in_an_open_list_change_nothing_until_an_entry_is_chosen() {
    let (_folder, mut viewer) = simple();
    let mut window = open(&mut viewer, SIZE);
    key(&mut window, "Shift+D");
    let before = window.stage().settings.clone();
    let is_list = |widget: &&Widget| widget.role == Role::ComboBox;
    let at = window.widgets("lighting").iter().find(is_list).expect("a list").center;
    click(&mut window, PointerButton::Left, at);
    for chord in ["Down", "Up", "Up", "Down", "Left", "Up"] {
        key(&mut window, chord);
        assert!(window.stage().settings == before, "{chord} only leads to another entry");
    }
    key(&mut window, "Escape");
    assert!(window.stage().settings == before, "Escape chooses nothing");
    click(&mut window, PointerButton::Left, at);
    let per_pixel = before.shading;
    for chord in ["Up", "Up", "Up", "Up", "Enter"] {
        key(&mut window, chord);
    }
    assert_eq!(
        (per_pixel, window.stage().settings.shading),
        (ShadingModel::Phong, ShadingModel::Flat),
        "the first one"
    );
    let chosen = window.stage().settings.clone();
    key(&mut window, "Down");
    assert!(window.stage().settings != chosen, "in the closed list an arrow chooses");
}

#[test]
fn f11_fills_the_screen_and_escape_leaves_it() {
    let (_folder, mut viewer) = simple();
    let mut window = open(&mut viewer, SIZE);
    key(&mut window, "F11");
    assert!(window.stage().full_screen, "filled");
    key(&mut window, "Escape");
    assert!(!window.stage().full_screen, "as before");
}
