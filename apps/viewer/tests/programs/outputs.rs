//! Outputs that are inputs, full devices, and programs that are told to end.

use std::fs;
use std::path::Path;

use crate::Folder;

/// A folder whose model has a texture.
fn textured() -> Folder {
    let folder = Folder::new();
    folder.write("corner.mtl", "newmtl red\nKd 1 1 1\nmap_Kd tex.png\n");
    for name in ["tex.png", "other.png", "out.depth.png"] {
        trigon_io::write_png(folder.path(name), 1, 1, trigon_io::Pixels::Rgb8(&[255, 0, 0]))
            .expect("written");
    }
    folder.write("state.json", r#"{"format": "trigon state 1", "files": ["corner.obj"], "options": {}}"#);
    folder.write("config.json", "[]");
    folder.write("script.txt", "set_camera front\n");
    folder
}

/// All files of a folder with their contents.
fn contents(folder: &Folder) -> Vec<(std::ffi::OsString, Vec<u8>)> {
    let entries = fs::read_dir(folder.path("")).expect("a folder").map(|entry| entry.expect("an entry"));
    let files = entries.filter(|entry| entry.path().is_file());
    let mut files: Vec<_> =
        files.map(|entry| (entry.file_name(), fs::read(entry.path()).expect("a file"))).collect();
    files.sort();
    files
}

#[cfg(unix)]
#[test]
fn no_file_that_is_read_is_overwritten() {
    use std::os::unix::fs::symlink;
    let folder = textured();
    fs::create_dir(folder.path("sub")).expect("a folder");
    folder.said("corner.obj --output first.png --capture a.trigon --resolution 40,30", 0);
    for (link, target) in [
        ("model.png", "corner.obj"),
        ("mtl.png", "corner.mtl"),
        ("state.png", "state.json"),
        ("config.png", "config.json"),
        ("script.png", "script.txt"),
        ("capture.png", "a.trigon"),
        ("link.png", "tex.png"),
        ("link.gif", "tex.png"),
    ] {
        symlink(target, folder.path(link)).expect("a link");
    }
    fs::hard_link(folder.path("tex.png"), folder.path("second.png")).expect("a second name");
    folder.write("other.obj", crate::CORNER);
    let before = contents(&folder);
    let small = "--resolution 40,30";
    for (flags, output) in [
        ("corner.obj --output tex.png", "tex.png"),
        ("corner.obj --output link.png", "link.png"),
        ("corner.obj --output second.png", "second.png"),
        ("corner.obj --output sub/../tex.png", "sub/../tex.png"),
        ("corner.obj --output model.png", "model.png"),
        ("corner.obj --output mtl.png", "mtl.png"),
        (
            "corner.obj --texture-base-color out.depth.png --outputs depth.png --output out.png",
            "out.depth.png",
        ),
        ("corner.obj --texture-base-color other.png --output other.png", "other.png"),
        ("corner.obj --reference first.png --reference-threshold 0 --edges --output first.png", "first.png"),
        ("--statefile state.json --output state.png", "state.png"),
        ("corner.obj --config config.json --output config.png", "config.png"),
        ("corner.obj --command-script script.txt --output script.png", "script.png"),
        ("--replay a.trigon --output capture.png", "capture.png"),
        ("corner.obj --capture corner.obj", "corner.obj"),
        ("corner.obj --compare other.obj --output link.png", "link.png"),
        ("corner.obj --turntable 2 --output link.gif", "link.gif"),
    ] {
        let said = folder.said(&format!("{flags} {small}"), 2);
        let expected = format!("{output}: is read by this very command");
        assert!(said.contains(&expected), "`{flags}` said: {said}");
        // The image beside which an output would be written is there.
        let _ = fs::remove_file(folder.path("out.png"));
        assert!(contents(&folder) == before, "`{flags}` changed a file");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn full_devices_are_errors_everywhere() {
    use std::process::Stdio;
    let folder = Folder::new();
    for flags in [
        "--help",
        "--help=all",
        "--version",
        "--list-readers",
        "--list-rendering-backends",
        "corner.obj --no-render",
        "corner.obj --no-render --json",
        "corner.obj --explain",
        "corner.obj --explain-pixel 3,3 --resolution 9,9",
        "corner.obj --check",
        "corner.obj --check --json",
        "corner.obj --output - --resolution 9,9",
        "corner.obj --output out.png --resolution 9,9 --json",
        "corner.obj --compare corner.obj --output out.png --resolution 9,9 --json",
    ] {
        let full = fs::File::options().write(true).open("/dev/full").expect("Linux has it");
        let mut command = folder.command(flags);
        let output = command.stdout(full).stderr(Stdio::piped()).output().expect("the viewer starts");
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "`{flags}` said: {said}");
        assert!(said.contains("No space left on device"), "`{flags}` said: {said}");
    }
    std::os::unix::fs::symlink("/dev/full", folder.path("full.png")).expect("a link");
    let said = folder.failed("corner.obj --output full.png --resolution 9,9");
    assert!(said.contains("full.png: cannot be written (No space left on device"), "{said}");
    assert!(!Path::new("/dev/full").is_file(), "the device is what it was");
}

/// The files of a folder that are not finished.
#[cfg(unix)]
fn unfinished(folder: &Folder) -> usize {
    let names = fs::read_dir(folder.path("")).expect("a folder");
    let names = names.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned());
    names.filter(|name| name.ends_with(".part")).count()
}

#[cfg(unix)]
#[test]
fn whoever_is_told_to_end_leaves_no_temporary_file() {
    use std::os::unix::process::ExitStatusExt;
    use std::process::Command;
    let folder = Folder::new();
    for (name, number) in [("INT", 2), ("TERM", 15)] {
        let flags = "corner.obj --turntable=2000 --resolution 400,300 --output turn.gif";
        let mut child = folder.command(flags).spawn().expect("the viewer starts");
        while unfinished(&folder) == 0 {
            assert_eq!(child.try_wait().expect("a child"), None, "it takes longer than to look at a folder");
            std::thread::yield_now();
        }
        let sent = Command::new("kill").args([format!("-{name}"), child.id().to_string()]).status();
        assert!(sent.expect("there is `kill`").success(), "SIG{name} is sent");
        // A shell adds 128: 130 and 143.
        assert_eq!(child.wait().expect("a child").signal(), Some(number), "SIG{name}");
        assert_eq!(unfinished(&folder), 0, "SIG{name}");
        assert!(!folder.path("turn.gif").exists(), "SIG{name}: nothing is half done");
    }
}
