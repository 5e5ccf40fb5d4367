//! Selecting by mouse on models that somebody else made: clicks, boxes, circles, lassos, loops, rings and
//! paths, of vertices, edges and faces, visible only and through, each judged by an oracle of rays and
//! polygons. Here on Newell's teapot; `TRIGON_SELECTIONS=FOLDER` does it on the models of a folder instead
//! and tells how many agree.

mod lens;
mod oracle;
mod pixels;
mod session;
mod shape;
mod topology;

use std::path::{Path, PathBuf};

use trigon_window::scene::camera::Viewport;

use super::sessions::at_the_editor;
use session::select_everywhere;

/// Small, so that all of it is drawn soon.
const SIZE: Viewport = Viewport { width: 640, height: 480 };

/// Whether elements were selected as the rule says.
#[derive(Debug, Default)]
struct Tally {
    selections: usize,
    agreed: usize,
    /// Left to roundings.
    open: usize,
    wrong: Vec<String>,
}

/// Opens a model, or adds the teapot, and selects on it.
fn of_model(file: Option<&Path>) -> Result<Tally, String> {
    let folder = tempfile::tempdir().expect("a folder");
    let files: Vec<PathBuf> = file.map(Path::to_owned).into_iter().collect();
    let mut result = Err("it was not opened".into());
    at_the_editor(folder.path(), &files, SIZE, |user| {
        if files.is_empty() {
            user.play("keys X Shift+A\npress Teapot\npress Show\nenter Subdivisions 4");
        }
        while user.editor.borrow().loading.is_some() {
            user.window.wait();
        }
        result = select_everywhere(user);
    });
    result
}

/// The models of a folder and those within it, in order.
fn models(folder: &Path) -> Vec<PathBuf> {
    let entries =
        std::fs::read_dir(folder).map(|entries| entries.flatten().map(|entry| entry.path()).collect());
    let mut entries: Vec<PathBuf> = entries.unwrap_or_default();
    entries.sort();
    let is_model = |path: &PathBuf| {
        let ending = path.extension().and_then(|ending| ending.to_str());
        ending.is_some_and(|ending| ["obj", "glb", "gltf", "ply", "stl", "off", "3mf"].contains(&ending))
    };
    entries
        .into_iter()
        .flat_map(|path| if path.is_dir() { models(&path) } else { vec![path] })
        .filter(is_model)
        .collect()
}

#[test]
fn selecting_by_mouse_gives_what_rays_say() {
    let Some(folder) = std::env::var_os("TRIGON_SELECTIONS") else {
        let tally = of_model(None).expect("the teapot is opaque");
        assert_eq!(tally.wrong, [""; 0], "{tally:?}");
        assert!(tally.selections > 80 && tally.agreed > 1000, "{tally:?}");
        // This oracle does not know the rasterizer's grid: more is open than with one that does.
        assert!(tally.open * 50 <= tally.agreed, "{tally:?}");
        return;
    };
    let (mut wrong, mut judged) = (0, 0);
    for model in models(Path::new(&folder)) {
        match of_model(Some(&model)) {
            Ok(Tally { selections, agreed, open, wrong: differ }) => {
                judged += 1;
                wrong += differ.len();
                println!(
                    "{}: {selections} selections, {agreed} elements agree, {open} open",
                    model.display()
                );
                differ.iter().for_each(|what| println!("    differs: {what}"));
            }
            Err(reason) => println!("{}: left out, {reason}", model.display()),
        }
    }
    println!("{judged} models, {wrong} selections differ");
    assert_eq!(wrong, 0, "selections differ");
}
