//! What does it cost to mix light as the bytes of a file?

use super::*;
use crate::color::Mixing;
use std::hint::black_box;

const WORST: &str = "worst, linear light";
const DELTA_E: &str = "mean ΔE";
const TIME: &str = "ns per pixel";

const CASE: &str = "half of each of two greys";

pub(super) fn measure(effort: Effort) -> Chapter {
    let times = nanoseconds(effort.rounds(), &Mixing::ALL, |mixing| -> Box<dyn FnMut()> {
        Box::new(move || {
            let pairs = (0..=255).flat_map(|one| (0..=255).map(move |other| (one, other)));
            black_box(pairs.map(|(one, other)| u64::from(mixing.mix(one, other))).sum::<u64>());
        })
    });
    let row = |(mixing, time): (Mixing, Spread)| {
        let error = mixing.error();
        let row = Row::new(CASE, mixing.name()).with(WORST, error.worst).with(DELTA_E, error.delta_e());
        row.timed(TIME, time.per(256 * 256))
    };
    let rows: Vec<Row> = Mixing::ALL.into_iter().zip(times).map(row).collect();
    Chapter {
        name: "color",
        title: "What does it cost to mix light as the bytes of a file?",
        text: "All pairs of grey bytes, averaged: as bytes, in linear light kept in 8 bits, in linear light.",
        findings: vec![
            "The mean of the bytes of black and white is a grey with 22 % of the light of white instead of 50 %.".to_owned(),
        ],
        plots: vec![Plot::trade("mixing", &rows, CASE, [TIME, DELTA_E])],
        images: Vec::new(),
        rows,
    }
}

pub(super) fn headlines() -> Vec<Headline> {
    let [bytes, _, linear] = Mixing::ALL.map(Mixing::name);
    vec![Headline::within(CASE, [linear, bytes], [TIME, DELTA_E])]
}
