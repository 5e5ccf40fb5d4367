//! What does a whole image's accuracy cost?

use super::*;
use crate::frames::{
    FlightSummary, FrameCase, Prover, Repeated, Step, errors, fly, name, other_shadows, variants,
};
use crate::workloads::Workload;
use std::time::{Duration, Instant};
use trigon_classic::Field;
use trigon_math::elementary;
use trigon_scene::SimdLevel;
use trigon_scene::quality::{Preset, Quality};

const RMSE: &str = "RMSE in linear light";
const TIME: &str = "ms per frame";
const IN_TIME: &str = "in time, %";
const TIMES: &str = "times foreseen within a fifth, %";
const FORESEEN: &str = "errors foreseen within a fifth, %";
const WORST: &str = "worst miss of an error, %";
const CERTIFIED: &str = "certified, %";
const SEES: &str = "may see something else, %";
const OTHER: &str = "bytes that differ";

const LIMIT: Duration = Duration::from_millis(16);
const FLIGHT: &str = "a flight with a budget of 16 ms";
const LEVELS: &str = "the built-in scene by vector instructions";
const PROOFS: &str = "workloads, drawn and proven";
const DRAWN: &str = "drawn";
const PROVEN: &str = "drawn and proven";
const MEANS: &str = "all scenes, geometric means";

