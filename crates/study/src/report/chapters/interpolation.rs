//! What does a division in each pixel buy?

use super::*;
use crate::interpolation::{Interpolation, Wall};

const RMS: &str = "RMS, texels";
const WORST: &str = "worst, texels";
const TIME: &str = "ns per pixel";

const CASE: &str = "a wall of two triangles";

pub(super) fn measure(effort: Effort) -> Chapter {
    let width = effort.pick(320, 640);
    let (wall, size) = (&Wall::new(width), [width, width * 3 / 4]);
    let pixels = Interpolation::Affine.draw(wall).values().iter().flatten().count();
    let times = nanoseconds(effort.rounds(), &Interpolation::ALL, |way| way.repeated(wall));
    let row = |(way, time): (Interpolation, Spread)| {
        let errors = way.errors(wall);
        let row = Row::new(CASE, way.name()).sized(size).with(RMS, errors.rms).with(WORST, errors.worst);
        row.timed(TIME, time.per(pixels))
    };
    let rows: Vec<Row> = Interpolation::ALL.into_iter().zip(times).map(row).collect();
    Chapter {
        name: "interpolation",
        title: "What does a division in each pixel buy?",
        text: "Texture coordinates on a wall that leads from 1.5 to 6 metres away, 256 texels to the metre, against exact areas and \
               a division in `f64` (`oracle::perspective`). Which pixels a row covers is known before for all but the engine, \
               whose time is that of a whole image.",
        findings: Vec::new(),
        plots: vec![Plot::trade("wall", &rows, CASE, [TIME, RMS])],
        images: vec![image()],
        rows,
    }
}

/// The wall with a checker of half metres.
fn image() -> ImageRow {
    let wall = Wall::new(256);
    let panel = |way: Interpolation| {
        way.draw(&wall).map(|texel| match texel {
            Some([u, v]) => {
                let [column, row] = [u, v].map(|part| (part / 128.0).floor() as i64);
                if (column + row).rem_euclid(2) == 0 { [220; 3] } else { [40, 90, 160] }
            }
            None => [16; 3],
        })
    };
    let ways = [Interpolation::Affine, Interpolation::Every16, Interpolation::Perspective];
    ImageRow::new("wall", "Affine, perspective every 16 pixels, perspective", ways.map(panel).to_vec())
}

pub(super) fn headlines() -> Vec<Headline> {
    let [affine, every16, perspective, engine] = Interpolation::ALL.map(Interpolation::name);
    let of = |ways: [&'static str; 2]| Headline::within(CASE, ways, [TIME, WORST]);
    vec![of([perspective, affine]), of([every16, perspective]), of([engine, perspective])]
}
