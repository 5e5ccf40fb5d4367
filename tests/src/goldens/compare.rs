//! Compares a frame with its golden image, byte for byte.
//!
//! On a difference it writes what was expected, what was drawn and where they
//! differ, and names the files. `TRIGON_UPDATE_GOLDENS=1` writes the goldens
//! anew: look at the difference first.

use std::fs;
use std::path::{Path, PathBuf};

use trigon_io::{Pixels, load_image, write_png};
use trigon_scene::Frame;

/// Asserts that the frame equals `tests/goldens/NAME.png`.
pub(crate) fn assert_golden(name: &str, frame: &Frame) {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("goldens").join(format!("{name}.png"));
    if std::env::var_os("TRIGON_UPDATE_GOLDENS").is_some() {
        write(&golden, frame.width, frame.height, &frame.color);
        return;
    }
    let expected =
        load_image(&golden, &trigon_io::Limits::default()).unwrap_or_else(|error| panic!("{error}"));
    let size = (expected.width, expected.height);
    if size == (frame.width, frame.height) && expected.rgba == frame.color {
        return;
    }
    let report = report_folder(name);
    fs::copy(&golden, report.join("expected.png")).expect("the golden can be copied");
    write(&report.join("actual.png"), frame.width, frame.height, &frame.color);
    let mut message = format!("{name} differs from its golden image; see {}", report.display());
    if size == (frame.width, frame.height) {
        let difference = difference(expected.rgba.as_slice(), &frame.color);
        let count = difference.chunks_exact(4).filter(|pixel| pixel[0] > 0).count();
        write(&report.join("difference.png"), frame.width, frame.height, &difference);
        message.push_str(&format!(" ({count} pixels)"));
    }
    panic!("{message}");
}

fn report_folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("goldens").join(name);
    fs::create_dir_all(&folder).expect("cargo's folder is writable");
    folder
}

fn write(path: &Path, width: u32, height: u32, rgba: &[u8]) {
    write_png(path, width, height, Pixels::Rgba8(rgba)).unwrap_or_else(|error| panic!("{error}"));
}

/// White where the images differ in any channel.
fn difference(expected: &[u8], actual: &[u8]) -> Vec<u8> {
    let pairs = expected.chunks_exact(4).zip(actual.chunks_exact(4));
    pairs.flat_map(|(a, b)| if a == b { [0, 0, 0, 255] } else { [255; 4] }).collect()
}
