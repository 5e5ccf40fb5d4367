//! What do normals in each pixel buy?

use super::*;
use crate::shading::{Ball, BallShading, error_at};
use trigon_classic::Field;

const RMSE: &str = "RMSE, linear light";
const WORST: &str = "worst pixel";
const DELTA_E: &str = "mean ΔE";
const TIME: &str = "ns per pixel";

pub(super) fn measure(effort: Effort) -> Chapter {
    let side = effort.pick(192, 512);
    let cases: Vec<(String, Ball)> =
        (1..=4).map(|subdivisions| (case(subdivisions), Ball::new(side, subdivisions))).collect();
    let mut rows = Vec::new();
    for (name, ball) in &cases {
        let pixels = BallShading::Flat.draw(ball).values().iter().flatten().count();
        let times = nanoseconds(effort.rounds(), &BallShading::ALL, |shading| shading.repeated(ball));
        for (shading, time) in BallShading::ALL.into_iter().zip(times) {
            let error = shading.error(ball);
            let row = Row::new(name, shading.name())
                .sized([side; 2])
                .with(RMSE, error.rmse())
                .with(WORST, error.worst);
            rows.push(row.with(DELTA_E, error.delta_e()).timed(TIME, time.per(pixels)));
        }
    }
    Chapter {
        name: "shading",
        title: "What do normals in each pixel buy?",
        text: "Balls of triangles with a highlight, against a ball (source D compares the three in words). ΔE is the difference in \
               CIE lightness: below about 1 hardly anybody sees it.",
        findings: Vec::new(),
        plots: vec![Plot::trade("ball", &rows, &cases[1].0, [TIME, RMSE])],
        images: vec![image()],
        rows,
    }
}

fn image() -> ImageRow {
    let ball = Ball::new(256, 2);
    let light = |shading: BallShading| shading.draw(&ball).map(|light| light.map_or([0; 3], grey));
    let error = |shading: BallShading| {
        let drawn = shading.draw(&ball);
        Field::from_fn([256; 2], |position| heat(error_at(&ball, &drawn, position) * 5.0))
    };
    let panels = BallShading::ALL.map(light).into_iter().chain(BallShading::ALL.map(error));
    let caption =
        "Flat, Gouraud and Phong on 320 triangles, then their errors in linear light, five times as bright";
    ImageRow::new("balls", caption, panels.collect())
}

fn case(subdivisions: u32) -> String {
    format!("a ball of {} triangles", 20 << (2 * subdivisions))
}

pub(super) fn headlines() -> Vec<Headline> {
    let [flat, gouraud, phong] = BallShading::ALL.map(BallShading::name);
    let of_320 = |ways: [&'static str; 2]| Headline::within(case(2), ways, [TIME, RMSE]);
    vec![
        of_320([phong, gouraud]),
        of_320([flat, gouraud]),
        Headline::between([case(4), case(2)], gouraud, [TIME, RMSE]).meaning("Triangles buy accuracy, too."),
    ]
}
