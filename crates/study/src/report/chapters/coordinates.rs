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
    Chapter {
        name: "coordinates",
        title: "How far from the origin may a model be?",
        text: "Points three metres before a camera, in a picture with 1,000 pixels to the metre at one metre's distance.",
        findings: Vec::new(),
        plots: vec![plot],
        pictures: Vec::new(),
        rows,
    }
}

fn case(offset: f64) -> String {
    format!("{offset} m away")
}

pub(super) fn headlines() -> Vec<Headline> {
    let [world, relative] = Coordinates::ALL.map(Coordinates::name);
    let at = |offset: f64| Headline::within(case(offset), [world, relative], [ERROR]);
    vec![
        at(1e3),
        at(1e6).meaning("The engine composes its matrices relative to the camera: three subtractions in `f64` for a node."),
    ]
}
