//! What a time budget can buy with the qualities that it chooses from, by the recorded times and errors of
//! `docs/accuracy.csv`.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use trigon_scene::Shadows;
use trigon_scene::quality::{Quality, candidates};
use trigon_study::frames::name;

/// Milliseconds a frame, and the root mean square error.
type Recorded = BTreeMap<String, [f64; 2]>;

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
        let [question, scene, variant, _, _, _, _, _, quantity, value, ..] = &cells[..] else { continue };
        let number = match quantity.as_str() {
            "ms per frame" => 0,
            "RMSE in linear light" => 1,
            _ => continue,
        };
        // A name ends with that of its preset.
        if question == "frames" && !scene.starts_with("all scenes") {
            let variant = variant.split(" (").next().expect("there is one").to_owned();
            let pair = scenes.entry(scene.clone()).or_default().entry(variant).or_insert([f64::NAN; 2]);
            pair[number] = value.parse().expect("a number");
        }
    }
    for qualities in scenes.values_mut() {
        qualities.retain(|_, pair| pair.iter().all(|value| value.is_finite()));
    }
    scenes.retain(|_, qualities| qualities.len() > 50);
    scenes
}

/// What was recorded for a quality; scenes without shadows have one name for both of their ways.
fn of(quality: Quality, recorded: &Recorded) -> [f64; 2] {
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
            let least = |qualities: &mut dyn Iterator<Item = [f64; 2]>| {
                qualities.filter(|[time, _]| *time <= budget).map(|[_, error]| error).fold(f64::MAX, f64::min)
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
