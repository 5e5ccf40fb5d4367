//! The guided tour of `docs/editor.md`: what it describes is played here, and its images are made here:
//! `TRIGON_UPDATE_GOLDENS=1 cargo test -p trigon-editor --lib the_tour`, then for each `convert x.png -colors 96 PNG8:x.png`.

use std::fs;

use super::*;

/// A chair, as the tour makes it.
const TOUR: &str = "
    hover 0 1 0
    image start
    keys Tab A S Y . 1 Enter
    hover 0 0.1 0.98
    keys 2 Ctrl+R
    wheel 1
    image loop-cut
    click
    right click
    keys S X 2 . 1 Enter
    hover 0.98 0.1 0
    keys Ctrl+R
    wheel 1
    click
    right click
    keys S Z 2 . 1 Enter
    keys 3 Ctrl+Numpad7
    click -0.85 -0.1 -0.85
    click 0.85 -0.1 -0.85 with Shift
    click 0.85 -0.1 0.85 with Shift
    click -0.85 -0.1 0.85 with Shift
    keys Numpad9 Numpad8 Numpad8 Numpad8 Numpad8 Numpad8
    image legs-selected
    keys E 1 . 8 Enter
    keys Numpad7
    click 0 0.1 -0.85
    click -0.85 0.1 -0.85 with Shift
    click 0.85 0.1 -0.85 with Shift
    keys E 2 Enter
    keys Numpad2 Numpad2 Numpad2 Numpad2 Numpad4 Numpad4 Home
    image chair
    keys A Ctrl+2
    image cage
    mesh Cube 56 108 54
";

/// The folder of the guide.
fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs")
}

/// Where the guide's images are.
fn images() -> PathBuf {
    docs().join("images/editor")
}

#[test]
fn the_tour_of_the_guide_is_a_session_with_images() {
    let folder = tempfile::tempdir().expect("a folder");
    at_the_editor(folder.path(), &[], Viewport { width: 960, height: 640 }, |user| {
        user.images = std::env::var_os("TRIGON_UPDATE_GOLDENS").map(|_| images());
        user.play(TOUR);
    });
    let guide = fs::read_to_string(docs().join("editor.md")).expect("the guide");
    let names = TOUR.lines().filter_map(|line| line.trim().strip_prefix("image "));
    for name in names {
        assert!(guide.contains(&format!("(images/editor/{name}.png)")), "the guide shows {name}");
        assert!(images().join(format!("{name}.png")).is_file(), "{name}: TRIGON_UPDATE_GOLDENS=1 makes it");
    }
}
