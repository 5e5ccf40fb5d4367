//! Chooses the most accurate quality that fits into a time.

use std::time::Duration;

use trigon_camera::Camera;

use super::choice::Patience;
use super::{Choice, CostModel, ErrorModel, Prediction, Preset, Quality, candidates};
use crate::frame::Frame;
use crate::render::{RenderError, Renderer};
use crate::scene::Scene;
use crate::settings::RenderSettings;

/// Of two qualities that fit, that of the last image is kept, unless the other has less than this
/// fraction of its error: images that alternate flicker.
const WORTH_A_CHANGE: f64 = 0.9;

/// Chooses for each frame of a scene the most accurate quality that fits into a time, based on the
/// times of previous frames.
///
/// It has no clock: the caller that draws measures and reports. If frames are drawn here, `clock`
/// is called before and after each; it returns the time since any fixed moment.
///
/// ```no_run
/// use std::time::{Duration, Instant};
/// use trigon_scene::quality::{TimeBudget, rmse};
/// use trigon_scene::{Renderer, showcase};
///
/// let (scene, start) = (showcase(), Instant::now());
/// let camera = scene.cameras()[0].1;
/// let mut renderer = Renderer::builder().size(50, 30).build();
/// let mut budget = TimeBudget::new(Duration::from_millis(16));
/// let clock = &mut || start.elapsed();
/// budget.calibrate(&mut renderer, &scene, &camera, clock)?;
///
/// let (frame, choice) = budget.render(&mut renderer, &scene, &camera, clock)?;
/// println!("{}×{}: {choice}", frame.width, frame.height);
/// # Ok::<(), trigon_scene::RenderError>(())
/// ```
#[derive(Clone, Debug)]
pub struct TimeBudget {
    limit: Duration,
    pub(super) candidates: Vec<Quality>,
    pub(super) reference: Quality,
    pub(super) costs: CostModel,
    pub(super) errors: ErrorModel,
    pub(super) patience: Patience,
    pub(super) last: Option<Quality>,
    /// Windows compared so far.
    pub(super) windows: u32,
}

impl TimeBudget {
    /// A budget of this time per frame. Nothing is known of the scene yet.
    #[must_use]
    pub fn new(limit: Duration) -> Self {
        Self {
            limit,
            candidates: candidates().map(of_any_glass).to_vec(),
            reference: of_any_glass(Preset::Reference.quality()),
            costs: CostModel::default(),
            errors: ErrorModel::default(),
            patience: Patience::default(),
            last: None,
            windows: 0,
        }
    }

    /// With all qualities changed, including the reference, so that fixed settings are never
    /// varied.
    #[must_use]
    pub fn insisting(self, change: impl Fn(Quality) -> Quality) -> Self {
        let mut candidates: Vec<Quality> = Vec::new();
        for quality in self.candidates.iter().map(|&quality| change(quality)) {
            if !candidates.contains(&quality) {
                candidates.push(quality);
            }
        }
        Self { candidates, reference: change(self.reference), ..self }
    }

    /// The time per frame.
    #[must_use]
    pub fn limit(&self) -> Duration {
        self.limit
    }

    /// The choice for the next frame, with settings for everything but the quality.
    pub fn choose(&self, settings: &RenderSettings) -> Choice {
        let all = self.predictions(settings);
        let fits = |predicted: &&Prediction| {
            self.patience.with_margin(predicted.time) <= self.limit
                && !self.patience.is_resting(predicted.quality)
        };
        let best = all.iter().filter(fits).reduce(more_accurate);
        let stays = self.last.and_then(|last| all.iter().filter(fits).find(|one| one.quality == last));
        let chosen = match (stays, best) {
            (Some(last), Some(best)) if !is_worth_a_change(last, best) => Some(last),
            _ => best,
        };
        let quickest = || all.iter().min_by_key(|predicted| predicted.time).expect("there are candidates");
        let choice = chosen.unwrap_or_else(quickest);
        Choice {
            chosen: *choice,
            limit: self.limit,
            fits: chosen.is_some() || choice.time <= self.limit,
            given_up: next_better(&all, choice).copied(),
            reference: self.reference.within(settings),
        }
    }

    /// Reports that a frame was drawn as chosen.
    pub fn saw(&mut self, choice: &Choice, frame: &Frame) {
        self.errors.saw(choice.chosen.quality, frame);
    }

    /// The time that it took.
    pub fn took(&mut self, choice: &Choice, settings: &RenderSettings, time: Duration) {
        let Prediction { quality, time: predicted, .. } = choice.chosen;
        self.patience.note(quality, [time, predicted, self.limit]);
        self.costs.learn(&of_quality(settings, quality), time);
        self.last = Some(quality);
    }

    /// Chooses, draws, and learns from the result. Afterwards the renderer's settings have the
    /// chosen quality.
    ///
    /// # Errors
    /// As [`Renderer::render`].
    pub fn render(
        &mut self,
        renderer: &mut Renderer,
        scene: &Scene,
        camera: &Camera,
        clock: &mut dyn FnMut() -> Duration,
    ) -> Result<(Frame, Choice), RenderError> {
        let mut frame = Frame::default();
        let choice = self.render_into(renderer, scene, camera, clock, &mut frame)?;
        Ok((frame, choice))
    }

