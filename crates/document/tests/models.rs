//! Models that scripts make: a chair, and a mug that holds what its drawing says.

use std::f64::consts::PI;
use std::fs;
use std::path::Path;

use trigon_document::mesh::Mesh;
use trigon_document::mesh::math::elementary;
use trigon_document::{Document, Script};

/// The mesh that a script of `docs/models` makes.
fn modelled(script: &str) -> Mesh {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/models").join(script);
    let script = Script::from_json(&fs::read_to_string(path).expect("a file")).expect("a script");
    let mut document = Document::default();
    script.run(&mut document, |_| {}).expect("every command is possible");
    let (_, asset) = document.scene().meshes().iter().next().expect("it makes one object");
    asset.mesh().clone()
}

#[test]
fn the_mug_is_closed_has_a_handle_and_the_volume_of_its_drawing() {
    let mug = modelled("mug.json");
    assert!(mug.is_closed(), "it holds water");
    // 2 − 2·genus: one handle.
    assert_eq!(mug.euler_characteristic(), 0, "one handle");
    let (radius, height, wall, floor) = (0.04, 0.1, 0.004, 0.005_f64);
    let inner: f64 = radius - wall;
    let body = PI * radius * radius * height - PI * inner * inner * (height - floor);
    // Four sides of the cylinder wide.
    let width = 2.0 * radius * elementary::sin(PI / 16.0);
    let arms = 2.0 * width * 0.01 * 0.03;
    let grip = width * 0.01 * 0.04;
    let drawn = body + arms + grip;
    let share = mug.volume() / drawn;
    assert!((share - 1.0).abs() < 0.01, "{:.3e} m³ of {drawn:.3e}: {share}", mug.volume());
}

#[test]
fn the_chair_is_closed_and_stands_on_four_legs() {
    let chair = modelled("chair.json");
    assert!(chair.is_closed(), "a solid");
    assert_eq!(chair.euler_characteristic(), 0, "a back with one opening");
    assert!(chair.volume() > 0.0, "its outside is outside");
    let bounds = chair.bounds();
    assert!(bounds.min.y.abs() < 0.01, "it stands on the floor: {}", bounds.min.y);
    let lowest = chair.positions().iter().filter(|p| f64::from(p.y) < bounds.min.y + 1e-6);
    let (mut left, mut right, mut front, mut back) = (0, 0, 0, 0);
    for place in lowest {
        *(if place.x < 0.0 { &mut left } else { &mut right }) += 1;
        *(if place.z < 0.0 { &mut back } else { &mut front }) += 1;
    }
    assert!(left > 0 && left == right && front == back, "four legs: {left} {right} {front} {back}");
}
