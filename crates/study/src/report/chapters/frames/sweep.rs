//! All qualities of all scenes at a size: their times, and their errors against the truth.

use std::cell::RefCell;

use super::super::*;
use super::whole;
use crate::frames::{FrameCase, Repeated, name, other_shadows, usual, variants};
use crate::truth::Truth;
use trigon_math::elementary;
use trigon_scene::quality::{Preset, Quality, candidates};

pub(in crate::report) const RMSE: &str = "RMSE in linear light";
pub(in crate::report) const TIME: &str = "ms per frame";
pub(in crate::report) const ROUNDING: &str = "RMSE of the truth as bytes";
pub(in crate::report) const BOUND: &str = "more than the RMSE of the truth";
pub(in crate::report) const UNCERTAIN: &str = "RMSE of draft known within, %";

/// The time and the error of an image.
pub(in crate::report) struct ImageCost {
    time: Spread,
    error: f64,
}

impl ImageCost {
    /// In a row.
    pub(in crate::report) fn on(self, row: Row) -> Row {
        row.with(RMSE, self.error).timed(TIME, self.time.scaled(1e-6))
    }
}

/// Draws so many images in turns, and compares each of them with the truth.
pub(in crate::report) fn image_costs(
    truth: &Truth,
    rounds: usize,
    count: usize,
    image: &dyn Fn(usize) -> Repeated,
) -> Vec<ImageCost> {
    let errors = RefCell::new(vec![f64::NAN; count]);
    let numbers: Vec<usize> = (0..count).collect();
    let times = nanoseconds(rounds, &numbers, |number| -> Box<dyn FnMut()> {
        let (mut repeated, errors) = (image(number), &errors);
        Box::new(move || {
            let frame = repeated.draw(0.0).expect("the size is in range");
            // In the first round, which does not count.
            let mut errors = errors.borrow_mut();
            if errors[number].is_nan() {
                errors[number] = truth.error(frame);
            }
        })
    });
    times.into_iter().zip(errors.into_inner()).map(|(time, error)| ImageCost { time, error }).collect()
}

/// Scenes at a size.
pub(in crate::report) struct Sweep {
    pub(in crate::report) size: [u32; 2],
    cases: &'static [FrameCase],
    is_large: bool,
    /// Whether only the qualities from which a budget chooses are measured.
    is_brief: bool,
}

/// The scenes that are drawn large, too.
const LARGE: [FrameCase; 4] = [FrameCase::Showcase, FrameCase::Shadows, FrameCase::Dense, FrameCase::Passage];

impl Sweep {
    /// All scenes at all qualities.
    pub(in crate::report) fn small(size: [u32; 2]) -> Self {
        Self { size, cases: &FrameCase::ALL, is_large: false, is_brief: false }
    }

    /// Some scenes at the qualities from which a budget chooses.
    pub(in crate::report) fn large(size: [u32; 2]) -> Self {
        Self { size, cases: &LARGE, is_large: true, is_brief: true }
    }

