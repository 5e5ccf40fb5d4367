//! A time budget on a flight: whether frames keep it, and whether errors are what was
//! foreseen.

use super::Case;
use std::time::Duration;
use trigon_scene::quality::{Choice, Preset, TimeBudget, rmse};
use trigon_scene::{Frame, RenderError, Renderer};

/// One frame of a flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// What was chosen and foreseen before it was drawn.
    pub choice: Choice,
    /// What all of it took: choosing, drawing, learning from it, looking again.
    pub time: Duration,
    /// How far it is from the reference, where that was measured.
    pub error: Option<f64>,
}

/// Draws the frames of a case's flight, each within a time; measures the errors of some of
/// them, spread evenly, while the clock's time is not counted.
///
/// # Errors
/// A size that cannot be drawn.
pub fn fly(
    case: Case,
    size: [u32; 2],
    limit: Duration,
    [frames, measured]: [usize; 2],
    clock: &mut dyn FnMut() -> Duration,
) -> Result<Vec<Step>, RenderError> {
    let (scene, settings) = (case.scene(), case.settings(size));
    let camera = |frame: usize| case.camera(&scene, settings.aspect(), frame as f64 / frames as f64);
    let mut best = Renderer::new(settings.clone());
    Preset::Reference.apply(best.settings_mut());
    let (mut renderer, mut budget) = (Renderer::new(settings.clone()), TimeBudget::new(limit));
    budget.calibrate(&mut renderer, &scene, &camera(0), clock)?;
    let (mut steps, mut picture) = (Vec::new(), Frame::default());
    for frame in 0..frames {
        let (camera, start) = (camera(frame), clock());
        let choice = budget.render_into(&mut renderer, (&scene, &camera), clock, &mut picture)?;
        let spare = limit.saturating_sub(clock().saturating_sub(start));
        budget.look_again(&mut renderer, (&scene, &camera), spare, clock)?;
        let time = clock().saturating_sub(start);
        // As often as `measured * frame / frames` comes to a whole number.
        let is_measured = measured * frame % frames.max(1) < measured;
        let error = if is_measured { Some(rmse(&picture, &best.render(&scene, &camera)?)) } else { None };
        steps.push(Step { choice, time, error });
    }
    Ok(steps)
}

/// How a flight went.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kept {
    /// The part of the frames that took no longer than they should.
    pub in_time: f64,
    /// Frames whose error was measured.
    pub measured: usize,
    /// Of those, the ones whose error had been foreseen within a fifth.
    pub foreseen: usize,
    /// Of those, the greatest miss, as a part of the error.
    pub worst: f64,
}

impl Kept {
    /// Of the frames of a flight.
    pub fn of(steps: &[Step]) -> Self {
        let in_time = steps.iter().filter(|step| step.time <= step.choice.limit).count();
        let miss = |step: &Step| Some(miss(step.choice.chosen.error?, step.error?));
        let misses: Vec<f64> = steps.iter().filter_map(miss).collect();
        Self {
            in_time: in_time as f64 / steps.len().max(1) as f64,
            measured: misses.len(),
            foreseen: misses.iter().filter(|&&miss| miss <= 0.2).count(),
            worst: misses.iter().copied().fold(0.0, f64::max),
        }
    }
}

/// How far what was foreseen is from what was measured, as a part of that.
pub(super) fn miss(foreseen: f64, measured: f64) -> f64 {
    if foreseen == measured { 0.0 } else { (foreseen - measured).abs() / measured }
}
