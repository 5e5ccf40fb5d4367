//! How many samples does an edge need?

use super::*;
use crate::antialiasing::{AntiAliasing, Star, exact};
use crate::field::Field;

const RMSE: &str = "RMSE at edges, linear light";
const WORST: &str = "worst pixel";
const DELTA_E: &str = "mean ΔE at edges";
const TIME: &str = "ns per pixel of the picture";

const CASE: &str = "a star of needles";

pub(super) fn measure(effort: Effort) -> Chapter {
    let side = effort.pick(192, 512);
    let star = &Star::new(side);
    let right = exact(star);
    let times = nanoseconds(effort.rounds(), &AntiAliasing::ALL, |way| way.repeated(star));
    let row = |(way, time): (AntiAliasing, Spread)| {
        let error = way.error(star, &right);
        let row = Row::new(CASE, way.name()).with(RMSE, error.rmse()).with(WORST, error.worst);
        row.with(DELTA_E, error.delta_e()).timed(TIME, time.scaled(1.0 / (side * side) as f64))
    };
    let rows: Vec<Row> = AntiAliasing::ALL.into_iter().zip(times).map(row).collect();
    Chapter {
        name: "antialiasing",
        title: "How many samples does an edge need?",
        text: "White needles on black with the engine's samples, on finer grids, and by the exact area in each pixel, in the pixels \
               that are partly covered. The exact area is found triangle by triangle, for pictures in which none hides another.",
        findings: findings(&rows),
        plots: vec![Plot::trade("star", &rows, CASE, [TIME, RMSE])],
        pictures: vec![picture()],
        rows,
    }
}

fn picture() -> Picture {
    let star = Star::new(128);
    let right = exact(&star);
    let ways = [AntiAliasing::Samples(1), AntiAliasing::Samples(4), AntiAliasing::Samples(16)];
    let drawn = ways.map(|way| way.draw(&star));
    let error = |shares: &Field<f64>| {
        Field::from_fn([128; 2], |place| heat((shares[place] - right[place]).abs() * 2.0))
    };
    let panels = drawn.each_ref().map(|shares| shares.map(|&share| grey(share))).into_iter();
    let caption = "1, 4 and 16 samples, then their errors, twice as bright";
    Picture::new("star", caption, panels.chain(drawn.each_ref().map(error)).collect())
}

fn findings(rows: &[Row]) -> Vec<String> {
    let of = |way: AntiAliasing, quantity: &str| value(rows, CASE, &way.name(), quantity);
    let step = |few: u32, many: u32| {
        let [few, many] = [few, many].map(AntiAliasing::Samples);
        format!(
            "{} of the time for {} of the error",
            times(of(many, TIME), of(few, TIME)),
            times(of(many, RMSE), of(few, RMSE))
        )
    };
    vec![
        format!("**4 samples instead of 1** take {}; **16 instead of 4**, {}.", step(1, 4), step(4, 16)),
        format!(
            "A finer grid of 2x2 has {} of the error of 4 samples at their standard places, for {} of the time, as everything is \
             shaded four times.",
            times(of(AntiAliasing::Finer(2), RMSE), of(AntiAliasing::Samples(4), RMSE)),
            times(of(AntiAliasing::Finer(2), TIME), of(AntiAliasing::Samples(4), TIME)),
        ),
    ]
}
