//! How far from the origin may a model be?

use super::*;
use crate::coordinates::Coordinates;

const ERROR: &str = "worst error, pixels";

pub(super) fn measure(_: Effort) -> Chapter {
    let offsets = [1.0, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7];
    let rows: Vec<Row> = offsets
        .iter()
        .flat_map(|&offset| {
            Coordinates::ALL
                .map(|way| Row::new(case(offset), way.name()).with(ERROR, way.worst_error(offset)))
        })
        .collect();
    let line = |way: Coordinates| {
        (way.name().to_owned(), offsets.map(|offset| [offset, way.worst_error(offset)]).to_vec())
    };
    let axes = ["metres from the origin, on each axis", ERROR];
    let plot = Plot::growth(
        "distance",
        "Where points land on the picture",
        axes,
        Coordinates::ALL.map(line).to_vec(),
    );
    let world = |offset: f64| number(value(&rows, &case(offset), Coordinates::World.name(), ERROR));
    let relative = number(value(&rows, &case(1e7), Coordinates::CameraRelative.name(), ERROR));
    let finding = format!(
        "World coordinates in `f32` are {} pixels wrong a kilometre from the origin and {} at a thousand; with the camera \
         subtracted in `f64` first, {relative} at any distance, for three subtractions a node (the engine's matrices are composed \
         so).",
        world(1e3),
        world(1e6),
    );
    Chapter {
        name: "coordinates",
        title: "How far from the origin may a model be?",
        text: "Points three metres before a camera, in a picture with 1,000 pixels to the metre at one metre's distance.",
        findings: vec![finding],
        plots: vec![plot],
        pictures: Vec::new(),
        rows,
    }
}

fn case(offset: f64) -> String {
    format!("{offset} m away")
}
