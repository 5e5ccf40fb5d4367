//! What does a whole image's accuracy cost? Twelve scenes with all combinations of samples and shadows, compared with a
//! [`Truth`]; and a time budget on flights past them.

mod cases;
mod certified;
mod scenes;

use std::num::NonZeroUsize;
use std::time::Duration;

use crate::truth::Truth;
use trigon_scene::quality::{Choice, Preset, Quality, TimeBudget, rmse};
use trigon_scene::{Frame, RenderError, Renderer, Sampler, Scene, ShadingModel, Shadows, SimdLevel};

pub use cases::FrameCase;
pub use certified::{Certified, Prover};

/// The variants of every case: all numbers of samples with light in each pixel, and a few with light once per triangle or
/// vertex. The presets are among them.
#[must_use]
pub fn variants() -> Vec<Quality> {
    let few = |model| {
        let few =
            sampled().into_iter().filter(|quality| quality.samples == 1 && quality.samples_per_axis != 3);
        few.map(move |quality| Quality { shading: model, ..quality })
    };
    let coarse = [ShadingModel::Flat, ShadingModel::Gouraud].into_iter().flat_map(few);
    sampled().into_iter().chain(coarse).collect()
}

/// The additional variants for scenes with shadows: those of [`variants`] with maps instead of rays, and the
/// other way round.
#[must_use]
pub fn other_shadows() -> Vec<Quality> {
    let by_maps = Preset::Draft.quality().shadows;
    let other = |quality: Quality| {
        let shadows = if quality.shadows == Shadows::Rays { by_maps } else { Shadows::Rays };
        Quality { shadows, ..quality }
    };
    // More samples in each hardly change a shadow.
    let few = sampled().into_iter().filter(|quality| quality.samples <= 4);
    few.map(other).collect()
}

/// All numbers of samples, with what the presets choose beside them.
fn sampled() -> Vec<Quality> {
    let of_axis = |axis: u32| {
        let samples = [1, 2, 4, 8, 16].into_iter();
        samples.map(move |samples| {
            let like = match (axis, samples) {
                (1, _) => Preset::Draft,
                (2, _) => Preset::Standard,
                (4, 16) => Preset::Reference,
                _ => Preset::High,
            };
            Quality { samples_per_axis: axis, samples, ..like.quality() }
        })
    };
    (1..=4).flat_map(of_axis).collect()
}

/// The quality with the shadows that a preset of as many samples would have.
#[must_use]
pub fn usual(quality: Quality) -> Quality {
    let like = if quality.samples_per_axis > 2 { Preset::High } else { Preset::Standard };
    Quality { shadows: like.quality().shadows, ..quality }
}

/// The name of a variant in tables and plots: its samples, what is unusual about it, and the preset if it is one.
pub fn name(quality: Quality) -> String {
    let Quality { samples_per_axis: axis, samples, .. } = quality;
    let positions = match quality.shading {
        ShadingModel::Flat => ", flat",
        ShadingModel::Gouraud => ", Gouraud",
        ShadingModel::Phong => "",
    };
    let shadows = match quality.shadows {
        Shadows::Rays if axis < 3 => ", shadow rays",
        Shadows::Maps { .. } if axis > 2 => ", shadow maps",
        _ => "",
    };
    let preset = Preset::ALL.into_iter().find(|preset| preset.quality() == quality);
    let preset = preset.map_or_else(String::new, |preset| format!(" ({preset})"));
    format!("{axis}×{axis}×{samples}{positions}{shadows}{preset}")
}

/// A case at a quality, drawn repeatedly.
pub struct Repeated {
    case: FrameCase,
    scene: Scene,
    renderer: Renderer,
    frame: Frame,
}

impl Repeated {
    /// Nothing is drawn yet.
    #[must_use]
    pub fn new(case: FrameCase, size: [u32; 2], quality: Quality) -> Self {
        Self::of(case, case.scene(), size, quality)
    }

    /// Of a scene that was made before.
    #[must_use]
    pub fn of(case: FrameCase, scene: Scene, size: [u32; 2], quality: Quality) -> Self {
        let mut settings = case.settings(size);
        quality.apply(&mut settings);
        Self { case, scene, renderer: Renderer::new(settings), frame: Frame::default() }
    }

