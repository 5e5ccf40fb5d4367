//! The table "this much time, this setting, this error, and what limits it".

use std::fmt::Write as _;

use super::super::chapter::{Row, number, quartile_words, value};
use super::super::chapters::frames::sweep::{ROUNDING, geometric_mean};
use super::super::chapters::frames::{Sweep, TIME};
use super::recorded::{Recorded, Setting, best_within, settings};

/// The budgets, in milliseconds.
const BUDGETS: [f64; 5] = [2.0, 5.0, 16.0, 50.0, 200.0];

/// Less error than this part of it is worth a word.
const WORTH: f64 = 0.9;

pub(super) fn write(recorded: &Recorded<'_>, text: &mut String) {
    let sweeps = recorded.sweeps();
    text.push_str("## What do 2, 5, 16, 50 and 200 ms buy?\n\nGeometric means over twelve scenes, and over four of them at 1920×1080, of medians and, in parentheses, of quartiles. What limits an image is the one change that takes away most of its \
         error, whatever it costs: more shaded samples, more samples of coverage, shadow rays instead of maps, or lighting per pixel.\n");
    for sweep in &sweeps {
        let [width, height] = sweep.size;
        let all = settings(recorded.frames, &sweep.means());
        let floor = floor(recorded, sweep);
        let _ = write!(
            text,
            "\n| {width}×{height} | setting | takes | error | what limits it |\n|---|---|--:|--:|---|\n"
        );
        for budget in BUDGETS {
            let _ = match best_within(&all, budget) {
                Some(best) => writeln!(
                    text,
                    "| {budget} ms | {} | {}{} ms | {} | {} |",
                    best.name,
                    number(best.time),
                    quartile_words(best.quartiles),
                    number(best.error),
                    limit(best, &all, floor)
                ),
                None => {
                    let least = all.iter().map(|one| one.time).fold(f64::INFINITY, f64::min);
                    writeln!(text, "| {budget} ms | nothing fits | {} ms at least | – | – |", number(least))
                }
            };
        }
    }
}

/// The error of the right images as bytes, over all scenes.
pub(super) fn floor(recorded: &Recorded<'_>, sweep: &Sweep) -> f64 {
    let rounding = |name: &str| value(recorded.frames, &sweep.truths(), name, ROUNDING);
    geometric_mean(sweep.cases().iter().map(|case| rounding(case.name())))
}

/// What stands between a setting and less error.
pub(super) fn limit(of: &Setting, all: &[Setting], floor: f64) -> String {
    let changes = all.iter().filter_map(|other| Some((change(&of.name, &other.name)?, other)));
    let best = changes.min_by(|(_, one), (_, other)| one.error.total_cmp(&other.error));
    match best {
        Some((what, other)) if other.error < WORTH * of.error => {
            format!("{what}: {} has {} of the error", other.name, number(other.error / of.error))
        }
        _ => {
            let rest = (of.error * of.error - floor * floor).max(0.0).sqrt();
            format!(
                "no single change takes away much: {} of it is rounding to bytes, {} the rest (their squares add up)",
                number(floor),
                number(rest)
            )
        }
    }
}

/// Pairs of settings in the same scene of which one has at least twice the samples of the other and else is the same, and
/// those among them whose times contradict that: the one with more is faster, and the quartiles of both lie apart.
pub(in crate::report) fn contradictions(rows: &[Row]) -> [usize; 2] {
    let means = [Sweep::small, Sweep::large].map(|sweep| sweep([1, 1]).means());
    let mut counts = [0; 2];
    for less in rows.iter().filter(|row| !means.contains(&row.case)) {
        for more in rows.iter().filter(|more| more.case == less.case) {
            let [Some([low, _]), Some([_, high])] = [less.quartiles(TIME), more.quartiles(TIME)] else {
                continue;
            };
            if is_twice(&less.variant, &more.variant) {
                counts[0] += 1;
                counts[1] += usize::from(high < low);
            }
        }
    }
    counts
}