    /// As [`render`](Self::render), into an existing frame.
    ///
    /// # Errors
    /// As [`Renderer::render`].
    pub fn render_into(
        &mut self,
        renderer: &mut Renderer,
        scene: &Scene,
        camera: &Camera,
        clock: &mut dyn FnMut() -> Duration,
        frame: &mut Frame,
    ) -> Result<Choice, RenderError> {
        let start = clock();
        let choice = self.choose(renderer.settings());
        choice.chosen.quality.apply(renderer.settings_mut());
        renderer.render_into(scene, camera, frame)?;
        // Comparing windows is part of the time.
        self.saw(&choice, frame);
        self.took(&choice, renderer.settings(), clock().saturating_sub(start));
        Ok(choice)
    }

    /// The known cost and error of all candidates, as far as such a frame distinguishes them.
    pub(super) fn predictions(&self, settings: &RenderSettings) -> Vec<Prediction> {
        let mut all: Vec<Prediction> = Vec::new();
        for candidate in &self.candidates {
            let quality = candidate.within(settings);
            if all.iter().all(|predicted| predicted.quality != quality) {
                let time = self.costs.predict(&of_quality(settings, quality));
                all.push(Prediction { quality, time, error: self.errors.predict(quality) });
            }
        }
        all
    }
}

/// With as many surfaces for rays through glass as the settings say. Settings cannot tell whether a scene has
/// glass, and without it two qualities that differ in nothing else are one.
fn of_any_glass(quality: Quality) -> Quality {
    Quality { glass_bounces: 0, ..quality }
}

/// The one with the smaller error; while an error is unknown the second, which comes later in the
/// order of candidates.
fn more_accurate<'a>(first: &'a Prediction, second: &'a Prediction) -> &'a Prediction {
    match (first.error, second.error) {
        (Some(a), Some(b)) if a <= b => first,
        _ => second,
    }
}

/// The fastest of those more accurate than one of them; while errors are unknown, of those that
/// come later.
fn next_better<'a>(all: &'a [Prediction], than: &Prediction) -> Option<&'a Prediction> {
    let later = all.iter().skip_while(|one| one.quality != than.quality).skip(1);
    match than.error {
        Some(error) => {
            let better = all.iter().filter(|one| one.error.is_some_and(|other| other < error));
            better.min_by_key(|one| one.time)
        }
        None => later.min_by_key(|one| one.time),
    }
}

fn is_worth_a_change(last: &Prediction, best: &Prediction) -> bool {
    match (last.error, best.error) {
        (Some(last), Some(best)) => best < WORTH_A_CHANGE * last,
        _ => last.quality != best.quality,
    }
}

pub(super) fn of_quality(settings: &RenderSettings, quality: Quality) -> RenderSettings {
    let mut settings = settings.clone();
    quality.apply(&mut settings);
    settings
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Milliseconds and an error; of qualities that are all different.
    fn predictions(all: &[(u64, Option<f64>)]) -> Vec<Prediction> {
        let one = |(rays, &(time, error)): (u32, &(u64, Option<f64>))| Prediction {
            quality: Quality { occlusion_rays: rays, ..Preset::Draft.quality() },
            time: Duration::from_millis(time),
            error,
        };
        (0..).zip(all).map(one).collect()
    }

    #[test]
    fn the_smaller_error_is_more_accurate_and_the_later_while_it_is_unknown() {
        let pair = |errors: [Option<f64>; 2]| {
            let all = predictions(&errors.map(|error| (1, error)));
            usize::from(more_accurate(&all[0], &all[1]).quality == all[1].quality)
        };
        assert_eq!(pair([Some(1.0), Some(2.0)]), 0);
        assert_eq!(pair([Some(2.0), Some(1.0)]), 1);
        assert_eq!(pair([Some(1.0), Some(1.0)]), 0, "of equal ones the first");
        for unknown in [[None, Some(1.0)], [Some(1.0), None], [None, None]] {
            assert_eq!(pair(unknown), 1, "{unknown:?}");
        }
    }

    #[test]
    fn the_fastest_of_those_that_are_better_comes_next() {
        let next = |all: &[(u64, Option<f64>)], than: usize| {
            let all = predictions(all);
            next_better(&all, &all[than]).map(|next| next.quality.occlusion_rays)
        };
        let known = [(1, Some(9.0)), (5, Some(4.0)), (3, Some(6.0)), (9, Some(6.0)), (2, None)];
        assert_eq!([0, 1, 2, 3].map(|than| next(&known, than)), [Some(2), None, Some(1), Some(1)]);
        let unknown = [(1, None), (5, None), (3, None), (4, None)];
        assert_eq!([0, 1, 2, 3].map(|than| next(&unknown, than)), [Some(2), Some(2), Some(3), None]);
    }

    #[test]
    fn a_tenth_less_error_is_worth_a_change() {
        let worth = |errors: [Option<f64>; 2]| {
            let all = predictions(&errors.map(|error| (1, error)));
            is_worth_a_change(&all[0], &all[1])
        };
        assert!(worth([Some(1.0), Some(0.89)]) && !worth([Some(1.0), Some(0.91)]));
        assert!(!worth([Some(1.0), Some(1.0)]) && !worth([Some(1.0), Some(2.0)]));
        assert!(worth([None, Some(1.0)]) && worth([Some(1.0), None]), "unless it is unknown");
        let all = predictions(&[(1, None)]);
        assert!(!is_worth_a_change(&all[0], &all[0]), "not to itself");
    }
}
