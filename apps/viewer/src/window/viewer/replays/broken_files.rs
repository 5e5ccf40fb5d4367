//! Broken, half-written and deleted files: never a crash, never a frozen window, always a message that stays.

use std::fs;

use trigon_math::SplitMix64;

use super::*;

/// The window still does what keys say, and the message is there all the time.
fn lives_on(window: &mut HeadlessWindow<'_>, what: &str) {
    key(window, "H");
    assert!(says(window, "Keys and commands"), "{what}: H shows the keys: {:?}", said(window));
    key(window, "Escape");
    let before = window.pixels();
    (0..4).for_each(|_| key(window, "Shift+Right"));
    assert!(window.pixels() != before, "{what}: the camera turns");
}

/// What can arrive under the name of a model.
fn broken() -> Vec<(&'static str, Vec<u8>)> {
    let mut random = SplitMix64::new(1);
    let noise: Vec<u8> = (0..20_000).map(|_| random.below(256) as u8).collect();
    let mut cut = b"glTF\x02\0\0\0\xff\xff\xff\x7f".to_vec();
    cut.extend([0xff, 0xff, 0xff, 0x7e, b'J', b'S', b'O', b'N', b'{']);
    vec![
        ("empty.obj", Vec::new()),
        ("noise.obj", noise.clone()),
        ("noise.glb", noise.clone()),
        ("short.stl", noise[..40].to_vec()),
        ("noise.ply", noise),
        ("cut.glb", cut),
        ("half.gltf", GLTF.as_bytes()[..GLTF.len() / 2].to_vec()),
        (
            "claims.ply",
            b"ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n".to_vec(),
        ),
        ("nothing.off", b"OFF\n0 0 0\n".to_vec()),
        ("far.obj", b"v 0 0 0\nf 1 2 99\n".to_vec()),
        ("words.xyz", b"what is this?".to_vec()),
    ]
}

#[test]
fn broken_files_that_are_dropped_are_messages_that_stay() {
    let folder = tempfile::tempdir().expect("a folder");
    let good = written(folder.path(), "good.obj", OBJ);
    let mut viewer = viewer("", &[good]);
    let mut window = open(&mut viewer, SMALL);
    assert_eq!(window.stage().title(), "good.obj - trigon", "shown");
    for (name, contents) in broken() {
        let file = written(folder.path(), name, contents);
        window.drop_files(&[file]);
        loaded(&mut window);
        let message = format!("{name} is not shown");
        assert!(says(&window, &message), "{name}: {:?}", said(&window));
        lives_on(&mut window, name);
        assert!(says(&window, &message), "{name}: it stays");
        assert_eq!(window.stage().title(), "good.obj - trigon", "{name}: and so does the model");
        assert!(!window.stage().scene.bounds().is_empty(), "{name}: which is still there");
        key(&mut window, "Escape");
        assert!(!says(&window, &message), "{name}: until it is closed");
    }
}

#[test]
fn folders_and_files_that_are_not_there_are_messages_too() {
    let folder = tempfile::tempdir().expect("a folder");
    let empty = folder.path().join("empty");
    fs::create_dir(&empty).expect("a folder in it");
    let (_folder, mut viewer) = simple();
    let mut window = open(&mut viewer, SMALL);
    for path in [empty, folder.path().join("gone.obj")] {
        window.drop_files(&[path]);
        loaded(&mut window);
        assert!(says(&window, "is not shown"), "{:?}", said(&window));
        lives_on(&mut window, "missing");
        assert!(says(&window, "is not shown"), "it stays");
        key(&mut window, "Escape");
    }
}

#[test]
fn a_window_that_has_shown_nothing_yet_says_how_to_fill_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let broken = written(folder.path(), "broken.glb", "glTF");
    let good = written(folder.path(), "good.obj", OBJ);
    let mut viewer = viewer("", &[broken]);
    let mut window = open(&mut viewer, SMALL);
    assert!(says(&window, "broken.glb is not shown"), "{:?}", said(&window));
    assert!(says(&window, "Drop a model here"), "and what to do: {:?}", said(&window));
    window.drop_files(&[good]);
    loaded(&mut window);
    assert_eq!(window.stage().title(), "good.obj - trigon", "it was dropped");
    assert!(!says(&window, "Drop a model here") && !says(&window, "is not shown"), "{:?}", said(&window));
}

