//! Budgets on invented machines, and errors of real images.

use std::time::Duration;

use trigon_camera::Camera;
use trigon_math::{DQuat, DVec3};

use super::*;
use crate::{Frame, RenderSettings, Renderer, Scene, ShadingModel, Shadows, render, showcase};

const LIMIT: Duration = Duration::from_millis(16);

/// What a frame takes on an invented machine.
fn invented(settings: &RenderSettings, slowness: f64) -> Duration {
    let quality = Quality::of(settings);
    let samples = f64::from(quality.shaded_samples()) * (1.0 + 0.3 * f64::from(quality.samples - 1));
    Duration::from_secs_f64(slowness * (0.5e-3 + 1e-3 * samples))
}

/// Draws nothing, but takes an invented time for it.
fn pretend(budget: &mut TimeBudget, slowness: f64) -> (Choice, Duration) {
    let mut settings = RenderSettings::new(640, 400);
    let choice = budget.choose(&settings);
    choice.chosen.quality.apply(&mut settings);
    let time = invented(&settings, slowness);
    budget.took(&choice, &settings, time);
    (choice, time)
}

#[test]
fn the_budget_is_kept_while_the_scene_changes() {
    let mut budget = TimeBudget::new(LIMIT);
    for _ in 0..20 {
        pretend(&mut budget, 1.0);
    }
    let mut late = 0;
    for frame in 0..200 {
        // Twice as slow and back, slowly.
        let slowness = 2.0 - f64::from(frame - 100_i32).abs() / 100.0;
        late += usize::from(pretend(&mut budget, slowness).1 > LIMIT);
    }
    assert!(late <= 10, "of 200 frames {late} are late");
}

#[test]
fn the_most_accurate_that_fits_is_found() {
    let mut budget = TimeBudget::new(LIMIT);
    let (choice, time) = (0..80).map(|_| pretend(&mut budget, 1.0)).last().expect("some");
    assert!(choice.fits && time <= LIMIT, "{choice}");
    // 0.5 + 9 · 1.3 = 12.2 ms; 4×4 samples take 16.5 ms.
    assert_eq!(choice.chosen.quality.covered_samples(), 18, "{choice}");
    assert_eq!(choice.given_up.expect("there are better ones").quality.shaded_samples(), 16, "{choice}");
}

#[test]
fn what_never_fits_is_drawn_as_quickly_as_possible() {
    let mut budget = TimeBudget::new(LIMIT);
    let (choice, _) = (0..10).map(|_| pretend(&mut budget, 100.0)).last().expect("some");
    assert_eq!(choice.chosen.quality.covered_samples(), 1, "{choice}");
    assert!(!choice.fits && choice.to_string().contains("the fastest setting takes"), "{choice}");
}

#[test]
fn what_somebody_insists_on_is_not_traded() {
    let mut budget = TimeBudget::new(LIMIT).insisting(|quality| Quality {
        samples_per_axis: 2,
        samples: 1,
        shading: ShadingModel::Phong,
        ..quality
    });
    assert_eq!(budget.limit(), LIMIT, "of the same time");
    let (choice, _) = pretend(&mut budget, 1000.0);
    assert_eq!((choice.chosen.quality.samples_per_axis, choice.chosen.quality.samples), (2, 1), "{choice}");
    assert!(choice.given_up.is_none(), "nothing else is told apart: {choice}");
}

#[test]
fn a_choice_says_what_it_gives_up() {
    let error = |error| Some(error);
    let [standard, high] = [Preset::Standard, Preset::High].map(Preset::quality);
    let quality = |quality: Quality| quality.within(&RenderSettings::new(1, 1));
    let choice = Choice {
        chosen: Prediction { quality: quality(standard), time: LIMIT / 2, error: error(0.00337) },
        limit: LIMIT,
        fits: true,
        given_up: Some(Prediction { quality: quality(high), time: 2 * LIMIT, error: error(0.0012) }),
        reference: quality(Preset::Reference.quality()),
    };
    assert_eq!(
        choice.to_string(),
        "2×2 samples, lighting per pixel: about 8.0 ms of 16.0 ms, error about 0.0034; gave up 4×4 samples, \
         lighting per pixel (about 32.0 ms, error about 0.0012); errors are RMSE in linear light \
         against 4×4 samples of 16, lighting per pixel",
        "in one line"
    );
}

