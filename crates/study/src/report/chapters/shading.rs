//! What do normals in each pixel buy?

use super::*;
use crate::field::Field;
use crate::shading::{Ball, Shading, error_at};

const RMSE: &str = "RMSE, linear light";
const WORST: &str = "worst pixel";
const DELTA_E: &str = "mean ΔE";
const TIME: &str = "ns per pixel";

pub(super) fn measure(effort: Effort) -> Chapter {
    let side = effort.pick(192, 512);
    let cases: Vec<(String, Ball)> = (1..=4)
        .map(|subdivisions| {
            (format!("a ball of {} triangles", 20 << (2 * subdivisions)), Ball::new(side, subdivisions))
        })
        .collect();
    let mut rows = Vec::new();
    for (name, ball) in &cases {
        let pixels = Shading::Flat.draw(ball).values().iter().flatten().count() as f64;
        let times = nanoseconds(effort.rounds(), &Shading::ALL, |shading| -> Box<dyn FnMut()> {
            Box::new(move || drop(shading.draw(ball)))
        });
        for (shading, time) in Shading::ALL.into_iter().zip(times) {
            let error = shading.error(ball);
            let row = Row::new(name, shading.name()).with(RMSE, error.rmse()).with(WORST, error.worst);
            rows.push(row.with(DELTA_E, error.delta_e()).timed(TIME, time.scaled(1.0 / pixels)));
        }
    }
    Chapter {
        name: "shading",
        title: "What do normals in each pixel buy?",
        text: "Balls of triangles with a highlight, against a ball (source D compares the three in words). ΔE is the difference in \
               CIE lightness: below about 1 hardly anybody sees it.",
        findings: findings(&rows, &cases),
        plots: vec![Plot::trade("ball", &rows, &cases[1].0, [TIME, RMSE])],
        pictures: vec![picture()],
        rows,
    }
}

fn picture() -> Picture {
    let ball = Ball::new(256, 2);
    let light = |shading: Shading| shading.draw(&ball).map(|light| light.map_or([0; 3], grey));
    let error = |shading: Shading| {
        let drawn = shading.draw(&ball);
        Field::from_fn([256; 2], |place| heat(error_at(&ball, &drawn, place) * 5.0))
    };
    let panels = Shading::ALL.map(light).into_iter().chain(Shading::ALL.map(error));
    let caption =
        "Flat, Gouraud and Phong on 320 triangles, then their errors in linear light, five times as bright";
    Picture::new("balls", caption, panels.collect())
}

fn findings(rows: &[Row], cases: &[(String, Ball)]) -> Vec<String> {
    let of =
        |case: usize, shading: Shading, quantity: &str| value(rows, &cases[case].0, shading.name(), quantity);
    let [flat, gouraud, phong] = Shading::ALL;
    vec![
        format!(
            "**Light in each pixel over light at the corners:** {} of the time for {} of the error on {}; flat faces have {} of \
             Gouraud's error.",
            times(of(1, phong, TIME), of(1, gouraud, TIME)),
            times(of(1, phong, RMSE), of(1, gouraud, RMSE)),
            cases[1].0,
            times(of(1, flat, RMSE), of(1, gouraud, RMSE)),
        ),
        format!(
            "Triangles buy the same: Gouraud on {} has an error of {}, Phong on {} of {}.",
            cases[3].0,
            number(of(3, gouraud, RMSE)),
            cases[1].0,
            number(of(1, phong, RMSE)),
        ),
    ]
}
