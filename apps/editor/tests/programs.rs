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
    assert!(message.contains("command 2 of 2 (Delete)") && message.contains("edit mode"), "{message}");
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
    let script = write(&folder, "twice.json", TWICE);
    for (name, options, faces) in [
        ("out.obj", &["--up", "+Z"][..], 4),
        ("out.ply", &["--ascii", "--triangulate"], 8),
        ("out.stl", &["--scale", "1000"], 8),
        ("out.off", &["--quiet"], 4),
        ("out.glb", &["--selection-only"], 8),
    ] {
        let output = folder.join(name);
        let mut arguments = vec!["--run".as_ref(), script.as_path(), &model, "--output".as_ref(), &output];
        arguments.extend(options.iter().map(Path::new));
        let done = run(&arguments);
        assert!(done.status.success(), "{name}: {}", String::from_utf8_lossy(&done.stderr));
        let (mut document, _) = Document::open(&output, &LoadOptions::default()).expect("as written");
        let count: usize = document.scene().meshes().iter().map(|(_, asset)| asset.mesh().face_count()).sum();
        assert_eq!(count, faces, "{name}");
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
