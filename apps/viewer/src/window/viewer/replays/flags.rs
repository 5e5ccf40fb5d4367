//! F3D's flags of the window: what they do is seen there.

use trigon_camera::OrbitStyle;

use super::*;

/// What a window of an animated triangle with these flags says, after these keys.
fn said_with(flags: &str, keys: &[&str]) -> Vec<String> {
    let folder = tempfile::tempdir().expect("a folder");
    let file = written(folder.path(), "walk.gltf", GLTF);
    let mut viewer = viewer(flags, &[file]);
    let mut window = open(&mut viewer, SMALL);
    keys.iter().for_each(|chord| key(&mut window, chord));
    said(&window)
}

#[test]
fn the_frame_time_is_shown() {
    let has_time = |flags: &str| said_with(flags, &[]).iter().any(|text| text.ends_with(" ms"));
    assert!(has_time("--fps") && has_time("-z"), "{:?}", said_with("--fps", &[]));
    assert!(!has_time(""), "only then");
}

#[test]
fn keys_tell_what_they_do_unless_nobody_wants_to_know() {
    let tells = |flags: &str| said_with(flags, &["C"]).iter().any(|text| text.contains("faces show"));
    assert!(tells("") && tells("--notifications"), "usually");
    assert!(!tells("--notifications=false"), "unless it is turned off");
}

#[test]
fn the_bar_of_animations_has_more_or_less_in_it() {
    for (flags, texts) in [
        ("", &["Play", "clip", "Loop"][..]),
        ("--animation-progress=advanced", &["Play", "clip", "Loop"]),
        ("--animation-progress=default", &["Play"]),
        ("--animation-progress", &["Play"]),
        ("--animation-progress=none", &[]),
        ("--animation-autoplay", &["Pause", "clip", "Loop"]),
    ] {
        let said = said_with(flags, &[]);
        let all = ["Play", "Pause", "clip", "Loop"];
        let shown: Vec<&str> = all.into_iter().filter(|text| said.iter().any(|said| said == text)).collect();
        assert_eq!(shown, texts, "{flags}: {said:?}");
    }
}

#[test]
fn the_camera_turns_as_a_trackball() {
    for (flags, style) in [
        ("--interaction-style=trackball", OrbitStyle::Trackball),
        ("-k trackball", OrbitStyle::Trackball),
        ("--interaction-style=default", OrbitStyle::Turntable),
        ("", OrbitStyle::Turntable),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let mut viewer = viewer(flags, &[written(folder.path(), "a.obj", OBJ)]);
        let window = open(&mut viewer, SMALL);
        assert_eq!(window.stage().orbit.style(), style, "{flags}");
    }
}

#[test]
fn screenshots_and_states_have_their_names() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path().display();
    let flags =
        format!("--screenshot-filename={at}/{{model}}_{{n:2}}.png --statefile-filename={at}/kept.json");
    let mut viewer = viewer(&flags, &[written(folder.path(), "a.obj", OBJ)]);
    let mut window = open(&mut viewer, SMALL);
    for chord in ["F12", "Ctrl+F12", "Ctrl+S"] {
        key(&mut window, chord);
        loaded(&mut window);
    }
    for name in ["a_01.png", "a_02.png", "kept.json"] {
        assert!(folder.path().join(name).is_file(), "{name}: {:?}", said(&window));
    }
}
