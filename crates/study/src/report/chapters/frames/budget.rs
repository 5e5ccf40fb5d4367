//! What a time budget keeps of its promise: on flights, and at rest against all that was measured.

use std::time::{Duration, Instant};

use super::super::*;
use super::sweep::TIME;
use super::whole;
use crate::frames::{FlightSummary, FrameCase, Step, fly, name, stay};

const IN_TIME: &str = "in time, %";
const TIMES: &str = "times foreseen within a fifth, %";
const FORESEEN: &str = "errors foreseen within a fifth, %";
const WORST: &str = "worst miss of an error, %";
const FLIGHT: &str = "a flight with a budget of 16 ms";

/// The table of a budget at rest: each frame's quality by its name, and how many frames it drew.
pub(in crate::report) const REST: &str = "a budget at rest";
pub(in crate::report) const LATE: &str = "frames that were late";
pub(in crate::report) const DRAWN: &str = "frames";

/// The budgets at rest, in milliseconds.
pub(in crate::report) const LIMITS: [u64; 3] = [5, 16, 50];

/// The scenes that are flown past.
fn flown() -> impl Iterator<Item = FrameCase> + Clone {
    FrameCase::ALL.into_iter().take(6)
}

pub(super) fn rows(size: [u32; 2], effort: Effort) -> Vec<Row> {
    let mut rows: Vec<Row> = flown().map(|case| flight(case, size, effort)).collect();
    let limits = effort.pick(&LIMITS[1..2], &LIMITS);
    for &limit in limits {
        rows.extend(FrameCase::ALL.into_iter().flat_map(|case| rest(case, size, limit, effort)));
    }
    rows
}

/// The budget on a case's flight.
fn flight(case: FrameCase, size: [u32; 2], effort: Effort) -> Row {
    let (start, frames) = (Instant::now(), effort.pick(5, 30));
    let limit = Duration::from_millis(16);
    let steps = fly(case, size, limit, frames, &mut || start.elapsed()).expect("the size is in range");
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

/// The budget at the start of a case's flight: a row for each quality that it chose.
fn rest(case: FrameCase, size: [u32; 2], limit: u64, effort: Effort) -> Vec<Row> {
    let (start, frames) = (Instant::now(), effort.pick(4, 16));
    let milliseconds = Duration::from_millis(limit);
    let steps =
        stay(case, size, milliseconds, frames, &mut || start.elapsed()).expect("the size is in range");
    let mut chosen: Vec<(String, [f64; 2])> = Vec::new();
    for (quality, time) in steps {
        let name = name(quality);
        let late = f64::from(u8::from(time > milliseconds));
        match chosen.iter_mut().find(|(known, _)| *known == name) {
            Some((_, [frames, lates])) => (*frames, *lates) = (*frames + 1.0, *lates + late),
            None => chosen.push((name, [1.0, late])),
        }
    }
    let row = |(name, [frames, late]): (String, [f64; 2])| {
        let variant = format!("{} in {limit} ms: {name}", case.name());
        whole(REST, variant, size).by(name).of(case.name()).with(DRAWN, frames).with(LATE, late)
    };
    chosen.into_iter().map(row).collect()
}

pub(super) fn finding(rows: &[Row]) -> String {
    let flight = |case: FrameCase, quantity: &str| number(value(rows, FLIGHT, case.name(), quantity));
    let list = |quantity: &str| flown().map(|case| flight(case, quantity)).collect::<Vec<_>>().join(", ");
    format!(
        "Six flights, with the share of their frames in %, flight by flight. Frames that keep a budget of 16 ms: {}. Frames \
         that take the predicted time, within a fifth: {}. Frames that have the predicted error, within a fifth: {}.",
        list(IN_TIME),
        list(TIMES),
        list(FORESEEN),
    )
}
