//! What a time budget can buy with the qualities that it chooses from, by the recorded times and errors of
//! `docs/accuracy.csv`.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use trigon_scene::Shadows;
use trigon_scene::quality::{Quality, candidates};
use trigon_study::frames::name;

/// The milliseconds of a frame, between which values half of the frames lay, and the root mean square error.
#[derive(Clone, Copy)]
struct Figures {
    time: f64,
    low: f64,
    high: f64,
    error: f64,
}

type Recorded = BTreeMap<String, Figures>;

/// By scene, and by the name of the quality.
fn recorded() -> BTreeMap<String, Recorded> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../docs/accuracy.csv");
    let text = fs::read_to_string(path).expect("the study has written it");
    let mut scenes: BTreeMap<String, Recorded> = BTreeMap::new();
    for line in text.lines() {
        // Names with commas are quoted.
        let mut cells: Vec<String> = vec![String::new()];
        let mut is_quoted = false;
        for character in line.chars() {
            match character {
                '"' => is_quoted = !is_quoted,
                ',' if !is_quoted => cells.push(String::new()),
                _ => cells.last_mut().expect("there is one").push(character),
            }
        }
        let [question, scene, variant, _, _, _, _, _, quantity, value, low, high] = &cells[..] else {
            continue;
        };
        // A name ends with that of its preset.
        if question == "frames" && !scene.starts_with("all scenes") {
            let variant = variant.split(" (").next().expect("there is one").to_owned();
            let unknown = Figures { time: f64::NAN, low: f64::NAN, high: f64::NAN, error: f64::NAN };
            let figures = scenes.entry(scene.clone()).or_default().entry(variant).or_insert(unknown);
            let [value, low, high] = [value, low, high].map(|number| number.parse().expect("a number"));
            match quantity.as_str() {
                "ms per frame" => (figures.time, figures.low, figures.high) = (value, low, high),
                "RMSE in linear light" => figures.error = value,
                _ => {}
            }
        }
    }
    for qualities in scenes.values_mut() {
        qualities.retain(|_, figures| figures.time.is_finite() && figures.error.is_finite());
    }
    scenes.retain(|_, qualities| qualities.len() > 50);
    scenes
}

/// What was recorded for a quality; scenes without shadows have one name for both of their ways.
fn of(quality: Quality, recorded: &Recorded) -> Figures {
    let own = |quality| recorded.get(name(quality).split(" (").next().expect("there is one"));
    let other = Quality {
        shadows: match quality.shadows {
            Shadows::Rays => Shadows::Maps { resolution: 2048 },
            shadows => {
                if quality.samples_per_axis > 2 {
                    Shadows::Rays
                } else {
                    shadows
                }
            }
        },
        ..quality
    };
    *own(quality).or_else(|| own(other)).unwrap_or_else(|| panic!("{quality} is recorded"))
}

/// With twelve candidates, of which those with 3×3 samples and more had shadow rays, it was 1.35, and 3.3 at worst.
#[test]
fn no_quality_would_buy_much_more_accuracy_for_the_same_time() {
    let scenes = recorded();
    assert_eq!(scenes.len(), 6, "{:?}", scenes.keys());
    let mut logarithms = Vec::new();
    for (scene, all) in &scenes {
        for budget in [5.0, 8.0, 12.0, 16.0, 20.0, 33.0, 50.0, 100.0] {
            let least = |qualities: &mut dyn Iterator<Item = Figures>| {
                let within = qualities.filter(|figures| figures.time <= budget);
                within.map(|figures| figures.error).fold(f64::MAX, f64::min)
            };
            let best = least(&mut all.values().copied());
            let chosen = least(&mut candidates().into_iter().map(|quality| of(quality, all)));
            if chosen < f64::MAX {
                let ratio = chosen / best;
                assert!(ratio < 1.8, "{scene}, {budget} ms: {ratio} times the error");
                logarithms.push(trigon_math::elementary::ln(ratio));
            }
        }
    }
    assert!(logarithms.len() > 40, "{} budgets", logarithms.len());
    let mean = logarithms.iter().sum::<f64>() / logarithms.len() as f64;
    assert!(mean < trigon_math::elementary::ln(1.1), "in the geometric mean e^{mean}");
}

/// A quality that another one beats beyond doubt in most scenes would only cost calibration.
#[test]
fn no_candidate_is_dominated_in_most_scenes() {
    let scenes = recorded();
    for candidate in candidates() {
        let is_dominated = |all: &Recorded| {
            let own = of(candidate, all);
            all.values().any(|other| other.high < own.low && other.error <= own.error)
        };
        let count = scenes.values().filter(|all| is_dominated(all)).count();
        assert!(2 * count <= scenes.len(), "{candidate} is dominated in {count} scenes");
    }
}
