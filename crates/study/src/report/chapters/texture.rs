//! How many texels does a pixel need?

use super::*;
use crate::texture::{Ground, TextureFilter, exact};

const RMSE: &str = "RMSE, linear light";
const WORST: &str = "worst pixel";
const DELTA_E: &str = "mean ΔE";
const TIME: &str = "ns per pixel";

const CASE: &str = "a checkered floor";

pub(super) fn measure(effort: Effort) -> Chapter {
    let ground = &Ground::new(effort.pick(256, 512));
    let right = exact(ground);
    let pixels = right.values().len() as f64;
    let times = nanoseconds(effort.rounds(), &TextureFilter::ALL, |filter| -> Box<dyn FnMut()> {
        Box::new(move || drop(filter.draw(ground)))
    });
    let row = |(filter, time): (TextureFilter, Spread)| {
        let error = filter.error(ground, &right);
        let row = Row::new(CASE, filter.name())
            .sized(ground.size())
            .with(RMSE, error.rmse())
            .with(WORST, error.worst);
        row.with(DELTA_E, error.delta_e()).timed(TIME, time.scaled(1.0 / pixels))
    };
    let rows: Vec<Row> = TextureFilter::ALL.into_iter().zip(times).map(row).collect();
    let panels = [TextureFilter::Nearest, TextureFilter::Trilinear, TextureFilter::Anisotropic(16)]
        .map(|filter| filter.draw(ground).map(|&light| grey(light)));
    let panels = panels.into_iter().chain([right.map(|&light| grey(light))]).collect();
    Chapter {
        name: "texture",
        title: "How many texels does a pixel need?",
        text: "The engine's filters, one look-up at a time, on a floor that leads to the horizon, against the mean of 256 points in \
               each pixel.",
        findings: Vec::new(),
        plots: vec![Plot::trade("floor", &rows, CASE, [TIME, RMSE])],
        pictures: vec![Picture::new(
            "floor",
            "Nearest, trilinear, anisotropic 16, and what pixels see",
            panels,
        )],
        rows,
    }
}

pub(super) fn headlines() -> Vec<Headline> {
    let [nearest, trilinear] = [TextureFilter::Nearest, TextureFilter::Trilinear].map(TextureFilter::name);
    let anisotropic = TextureFilter::Anisotropic(16).name();
    let of = |filters: [String; 2]| Headline::within(CASE, filters, [TIME, RMSE]);
    vec![of([trilinear.clone(), nearest]), of([anisotropic, trilinear])]
}
