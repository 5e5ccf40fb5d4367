//! What does a division in each pixel buy?

use super::*;
use crate::interpolation::{Interpolation, Wall};

const RMS: &str = "RMS, texels";
const WORST: &str = "worst, texels";
const TIME: &str = "ns per pixel";

const CASE: &str = "a wall of two triangles";

pub(super) fn measure(effort: Effort) -> Chapter {
    let wall = &Wall::new(effort.pick(320, 640));
    let pixels = Interpolation::Affine.draw(wall).values().iter().flatten().count() as f64;
    let times = nanoseconds(effort.rounds(), &Interpolation::ALL, |way| -> Box<dyn FnMut()> {
        Box::new(move || drop(way.draw(wall)))
    });
    let row = |(way, time): (Interpolation, Spread)| {
        let errors = way.errors(wall);
        let row = Row::new(CASE, way.name()).with(RMS, errors.rms).with(WORST, errors.worst);
        row.timed(TIME, time.scaled(1.0 / pixels))
    };
    let rows: Vec<Row> = Interpolation::ALL.into_iter().zip(times).map(row).collect();
    Chapter {
        name: "interpolation",
        title: "What does a division in each pixel buy?",
        text: "Texture coordinates on a wall that leads from 1.5 to 6 metres away, 256 texels to the metre, against what the corners say \
               in `f64`. The engine's time is that of a whole picture with a pipeline of its own.",
        findings: findings(&rows),
        plots: vec![Plot::trade("wall", &rows, CASE, [TIME, RMS])],
        pictures: vec![picture()],
        rows,
    }
}

/// The wall with a checker of half metres.
fn picture() -> Picture {
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
    Picture::new("wall", "Affine, perspective every 16 pixels, perspective", ways.map(panel).to_vec())
}

fn findings(rows: &[Row]) -> Vec<String> {
    let of = |way: Interpolation, quantity: &str| value(rows, CASE, way.name(), quantity);
    let [affine, every16, perspective, _] = Interpolation::ALL;
    vec![format!(
        "**Perspective over affine** takes {} of the time, and texels are where they should be instead of up to {} away. \
         Dividing at every 16th pixel leaves {} texels at most, for {} of the time of dividing everywhere.",
        times(of(perspective, TIME), of(affine, TIME)),
        number(of(affine, WORST)),
        number(of(every16, WORST)),
        times(of(every16, TIME), of(perspective, TIME)),
    )]
}
