//! How near may two surfaces be?

use super::*;
use crate::depth::{DepthFormat, Road, misordered_per_mille, resolved_separation};
use std::hint::black_box;

const WRONG: &str = "misordered, ‰ of pairs 0.01 % apart";
const RESOLVED: &str = "always told apart, share of the distance";
const BYTES: &str = "bytes";
const TIME: &str = "ns per depth";

const ROAD: &str = "a road with paint 0.1 mm above it";
const SHOWN: &str = "road instead of paint, ‰ of pixels";
const PIXEL: &str = "ns per pixel and two layers";

/// In metres.
const PAINT: f64 = 0.0001;

const DISTANCES: [f64; 4] = [1.0, 10.0, 100.0, 1000.0];

pub(super) fn measure(effort: Effort) -> Chapter {
    let distances: Vec<f32> = (0..100_000).map(|i| 0.1 + i as f32 * 0.05).collect();
    let distances = &distances;
    let times = nanoseconds(effort.rounds(), &DepthFormat::ALL, |format| -> Box<dyn FnMut()> {
        Box::new(move || {
            let sum =
                distances.iter().fold(0, |sum: u32, &distance| sum.wrapping_add(format.encode(distance)));
            black_box(sum);
        })
    });
    let rows: Vec<Row> = DISTANCES
        .iter()
        .flat_map(|&distance| {
            DepthFormat::ALL.iter().zip(&times).map(move |(&format, &time)| row(distance, format, time))
        })
        .collect();
    let rows = [rows, on_road(effort)].concat();
    let line = |format: DepthFormat| {
        let points = [0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0, 3000.0];
        let resolved = points.map(|distance| [distance, resolved_separation(format, distance)]);
        (format.name().to_owned(), resolved.to_vec())
    };
    let lines = DepthFormat::ALL.map(line).to_vec();
    let axes = ["distance, metres", RESOLVED];
    let plot =
        Plot::growth("resolved", "What a depth format tells apart (near 0.1 m, far 10 km)", axes, lines);
    Chapter {
        name: "depth",
        title: "How near may two surfaces be?",
        text: "Pairs of surfaces at 10,000 distances about 1, 10, 100 and 1000 metres, between planes at 0.1 and 10,000 metres, \
               through depths computed in `f32`. Misordered are pairs that come out as equal or the wrong way round. Then images by a z-buffer of each format: a road that leads to the horizon, and \
               paint 0.1 mm above it, with depths that are linear on the screen.",
        findings: vec![
            "Surfaces that should be told apart at a distance need the near plane as far out as it may be, or reversed depth."
                .to_owned(),
        ],
        plots: vec![plot],
        images: vec![image()],
        rows,
    }
}

/// Images of a road with paint, in time and in wrong pixels.
fn on_road(effort: Effort) -> Vec<Row> {
    let road = &Road::new(effort.pick(256, 512), PAINT);
    let [width, height] = road.size();
    let times = nanoseconds(effort.rounds(), &DepthFormat::ALL, |format| road.repeated(format));
    let row = |(format, time): (DepthFormat, Spread)| {
        let row = Row::new(ROAD, format.name()).sized(road.size());
        row.with(SHOWN, road.wrong_per_mille(format)).timed(PIXEL, time.per(width * height))
    };
    DepthFormat::ALL.into_iter().zip(times).map(row).collect()
}

/// The paint in each format, and red where the road shows through.
fn image() -> ImageRow {
    let road = Road::new(256, PAINT);
    let panel = |format: DepthFormat| {
        road.draw(format).map(|&is_paint| if is_paint { [220; 3] } else { [200, 40, 30] })
    };
    let caption = "Paint 0.1 mm above a road, by z-buffers of 16 bits, 24 bits, f32 and reversed f32: red is road that shows through";
    ImageRow::new("road", caption, DepthFormat::ALL.map(panel).to_vec())
}

fn case(distance: f64) -> String {
    format!("at {distance} m")
}

fn row(distance: f64, format: DepthFormat, time: Spread) -> Row {
    Row::new(case(distance), format.name())
        .with(WRONG, misordered_per_mille(format, distance, 1e-4))
        .with(RESOLVED, resolved_separation(format, distance))
        .with(BYTES, format.bytes() as f64)
        .timed(TIME, time.per(100_000))
}

pub(super) fn headlines() -> Vec<Headline> {
    let [fixed16, fixed24, float, reversed] = DepthFormat::ALL.map(DepthFormat::name);
    let at_1000 = |formats: [&'static str; 2]| Headline::within(case(1000.0), formats, [TIME, RESOLVED]);
    let on_road = |formats: [&'static str; 2]| Headline::within(ROAD, formats, [PIXEL, SHOWN]);
    vec![
        at_1000([reversed, float]),
        on_road([reversed, float]),
        on_road([float, fixed24]),
        on_road([fixed16, fixed24]),
    ]
}