    /// With these SIMD instructions.
    #[must_use]
    pub fn at_level(mut self, level: SimdLevel) -> Self {
        self.renderer.settings_mut().simd = Some(level);
        self
    }

    /// On so many threads.
    #[must_use]
    pub fn on_threads(mut self, threads: NonZeroUsize) -> Self {
        self.renderer.settings_mut().threads = Some(threads);
        self
    }

    /// With another filter of all textures of colours.
    #[must_use]
    pub fn with_sampler(mut self, sampler: Sampler) -> Self {
        let bindings = self.scene.materials.iter_mut();
        bindings.filter_map(|(_, material)| material.base_color_texture.as_mut()).for_each(|binding| {
            binding.sampler = sampler;
        });
        self
    }

    /// Where the flight is in a part of it, from 0 to 1.
    ///
    /// # Errors
    /// A size that cannot be drawn.
    pub fn draw(&mut self, part: f64) -> Result<&Frame, RenderError> {
        let camera = self.case.camera(&self.scene, self.renderer.settings().aspect(), part);
        self.renderer.render_into(&self.scene, &camera, &mut self.frame)?;
        Ok(&self.frame)
    }
}

/// The errors of several qualities, relative to the truth, at the start of a case's flight.
///
/// # Errors
/// A size that cannot be drawn.
pub fn errors(
    case: FrameCase,
    truth: &Truth,
    size: [u32; 2],
    qualities: &[Quality],
) -> Result<Vec<f64>, RenderError> {
    let error = |&quality: &Quality| Ok(truth.error(Repeated::new(case, size, quality).draw(0.0)?));
    qualities.iter().map(error).collect()
}

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
    case: FrameCase,
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

/// Draws frames of a case that does not move, each within a time, and returns the chosen qualities and the times.
///
/// # Errors
/// A size that cannot be drawn.
pub fn stay(
    case: FrameCase,
    size: [u32; 2],
    limit: Duration,
    frames: usize,
    clock: &mut dyn FnMut() -> Duration,
) -> Result<Vec<(Quality, Duration)>, RenderError> {
    let (scene, settings) = (case.scene(), case.settings(size));
    let camera = case.camera(&scene, settings.aspect(), 0.0);
    let (mut renderer, mut budget) = (Renderer::new(settings), TimeBudget::new(limit));
    budget.calibrate(&mut renderer, &scene, &camera, clock)?;
    let mut image = Frame::default();
    let mut draw = |_| {
        let start = clock();
        let choice = budget.render_into(&mut renderer, &scene, &camera, clock, &mut image)?;
        let drawing = clock().saturating_sub(start);
        budget.look_again(&mut renderer, &scene, &camera, limit.saturating_sub(drawing), clock)?;
        Ok((recorded(choice.chosen.quality, case), drawing))
    };
    (0..frames).map(&mut draw).collect()
}

/// The quality as the study names it: a budget leaves out of a quality what a frame does not request.
fn recorded(quality: Quality, case: FrameCase) -> Quality {
    let like = usual(quality);
    let shadows = if case.has_shadows() { quality.shadows } else { like.shadows };
    let all = sampled();
    let same = all
        .iter()
        .find(|one| (one.samples_per_axis, one.samples) == (quality.samples_per_axis, quality.samples));
    Quality { shadows, shading: quality.shading, ..*same.expect("all numbers of samples are there") }
}

/// The results of a flight: fractions of all its frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlightSummary {
    /// Frames that kept within the time.
    pub in_time: f64,
    /// Frames whose time was predicted within a fifth.
    pub times: f64,
    /// Frames whose error was predicted within a fifth. Frames without a prediction do not count.
    pub errors: f64,
    /// The largest relative difference between a predicted error and the measured one.
    pub worst: f64,
}

impl FlightSummary {
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
fn miss(foreseen: f64, measured: f64) -> f64 {
    if foreseen == measured { 0.0 } else { (foreseen - measured).abs() / measured }
}

#[cfg(test)]
mod tests;
