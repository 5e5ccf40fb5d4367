//! The program as a user starts it.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use trigon_document::Document;
use trigon_io::LoadOptions;

fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("trigon-editor-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a temporary folder");
    folder
}

fn run(arguments: &[&Path]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trigon-editor"));
    command.args(arguments).output().expect("the program starts")
}

fn write(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, text).expect("a file");
    path
}

const TWICE: &str = r#"{ "version": 1, "commands": [
    { "op": "select_all" }, { "op": "edit_objects" },
    { "op": "catmull_clark" }
] }"#;

#[test]
fn a_script_edits_a_file_and_the_old_result_is_kept() {
    let folder = folder("edits");
    let model = write(&folder, "square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    let script = write(&folder, "twice.json", TWICE);
    let (output, backup) = (folder.join("out.glb"), folder.join("out.glb.bak"));
    let arguments = ["--run".as_ref(), script.as_path(), &model, "--output".as_ref(), &output];
    let done = run(&arguments);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let first = std::fs::read(&output).expect("written");
    let faces = |path: &Path| {
        let (mut document, _) = Document::open(path, &LoadOptions::default()).expect("as written");
        let meshes = document.scene().meshes().iter().map(|(_, asset)| asset.mesh().face_count());
        meshes.sum::<usize>()
    };
    assert_eq!(faces(&output), 4, "one square became four");

    // Its own result again: polygons come back as polygons.
    let again = run(&["--run".as_ref(), &script, &output, "--output".as_ref(), &output]);
    assert!(again.status.success(), "{}", String::from_utf8_lossy(&again.stderr));
    assert_eq!(faces(&output), 16, "four became sixteen");
    assert_eq!(std::fs::read(&backup).expect("kept"), first, "the one before");
    std::fs::remove_dir_all(&folder).expect("it was made above");
}

#[test]
fn a_script_that_fails_writes_nothing_and_says_where() {
    let folder = folder("fails");
    let script = write(
        &folder,
        "wrong.json",
        r#"{ "version": 1, "commands": [ { "op": "select_all" }, { "op": "delete" } ] }"#,
    );
    let output = write(&folder, "out.glb", "what was there");
    let failed = run(&["--run".as_ref(), &script, "--output".as_ref(), &output]);
    assert_eq!(failed.status.code(), Some(1), "it failed");
    let message = String::from_utf8_lossy(&failed.stderr).into_owned();
    assert!(
        message.contains("wrong.json, command 2 of 2 (Delete)") && message.contains("edit mode"),
        "{message}"
    );
    assert_eq!(std::fs::read(&output).expect("kept"), b"what was there", "untouched");
    std::fs::remove_dir_all(&folder).expect("it was made above");
}

#[test]
fn the_commands_are_told() {
    let told = run(&["--list-commands".as_ref()]);
    let text = String::from_utf8(told.stdout).expect("text");
    assert!(told.status.success() && text.contains("## `catmull_clark`"), "{text}");
}

#[test]
fn the_ending_of_the_output_chooses_its_format() {
    let folder = folder("formats");
    let model = write(&folder, "square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    // Four faces, and as many by a modifier.
    let array = r#", { "op": "leave_edit_mode" },
    { "op": "add_modifier", "modifier": { "kind": "array", "count": 2 } }
]"#;
    let script = write(&folder, "twice.json", &TWICE.replace("\n]", array));
    for (name, options, faces) in [
        ("out.obj", &["--up", "+Z"][..], 8),
        ("out.ply", &["--ascii", "--triangulate"], 16),
        ("out.stl", &["--scale", "1000"], 16),
        ("out.off", &["--quiet"], 8),
        ("out.glb", &["--selection-only"], 16),
        ("edited.off", &["--no-modifiers"], 4),
        ("out.3mf", &["--scale", "1000"], 16),
    ] {
        let output = folder.join(name);
        let mut arguments = vec!["--run".as_ref(), script.as_path(), &model, "--output".as_ref(), &output];
        arguments.extend(options.iter().map(Path::new));
        let done = run(&arguments);
        assert!(done.status.success(), "{name}: {}", String::from_utf8_lossy(&done.stderr));
        let (mut document, _) = Document::open(&output, &LoadOptions::default()).expect("as written");
        let count: usize = document.scene().meshes().iter().map(|(_, asset)| asset.mesh().face_count()).sum();
        assert_eq!(count, faces, "{name}");
        if name == "out.3mf" {
            let told = String::from_utf8_lossy(&done.stderr);
            assert!(told.contains("--scale is left out"), "{told}");
            let size = document.scene().bounds().size();
            assert!((size.max_element() - 2.0).abs() < 1e-6, "two squares of 1 m in a row: {size}");
        }
    }
    let refused = run(&["--run".as_ref(), &script, &model, "--output".as_ref(), &folder.join("out.fbx")]);
    let message = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(message.contains(".obj, .glb, .ply, .stl, .off"), "{message}");
    std::fs::remove_dir_all(&folder).expect("it was made above");
}

/// The file that is edited may be replaced: a backup of it stays. Nothing else that is read may.
#[cfg(unix)]
#[test]
fn a_script_is_not_replaced_by_its_result() {
    let folder = folder("script");
    let script = write(&folder, "twice.json", TWICE);
    let link = folder.join("out.glb");
    std::os::unix::fs::symlink("twice.json", &link).expect("a link");
    let refused = run(&["--run".as_ref(), &script, "--output".as_ref(), &link]);
    assert_eq!(refused.status.code(), Some(1), "it is the script");
    let message = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(message.contains("out.glb: is the script itself"), "{message}");
    assert_eq!(std::fs::read_to_string(&script).expect("there"), TWICE, "untouched");
    std::fs::remove_dir_all(&folder).expect("it was made above");
}

#[cfg(target_os = "linux")]
#[test]
fn full_devices_are_errors() {
    for flag in ["--list-commands", "--help", "--version"] {
        let full = std::fs::File::options().write(true).open("/dev/full").expect("Linux has it");
        let mut command = Command::new(env!("CARGO_BIN_EXE_trigon-editor"));
        let output = command.arg(flag).stdout(full).output().expect("the program starts");
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{flag}: {said}");
        assert!(said.contains("No space left on device"), "{flag}: {said}");
    }
}

/// The image "b" of a model "m" is exported as "m_b.png", which may be the name of another image.
#[test]
fn no_texture_of_the_document_is_replaced_by_an_export() {
    let folder = folder("textures");
    let model = write(
        &folder,
        "m.obj",
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl one\nf 1/1 2/2 3/3\nusemtl two\nf 3/3 2/2 1/1\n",
    );
    write(&folder, "m.mtl", "newmtl one\nmap_Kd b.png\nnewmtl two\nmap_Kd m_b.png\n");
    for (name, color) in [("b.png", [255, 0, 0]), ("m_b.png", [0, 255, 0])] {
        trigon_io::write_png(folder.join(name), 1, 1, trigon_io::Pixels::Rgb8(&color)).expect("written");
    }
    let script = write(&folder, "nothing.json", r#"{ "version": 1, "commands": [{ "op": "select_all" }] }"#);
    let export = |output: &Path| run(&["--run".as_ref(), &script, &model, "--output".as_ref(), output]);
    let bytes = |name: &str| std::fs::read(folder.join(name)).expect("a file");
    let before = ["m.obj", "m.mtl", "b.png", "m_b.png"].map(bytes);
    let refused = export(&model);
    let message = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(!refused.status.success() && message.contains("m_b.png"), "{message}");
    let again = ["m.obj", "m.mtl", "b.png", "m_b.png"].map(bytes);
    assert!(again == before, "nothing is written");
    let done = export(&folder.join("n.obj"));
    assert!(done.status.success(), "another name: {}", String::from_utf8_lossy(&done.stderr));
    let elsewhere = folder.join("elsewhere");
    std::fs::create_dir_all(&elsewhere).expect("a folder");
    let done = export(&elsewhere.join("m.obj"));
    assert!(done.status.success(), "another folder: {}", String::from_utf8_lossy(&done.stderr));
    std::fs::remove_dir_all(&folder).expect("it was made above");
}

/// Its own file and that file's materials may be written again: both keep a backup.
#[test]
fn a_model_may_be_exported_over_itself() {
    let folder = folder("itself");
    let model = write(&folder, "m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl one\nf 1 2 3\n");
    write(&folder, "m.mtl", "newmtl one\nKd 1 0 0\n");
    let script = write(&folder, "nothing.json", r#"{ "version": 1, "commands": [{ "op": "select_all" }] }"#);
    let done = run(&["--run".as_ref(), &script, &model, "--output".as_ref(), &model]);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let other = write(&folder, "n.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl one\nf 1 2 3\n");
    let refused = run(&["--run".as_ref(), &script, &other, "--output".as_ref(), &model]);
    let message = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(!refused.status.success() && message.contains("m.mtl"), "the library of two models: {message}");
    std::fs::remove_dir_all(&folder).expect("it was made above");
}

/// A link with the ending of a model leads to a texture.
#[cfg(unix)]
#[test]
fn no_texture_is_replaced_through_a_link() {
    let folder = folder("linked");
    let model = write(
        &folder,
        "m.obj",
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl one\nf 1/1 2/2 3/3\n",
    );
    write(&folder, "m.mtl", "newmtl one\nmap_Kd b.png\n");
    trigon_io::write_png(folder.join("b.png"), 1, 1, trigon_io::Pixels::Rgb8(&[9, 9, 9])).expect("written");
    let before = std::fs::read(folder.join("b.png")).expect("a file");
    let script = write(&folder, "nothing.json", r#"{ "version": 1, "commands": [{ "op": "select_all" }] }"#);
    for link in ["link.glb", "link.stl"] {
        let link = folder.join(link);
        std::os::unix::fs::symlink("b.png", &link).expect("a link");
        let refused = run(&["--run".as_ref(), &script, &model, "--output".as_ref(), &link]);
        let message = String::from_utf8_lossy(&refused.stderr).into_owned();
        assert!(!refused.status.success() && message.contains("b.png"), "{message}");
    }
    assert_eq!(std::fs::read(folder.join("b.png")).expect("a file"), before, "as it was");
    std::fs::remove_dir_all(&folder).expect("it was made above");
}
