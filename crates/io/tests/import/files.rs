//! Models whose files are in memory: the same as from the disk.

use std::collections::BTreeMap;
use std::fs;

use trigon_io::{Limits, LoadErrorKind, LoadOptions, Loaded, load, load_from_files};

/// A model in a folder that names files in it, beside it and out of it, not all as they are spelled.
const FILES: [(&str, &str); 5] = [
    (
        "bag/model.obj",
        "mtllib Parts/red.MTL\nmtllib ../blue.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n",
    ),
    (
        "bag/parts/red.mtl",
        "newmtl red\nKd 1 0 0\nmap_Kd C:\\work\\wood.png\nmap_d gone.png\nmap_Ke bad.png\n",
    ),
    ("bag/parts/bad.png", "no image"),
    ("blue.mtl", "newmtl red\nKd 0 0 1\n"),
    ("bag/unused.txt", ""),
];

fn files() -> BTreeMap<String, Vec<u8>> {
    FILES.into_iter().map(|(path, text)| (path.to_owned(), text.as_bytes().to_vec())).collect()
}

/// What was read and what was warned of, with paths from a common folder.
fn told(loaded: &Loaded, folder: &str) -> Vec<String> {
    let read = loaded.files.iter().map(|file| file.display().to_string());
    let all = read.chain(loaded.warnings.iter().map(ToString::to_string));
    all.map(|text| text.replace(folder, "")).collect()
}

#[test]
fn files_in_memory_are_found_as_on_the_disk() {
    let dir = tempfile::tempdir().expect("a temporary folder");
    for (path, text) in FILES {
        let path = dir.path().join(path);
        fs::create_dir_all(path.parent().expect("below the folder")).expect("a folder");
        fs::write(path, text).expect("a file");
    }
    let options = LoadOptions::default();
    let on_disk = load(dir.path().join("bag/model.obj"), &options).expect("it loads");
    let in_memory = load_from_files("bag/model.obj", files(), &options).expect("it loads");
    let on_disk = told(&on_disk, &format!("{}/", dir.path().display()));
    assert_eq!(told(&in_memory, "\0"), on_disk, "the same files and warnings");
    assert!(on_disk.contains(&"bag/parts/red.mtl".to_owned()), "in another spelling: {on_disk:?}");
    assert!(!on_disk.contains(&"blue.mtl".to_owned()), "not out of the folder: {on_disk:?}");
}

#[test]
fn a_model_that_is_not_among_the_files_or_is_too_large_is_refused() {
    let options = LoadOptions::default();
    let error = load_from_files("model.obj", files(), &options).expect_err("it is in a folder");
    assert_eq!((error.kind, error.file.to_str()), (LoadErrorKind::Read, Some("model.obj")), "{error}");
    let limits = Limits { file_bytes: 20, ..Limits::default() };
    let options = LoadOptions { limits, ..LoadOptions::default() };
    let error = load_from_files("bag/model.obj", files(), &options).expect_err("it has more");
    assert_eq!(error.kind, LoadErrorKind::Limit, "{error}");
}
