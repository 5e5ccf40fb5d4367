//! A time budget during a flight: whether frames keep within it, and whether the predicted errors are right.

use super::Case;
use std::time::Duration;
use trigon_scene::quality::{Choice, Preset, TimeBudget, rmse};
use trigon_scene::{Frame, RenderError, Renderer};

/// One frame of a flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// The choice and its predictions, before the frame was drawn.
    pub choice: Choice,
    /// The time to choose, draw and learn from the frame, which is the time that was predicted.
    pub drawing: Duration,
    /// The total time, including that of measuring a part of the image again.
    pub time: Duration,
    /// The error relative to the reference.
    pub error: f64,
}

/// Draws the frames of a case's flight, each within a time, and measures their errors. The clock is stopped
/// while errors are measured.
///
/// # Errors
/// A size that cannot be drawn.
pub fn fly(
    case: Case,
    size: [u32; 2],
    limit: Duration,
    frames: usize,
    clock: &mut dyn FnMut() -> Duration,
) -> Result<Vec<Step>, RenderError> {
    let (scene, settings) = (case.scene(), case.settings(size));
    let camera = |frame: usize| case.camera(&scene, settings.aspect(), frame as f64 / frames as f64);
    let mut best = Renderer::new(settings.clone());
    Preset::Reference.apply(best.settings_mut());
    let (mut renderer, mut budget) = (Renderer::new(settings.clone()), TimeBudget::new(limit));
    budget.calibrate(&mut renderer, &scene, &camera(0), clock)?;
    let (mut steps, mut image) = (Vec::new(), Frame::default());
    for frame in 0..frames {
        let (camera, start) = (camera(frame), clock());
        let choice = budget.render_into(&mut renderer, &scene, &camera, clock, &mut image)?;
        let drawing = clock().saturating_sub(start);
        let spare = limit.saturating_sub(drawing);
        budget.look_again(&mut renderer, &scene, &camera, spare, clock)?;
        let time = clock().saturating_sub(start);
        let error = rmse(&image, &best.render(&scene, &camera)?);
        steps.push(Step { choice, drawing, time, error });
    }
    Ok(steps)
}

/// The results of a flight: fractions of all its frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kept {
    /// Frames that kept within the time.
    pub in_time: f64,
    /// Frames whose time was predicted within a fifth.
    pub times: f64,
    /// Frames whose error was predicted within a fifth. Frames without a prediction do not count.
    pub errors: f64,
    /// The largest relative difference between a predicted error and the measured one.
    pub worst: f64,
}

impl Kept {
    /// Of the frames of a flight.
    pub fn of(steps: &[Step]) -> Self {
        const NEAR: f64 = 0.2;
        let error = |step: &Step| Some(miss(step.choice.chosen.error?, step.error));
        let time = |step: &Step| miss(step.choice.chosen.time.as_secs_f64(), step.drawing.as_secs_f64());
        let share = |counts: &dyn Fn(&Step) -> bool| {
            steps.iter().filter(|step| counts(step)).count() as f64 / steps.len().max(1) as f64
        };
        Self {
            in_time: share(&|step| step.time <= step.choice.limit),
            times: share(&|step| time(step) <= NEAR),
            errors: share(&|step| error(step).is_some_and(|miss| miss <= NEAR)),
            worst: steps.iter().filter_map(error).fold(0.0, f64::max),
        }
    }
}

/// The relative difference between prediction and measurement.
pub(super) fn miss(foreseen: f64, measured: f64) -> f64 {
    if foreseen == measured { 0.0 } else { (foreseen - measured).abs() / measured }
}
