//! What does a whole image's accuracy cost?

pub(in crate::report) mod budget;
pub(in crate::report) mod sweep;

use super::*;
use crate::frames::{FrameCase, Prover, Repeated, name};
use crate::sittings;
use crate::workloads::Workload;
use trigon_classic::Field;
use trigon_scene::SimdLevel;
use trigon_scene::quality::Preset;

pub(super) use sweep::leave_out_what_is_beaten;
pub(in crate::report) use sweep::{RMSE, Sweep, TIME};

const CERTIFIED: &str = "certified, %";
const SEES: &str = "may see something else, %";
const OTHER: &str = "bytes that differ";

const LEVELS: &str = "the built-in scene by vector instructions";
const PROOFS: &str = "workloads, drawn and proven";
const DRAWN: &str = "drawn";
const PROVEN: &str = "drawn and proven";

pub(super) fn measure(effort: Effort) -> Chapter {
    let size = effort.pick([120, 72], [480, 288]);
    let large = effort.pick([240, 136], [1920, 1080]);
    let mut rows = Vec::new();
    let small = Sweep::small(size);
    for sweep in [effort.pick(small.brief(), Sweep::small(size)), Sweep::large(large)] {
        rows.extend(sweep.measure(effort));
    }
    leave_out_what_is_beaten(&mut rows);
    if sittings::is_last() {
        rows.extend(budget::rows(size, effort));
    }
    rows.extend(levels(size, effort));
    rows.extend(proofs(effort));
    Chapter {
        name: "frames",
        title: "Which preset should one use?",
        text: "Whole images of twelve scenes on all threads, at 26 qualities, and at 12 more where there are shadows; four of them also with \
               1920×1080 pixels, at the qualities from which a time budget chooses. A name gives the shaded samples along each side of a pixel, \
               twice, and the samples of coverage in each of them. Shadows come from maps up to 2×2 samples and from rays above, unless the name says \
               otherwise. The tables list the presets and each quality that no other one beats in both time and error; the file has \
               them all. Errors are against the truth of [accuracy.md](accuracy.md): rays in `f64`. The teapot is Newell's, the chair and \
               the mug were modelled with the editor. On the flights a budget of 16 ms chooses the most accurate quality that fits each \
               frame, and predicts its time and its error against `reference`. Every frame counts. The constants behind the predictions were \
               chosen on other flights. A frame's time includes choosing, drawing, and looking again at a part of the image.",
        findings: findings(&rows),
        plots: [("grass", FrameCase::Grass), ("layers", FrameCase::Layers)]
            .map(|(name, case)| Plot::trade(name, &rows, case.name(), [TIME, RMSE]))
            .into(),
        images: vec![heat_image([256, 160])],
        rows,
    }
}

/// A row of images, drawn by all threads of the machine.
fn whole(case: impl Into<String>, variant: impl Into<String>, size: [u32; 2]) -> Row {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    Row::new(case, variant).sized(size.map(|side| side as usize)).with_threads(threads)
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
    let certified = [Workload::KnotPhong, Workload::Cubes]
        .map(|workload| {
            let share = value(rows, PROOFS, &format!("{}, {PROVEN}", workload.name()), CERTIFIED);
            format!("{} % of {}", number(share), workload.name())
        })
        .join(", ");
    vec![
        "`standard` is for images that move, `high` for those that stay; `draft` to find a view, `reference` to measure against."
            .to_owned(),
        budget::finding(rows),
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
        Headline::within(Sweep::small([480, 288]).means(), [to.clone(), from.clone()], quantities)
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
