//! What the report says of whole frames, as far as it is about errors.

use super::miss;
use super::*;
use crate::workloads::Workload;
use std::time::Duration;

const SIZE: [u32; 2] = [60, 36];

/// Some scenes, each with something that the others lack. All have their truth in the published rows.
const CASES: [FrameCase; 4] = [FrameCase::Showcase, FrameCase::Shadows, FrameCase::Chair, FrameCase::Layers];

fn truth(case: FrameCase) -> Truth {
    let (scene, settings) = (case.scene(), case.settings(SIZE));
    Truth::new(&scene, &case.camera(&scene, settings.aspect(), 0.0), &settings).unwrap()
}

/// What one more setting gains is little: on so small images chance decides about so much.
const CHANCE: f64 = 0.85;

#[test]
fn each_preset_is_nearer_than_the_one_before() {
    let presets = Preset::ALL.map(Preset::quality);
    for case in CASES {
        let errors = errors(case, &truth(case), SIZE, &presets).unwrap();
        let [draft, standard, high, reference] = errors[..] else { panic!("{errors:?}") };
        let is_nearer = standard < draft && high < standard && CHANCE * reference < high;
        assert!(is_nearer, "{}: {errors:?}", case.name());
    }
}

#[test]
fn all_qualities_have_names_of_their_own() {
    let (all, others) = (variants(), other_shadows());
    assert_eq!((all.len(), others.len()), (26, 12), "4 grids, 5 numbers of samples; and other shadows");
    let mut names: Vec<String> = all.iter().chain(&others).map(|&quality| name(quality)).collect();
    assert_eq!(names.iter().filter(|name| name.ends_with(')')).count(), 4, "the presets: {names:?}");
    names.sort();
    names.dedup();
    assert_eq!(names.len(), 38, "each has a name of its own");
}

/// No quality that does less of everything is nearer to the truth. Times are not asked: `published` holds the presets to
/// those that were measured.
#[test]
fn nothing_that_does_less_is_better_than_a_preset() {
    let (case, qualities) = (FrameCase::Shadows, variants());
    let errors = errors(case, &truth(case), SIZE, &qualities).unwrap();
    let of = |preset: Preset| {
        let index = qualities.iter().position(|quality| *quality == preset.quality());
        errors[index.expect("presets are among them")]
    };
    for preset in Preset::ALL {
        let less =
            qualities.iter().zip(&errors).filter(|(quality, _)| preset.quality().is_finer_than(quality));
        for (quality, error) in less {
            let own = of(preset);
            assert!(*error >= CHANCE * own, "{error} with {quality}, {own} with {preset}");
        }
    }
}

#[test]
fn light_once_for_each_triangle_is_worse_than_at_its_corners() {
    let draft = Preset::Draft.quality();
    let qualities = [ShadingModel::Flat, ShadingModel::Gouraud].map(|shading| Quality { shading, ..draft });
    let errors = errors(FrameCase::Showcase, &truth(FrameCase::Showcase), SIZE, &qualities).unwrap();
    assert!(errors[0] > errors[1], "flat, Gouraud: {errors:?}");
}

/// The truth ignores light meters: every scene is as bright as a display shows.
#[test]
fn no_scene_is_metered() {
    for case in FrameCase::ALL {
        let scene = case.scene();
        assert!(scene.light_reading().is_none_or(|reading| reading.is_in_range()), "{}", case.name());
    }
}

#[test]
fn a_budget_at_rest_is_measured() {
    let mut now = Duration::ZERO;
    let mut clock = move || {
        now += Duration::from_millis(1);
        now
    };
    let limit = Duration::from_millis(16);
    let steps = stay(FrameCase::Corner, [30, 18], limit, 4, &mut clock).unwrap();
    assert_eq!(steps.len(), 4, "every frame");
    let all = [variants(), other_shadows()].concat();
    assert!(steps.iter().all(|(quality, _)| all.contains(quality)), "as the sweep names them: {steps:?}");
}

#[test]
fn flights_are_measured() {
    // Every question takes a tenth of a second: nothing fits but what is asked for first.
    let mut now = Duration::ZERO;
    let mut clock = move || {
        now += Duration::from_millis(100);
        now
    };
    let steps = fly(FrameCase::Showcase, [30, 18], Duration::from_millis(16), 6, &mut clock).unwrap();
    assert_eq!(steps.len(), 6, "every frame");
    assert!(steps.iter().all(|step| step.choice.chosen.quality.covered_samples() == 1), "the quickest");
    assert!(steps.iter().all(|step| step.drawing < step.time && step.error > 0.0), "{steps:?}");
    let summary = FlightSummary::of(&steps);
    assert_eq!(summary.in_time, 0.0, "on a clock like that no frame is in time");
    assert!(summary.worst > 0.0, "nothing is foreseen exactly: {summary:?}");
    let foreseen = |step: &Step| {
        let choice = step.choice.chosen;
        Step { drawing: choice.time, error: choice.error.unwrap(), ..*step }
    };
    let summary = FlightSummary::of(&steps.iter().map(foreseen).collect::<Vec<_>>());
    assert_eq!(
        (summary.times, summary.errors, summary.worst),
        (1.0, 1.0, 0.0),
        "unless it comes as foreseen"
    );
}

#[test]
fn models_stand_on_their_floor() {
    for case in [FrameCase::Teapot, FrameCase::Chair, FrameCase::Mug] {
        let bounds = case.scene().bounds();
        // Vertices are f32.
        let is_near = |index: f64, right: f64| (index - right).abs() < 1e-6;
        assert!(is_near(bounds.min.y, 0.0) && is_near(bounds.max.y, 1.0), "{}: {bounds:?}", case.name());
    }
}

#[test]
fn misses_are_parts_of_what_was_measured() {
    assert_eq!([miss(0.8, 1.0), miss(1.25, 1.0), miss(0.0, 0.0)], [1.0 - 0.8, 0.25, 0.0], "either way");
}

#[test]
fn most_of_a_smooth_image_is_certified() {
    let proven = Prover::new(Workload::KnotPhong, 8).unwrap().prove().unwrap();
    let sum = proven.certified + proven.visibility + proven.color;
    // Three quotients by the same number: a few roundings.
    assert!((sum - 1.0).abs() < 1e-12, "every pixel is one of three: {proven:?}");
    assert!(proven.visibility > 0.0 && proven.certified > 0.0, "some of each: {proven:?}");
}
