//! What does a shadow's edge cost?

use super::*;
use crate::shadow::{MapFilter, Shadow, ShadowDrawer, draw, draw_into, error, exact};
use trigon_classic::Field;
use trigon_scene::Shadows;

const RMSE: &str = "RMSE near the edge";
const TIME: &str = "ns per pixel";
const READY: &str = "ms to make ready";

const CASE: &str = "a ball above a floor";

pub(super) fn measure(effort: Effort) -> Chapter {
    let side = effort.pick(128, 512);
    let rounds = effort.rounds();
    let right = exact(side);
    let ready = nanoseconds(rounds.div_ceil(3), &Shadow::ALL, |shadow| -> Box<dyn FnMut()> {
        Box::new(move || drop(shadow.ready()))
    });
    let times = nanoseconds(rounds, &Shadow::ALL, |shadow| -> Box<dyn FnMut()> {
        let (light, mut image) = (shadow.ready(), Field::new([side; 2], 0.0));
        Box::new(move || draw_into(&mut image, &*light))
    });
    let row = |(shadow, (ready, time)): (Shadow, (Spread, Spread))| {
        let row = Row::new(CASE, shadow.name()).sized([side; 2]);
        row.with(RMSE, error(&draw(side, &*shadow.ready()), &right).rmse())
            .timed(TIME, time.per(side * side))
            .timed(READY, ready.scaled(1e-6))
    };
    let mut rows: Vec<Row> = Shadow::ALL.into_iter().zip(ready.into_iter().zip(times)).map(row).collect();
    rows.extend(of_engine(side, &right, effort));
    Chapter {
        name: "shadow",
        title: "What does a shadow's edge cost?",
        text: "A ball of 5,120 triangles over a floor. Its shadow comes from maps that reach just round it, by the nearest texel or \
               four weighted ones, or from rays against a tree of the same triangles. Then follow whole images of the floor by \
               the engine, with its own maps and rays, which it keeps from frame to frame. Errors are against the shadow of these triangles, moved onto the \
               floor in `f64`, in the pixels within two of its edge.",
        findings: Vec::new(),
        plots: vec![Plot::trade("ball", &rows, CASE, [TIME, RMSE])],
        images: vec![image()],
        rows,
    }
}

/// The engine's shadows, by their names.
const ENGINE: [(&str, Shadows); 5] = [
    ("engine, no shadows", Shadows::Off),
    ("engine, map 256", Shadows::Maps { resolution: 256 }),
    ("engine, map 1024", Shadows::Maps { resolution: 1024 }),
    ("engine, map 4096", Shadows::Maps { resolution: 4096 }),
    ("engine, rays", Shadows::Rays),
];

fn of_engine(side: usize, right: &Field<f64>, effort: Effort) -> Vec<Row> {
    let times = nanoseconds(effort.rounds(), &ENGINE, |(_, shadows)| -> Box<dyn FnMut()> {
        let mut drawer = ShadowDrawer::new(shadows, side);
        Box::new(move || drawer.draw())
    });
    let row = |((name, shadows), time): ((&str, Shadows), Spread)| {
        let mut drawer = ShadowDrawer::new(shadows, side);
        drawer.draw();
        let row = Row::new(CASE, name).sized([side; 2]);
        row.with(RMSE, error(&drawer.light(), right).rmse()).timed(TIME, time.per(side * side))
    };
    ENGINE.into_iter().zip(times).map(row).collect()
}

fn image() -> ImageRow {
    let shown = |light: Field<f64>| -> Field<[u8; 3]> { light.map(|&light| grey(0.05 + 0.6 * light)) };
    let shadows = [
        Shadow::Map(64, MapFilter::Nearest),
        Shadow::Map(64, MapFilter::Linear),
        Shadow::Map(1024, MapFilter::Nearest),
    ];
    let mut panels: Vec<_> = shadows.iter().map(|shadow| shown(draw(256, &*shadow.ready()))).collect();
    panels.push(shown(exact(256)));
    ImageRow::new(
        "edges",
        "A map of 64 texels a side, the same filtered, one of 1024, and the exact shadow",
        panels,
    )
}

pub(super) fn headlines() -> Vec<Headline> {
    let map = Shadow::Map(1024, MapFilter::Nearest);
    let of = |ways: [String; 2]| Headline::within(CASE, ways, [TIME, RMSE]);
    let [_, _, engine_map, _, engine_rays] = ENGINE.map(|(name, _)| name.to_owned());
    vec![
        of([Shadow::Rays.name(), map.name()]),
        of([Shadow::Map(1024, MapFilter::Linear).name(), map.name()]),
        of([engine_rays, engine_map]).meaning("Both rows are whole images."),
    ]
}
