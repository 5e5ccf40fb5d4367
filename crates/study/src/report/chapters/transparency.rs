//! In which order are translucent faces blended?

use super::*;
use crate::transparency::{Transparency, exact};
use crate::visibility::VisibilityCase;

const RMSE: &str = "RMSE, linear light";
const WORST: &str = "worst pixel";
const DELTA_E: &str = "mean ΔE";
const TIME: &str = "ms per frame";

pub(super) fn measure(effort: Effort) -> Chapter {
    let side = effort.pick(128, 256);
    let mut rows = Vec::new();
    for case in [VisibilityCase::Balls, VisibilityCase::Crossing] {
        let scene = &case.scene(side);
        let times = nanoseconds(effort.rounds().div_ceil(2), &Transparency::ALL, |way| way.repeated(scene));
        let right = exact(scene);
        for (way, time) in Transparency::ALL.into_iter().zip(times) {
            let error = way.error(scene, &right);
            let row = Row::new(case.name(), way.name())
                .sized([side; 2])
                .with(RMSE, error.rmse())
                .with(WORST, error.worst);
            rows.push(row.with(DELTA_E, error.delta_e()).timed(TIME, time.scaled(1e-6)));
        }
    }
    Chapter {
        name: "transparency",
        title: "In which order are translucent faces laid over each other?",
        text: "Bodies whose faces let half of the light through, against fragments in the order of their exact depths (`oracle::nearness`).",
        findings: Vec::new(),
        plots: vec![Plot::trade("crossing", &rows, VisibilityCase::Crossing.name(), [TIME, RMSE])],
        images: vec![image()],
        rows,
    }
}

fn image() -> ImageRow {
    let scene = VisibilityCase::Crossing.scene(256);
    let ways = [Transparency::Unsorted, Transparency::ByBody, Transparency::ByFace, Transparency::Engine];
    let panel = |way: Transparency| way.draw(&scene).map(|&light| grey(light));
    ImageRow::new("order", "Unsorted, sorted by body, sorted by face, the engine", ways.map(panel).to_vec())
}

pub(super) fn headlines() -> Vec<Headline> {
    let of = |case: VisibilityCase, ways: [Transparency; 2]| {
        Headline::within(case.name(), ways.map(Transparency::name), [TIME, DELTA_E])
    };
    vec![
        of(VisibilityCase::Crossing, [Transparency::ByFace, Transparency::ByBody]),
        of(VisibilityCase::Crossing, [Transparency::ByFragment, Transparency::ByFace]),
        of(VisibilityCase::Crossing, [Transparency::Engine, Transparency::ByFragment]),
    ]
}
