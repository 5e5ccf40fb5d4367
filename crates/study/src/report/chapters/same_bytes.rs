//! What do the same bytes everywhere cost?

use super::*;
use crate::same_bytes::{PIXELS, Rules, SIZE};

const RMSE: &str = "RMSE, linear light";
const WORST: &str = "worst pixel";
const OTHER: &str = "bytes unlike ours, ‰";
const TIME: &str = "ns per pixel";

const CASE: &str = "a lit triangle";

pub(super) fn measure(effort: Effort) -> Chapter {
    /// Images in a run, so that it takes some milliseconds.
    const IMAGES: usize = 16;
    let times = nanoseconds(effort.rounds(), &Rules::ALL, |rules| -> Box<dyn FnMut()> {
        let mut draw = rules.repeated();
        Box::new(move || (0..IMAGES).for_each(|_| draw()))
    });
    let row = |(rules, time): (Rules, Spread)| {
        let error = rules.error();
        Row::new(CASE, rules.name())
            .sized(SIZE)
            .with(RMSE, error.rmse())
            .with(WORST, error.worst)
            .with(OTHER, rules.other_bytes_per_mille())
            .timed(TIME, time.per(IMAGES * PIXELS))
    };
    Chapter {
        name: "same-bytes",
        title: "What do the same bytes everywhere cost?",
        text: "A kernel of perspective and Blinn-Phong shading, eight pixels at a time with the processor's best vectors. It follows the \
               renderer's rules, or fuses products with sums, or estimates reciprocals, too. All three are compared with the \
               formula in `f64`. What the last two give, errors included, depends on the processor.",
        findings: Vec::new(),
        plots: Vec::new(),
        images: Vec::new(),
        rows: Rules::ALL.into_iter().zip(times).map(row).collect(),
    }
}

pub(super) fn headlines() -> Vec<Headline> {
    let [ours, fused, estimated] = Rules::ALL.map(Rules::name);
    let of = |rules: [&'static str; 2]| Headline::within(CASE, rules, [TIME, RMSE]);
    vec![of([ours, fused]), of([ours, estimated])]
}
