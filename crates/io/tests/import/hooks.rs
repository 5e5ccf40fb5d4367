//! Limits, progress and cancelling.

use std::ops::ControlFlow;
use std::sync::Mutex;

use trigon_io::{Format, Limits, LoadErrorKind, LoadOptions, Stage, load, load_from_slice, readers};

fn grid(side: usize) -> String {
    let vertices = (0..side * side).map(|index| format!("v {} {} 0\n", index % side, index / side));
    let corner = |x: usize, y: usize| y * side + x + 1;
    let cells = (0..side - 1).flat_map(|y| (0..side - 1).map(move |x| (x, y)));
    let faces = cells.map(|(x, y)| {
        format!("f {} {} {} {}\n", corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1))
    });
    vertices.chain(faces).collect()
}

#[test]
fn progress_goes_forward_to_the_end() {
    let seen = Mutex::new(Vec::new());
    let hook = |progress: trigon_io::Progress| {
        seen.lock().expect("no panic").push((progress.stage, progress.fraction));
        ControlFlow::Continue(())
    };
    let options = LoadOptions { progress: Some(&hook), ..LoadOptions::default() };
    load_from_slice("a.obj", grid(100).as_bytes(), &options).expect("a grid");
    let seen = seen.into_inner().expect("no panic");
    assert!(seen.len() > 3, "called now and then: {seen:?}");
    assert!(seen.windows(2).all(|pair| pair[0].1 <= pair[1].1), "never back: {seen:?}");
    assert_eq!(seen.last(), Some(&(Stage::Textures, 1.0)), "to the end");
}

#[test]
fn a_load_can_be_cancelled() {
    let hook = |progress: trigon_io::Progress| {
        if progress.stage == Stage::Geometry { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let options = LoadOptions { progress: Some(&hook), ..LoadOptions::default() };
    let error = load_from_slice("a.obj", grid(10).as_bytes(), &options).map(|_| ()).expect_err("cancelled");
    assert_eq!(error.kind, LoadErrorKind::Cancelled, "{error}");
}

#[test]
fn every_limit_holds() {
    let text = grid(10);
    let small = [
        Limits { file_bytes: 100, ..Limits::default() },
        Limits { nodes: 0, ..Limits::default() },
        Limits { vertices: 99, ..Limits::default() },
        Limits { corners: 4 * 81 - 1, ..Limits::default() },
    ];
    for limits in small {
        let options = LoadOptions { limits, ..LoadOptions::default() };
        let error = load_from_slice("a.obj", text.as_bytes(), &options).map(|_| ()).expect_err("too much");
        assert_eq!(error.kind, LoadErrorKind::Limit, "{error}");
    }
}

#[test]
fn files_that_are_none_say_so() {
    let dir = tempfile::tempdir().expect("a folder");
    for (path, word) in [(dir.path().join("gone.obj"), "no such file"), (dir.path().to_owned(), "folder")] {
        let message = load(&path, &LoadOptions::default()).map(|_| ()).expect_err("no file").to_string();
        assert!(message.contains(word), "{message}");
    }
    for name in ["a.stl", "a.txt"] {
        let message = load_from_slice(name, b"solid x", &LoadOptions::default())
            .map(|_| ())
            .expect_err("not supported")
            .to_string();
        assert!(message.contains(".obj, .gltf, .glb"), "{message} names what is supported");
    }
}

#[test]
fn the_list_of_readers_is_what_is_read() {
    let formats: Vec<Format> = readers().iter().map(|reader| reader.format).collect();
    assert_eq!(formats, [Format::Obj, Format::Gltf, Format::Glb], "in this order");
}