#[test]
fn a_half_written_file_that_is_watched_is_a_message_until_it_is_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = written(folder.path(), "model.gltf", GLTF);
    let mut viewer = viewer("--watch --animation-progress=none", std::slice::from_ref(&file));
    let mut window = open(&mut viewer, SMALL);
    for _ in 0..2 {
        fs::write(&file, &GLTF[..GLTF.len() / 2]).expect("written");
        while !says(&window, "model.gltf is not shown") {
            window.wait();
        }
        lives_on(&mut window, "half");
        assert!(says(&window, "model.gltf is not shown"), "it stays");
        assert!(!window.stage().scene.bounds().is_empty(), "behind it is what was read before");
        fs::write(&file, GLTF).expect("written");
        while says(&window, "model.gltf is not shown") || says(&window, "loading ") {
            window.wait();
        }
    }
    assert_eq!(window.stage().title(), "model.gltf - trigon", "whole again");
}

#[test]
fn a_file_that_is_deleted_while_it_is_open_stays_on_the_screen() {
    let folder = tempfile::tempdir().expect("a folder");
    for flags in ["", "--watch"] {
        let file = written(folder.path(), "model.obj", OBJ);
        let mut viewer = viewer(flags, std::slice::from_ref(&file));
        let mut window = open(&mut viewer, SMALL);
        fs::remove_file(&file).expect("it was there");
        if flags.is_empty() {
            key(&mut window, "Up");
            loaded(&mut window);
        }
        while !says(&window, "model.obj is not shown") {
            window.wait();
        }
        lives_on(&mut window, "deleted");
        key(&mut window, "M");
        assert!(says(&window, "vertices"), "counts are known without it: {:?}", said(&window));
        assert!(says(&window, "model.obj is not shown"), "the message stays");
        assert!(!window.stage().scene.bounds().is_empty(), "and the model, too");
    }
}

/// Under the name of another file that was loaded with it, or is current.
#[test]
fn the_headline_of_a_message_is_the_file_that_it_is_about() {
    let folder = tempfile::tempdir().expect("a folder");
    let files = [("a.obj", OBJ), ("b.obj", "v 0")];
    let files = files.map(|(name, contents)| written(folder.path(), name, contents));
    let mut both = viewer("--multi-file-mode=all", &files);
    let window = open(&mut both, SMALL);
    assert!(
        says(&window, "b.obj is not shown") && !says(&window, "a.obj and 1 more is"),
        "{:?}",
        said(&window)
    );
    drop(window);
    let empty = folder.path().join("empty");
    fs::create_dir(&empty).expect("a folder in it");
    let mut viewer = viewer("", &files[..1]);
    let mut window = open(&mut viewer, SMALL);
    window.drop_files(&[empty]);
    loaded(&mut window);
    assert!(says(&window, "empty is not shown") && !says(&window, "a.obj is not"), "{:?}", said(&window));
}

#[test]
fn title_counter_and_model_agree_beside_a_file_that_is_not_shown() {
    let folder = tempfile::tempdir().expect("a folder");
    let files = [("a.obj", OBJ), ("b.obj", "v 0"), ("c.obj", OBJ)];
    let files = files.map(|(name, contents)| written(folder.path(), name, contents));
    let mut viewer = viewer("--filename", &files);
    let mut window = open(&mut viewer, SMALL);
    let state = |window: &HeadlessWindow<'_>, counter: &str, title: &str| {
        assert!(says(window, counter), "{counter}: {:?}", said(window));
        assert_eq!(window.stage().title(), format!("{title} - trigon"), "{counter}");
    };
    state(&window, "(1/3) a.obj", "a.obj");
    key(&mut window, "Right");
    loaded(&mut window);
    state(&window, "(1/3) a.obj", "a.obj");
    assert!(says(&window, "b.obj is not shown"), "{:?}", said(&window));
    key(&mut window, "Right");
    loaded(&mut window);
    state(&window, "(3/3) c.obj", "c.obj");
    assert!(!says(&window, "is not shown"), "{:?}", said(&window));
    key(&mut window, "Left");
    loaded(&mut window);
    state(&window, "(3/3) c.obj", "c.obj");
    window.drop_files(&[files[0].clone()]);
    loaded(&mut window);
    state(&window, "(3/4) a.obj", "a.obj");
}
