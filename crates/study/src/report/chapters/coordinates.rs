//! How far from the origin may a model be?

use super::*;
use crate::coordinates::{Coordinates, POINTS};

const ERROR: &str = "worst error, pixels";
const TIME: &str = "ns per point";

pub(super) fn measure(effort: Effort) -> Chapter {
    let offsets = [1.0, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7];
    /// The number of runs over all points, so that a measurement takes some tenths of a millisecond.
    const RUNS: usize = 100;
    let times = nanoseconds(effort.rounds(), &Coordinates::ALL, |way| -> Box<dyn FnMut()> {
        let mut place = way.repeated(1e3);
        Box::new(move || (0..RUNS).for_each(|_| place()))
    });
    let row = |offset: f64, (way, time): (Coordinates, &Spread)| {
        let row = Row::new(case(offset), way.name()).with(ERROR, way.worst_error(offset));
        row.timed(TIME, time.per(RUNS * POINTS))
    };
    let rows: Vec<Row> = offsets
        .iter()
        .flat_map(|&offset| Coordinates::ALL.into_iter().zip(&times).map(move |way| row(offset, way)))
        .collect();
    let line = |way: Coordinates| {
        (way.name().to_owned(), offsets.map(|offset| [offset, way.worst_error(offset)]).to_vec())
    };
    let axes = ["metres from the origin, on each axis", ERROR];
    let plot =
        Plot::growth("distance", "Where points land on the image", axes, Coordinates::ALL.map(line).to_vec());
    Chapter {
        name: "coordinates",
        title: "How far from the origin may a model be?",
        text: "Points three metres before a camera, in an image with 1,000 pixels to the metre at one metre's distance. Times \
               are of a node of 1,000 points, its matrix included, a kilometre away: they do not depend on the place.",
        findings: Vec::new(),
        plots: vec![plot],
        images: Vec::new(),
        rows,
    }
}

fn case(offset: f64) -> String {
    format!("{offset} m away")
}

pub(super) fn headlines() -> Vec<Headline> {
    let [world, relative] = Coordinates::ALL.map(Coordinates::name);
    let at = |offset: f64| Headline::within(case(offset), [world, relative], [TIME, ERROR]);
    vec![
        at(1e3),
        at(1e6).meaning("The engine composes its matrices relative to the camera: three subtractions in `f64` for a node."),
    ]
}
