//! Five questions that readers have, each answered with the two rows that it compares.

use std::fmt::Write as _;

use super::super::chapter::{number, value};
use super::super::chapters::frames::sweep::geometric_mean;
use super::super::chapters::frames::{RMSE, Sweep, TIME};
use super::super::chapters::rivals;
use super::limits;
use super::recorded::{Recorded, Setting, best_within, settings};
use crate::frames::{FrameCase, name};
use trigon_scene::Shadows;
use trigon_scene::quality::{Preset, Quality};

pub(super) fn write(recorded: &Recorded<'_>, text: &mut String) {
    text.push_str("\n## Five answers\n\n");
    let answers = [
        with_shadows(recorded),
        rays_for_maps(recorded),
        more_samples(recorded),
        llvmpipe(recorded),
        best_image(recorded),
    ];
    for answer in answers {
        let _ = writeln!(text, "- {answer}");
    }
}

/// The settings of a sweep over its scenes with shadows.
fn shadowed(recorded: &Recorded<'_>, sweep: &Sweep) -> Vec<Setting> {
    let cases: Vec<FrameCase> = sweep.cases().iter().copied().filter(|case| case.has_shadows()).collect();
    let setting = |quality: &Quality| {
        let mean = |quantity: &str| {
            geometric_mean(cases.iter().map(|&case| sweep.value(recorded.frames, case, *quality, quantity)))
        };
        Setting { name: name(*quality), time: mean(TIME), quartiles: None, error: mean(RMSE) }
    };
    sweep.qualities(None).iter().map(setting).collect()
}

fn with_shadows(recorded: &Recorded<'_>) -> String {
    let [_, large] = recorded.sweeps();
    let all = shadowed(recorded, &large);
    let question = format!(
        "**Which setting for 16 ms at {}×{} with shadows?** Over the scenes that have them:",
        large.size[0], large.size[1]
    );
    match best_within(&all, 16.0) {
        Some(best) => {
            format!("{question} {}: {} ms, error {}.", best.name, number(best.time), number(best.error))
        }
        None => {
            let fastest = all.iter().min_by(|one, other| one.time.total_cmp(&other.time));
            let words = |one: &Setting| {
                format!(
                    "the fastest, {}, takes {} ms with an error of {}",
                    one.name,
                    number(one.time),
                    number(one.error)
                )
            };
            format!("{question} none on this machine; {}.", fastest.map_or_else(String::new, words))
        }
    }
}

/// One setting instead of another one.
fn instead([one, other]: [&Setting; 2]) -> String {
    format!(
        "{} instead of {} takes {}× the time ({} / {} ms) and has {}× the error ({} / {})",
        one.name,
        other.name,
        number(one.time / other.time),
        number(one.time),
        number(other.time),
        number(one.error / other.error),
        number(one.error),
        number(other.error)
    )
}

fn rays_for_maps(recorded: &Recorded<'_>) -> String {
    let [small, _] = recorded.sweeps();
    let all = shadowed(recorded, &small);
    let high = Preset::High.quality();
    let maps = Quality { shadows: Preset::Draft.quality().shadows, ..high };
    let standard = Preset::Standard.quality();
    let rays = Quality { shadows: Shadows::Rays, ..standard };
    let pair = |pair: [Quality; 2]| {
        let found = pair.map(|quality| all.iter().find(|one| one.name == name(quality)));
        let [Some(one), Some(other)] = found else { return String::new() };
        instead([one, other])
    };
    format!(
        "**What do shadow rays buy over maps of 2048 texels?** Over the scenes with shadows at the small size, {}; {}.",
        pair([high, maps]),
        pair([rays, standard])
    )
}

fn more_samples(recorded: &Recorded<'_>) -> String {
    let [small, large] = recorded.sweeps();
    let [standard, high] = [Preset::Standard, Preset::High].map(Preset::quality);
    let maps = Quality { shadows: standard.shadows, ..high };
    let pair = |sweep: &Sweep, more: Quality| {
        let all = settings(recorded.frames, &sweep.means());
        let found = [more, standard].map(|quality| all.iter().find(|one| one.name == name(quality)).cloned());
        let [Some(one), Some(other)] = found else { return String::new() };
        format!("at {}×{}, {}", sweep.size[0], sweep.size[1], instead([&one, &other]))
    };
    format!(
        "**What do 4×4 samples cost over 2×2?** With the same shadow maps {}; with shadow rays instead of them {}.",
        pair(&small, maps),
        pair(&large, high)
    )
}

/// The renderers of the rivals' tables that are compared, and the quantities.
fn llvmpipe(recorded: &Recorded<'_>) -> String {
    let rival = "llvmpipe, Mesa 26.2.6";
    let [one, four] =
        ["W3-knot-phong", "W6-knot-msaa4"].map(|workload| format!("{workload} as others draw it"));
    let cell = |case: &str, variant: &str| {
        let of = |quantity: &str| number(value(recorded.rivals, case, variant, quantity));
        format!("error {} in {} ms", of(rivals::IMAGE), of(rivals::ONE))
    };
    let supersampled = |side: u32| cell(&one, &format!("{rival}, {side}×{side} samples"));
    format!(
        "**How far is llvmpipe 26.2.6 with several samples?** On one thread, a knot at 1920×1080, errors of 255 in bytes. 1 sample: llvmpipe {}, trigon {}. 4 \
         multisamples: llvmpipe {}, trigon {}. 2×2 shaded samples: llvmpipe {}, trigon {}. 4×4: llvmpipe {}, trigon {}.",
        cell(&one, rival),
        cell(&one, "trigon, draft"),
        cell(&four, rival),
        cell(&four, "trigon"),
        supersampled(2),
        cell(&one, "trigon, standard"),
        supersampled(4),
        cell(&one, "trigon, high"),
    )
}

fn best_image(recorded: &Recorded<'_>) -> String {
    let [small, _] = recorded.sweeps();
    let all = settings(recorded.frames, &small.means());
    let Some(best) = best_within(&all, f64::INFINITY) else { return String::new() };
    let floor = limits::floor(recorded, &small);
    let rest = |error: f64, floor: f64| (error * error - floor * floor).max(0.0).sqrt();
    let worst = |case: &FrameCase| {
        let least = settings(recorded.frames, &small.case(*case))
            .iter()
            .map(|one| one.error)
            .fold(f64::INFINITY, f64::min);
        let rounding = value(
            recorded.frames,
            &small.truths(),
            case.name(),
            super::super::chapters::frames::sweep::ROUNDING,
        );
        (case.name(), rest(least, rounding), rounding)
    };
    let mut scenes: Vec<(&str, f64, f64)> = small.cases().iter().map(worst).collect();
    scenes.sort_by(|one, other| (other.1 / other.2).total_cmp(&(one.1 / one.2)));
    let listed: Vec<String> = scenes
        .iter()
        .take(4)
        .map(|(name, rest, floor)| format!("{name} ({} beside {})", number(*rest), number(*floor)))
        .collect();
    format!(
        "**What limits the best picture?** At the small size {} has an error of {}, of which {} is the rounding to bytes and {} all else. Where the rest is \
         largest beside the rounding: {}.",
        best.name,
        number(best.error),
        number(floor),
        number(rest(best.error, floor)),
        listed.join(", ")
    )
}