pub(super) fn measure(effort: Effort) -> Chapter {
    let size = effort.pick([120, 72], [480, 288]);
    let mut rows: Vec<Row> = FrameCase::ALL.into_iter().flat_map(|case| front(case, size, effort)).collect();
    rows.extend(means(&rows, size));
    leave_out_what_is_beaten(&mut rows);
    rows.extend(FrameCase::ALL.map(|case| flight(case, size, effort)));
    rows.extend(levels(size, effort));
    rows.extend(proofs(effort));
    let plot = |(name, case): (&'static str, FrameCase)| Plot::trade(name, &rows, case.name(), [TIME, RMSE]);
    Chapter {
        name: "frames",
        title: "Which preset should one use?",
        text: "Whole images of six scenes at 60 qualities, and at 20 more where there are shadows, on all threads. A name gives the \
               shaded places along each side of a pixel, twice, and the samples in each of them. Shadows come from maps up to 2×2 places and from rays above, unless \
               the name says otherwise. The tables and plots list the presets and each quality that no other one beats in both time and error; \
               the file has them all. Errors are against 8×8 shaded places with 16 samples each, none of which coincides with a sample of any quality. \
               The teapot is Newell's, the chair and the mug were modelled with the editor. On the flights a budget of 16 ms chooses the most accurate \
               quality that fits each frame, and predicts its time and its error against `reference`. Every frame counts. The constants \
               behind the predictions were chosen on other flights. A frame's time includes choosing, drawing, and looking again at a part of the \
               image.",
        findings: findings(&rows),
        plots: ["showcase", "shadows", "dense", "teapot", "chair", "mug"]
            .into_iter()
            .zip(FrameCase::ALL)
            .map(plot)
            .collect(),
        images: vec![heat_image([256, 160])],
        rows,
    }
}

/// All qualities of a case.
fn front(case: FrameCase, size: [u32; 2], effort: Effort) -> Vec<Row> {
    let mut variants = variants();
    if case.has_shadows() {
        variants.extend(other_shadows());
    }
    let errors = errors(case, size, &variants).expect("the size is in range");
    let times = nanoseconds(effort.rounds().div_ceil(3), &variants, |quality| -> Box<dyn FnMut()> {
        let mut repeated = Repeated::new(case, size, quality);
        Box::new(move || {
            repeated.draw(0.0).expect("the size is in range");
        })
    });
    let row = |((quality, error), time): ((&Quality, f64), Spread)| {
        whole(case.name(), name(*quality), size).with(RMSE, error).timed(TIME, time.scaled(1e-6))
    };
    variants.iter().zip(errors).zip(times).map(row).collect()
}

/// Keeps only qualities on the front of each scene and presets in tables and plots.
pub(super) fn leave_out_what_is_beaten(rows: &mut [Row]) {
    let point = |row: &Row| Some([row.value(TIME)?, row.value(RMSE)?]);
    for case in FrameCase::ALL.into_iter().map(FrameCase::name).chain([MEANS]) {
        let points: Vec<[f64; 2]> = rows.iter().filter(|row| row.case == case).filter_map(point).collect();
        let is_beaten = |[x, y]: [f64; 2]| points.iter().any(|&[u, v]| u <= x && v <= y && [u, v] != [x, y]);
        for row in rows.iter_mut().filter(|row| row.case == case) {
            let is_preset = row.variant.ends_with(')');
            row.is_listed = is_preset || !point(row).is_some_and(is_beaten);
        }
    }
}

/// A row of images, drawn by all threads of the machine.
fn whole(case: &str, variant: impl Into<String>, size: [u32; 2]) -> Row {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    Row::new(case, variant).sized(size.map(|side| side as usize)).with_threads(threads)
}

/// Each quality over all scenes.
pub(super) fn means(rows: &[Row], size: [u32; 2]) -> Vec<Row> {
    let mean = |variant: &str, quantity: &str| {
        let values = FrameCase::ALL.map(|case| value(rows, case.name(), variant, quantity));
        elementary::pow(values.iter().product(), 1.0 / values.len() as f64)
    };
    let row = |&quality: &Quality| {
        let variant = name(quality);
        let [time, error] = [TIME, RMSE].map(|quantity| mean(&variant, quantity));
        whole(MEANS, variant, size).with(RMSE, error).with(TIME, time)
    };
    variants().iter().map(row).collect()
}

/// The budget on a case's flight.
fn flight(case: FrameCase, size: [u32; 2], effort: Effort) -> Row {
    let (start, frames) = (Instant::now(), effort.pick(24, 60));
    let steps = fly(case, size, LIMIT, frames, &mut || start.elapsed()).expect("the size is in range");
    let summary = FlightSummary::of(&steps);
    let mut times: Vec<f64> = steps.iter().map(|step: &Step| step.time.as_secs_f64() * 1e3).collect();
    times.sort_by(f64::total_cmp);
    let at = |part: usize| times[(times.len() - 1) * part / 4];
    whole(FLIGHT, case.name(), size)
        .by("a budget of 16 ms")
        .of(case.name())
        .timed(TIME, Spread { low: at(1), median: at(2), high: at(3) })
        .with(IN_TIME, summary.in_time * 100.0)
        .with(TIMES, summary.times * 100.0)
        .with(FORESEEN, summary.errors * 100.0)
        .with(WORST, summary.worst * 100.0)
}

/// The same image at each level of vector instructions that is there.
fn levels(size: [u32; 2], effort: Effort) -> Vec<Row> {
    let levels: Vec<SimdLevel> = SimdLevel::ALL.into_iter().filter(|level| level.is_supported()).collect();
    let at = |level| Repeated::new(FrameCase::Showcase, size, Preset::Standard.quality()).at_level(level);
    let times = nanoseconds(effort.rounds().div_ceil(3), &levels, |level| -> Box<dyn FnMut()> {
        let mut repeated = at(level);
        Box::new(move || {
            repeated.draw(0.0).expect("the size is in range");
        })
    });
    let bytes = |level| at(level).draw(0.0).map(|frame| frame.color.clone()).unwrap_or_default();
    let first = bytes(levels[0]);
    let row = |(&level, time): (&SimdLevel, Spread)| {
        let differ = bytes(level).iter().zip(&first).filter(|(a, b)| a != b).count();
        whole(LEVELS, level.to_string(), size)
            .of(FrameCase::Showcase.name())
            .timed(TIME, time.scaled(1e-6))
            .with(OTHER, differ as f64)
    };
    levels.iter().zip(times).map(row).collect()
}

/// Images with and without a proof.
fn proofs(effort: Effort) -> Vec<Row> {
    let shrink = effort.pick(8, 1);
    let rows = [Workload::KnotPhong, Workload::Cubes].map(|workload| {
        let [mut drawn, mut proven] =
            [(); 2].map(|()| Prover::new(workload, shrink).expect("the size is in range"));
        let size = drawn.size();
        let certified = proven.prove().expect("there is memory");
        let times = interleaved(
            effort.rounds().div_ceil(3),
            &mut [
                Box::new(move || drawn.draw()),
                Box::new(move || {
                    proven.prove().expect("there is memory");
                }),
            ],
        );
        let row = |way: &str| {
            let variant = format!("{}, {way}", workload.name());
            Row::new(PROOFS, variant).by(way).of(workload.name()).sized(size)
        };
        [
            row(DRAWN).timed(TIME, times[0].scaled(1e-6)),
            row(PROVEN)
                .timed(TIME, times[1].scaled(1e-6))
                .with(CERTIFIED, certified.certified * 100.0)
                .with(SEES, certified.visibility * 100.0),
        ]
    });
    rows.concat()
}

/// The presets on the scene with shadows, and where each is wrong.
fn heat_image(size: [u32; 2]) -> ImageRow {
    let draw = |preset: Preset| {
        let mut repeated = Repeated::new(FrameCase::Shadows, size, preset.quality());
        repeated.draw(0.0).map(|frame| frame.color.clone()).unwrap_or_default()
    };
    let best = draw(Preset::Reference);
    let light = |color: &[u8], at: usize| {
        (0..3)
            .map(|channel| f64::from(trigon_math::color::srgb8_to_linear(color[4 * at + channel])))
            .sum::<f64>()
            / 3.0
    };
    let field = |pixel: &dyn Fn(usize) -> [u8; 3]| {
        Field::from_fn(size.map(|side| side as usize), |[x, y]| pixel(y * size[0] as usize + x))
    };
    let mut panels = vec![field(&|at| [best[4 * at], best[4 * at + 1], best[4 * at + 2]])];
    for preset in [Preset::Draft, Preset::Standard, Preset::High] {
        let color = draw(preset);
        panels.push(field(&|at| heat(5.0 * (light(&color, at) - light(&best, at)).abs())));
    }
    let caption = "The reference, and five times the error of draft, standard and high";
    ImageRow::new("presets", caption, panels)
}

pub(super) fn findings(rows: &[Row]) -> Vec<String> {
    let flight = |case: FrameCase, quantity: &str| number(value(rows, FLIGHT, case.name(), quantity));
    let list = |quantity: &str| FrameCase::ALL.map(|case| flight(case, quantity)).join(", ");
    let certified = [Workload::KnotPhong, Workload::Cubes]
        .map(|workload| {
            let share = value(rows, PROOFS, &format!("{}, {PROVEN}", workload.name()), CERTIFIED);
            format!("{} % of {}", number(share), workload.name())
        })
        .join(", ");
    vec![
        "`standard` is for images that move, `high` for those that stay; `draft` to find a view, `reference` to measure against."
            .to_owned(),
        format!(
            "Six flights, with the share of their frames in %, flight by flight. Frames that keep a budget of 16 ms: {}. Frames \
             that take the predicted time, within a fifth: {}. Frames that have the predicted error, within a fifth: {}.",
            list(IN_TIME),
            list(TIMES),
            list(FORESEEN),
        ),
        format!("Certified, of the pixels that show anything, are {certified}."),
        level_finding(rows),
    ]
}

/// What vectors of other widths change.
fn level_finding(rows: &[Row]) -> String {
    let levels: Vec<&Row> = rows.iter().filter(|row| row.case == LEVELS).collect();
    let said = levels
        .iter()
        .map(|row| format!("{} ms with {}", number(row.value(TIME).unwrap_or(f64::NAN)), row.variant));
    let differ: f64 = levels.iter().filter_map(|row| row.value(OTHER)).sum();
    format!(
        "A frame takes {}, and {} bytes differ between them.",
        said.collect::<Vec<_>>().join(", "),
        number(differ),
    )
}

pub(super) fn headlines() -> Vec<Headline> {
    let [draft, standard, high, reference] = Preset::ALL.map(|preset| name(preset.quality()));
    let step = |to: &String, from: &String, quantities: &[&'static str]| {
        Headline::within(MEANS, [to.clone(), from.clone()], quantities)
    };
    let proven = |workload: Workload| {
        let variants = [PROVEN, DRAWN].map(|way| format!("{}, {way}", workload.name()));
        Headline::within(PROOFS, variants, [TIME])
    };
    vec![
        step(&standard, &draft, &[TIME, RMSE]),
        step(&high, &standard, &[TIME, RMSE]),
        step(&reference, &high, &[TIME, RMSE]),
        proven(Workload::KnotPhong),
        proven(Workload::Cubes),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An image of a preset, drawn on its own.
    fn drawn(preset: Preset, size: [u32; 2]) -> Vec<u8> {
        let mut repeated = Repeated::new(FrameCase::Shadows, size, preset.quality());
        repeated.draw(0.0).expect("the size is in range").color.clone()
    }

    #[test]
    fn presets_are_shown_with_five_times_their_error() {
        let panels = heat_image([12, 8]).panels;
        assert_eq!(panels.len(), 4, "the reference and three presets");
        let best = drawn(Preset::Reference, [12, 8]);
        let light = |color: &[u8]| {
            let channels = [color[0], color[1], color[2]].map(trigon_math::color::srgb8_to_linear);
            f64::from(channels[0]) + f64::from(channels[1]) + f64::from(channels[2])
        };
        let mut wrong = 0;
        for (preset, panel) in [Preset::Draft, Preset::Standard, Preset::High].into_iter().zip(&panels[1..]) {
            let color = drawn(preset, [12, 8]);
            for (i, (found, right)) in color.chunks(4).zip(best.chunks(4)).enumerate() {
                let position = [i % 12, i / 12];
                assert_eq!(panels[0][position], right[..3], "the reference at {position:?}");
                let error = (light(found) - light(right)).abs() / 3.0;
                let differs = panel[position].into_iter().zip(heat(5.0 * error)).map(|(a, b)| a.abs_diff(b));
                assert!(differs.max() <= Some(1), "{preset:?} at {position:?}");
                wrong += usize::from(panel[position] != [0; 3]);
            }
        }
        assert!(wrong > 10, "no preset is the reference: {wrong} pixels");
    }
}
