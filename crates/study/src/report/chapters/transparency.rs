//! In which order are translucent faces laid over each other?

use super::*;
use crate::transparency::Transparency;
use crate::visibility::Case;

const RMSE: &str = "RMSE, linear light";
const WORST: &str = "worst pixel";
const DELTA_E: &str = "mean ΔE";
const TIME: &str = "ms per frame";

pub(super) fn measure(effort: Effort) -> Chapter {
    let mut rows = Vec::new();
    for case in [Case::Balls, Case::Crossing] {
        let scene = &case.scene(effort.pick(128, 256));
        let times = nanoseconds(effort.rounds().div_ceil(2), &Transparency::ALL, |way| -> Box<dyn FnMut()> {
            Box::new(move || drop(way.draw(scene)))
        });
        for (way, time) in Transparency::ALL.into_iter().zip(times) {
            let error = way.error(scene);
            let row = Row::new(case.name(), way.name()).with(RMSE, error.rmse()).with(WORST, error.worst);
            rows.push(row.with(DELTA_E, error.delta_e()).timed(TIME, time.scaled(1e-6)));
        }
    }
    Chapter {
        name: "transparency",
        title: "In which order are translucent faces laid over each other?",
        text: "Bodies whose faces let half of the light through, against fragments sorted in each pixel.",
        findings: findings(&rows),
        plots: vec![Plot::trade("crossing", &rows, Case::Crossing.name(), [TIME, RMSE])],
        pictures: vec![picture()],
        rows,
    }
}

fn picture() -> Picture {
    let scene = Case::Crossing.scene(256);
    let ways = [Transparency::Unsorted, Transparency::ByBody, Transparency::ByFace, Transparency::Engine];
    let panel = |way: Transparency| way.draw(&scene).map(|&light| grey(light));
    Picture::new("order", "Unsorted, sorted by body, sorted by face, the engine", ways.map(panel).to_vec())
}

fn findings(rows: &[Row]) -> Vec<String> {
    let of = |way: Transparency, quantity: &str| value(rows, Case::Crossing.name(), way.name(), quantity);
    vec![format!(
        "Where bodies stick in each other, sorting them leaves a ΔE of {}, sorting faces {}, sorting nothing {}. Sorting \
         fragments takes {} of the time of sorting faces here, the engine {}.",
        number(of(Transparency::ByBody, DELTA_E)),
        number(of(Transparency::ByFace, DELTA_E)),
        number(of(Transparency::Unsorted, DELTA_E)),
        times(of(Transparency::ByFragment, TIME), of(Transparency::ByFace, TIME)),
        times(of(Transparency::Engine, TIME), of(Transparency::ByFace, TIME)),
    )]
}
