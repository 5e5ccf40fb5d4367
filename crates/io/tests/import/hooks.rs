//! Limits, progress and cancelling.

use std::ops::ControlFlow;
use std::sync::Mutex;

use trigon_io::{Format, Limits, LoadErrorKind, LoadOptions, LoadStage, load, load_from_slice, readers};

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
    assert_eq!(seen.last(), Some(&(LoadStage::Textures, 1.0)), "to the end");
}

#[test]
fn a_load_can_be_cancelled() {
    let hook = |progress: trigon_io::Progress| {
        if progress.stage == LoadStage::Geometry { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let options = LoadOptions { progress: Some(&hook), ..LoadOptions::default() };
    let error = load_from_slice("a.obj", grid(10).as_bytes(), &options).map(|_| ()).expect_err("cancelled");
    assert_eq!(error.kind, LoadErrorKind::Cancelled, "{error}");
}

/// Half a second and more passed in which a gigabyte of geometry could not be cancelled.
#[test]
fn building_a_mesh_can_be_cancelled_as_reading_it_can() {
    // More faces than are built between two questions, in two smoothing groups.
    let text = grid(370).replacen("f ", "s 1\nf ", 1) + "s 2\nf 1 2 3\n";
    let calls = Mutex::new(Vec::new());
    let load = |last: usize| {
        calls.lock().expect("no panic").clear();
        let hook = |progress: trigon_io::Progress| {
            let mut calls = calls.lock().expect("no panic");
            calls.push(progress.fraction);
            if calls.len() < last { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        };
        let options = LoadOptions { progress: Some(&hook), ..LoadOptions::default() };
        let result = load_from_slice("a.obj", text.as_bytes(), &options).map(drop);
        (result.map_err(|error| error.kind), calls.lock().expect("no panic").clone())
    };
    let (loaded, all) = load(usize::MAX);
    assert_eq!(loaded, Ok(()), "nobody objects");
    // Reading ends at 0.1 + 0.6 · 0.75. Then: three times for what is found out before, once
    // among the faces, twice for the mesh, twice in each of two loops for the normals,
    // and at the ends of geometry and textures.
    let building = all.iter().filter(|&&fraction| fraction > 0.549).count();
    assert!(building >= 3 + 1 + 2 + 4 + 2, "{building} questions: {all:?}");
    for call in [all.len() - building + 1, all.len() - 6, all.len() - 2] {
        let (loaded, calls) = load(call);
        assert_eq!(loaded, Err(LoadErrorKind::Cancelled), "question {call} of {}", all.len());
        assert_eq!(calls.len(), call, "and not asked again");
    }
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
    for name in ["a.fbx", "a.txt"] {
        let message = load_from_slice(name, b"solid x", &LoadOptions::default())
            .map(|_| ())
            .expect_err("not supported")
            .to_string();
        assert!(message.contains(".obj, .gltf, .glb"), "{message} names what is supported");
    }
}

#[test]
fn every_format_is_found_by_its_extensions() {
    for reader in readers() {
        for extension in reader.extensions {
            assert_eq!(Format::from_extension(extension), Some(reader.format), "{extension}");
        }
    }
    assert!(readers().len() >= 6, "OBJ, glTF, GLB, PLY, STL and OFF at least");
}
