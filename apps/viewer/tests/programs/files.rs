//! Several files at once.

use std::fs;

use crate::{CORNER, Folder, image};

#[test]
fn several_files_are_drawn_together_or_under_several_names() {
    let folder = Folder::new();
    folder.write("b.obj", "v 5 0 0\nv 6 0 0\nv 5 1 0\nf 1 2 3\n");
    // The same faces in one file.
    let together = format!("{CORNER}usemtl none\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 8 9 10\n");
    folder.write("together.obj", &together);
    let said = folder.said("corner.obj b.obj --output {model}_{n:2}.png --resolution 20,20", 0);
    assert_eq!(said.lines().count(), 2, "a line each: {said}");
    folder.said("corner.obj b.obj --output all.png --multi-file-mode=all --resolution 20,20", 0);
    for (name, alone) in [("corner_01.png", "corner.obj"), ("b_01.png", "b.obj"), ("all.png", "together.obj")]
    {
        folder.said(&format!("{alone} --output alone.png --resolution 20,20 --verbose=error"), 0);
        assert!(image(&folder.path(name)) == image(&folder.path("alone.png")), "{name} shows {alone}");
    }
    let shows = |name: &str| image(&folder.path(name)).rgba;
    assert!(shows("corner_01.png") != shows("b_01.png") && shows("all.png") != shows("corner_01.png"));

    let said = folder.said("corner.obj b.obj --output one.png", 2);
    assert!(said.contains("{model}") && said.contains("--multi-file-mode=all"), "both remedies: {said}");
    fs::create_dir(folder.path("other")).expect("a folder");
    fs::copy(folder.path("b.obj"), folder.path("other/b.obj")).expect("a copy");
    let said = folder.said("b.obj other/b.obj --output {model}.png --resolution 20,20", 2);
    assert!(said.contains("two images") && said.contains("{n}"), "no image is lost silently: {said}");
}

#[test]
fn one_bad_file_among_several_fails_the_run_but_not_the_others() {
    let folder = Folder::new();
    let said = folder.said("missing.obj corner.obj --output {model}.png --resolution 20,20", 1);
    assert!(said.contains("missing.obj"), "named: {said}");
    assert!(folder.path("corner.png").is_file(), "the good one is drawn");
}
