//! What does a shadow's edge cost?

use super::*;
use crate::field::Field;
use crate::shadow::{MapFilter, Shadow, draw, error, exact};

const RMSE: &str = "RMSE near the edge";
const TIME: &str = "ns per pixel";
const READY: &str = "ms to make ready";

const CASE: &str = "a ball above a floor";

pub(super) fn measure(effort: Effort) -> Chapter {
    let side = effort.pick(256, 512);
    let rounds = effort.rounds();
    let ready = nanoseconds(rounds.div_ceil(3), &Shadow::ALL, |shadow| -> Box<dyn FnMut()> {
        Box::new(move || drop(shadow.ready()))
    });
    let times = nanoseconds(rounds, &Shadow::ALL, |shadow| -> Box<dyn FnMut()> {
        let light = shadow.ready();
        Box::new(move || drop(draw(side, &*light)))
    });
    let row = |(shadow, (ready, time)): (Shadow, (Spread, Spread))| {
        let row = Row::new(CASE, shadow.name())
            .sized([side; 2])
            .with(RMSE, error(&draw(side, &*shadow.ready())).rmse());
        row.timed(TIME, time.scaled(1.0 / (side * side) as f64)).timed(READY, ready.scaled(1e-6))
    };
    let rows: Vec<Row> = Shadow::ALL.into_iter().zip(ready.into_iter().zip(times)).map(row).collect();
    Chapter {
        name: "shadow",
        title: "What does a shadow's edge cost?",
        text: "Maps that reach just round the ball, nearest texel or four of them weighted, and rays against 5,120 triangles, \
               against the closed form, in the pixels within two of the shadow's edge. A map is made in closed form here; an \
               engine draws it.",
        findings: Vec::new(),
        plots: vec![Plot::trade("ball", &rows, CASE, [TIME, RMSE])],
        pictures: vec![picture()],
        rows,
    }
}

fn picture() -> Picture {
    let panel = |light: &dyn Fn([f64; 2]) -> f64| -> Field<[u8; 3]> {
        draw(256, light).map(|&light| grey(0.05 + 0.6 * light))
    };
    let shadows = [
        Shadow::Map(64, MapFilter::Nearest),
        Shadow::Map(64, MapFilter::Linear),
        Shadow::Map(1024, MapFilter::Nearest),
    ];
    let mut panels: Vec<_> = shadows.iter().map(|shadow| panel(&*shadow.ready())).collect();
    panels.push(panel(&exact));
    Picture::new(
        "edges",
        "A map of 64 texels a side, the same filtered, one of 1024, and the closed form",
        panels,
    )
}

pub(super) fn headlines() -> Vec<Headline> {
    let map = Shadow::Map(1024, MapFilter::Nearest);
    let against_map = |shadow: Shadow| Headline::within(CASE, [shadow.name(), map.name()], [TIME, RMSE]);
    vec![
        against_map(Shadow::Rays).meaning("What rays have of error is that of the triangles."),
        against_map(Shadow::Map(1024, MapFilter::Linear)),
    ]
}
