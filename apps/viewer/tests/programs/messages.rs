//! Failures and warnings, and the codes of exits.

use std::fs;

use crate::Folder;

#[test]
fn failures_are_one_line_that_names_the_file() {
    let folder = Folder::new();
    folder.write("empty.obj", "");
    folder.write("model.stl", "solid x\nendsolid x\n");
    folder.write("model.fbx", "Kaydara FBX Binary");
    folder.write("broken.gltf", "{ \"asset\": ");
    for (flags, words) in [
        ("missing.obj --output o.png", ["missing.obj", "check the name"]),
        ("empty.obj --output o.png", ["empty.obj", "nothing to draw"]),
        ("model.stl --output o.png", ["model.stl", "nothing to draw"]),
        ("model.fbx --output o.png", ["model.fbx", "supported"]),
        ("broken.gltf --output o.png", ["broken.gltf", ""]),
        (
            "corner.obj --output no/such/folder/o.png",
            ["no/such/folder/o.png", "no/such/folder does not exist"],
        ),
        ("corner.obj --output o.png --max-size=0.00001", ["corner.obj", "--max-size"]),
        ("corner.obj --output o.png --camera-index=0", ["--camera-index=0", "no camera"]),
    ] {
        let said = folder.failed(flags);
        assert!(words.iter().all(|word| said.contains(word)), "`{flags}`: {said}");
    }
    assert!(!folder.path("o.png").exists(), "no image of a failure");
}

#[test]
fn warnings_are_lines_and_can_be_silenced() {
    let folder = Folder::new();
    fs::remove_file(folder.path("corner.mtl")).expect("it was there");
    let said = folder.said("corner.obj --output o.png --resolution 20,20", 0);
    let warning = said.lines().next().expect("a line");
    assert!(warning.starts_with("trigon-viewer: warning: ") && warning.contains("corner.mtl"), "{said}");
    let said = folder.said("corner.obj --output o.png --resolution 20,20 --verbose=error", 0);
    assert_eq!(said, "", "silenced");
    let said = folder.said("missing.obj --output o.png --verbose=quiet", 1);
    assert_eq!(said, "", "the exit code has to do");
    let said = folder.said("corner.obj --output o.png --resolution 20,20 --raytracing", 0);
    assert!(said.contains("--raytracing is ignored"), "a flag of a GPU: {said}");
}

#[test]
fn an_image_that_shows_nothing_of_the_model_says_so() {
    let folder = Folder::new();
    let away = "--camera-position 9,9,9 --camera-focal-point 20,20,20 --output o.png --resolution 20,20";
    let said = folder.said(&format!("corner.obj {away}"), 0);
    assert!(said.contains("the model is not in view"), "{said}");
}

/// A level that only other processors have.
const ELSEWHERE: &str = if cfg!(target_arch = "aarch64") { "--simd=sse2" } else { "--simd=neon" };

#[test]
fn a_senseless_command_line_exits_with_2() {
    let folder = Folder::new();
    for (flags, words) in [
        ("--resolutoin 10,10", "--resolution"),
        ("--resolution 0,10", "1 to 16384"),
        ("--output o.tiff", ".png"),
        ("--outputs depth corner.obj", "--output"),
        ("--output - --outputs depth corner.obj", "standard output"),
        ("--output o.exr --outputs depth.png corner.obj", "without an ending"),
        ("--output o.png --outputs dept corner.obj", "triangle-ids"),
        ("--camera-position 1,2,3 --camera-focal-point 1,2,3 --output o.png", "same point"),
        ("corner.obj --camera-position 0.5,0.5,0.5 --output o.png", "view direction is undefined"),
        ("--background-color=blurple", "CSS name"),
        ("--simd=mmx", "mmx is not available here; write one of"),
        (ELSEWHERE, "is not available here; write one of"),
    ] {
        let said = folder.said(flags, 2);
        assert!(said.contains(words), "`{flags}`: {said}");
    }
}

#[test]
fn without_a_display_the_message_says_how_to_get_an_image() {
    let folder = Folder::new();
    let said = folder.failed("corner.obj");
    assert!(said.contains("--output image.png"), "the remedy: {said}");
}
