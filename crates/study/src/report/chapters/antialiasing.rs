//! How many samples does an edge need?

use super::*;
use crate::antialiasing::{AntiAliasing, Star, exact};
use trigon_classic::Field;

const RMSE: &str = "RMSE at edges, linear light";
const WORST: &str = "worst pixel";
const DELTA_E: &str = "mean ΔE at edges";
const TIME: &str = "ns per pixel of the image";

const CASE: &str = "a star of needles";

pub(super) fn measure(effort: Effort) -> Chapter {
    let side = effort.pick(192, 512);
    let star = &Star::new(side);
    let right = exact(star);
    let times = nanoseconds(effort.rounds(), &AntiAliasing::ALL, |way| way.repeated(star));
    let row = |(way, time): (AntiAliasing, Spread)| {
        let error = way.error(star, &right);
        let row =
            Row::new(CASE, way.name()).sized([side; 2]).with(RMSE, error.rmse()).with(WORST, error.worst);
        row.with(DELTA_E, error.delta_e()).timed(TIME, time.per(side * side))
    };
    let rows: Vec<Row> = AntiAliasing::ALL.into_iter().zip(times).map(row).collect();
    Chapter {
        name: "antialiasing",
        title: "How many samples does an edge need?",
        text: "White needles on black with the engine's samples, on finer grids, and by the exact area in each pixel, in the pixels \
               that are partly covered. The exact area is found triangle by triangle, for images in which none hides another.",
        findings: Vec::new(),
        plots: vec![Plot::trade("star", &rows, CASE, [TIME, RMSE])],
        images: vec![image()],
        rows,
    }
}

fn image() -> ImageRow {
    let star = Star::new(128);
    let right = exact(&star);
    let ways = [AntiAliasing::Samples(1), AntiAliasing::Samples(4), AntiAliasing::Samples(16)];
    let drawn = ways.map(|way| way.draw(&star));
    let error = |shares: &Field<f64>| {
        Field::from_fn([128; 2], |place| heat((shares[place] - right[place]).abs() * 2.0))
    };
    let panels = drawn.each_ref().map(|shares| shares.map(|&share| grey(share))).into_iter();
    let caption = "1, 4 and 16 samples, then their errors, twice as bright";
    ImageRow::new("star", caption, panels.chain(drawn.each_ref().map(error)).collect())
}

pub(super) fn headlines() -> Vec<Headline> {
    let step =
        |from: AntiAliasing, to: AntiAliasing| Headline::within(CASE, [to.name(), from.name()], [TIME, RMSE]);
    let [one, four, sixteen] = [1, 4, 16].map(AntiAliasing::Samples);
    vec![
        step(one, four),
        step(four, sixteen),
        step(four, AntiAliasing::Finer(2)).meaning("The finer grid shades everything four times."),
    ]
}
