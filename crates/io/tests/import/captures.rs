//! Captures in `crates/io/tests/captures` are drawn again, to the byte: images that were
//! wrong once, and one that no change of the format may lose.
//!
//! `TRIGON_UPDATE_GOLDENS=1` captures them anew from what they hold: look at the
//! images first (`trigon-viewer --replay FILE --output IMAGE.png`).

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use trigon_io::{Capture, Limits};
use trigon_scene::{RenderSettings, render};

#[test]
fn captures_are_drawn_as_they_were() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/captures");
    let entries = std::fs::read_dir(folder).expect("the folder of captures").flatten();
    let is_capture = |path: &PathBuf| path.extension().is_some_and(|ending| ending == "trigon");
    let files: Vec<PathBuf> = entries.map(|entry| entry.path()).filter(is_capture).collect();
    assert!(!files.is_empty(), "there are captures");
    for file in files {
        let capture = Capture::read(&file, &Limits::default()).unwrap_or_else(|error| panic!("{error}"));
        for threads in [1, 3] {
            let settings = RenderSettings { threads: NonZeroUsize::new(threads), ..capture.settings.clone() };
            let frame = render(&capture.scene, &capture.camera, &settings).expect("in range");
            if std::env::var_os("TRIGON_UPDATE_GOLDENS").is_some() {
                let Capture { scene, camera, settings, .. } = capture.clone();
                Capture::new(scene, camera, settings, &frame).write(&file).expect("the folder is writable");
            } else if let Some(mismatch) = capture.mismatch(&frame) {
                panic!("{}, {threads} threads: {mismatch}", file.display());
            }
        }
    }
}
