//! What a time budget keeps of its promise, on scenes that its constants were not chosen for; and the settings that no other one
//! beats.

use std::fmt::Write as _;

use super::super::chapter::{Row, number};
use super::super::chapters::frames::budget::{DRAWN, LATE, LIMITS, REST};
use super::super::chapters::frames::sweep::geometric_mean;
use super::super::chapters::frames::{RMSE, Sweep, TIME};
use super::recorded::{Recorded, Setting, best_within, settings};
use crate::frames::{FrameCase, name};
use trigon_scene::quality::candidates;

/// A setting counts as beaten by one that is better in both by this factor; less may be chance.
const CHANCE: f64 = 0.95;

pub(super) fn write(recorded: &Recorded<'_>, text: &mut String) {
    let [small, _] = recorded.sweeps();
    text.push_str(
        "\n## What a time budget keeps\n\n`--time-budget` at the small size, on flights through scenes that its constants were not chosen for. At the start of each flight, after calibrating, every frame counts. Where some setting fits into the \
         budget, the error of what the budget chose is divided by the least error that any of the measured settings has within that time. \
         Frames that took longer than the budget have less error, so a mean below 1 says that it was exceeded.\n\n\
         | budget | scenes with a setting that fits | frames in time there | error beside the best, geometric mean | worst scene |\n\
         |---|--:|--:|--:|--:|\n",
    );
    for limit in LIMITS {
        let scenes: Vec<Compliance> =
            small.cases().iter().filter_map(|&case| compliance(recorded, &small, case, limit)).collect();
        if scenes.is_empty() {
            continue;
        }
        let frames: f64 = scenes.iter().map(|one| one.frames).sum();
        let late: f64 = scenes.iter().map(|one| one.late).sum();
        let worst = scenes.iter().max_by(|one, other| one.ratio.total_cmp(&other.ratio));
        let _ = writeln!(
            text,
            "| {limit} ms | {} of {} | {} % of {frames} | {} | {} |",
            scenes.len(),
            small.cases().len(),
            number(100.0 * (1.0 - late / frames)),
            number(geometric_mean(scenes.iter().map(|one| one.ratio))),
            worst.map_or_else(String::new, |one| format!("{} ({})", number(one.ratio), one.scene))
        );
    }
    let front: Vec<String> = front(&settings(recorded.frames, &small.means()));
    let chosen: Vec<String> = candidates().map(name).to_vec();
    let _ = write!(
        text,
        "\nSettings that no other one beats over all scenes by more than {} % in both: {}. The budget chooses from: {}. If each scene could choose only from \
         what none beats over the eleven others, its error within 5, 16 and 50 ms would be {} times the least, in the geometric mean.\n",
        number(100.0 * (1.0 - CHANCE)),
        front.join("; "),
        chosen.join("; "),
        number(left_out(recorded, &small)),
    );
}

/// What a budget did in a scene in which some setting fits into it.
struct Compliance {
    scene: &'static str,
    frames: f64,
    late: f64,
    ratio: f64,
}

fn compliance(recorded: &Recorded<'_>, sweep: &Sweep, case: FrameCase, limit: u64) -> Option<Compliance> {
    let all = settings(recorded.frames, &sweep.case(case));
    let best = best_within(&all, limit as f64)?;
    let start = format!("{} in {limit} ms: ", case.name());
    let rows: Vec<&Row> =
        recorded.frames.iter().filter(|row| row.case == REST && row.variant.starts_with(&start)).collect();
    let sum = |quantity: &str| rows.iter().filter_map(|row| row.value(quantity)).sum::<f64>();
    let (frames, late) = (sum(DRAWN), sum(LATE));
    let ratios = rows.iter().filter_map(|row| {
        let chosen = all.iter().find(|one| one.name == row.conditions.algorithm)?;
        Some((chosen.error / best.error, row.value(DRAWN)? as usize))
    });
    let each: Vec<f64> = ratios.flat_map(|(ratio, frames)| std::iter::repeat_n(ratio, frames)).collect();
    (!each.is_empty()).then(|| Compliance {
        scene: case.name(),
        frames,
        late,
        ratio: geometric_mean(each.into_iter()),
    })
}

/// The names of those that none beats by more than chance.
fn front(all: &[Setting]) -> Vec<String> {
    let mut front: Vec<&Setting> =
        all.iter().filter(|one| !all.iter().any(|other| beats(other, one))).collect();
    front.sort_by(|one, other| one.time.total_cmp(&other.time));
    front.into_iter().map(|one| one.name.clone()).collect()
}

fn beats(one: &Setting, other: &Setting) -> bool {
    one.time < CHANCE * other.time && one.error < CHANCE * other.error
}

/// The error of settings that others chose for a scene, divided by the least.
fn left_out(recorded: &Recorded<'_>, sweep: &Sweep) -> f64 {
    let scene = |case: FrameCase| -> Vec<Setting> {
        let value = |quality, quantity: &str| sweep.value(recorded.frames, case, quality, quantity);
        let qualities = sweep.qualities(None).into_iter();
        let setting = |quality| Setting {
            name: name(quality),
            time: value(quality, TIME),
            quartiles: None,
            error: value(quality, RMSE),
        };
        qualities.map(setting).collect()
    };
    let scenes: Vec<Vec<Setting>> = sweep.cases().iter().map(|&case| scene(case)).collect();
    let ratios = (0..scenes.len()).flat_map(|own| {
        let others: Vec<&Vec<Setting>> =
            scenes.iter().enumerate().filter(|(index, _)| *index != own).map(|(_, one)| one).collect();
        let mean = |index: usize| Setting {
            time: geometric_mean(others.iter().map(|scene| scene[index].time)),
            error: geometric_mean(others.iter().map(|scene| scene[index].error)),
            ..scenes[own][index].clone()
        };
        let names = front(&(0..scenes[own].len()).map(mean).collect::<Vec<_>>());
        let listed: Vec<Setting> =
            scenes[own].iter().filter(|one| names.contains(&one.name)).cloned().collect();
        LIMITS
            .into_iter()
            .filter_map(|limit| {
                let [chosen, best] =
                    [&listed, &scenes[own]].map(|all| best_within(all, limit as f64).map(|one| one.error));
                Some(chosen? / best?)
            })
            .collect::<Vec<f64>>()
    });
    geometric_mean(ratios)
}