    /// Its scenes.
    pub(in crate::report) fn cases(&self) -> &'static [FrameCase] {
        self.cases
    }

    /// In the names of files.
    pub(in crate::report) fn name(&self) -> &'static str {
        if self.is_large { "large" } else { "small" }
    }

    /// The table of a scene.
    pub(in crate::report) fn case(&self, case: FrameCase) -> String {
        if self.is_large { format!("{}, large", case.name()) } else { case.name().to_owned() }
    }

    /// The table of the means.
    pub(in crate::report) fn means(&self) -> String {
        let scenes = if self.is_large { "four scenes, large" } else { "all scenes" };
        format!("{scenes}, geometric means")
    }

    /// The table of what is known of the truth.
    pub(in crate::report) fn truths(&self) -> String {
        if self.is_large { "the truth, large".to_owned() } else { "the truth".to_owned() }
    }

    /// With fewer qualities.
    pub(super) fn brief(self) -> Self {
        Self { is_brief: true, ..self }
    }

    pub(super) fn measure(&self, effort: Effort) -> Vec<Row> {
        let (mut rows, mut truths) = (Vec::new(), Vec::new());
        for &case in self.cases {
            let truth = case.truth(self.size, &crate::truth::folder());
            rows.extend(self.front(case, &truth, effort));
            truths.push(self.known(case, &truth));
        }
        rows.extend(self.mean_rows(&rows));
        rows.extend(truths);
        rows
    }

    fn known(&self, case: FrameCase, truth: &Truth) -> Row {
        let mut draft = Repeated::new(case, self.size, Preset::Draft.quality());
        let frame = draft.draw(0.0).expect("the size is in range");
        whole(self.truths(), case.name(), self.size)
            .by("rays in f64")
            .of(case.name())
            .with(ROUNDING, truth.rounding())
            .with(BOUND, truth.bound())
            .with(UNCERTAIN, 100.0 * truth.uncertainty(frame))
    }

    /// The qualities of a case. Where nothing casts shadows, those with other shadows are the same.
    pub(in crate::report) fn qualities(&self, case: Option<FrameCase>) -> Vec<Quality> {
        let all = match self.is_brief {
            true => candidates().to_vec(),
            false => [variants(), other_shadows()].concat(),
        };
        let mut qualities = Vec::new();
        for quality in all {
            let has_shadows = case.is_none_or(FrameCase::has_shadows);
            let quality = if has_shadows { quality } else { usual(quality) };
            if !qualities.contains(&quality) {
                qualities.push(quality);
            }
        }
        qualities
    }

    fn front(&self, case: FrameCase, truth: &Truth, effort: Effort) -> Vec<Row> {
        let qualities = self.qualities(Some(case));
        let rounds = if self.is_large { 1 } else { effort.pick(1, 2) };
        let scene = case.scene();
        let costs = image_costs(truth, rounds, qualities.len(), &|number| {
            Repeated::of(case, scene.clone(), self.size, qualities[number])
        });
        let row = |(quality, cost): (&Quality, ImageCost)| {
            cost.on(whole(self.case(case), name(*quality), self.size))
        };
        qualities.iter().zip(costs).map(row).collect()
    }

    /// A number of a quality in a case.
    pub(in crate::report) fn value(
        &self,
        rows: &[Row],
        case: FrameCase,
        quality: Quality,
        quantity: &str,
    ) -> f64 {
        let quality = if case.has_shadows() { quality } else { usual(quality) };
        value(rows, &self.case(case), &name(quality), quantity)
    }

    /// Between which times half of the frames lay.
    fn quartiles(&self, rows: &[Row], case: FrameCase, quality: Quality) -> [f64; 2] {
        let quality = if case.has_shadows() { quality } else { usual(quality) };
        let (table, variant) = (self.case(case), name(quality));
        let found = rows.iter().find(|row| row.case == table && row.variant == variant);
        found.and_then(|row| row.quartiles(TIME)).unwrap_or([f64::NAN; 2])
    }

    /// Each quality over all scenes.
    pub(in crate::report) fn mean_rows(&self, rows: &[Row]) -> Vec<Row> {
        let mean = |quality: Quality, quantity: &str| {
            geometric_mean(self.cases.iter().map(|&case| self.value(rows, case, quality, quantity)))
        };
        let row = |quality: Quality| {
            let [error, median] = [RMSE, TIME].map(|quantity| mean(quality, quantity));
            let quartile = |which: usize| {
                geometric_mean(self.cases.iter().map(|&case| self.quartiles(rows, case, quality)[which]))
            };
            let time = Spread { low: quartile(0), median, high: quartile(1) };
            whole(self.means(), name(quality), self.size).with(RMSE, error).timed(TIME, time)
        };
        self.qualities(None).into_iter().map(row).collect()
    }
}

/// Of numbers above 0.
pub(in crate::report) fn geometric_mean(values: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0);
    for value in values {
        sum += elementary::ln(value);
        count += 1;
    }
    elementary::exp(sum / f64::from(count.max(1)))
}

/// Keeps only qualities on the front of each table and presets in tables and plots.
pub(in crate::report) fn leave_out_what_is_beaten(rows: &mut [Row]) {
    let point = |row: &Row| Some([row.value(TIME)?, row.value(RMSE)?]);
    let mut cases: Vec<String> =
        rows.iter().filter(|row| point(row).is_some()).map(|row| row.case.clone()).collect();
    cases.dedup();
    for case in cases {
        let points: Vec<[f64; 2]> = rows.iter().filter(|row| row.case == case).filter_map(point).collect();
        let is_beaten = |[x, y]: [f64; 2]| points.iter().any(|&[u, v]| u <= x && v <= y && [u, v] != [x, y]);
        for row in rows.iter_mut().filter(|row| row.case == case) {
            let is_preset = row.variant.ends_with(')');
            row.is_listed = is_preset || !point(row).is_some_and(is_beaten);
        }
    }
}
