//! Panels and overlays, each opened by its key.

use trigon_math::DVec2;
use trigon_scene::{Display, NodeId, Scene};
use trigon_window::{Chord, Key, Modifiers};

use super::{SMALL, click, click_at, key, says, shift, with_window};

/// A point of the image that the model covers and no panel does.
const ON_MODEL: DVec2 = DVec2::new(400.0, 300.0);

fn named(scene: &Scene, name: &str) -> NodeId {
    let found = scene.nodes().iter().find(|(_, node)| node.name == name);
    found.map(|(id, _)| id).unwrap_or_else(|| panic!("no {name}"))
}

#[test]
fn the_tree_hides_shows_selects_and_frames() {
    with_window("", SMALL, |window| {
        let before = window.pixels();
        shift(window, 'h');
        let name = "cone";
        let id = named(&window.stage().scene, name);
        click(window, &format!("Hide {name}"));
        assert!(!window.stage().scene.node(id).expect("still there").visible, "the eye hides it");
        click(window, &format!("Show {name}"));
        assert!(window.stage().scene.node(id).expect("still there").visible, "and shows it");
        click(window, name);
        assert_eq!(window.stage().selection, Some(id), "a click selects");
        let orbit = window.stage().orbit;
        let row = window.widgets(name)[0].center;
        click_at(window, row);
        assert_eq!(window.stage().orbit, orbit, "one click does not move the camera");
        window.key(Key::Escape.into());
        assert!(window.widgets(name).is_empty(), "Escape closes the panel");
        window.key(Key::Escape.into());
        assert!(window.pixels() == before, "and then selects nothing");
    });
}

#[test]
fn the_tree_is_searched_and_knows_nothing_of_the_grid() {
    with_window("--grid --scene-hierarchy", SMALL, |window| {
        assert!(window.widgets("grid").is_empty(), "the grid is beside the model");
        assert!(!window.widgets("cone").is_empty(), "the model is there");
        click(window, "Search the scene");
        "teap".chars().for_each(|letter| key(window, letter));
        assert!(window.widgets("cone").is_empty(), "it is not searched for");
        assert!(!window.widgets("teapot").is_empty(), "this is");
    });
}

#[test]
fn pixels_are_explained_where_the_pointer_is_and_where_it_clicks() {
    with_window("", SMALL, |window| {
        window.move_to(ON_MODEL);
        key(window, 'i');
        assert!(says(window, "pixel 400, 300"), "the one at the pointer");
        assert!(says(window, "seen"), "with what is seen there");
        let hit = window.stage().pick(ON_MODEL).expect("the model").0.node;
        let name = window.stage().scene.node(hit).expect("there").name.clone();
        assert!(says(window, &name), "it is {name}");
        click_at(window, DVec2::new(3.0, 3.0));
        assert!(says(window, "pixel 3, 3") && says(window, "the background"), "the one that was clicked");
        assert_eq!(window.stage().selection, None, "which selects nothing");
        key(window, 'i');
        assert!(!says(window, "pixel 3, 3"), "the key closes it, too");
    });
}

#[test]
fn effects_are_listed_with_reasons() {
    with_window("", SMALL, |window| {
        shift(window, 'p');
        assert!(says(window, "fog: because the settings do not request it"), "what is off");
        assert!(says(window, "On") && says(window, "Off"), "under two titles");
    });
}

#[test]
fn the_time_of_each_stage_is_shown() {
    with_window("", SMALL, |window| {
        shift(window, 'z');
        for stage in ["vertices", "set-up", "visibility", "shading", "blending", "resolve", "interface"] {
            assert!(says(window, stage), "{stage}");
        }
        assert!(!window.stage().report().stages.shading.is_zero(), "an image was drawn for it");
        shift(window, 'z');
        assert!(!says(window, "visibility"), "and hidden again");
    });
}

#[test]
fn axes_and_grid_are_toggled() {
    with_window("", SMALL, |window| {
        let plain = window.pixels();
        let (nodes, orbit) = (window.stage().scene.nodes().len(), window.stage().orbit);
        key(window, 'x');
        let with_axes = window.pixels();
        let differs = |at: usize| with_axes[at] != plain[at];
        let changed: Vec<usize> = (0..plain.len()).filter(|&at| differs(at)).collect();
        assert!(changed.len() > 100, "arrows");
        assert!(changed.iter().all(|at| at % 800 > 600 && at / 800 > 350), "at the lower right");
        key(window, 'x');
        assert!(window.pixels() == plain, "and gone");
        key(window, 'g');
        assert_eq!(window.stage().scene.nodes().len(), nodes + 1, "the grid");
        assert!(window.pixels() != plain, "is seen");
        key(window, 'g');
        assert_eq!((window.stage().scene.nodes().len(), window.stage().orbit), (nodes, orbit), "and gone");
        assert!(window.pixels() == plain, "without a trace");
    });
}

#[test]
fn faces_show_what_keys_and_the_list_choose() {
    with_window("", SMALL, |window| {
        let shaded = window.pixels();
        key(window, 'v');
        let mut images = vec![shaded.clone()];
        for display in &Display::ALL[1..] {
            click(window, display.name());
            assert_eq!(window.stage().settings.display, *display, "chosen");
            assert!(!images.contains(&window.pixels()), "{} looks like another", display.name());
            images.push(window.pixels());
        }
        window.key(Key::Escape.into());
        key(window, 'c');
        assert_eq!(window.stage().settings.display, Display::Shaded, "after the last comes the first");
        shift(window, 'c');
        assert_eq!(window.stage().settings.display, Display::Depth, "and before it the last");
        window.key(Chord::new(Modifiers::CTRL, Key::Character('d')));
        assert_eq!(window.stage().settings.display, Display::Shaded, "its own key takes it away");
        shift(window, 'm');
        assert_eq!(window.stage().settings.display, Display::Matcap, "clay");
    });
}

#[test]
fn clicks_measure_and_escape_ends_it() {
    with_window("", SMALL, |window| {
        let before = window.pixels();
        key(window, 'r');
        assert!(says(window, "Click a point."), "what to do");
        click_at(window, ON_MODEL);
        assert!(says(window, "1: ") && says(window, "Click a second one."), "the first");
        click_at(window, ON_MODEL + DVec2::new(30.0, 10.0));
        assert!(says(window, "distance  ") && says(window, "dx dy dz  "), "between two");
        click_at(window, ON_MODEL + DVec2::new(-20.0, 40.0));
        assert!(says(window, "angle     "), "of three");
        click_at(window, ON_MODEL);
        assert!(!says(window, "2: "), "the fourth is the first again");
        assert_eq!(window.stage().selection, None, "nothing is selected");
        window.key(Key::Escape.into());
        assert!(!says(window, "Measuring"), "ended");
        window.move_to(DVec2::ZERO);
        assert!(window.pixels() == before, "without a trace");
    });
}

#[test]
fn a_view_is_measured_in_the_background_until_it_is_cancelled() {
    with_window("", SMALL, |window| {
        shift(window, 'd');
        click(window, "Measure this view");
        assert!(window.widgets("Measure this view").is_empty(), "it has begun");
        click(window, "Cancel");
        assert_eq!(window.widgets("Measure again").len(), 1, "it has ended");
    });
}
