//! A time budget during a flight: whether frames keep within it, and whether the predicted errors are right.

use super::Case;
use std::time::Duration;
use trigon_scene::quality::{Choice, Preset, TimeBudget, rmse};
use trigon_scene::{Frame, RenderError, Renderer};

/// One frame of a flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// What was chosen and foreseen before it was drawn.
    pub choice: Choice,
    /// What choosing, drawing and learning from it took, which is what had been foreseen.
    pub drawing: Duration,
    /// What all of it took, looking again at a part of the image as well.
    pub time: Duration,
    /// How far it is from the reference.
    pub error: f64,
}

/// Draws the frames of a case's flight, each within a time, and measures their errors, while the clock's time is not
/// counted.
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
        let choice = budget.render_into(&mut renderer, (&scene, &camera), clock, &mut image)?;
        let drawing = clock().saturating_sub(start);
        let spare = limit.saturating_sub(drawing);
        budget.look_again(&mut renderer, (&scene, &camera), spare, clock)?;
        let time = clock().saturating_sub(start);
        let error = rmse(&image, &best.render(&scene, &camera)?);
        steps.push(Step { choice, drawing, time, error });
    }
    Ok(steps)
}

/// How a flight went: shares of all its frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kept {
    /// Took no longer than they should.
    pub in_time: f64,
    /// Took as long to draw as had been foreseen, within a fifth.
    pub times: f64,
    /// Had the error that had been foreseen, within a fifth. A frame whose error was not foreseen is none of these.
    pub errors: f64,
    /// The greatest miss of an error that was foreseen, as a part of the error.
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

/// How far what was foreseen is from what was measured, as a part of that.
pub(super) fn miss(foreseen: f64, measured: f64) -> f64 {
    if foreseen == measured { 0.0 } else { (foreseen - measured).abs() / measured }
}
