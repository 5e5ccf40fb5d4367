//! How many texels does a pixel need?

use super::*;
use crate::texture::{FloorDrawer, Ground, TextureFilter, exact};

const RMSE: &str = "RMSE, linear light";
const WORST: &str = "worst pixel";
const DELTA_E: &str = "mean ΔE";
const TIME: &str = "ns per pixel";

const PRICE: &str = "ns per look-up";

const CASE: &str = "a checkered floor";

pub(super) fn measure(effort: Effort) -> Chapter {
    let ground = &Ground::new(effort.pick(256, 512));
    let right = exact(ground);
    let pixels = right.values().len();
    // The floor without its texture comes first.
    let ways: Vec<Option<TextureFilter>> = [None].into_iter().chain(TextureFilter::ALL.map(Some)).collect();
    let times = nanoseconds(effort.rounds(), &ways, |way| -> Box<dyn FnMut()> {
        let mut drawer = FloorDrawer::new(ground);
        Box::new(move || match way {
            Some(filter) => drawer.draw(filter),
            None => drawer.draw_plain(),
        })
    });
    let times: Vec<Spread> = times.into_iter().map(|time| time.per(pixels)).collect();
    let plain = Row::new(CASE, "no texture").sized(ground.size()).timed(TIME, times[0]);
    let row = |(filter, &time): (TextureFilter, &Spread)| {
        let error = filter.error(ground, &right);
        Row::new(CASE, filter.name())
            .sized(ground.size())
            .with(RMSE, error.rmse())
            .with(WORST, error.worst)
            .with(DELTA_E, error.delta_e())
            .timed(TIME, time)
            .with(PRICE, time.median - times[0].median)
    };
    let rows: Vec<Row> =
        [plain].into_iter().chain(TextureFilter::ALL.into_iter().zip(&times[1..]).map(row)).collect();
    let panels = [TextureFilter::Nearest, TextureFilter::Trilinear, TextureFilter::Anisotropic(16)]
        .map(|filter| filter.draw(ground).map(|&light| grey(light)));
    let panels = panels.into_iter().chain([right.map(|&light| grey(light))]).collect();
    Chapter {
        name: "texture",
        title: "How many texels does a pixel need?",
        text: "Frames of the engine that show a floor which leads to the horizon through each of its filters, against the mean of \
               256 points in each pixel. What a look-up takes is the difference from a frame without one.",
        findings: Vec::new(),
        plots: vec![Plot::trade("floor", &rows, CASE, [TIME, RMSE])],
        images: vec![ImageRow::new(
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
    let of = |filters: [String; 2]| Headline::within(CASE, filters, [PRICE, RMSE]);
    vec![of([trilinear.clone(), nearest]), of([anisotropic, trilinear])]
}