/// Around the scene, and nearer.
fn flight(scene: &Scene, part: f64) -> Camera {
    let (_, start) = scene.cameras()[0];
    let turn = DQuat::from_axis_angle(DVec3::Y, 0.3 * part);
    let position = turn * start.position * (1.0 - 0.1 * part);
    Camera { position, orientation: (turn * start.orientation).normalize(), ..start }
}

fn drawn(scene: &Scene, part: f64, preset: Preset) -> Frame {
    let mut settings = RenderSettings::new(80, 48);
    settings.effects.shadows = Shadows::Maps { resolution: 64 };
    preset.apply(&mut settings);
    render(scene, &flight(scene, part), &settings).expect("drawn")
}

#[test]
fn errors_of_a_flight_are_foreseen() {
    let (scene, quality) = (showcase(), Preset::Standard.quality());
    let mut errors = ErrorModel::default();
    let mut last = drawn(&scene, 0.0, Preset::Standard);
    errors.learn(quality, &last, &drawn(&scene, 0.0, Preset::Reference));
    for part in [0.3, 0.6, 1.0] {
        errors.saw(quality, &last);
        let foreseen = errors.predict(quality).expect("learnt");
        last = drawn(&scene, part, Preset::Standard);
        let measured = rmse(&last, &drawn(&scene, part, Preset::Reference));
        // What is promised: within a fifth.
        assert!((foreseen / measured - 1.0).abs() < 0.2, "at {part}: {foreseen} for {measured}");
    }
}

/// A clock on which each image takes a millisecond.
fn clock() -> impl FnMut() -> Duration {
    let mut now = Duration::ZERO;
    move || {
        now += Duration::from_millis(1);
        now
    }
}

#[test]
fn calibrating_tells_the_errors_of_all_qualities() {
    let (scene, mut clock) = (showcase(), clock());
    let camera = flight(&scene, 0.0);
    let mut renderer = Renderer::builder().size(48, 30).samples_per_axis(1).build();
    let before = renderer.settings().clone();
    let mut budget = TimeBudget::new(LIMIT);
    assert_eq!(budget.choose(&before).chosen.error, None, "nothing is known");
    budget.calibrate(&mut renderer, &scene, &camera, &mut clock).expect("drawn");
    assert_eq!(*renderer.settings(), before, "settings are not changed by it");
    // All are equally quick here.
    let choice = budget.choose(&before);
    assert!(choice.fits && choice.chosen.error == Some(0.0), "{choice}");
    let (frame, choice) = budget.render(&mut renderer, &scene, &camera, &mut clock).expect("drawn");
    assert_eq!(Quality::of(renderer.settings()), choice.chosen.quality, "as chosen");
    let mut alone = before.clone();
    choice.chosen.quality.apply(&mut alone);
    assert!(frame == render(&scene, &camera, &alone).expect("drawn"), "the image is that of its settings");
}

#[test]
fn there_is_a_second_look_only_when_there_is_time() {
    let (scene, mut clock) = (showcase(), clock());
    let camera = flight(&scene, 0.0);
    let mut renderer = Renderer::builder().size(32, 20).build();
    let mut budget = TimeBudget::new(LIMIT);
    budget.calibrate(&mut renderer, &scene, &camera, &mut clock).expect("drawn");
    budget.render(&mut renderer, &scene, &camera, &mut clock).expect("drawn");
    let mut look = |spare| budget.look_again(&mut renderer, &scene, &camera, spare, &mut clock);
    assert_eq!(look(Duration::from_micros(1)), Ok(false), "no time");
    assert_eq!(look(Duration::from_secs(9)), Ok(true), "enough");
}