/// The one thing that differs between two settings, if the second has more of it.
fn change(from: &str, to: &str) -> Option<&'static str> {
    let (one, other) = (parts(from)?, parts(to)?);
    let is_same = |one: &Parts, other: &Parts| (one.axis, one.samples) == (other.axis, other.samples);
    if one.shading != other.shading {
        let is_shading_alone = is_same(&one, &other) && one.has_rays == other.has_rays;
        return (is_shading_alone && other.shading.is_empty()).then_some("lighting per vertex or triangle");
    }
    if is_same(&one, &other) {
        return (!one.has_rays && other.has_rays).then_some("shadow maps");
    }
    if one.has_rays != other.has_rays {
        return None;
    }
    let is_next_axis = other.axis > one.axis && one.samples == other.samples;
    let is_more_samples = other.samples > one.samples && one.axis == other.axis;
    if is_next_axis { Some("shaded samples") } else { is_more_samples.then_some("samples of coverage") }
}

/// Whether a setting has at least twice the samples of one that else is the same.
fn is_twice(less: &str, more: &str) -> bool {
    let (Some(one), Some(other)) = (parts(less), parts(more)) else { return false };
    let is_like = (one.shading, one.has_rays) == (other.shading, other.has_rays);
    let (shaded, covered) = (other.axis >= one.axis, other.samples >= one.samples);
    let twice = other.axis * other.axis * other.samples >= 2 * one.axis * one.axis * one.samples;
    is_like && shaded && covered && twice
}

/// A name as `crate::frames::name` makes it.
struct Parts {
    axis: u32,
    samples: u32,
    has_rays: bool,
    shading: &'static str,
}

fn parts(name: &str) -> Option<Parts> {
    let name = name.split(" (").next()?;
    let (numbers, rest) = name.split_once(", ").unwrap_or((name, ""));
    let mut numbers = numbers.split('×').map(|number| number.parse::<u32>().ok());
    let [axis, _, samples] = [(); 3].map(|()| numbers.next().flatten());
    let axis = axis?;
    let shading = ["flat", "Gouraud"].into_iter().find(|shading| rest.contains(shading)).unwrap_or("");
    let has_rays = if axis > 2 { !rest.contains("shadow maps") } else { rest.contains("shadow rays") };
    Some(Parts { axis, samples: samples?, has_rays, shading })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frames::{name, other_shadows, variants};

    fn setting(name: &str, error: f64) -> Setting {
        Setting { name: name.to_owned(), time: 1.0, quartiles: None, error }
    }

    #[test]
    fn names_are_taken_apart() {
        for quality in variants().into_iter().chain(other_shadows()) {
            let parts = parts(&name(quality)).expect("a name");
            assert_eq!((parts.axis, parts.samples), (quality.samples_per_axis, quality.samples), "{quality}");
            assert_eq!(parts.has_rays, quality.shadows == trigon_scene::Shadows::Rays, "{quality}");
        }
    }

    #[test]
    fn the_largest_gain_is_the_limit() {
        let own = setting("2×2×1 (standard)", 4.0);
        let all = [
            own.clone(),
            setting("2×2×4", 3.9),
            setting("2×2×1, shadow rays", 3.0),
            setting("3×3×1, shadow maps", 2.0),
        ];
        assert_eq!(limit(&own, &all, 1.0), "shaded samples: 3×3×1, shadow maps has 0.500 of the error");
        assert!(limit(&own, &all[..3], 1.0).starts_with("shadow maps: "), "without it");
        let by_vertex = setting("2×2×1, Gouraud", 9.0);
        assert!(
            limit(&by_vertex, &all, 1.0).starts_with("lighting per vertex or triangle: 2×2×1 (standard)")
        );
        assert_eq!(
            limit(&own, &all[..2], 2.4),
            "no single change takes away much: 2.40 of it is rounding to bytes, 3.20 the rest (their squares add up)"
        );
    }
}
