//! What a time budget can buy with the qualities that it chooses from, and what it does buy, by the recorded times and errors of
//! `docs/accuracy.csv`.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use trigon_math::elementary;
use trigon_scene::quality::{Preset, candidates};
use trigon_study::frames::{FrameCase, name, usual};

/// The numbers of a row by their columns.
type Values = BTreeMap<String, f64>;

/// Milliseconds a frame, and the root mean square error.
type Cost = [f64; 2];

/// All rows about whole frames, by table and name.
fn recorded() -> BTreeMap<[String; 2], Values> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../docs/accuracy.csv");
    let text = fs::read_to_string(path).expect("the study has written it");
    let mut rows: BTreeMap<[String; 2], Values> = BTreeMap::new();
    for line in text.lines() {
        let cells = cells(line);
        let [question, table, variant, _, _, _, _, _, quantity, value, ..] = &cells[..] else { continue };
        if question == "frames" {
            let row = rows.entry([table.clone(), variant.clone()]).or_default();
            row.insert(quantity.clone(), value.parse().expect("a number"));
        }
    }
    rows
}

/// Names with commas are quoted.
fn cells(line: &str) -> Vec<String> {
    let (mut cells, mut is_quoted) = (vec![String::new()], false);
    for character in line.chars() {
        match character {
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => cells.push(String::new()),
            _ => cells.last_mut().expect("there is one").push(character),
        }
    }
    cells
}

/// The costs of all qualities in a table.
fn costs(rows: &BTreeMap<[String; 2], Values>, table: &str) -> BTreeMap<String, Cost> {
    let of_table = rows.iter().filter(|([own, _], _)| own == table);
    let cost = of_table.filter_map(|([_, variant], values)| {
        Some((variant.clone(), [*values.get("ms per frame")?, *values.get("RMSE in linear light")?]))
    });
    cost.collect()
}

/// The costs of those that a budget chooses from.
fn chosen(case: FrameCase, all: &BTreeMap<String, Cost>) -> Vec<Cost> {
    let own = |quality| if case.has_shadows() { quality } else { usual(quality) };
    // Without shadows those of 4×4 samples are `high`, but for how they occlude ambient light.
    let samples = |name: &str| name.split(" (").next().map(str::to_owned);
    let cost = |quality| {
        let name = name(own(quality));
        let found = all.iter().find(|(known, _)| samples(known) == samples(&name));
        *found.unwrap_or_else(|| panic!("{name} is recorded")).1
    };
    candidates().into_iter().map(cost).collect()
}

/// The least error within a time.
fn least(qualities: impl IntoIterator<Item = Cost>, budget: f64) -> Option<f64> {
    let fits = qualities.into_iter().filter(|[time, _]| *time <= budget);
    fits.map(|[_, error]| error).min_by(f64::total_cmp)
}

fn geometric_mean(ratios: &[f64]) -> f64 {
    let sum: f64 = ratios.iter().map(|ratio| elementary::ln(*ratio)).sum();
    elementary::exp(sum / ratios.len() as f64)
}

/// In the geometric mean. At worst it is one step on the frontier, from one shaded sample to four of them, which takes away up to two
/// thirds of the error: two settings whose times differ by less than their quartiles may lie on both sides of a budget.
#[test]
fn no_quality_would_buy_much_more_accuracy_for_the_same_time() {
    let rows = recorded();
    let mut ratios = Vec::new();
    for case in FrameCase::ALL {
        let all = costs(&rows, case.name());
        assert!(all.len() >= 26, "{}: {} qualities", case.name(), all.len());
        for budget in [5.0, 8.0, 12.0, 16.0, 20.0, 33.0, 50.0, 100.0] {
            let best = least(all.values().copied(), budget);
            if let (Some(chosen), Some(best)) = (least(chosen(case, &all), budget), best) {
                assert!(chosen / best < 3.2, "{}, {budget} ms: {}", case.name(), chosen / best);
                ratios.push(chosen / best);
            }
        }
    }
    assert!(ratios.len() > 60, "{} budgets", ratios.len());
    assert!(geometric_mean(&ratios) < 1.1, "{}", geometric_mean(&ratios));
}

/// Over all scenes none of them is beaten, and none that no other one beats is missing.
#[test]
fn candidates_are_the_qualities_that_none_beats() {
    let all = costs(&recorded(), "all scenes, geometric means");
    let own: Vec<(String, Cost)> = candidates().map(|quality| (name(quality), all[&name(quality)])).to_vec();
    let beats = |one: &Cost, other: &Cost, by: f64| (0..2).all(|axis| one[axis] < by * other[axis]);
    for (name, cost) in &own {
        let better: Vec<&String> =
            all.iter().filter(|(_, other)| beats(other, cost, 0.9)).map(|(name, _)| name).collect();
        assert!(better.is_empty(), "{name} is beaten by {better:?}");
    }
    // A missing one beats all candidates of about its time by a sixth.
    let is_like = |one: &Cost, other: &Cost| (0..2).all(|axis| other[axis] <= 1.15 * one[axis]);
    let missing = all.iter().filter(|(_, cost)| {
        own.iter().all(|(_, other)| !is_like(cost, other))
            && !all.values().any(|other| beats(other, cost, 1.0))
    });
    let missing: Vec<&str> = missing.map(|(name, _)| name.as_str()).collect();
    assert!(missing.is_empty(), "{missing:?}");
    let presets = Preset::ALL.map(|preset| name(preset.quality()));
    assert!(
        presets.iter().all(|preset| own.iter().any(|(name, _)| name == preset)),
        "presets are candidates"
    );
}

/// The README says of `--time-budget`: "about as accurate as the budget allows". That is: at rest, on scenes that its constants were
/// not chosen for, at most half as much again as the least error that any quality has within the time.
#[test]
fn a_budget_is_used_about_as_well_as_it_allows() {
    let readme = fs::read_to_string(PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../README.md"))
        .expect("it is there");
    assert!(readme.contains("about as accurate as the budget allows"), "that is what is promised");
    let rows = recorded();
    for limit in [5, 16, 50] {
        let mut ratios = Vec::new();
        for case in FrameCase::ALL {
            let all = costs(&rows, case.name());
            let Some(best) = least(all.values().copied(), f64::from(limit)) else { continue };
            let start = format!("{} in {limit} ms: ", case.name());
            for ([table, variant], values) in &rows {
                if let Some(quality) = variant.strip_prefix(&start)
                    && table == "a budget at rest"
                {
                    let ratio = all[quality][1] / best;
                    ratios.extend(std::iter::repeat_n(ratio, values["frames"] as usize));
                }
            }
        }
        assert!(ratios.len() >= 80, "{limit} ms fits in fewer than five scenes: {} frames", ratios.len());
        let mean = geometric_mean(&ratios);
        assert!(mean <= 1.5, "{limit} ms: {mean} times the least error");
    }
}
