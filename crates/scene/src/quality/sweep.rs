//! Measures the time and the error of many qualities of one image, a frame at a time.

use std::time::Duration;

use trigon_camera::Camera;
use trigon_raster::Cancel;

use super::budget::of_quality;
use super::frontier::{Frontier, FrontierDot, Standing, TimeSpread};
use super::probe::colors_alone;
use super::{Preset, Quality, candidates, rmse, rounding_floor};
use crate::frame::Frame;
use crate::render::{RenderError, Renderer};
use crate::scene::Scene;
use crate::settings::RenderSettings;

/// Measures the time and the error of many qualities of one image, a frame at a time.
///
/// The first frame is the reference. Then each quality is drawn once for its error, and to fill caches, and once in each
/// round for its time, in random order, so that other load on the machine affects all of them alike. Two images are held
/// at a time.
///
/// It has no clock: `clock` is called before and after each frame, and returns the time since any fixed moment.
///
/// ```
/// use std::time::{Duration, Instant};
/// use trigon_scene::quality::{Preset, Sweep, SweepOptions};
/// use trigon_scene::{Cancel, RenderSettings, showcase};
///
/// let (scene, settings, start) = (showcase(), RenderSettings::new(32, 20), Instant::now());
/// let camera = scene.overview(settings.aspect());
/// let qualities = [Preset::Draft, Preset::Standard, Preset::Reference].map(Preset::quality);
/// let options = SweepOptions { rounds: 3, qualities: qualities.to_vec(), ..SweepOptions::default() };
/// let mut sweep = Sweep::new(scene, camera, &settings, options);
/// while !sweep.progress().is_done() {
///     sweep.step(&mut || start.elapsed(), &Cancel::default())?;
/// }
/// let frontier = sweep.frontier();
/// let [draft, standard] = [0, 1].map(|index| frontier.dots[index].error);
/// assert!(draft > standard);
/// assert!(frontier.plot("the built-in scene, 32×20", None).to_svg().contains("reference (0)"));
/// # Ok::<(), trigon_scene::RenderError>(())
/// ```
pub struct Sweep {
    scene: Scene,
    camera: Camera,
    settings: RenderSettings,
    renderer: Renderer,
    /// The image that others are compared with, once it is drawn.
    reference: Option<Frame>,
    floor: f64,
    /// The last one.
    frame: Frame,
    qualities: Vec<Measurements>,
    /// What is still to be drawn in this round, last things first.
    left: Vec<usize>,
    /// Rounds begun; the first one is for errors.
    round: u32,
    rounds: u32,
    random: u64,
}

/// What is known about a quality.
struct Measurements {
    quality: Quality,
    error: Option<f64>,
    times: Vec<Duration>,
}

/// What a [`Sweep`] measures.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepOptions {
    /// The qualities. Those that such a frame does not distinguish are measured once, and the reference always is.
    pub qualities: Vec<Quality>,
    /// How many frames of each are timed, 1 to 1000.
    pub rounds: u32,
    /// Where the random order begins.
    pub seed: u64,
}

impl Default for SweepOptions {
    /// The [`candidates`] of time budgets, and some between them and beside them, five times.
    fn default() -> Self {
        Self { qualities: usual_qualities(), rounds: 5, seed: 0 }
    }
}

/// How many frames of a sweep are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SweepProgress {
    /// Frames that are drawn.
    pub done: usize,
    /// All frames.
    pub of: usize,
}

impl SweepProgress {
    /// Whether nothing is left to be drawn.
    #[must_use]
    pub fn is_done(self) -> bool {
        self.done >= self.of
    }
}

fn usual_qualities() -> Vec<Quality> {
    let [draft, standard, high, reference] = Preset::ALL.map(Preset::quality);
    let samples = |quality, samples| Quality { samples, ..quality };
    let nine = Quality { samples_per_axis: 3, ..standard };
    let by_rays = |quality| Quality { shadows: high.shadows, ..quality };
    let between = [
        samples(draft, 16),
        samples(standard, 4),
        samples(standard, 8),
        nine,
        samples(nine, 4),
        samples(reference, 8),
        by_rays(draft),
        by_rays(standard),
    ];
    candidates().into_iter().chain(between).collect()
}

impl Sweep {
    /// Of what the camera sees of the scene with these settings, at the qualities of the options, and at that of the
    /// settings. Nothing is drawn yet.
    #[must_use]
    pub fn new(scene: Scene, camera: Camera, settings: &RenderSettings, options: SweepOptions) -> Self {
        /// More would only take memory.
        const MOST_ROUNDS: u32 = 1000;
        let settings = colors_alone(settings);
        let SweepOptions { qualities, rounds, seed } = options;
        let mut distinct: Vec<Measurements> = Vec::new();
        for quality in qualities.into_iter().chain([Quality::of(&settings), Preset::Reference.quality()]) {
            let quality = quality.within(&settings);
            if distinct.iter().all(|known| known.quality != quality) {
                distinct.push(Measurements { quality, error: None, times: Vec::new() });
            }
        }
        Self {
            scene,
            camera,
            renderer: Renderer::new(settings.clone()),
            settings,
            reference: None,
            floor: 0.0,
            frame: Frame::default(),
            qualities: distinct,
            left: Vec::new(),
            round: 0,
            rounds: rounds.clamp(1, MOST_ROUNDS),
            random: seed,
        }
    }

    /// How far it is.
    #[must_use]
    pub fn progress(&self) -> SweepProgress {
        let count = self.qualities.len();
        let of = count * (self.rounds as usize + 1);
        let of_round = match self.round {
            0 => usize::from(self.reference.is_some()),
            round => count * round as usize - self.left.len(),
        };
        SweepProgress { done: of_round, of }
    }

    /// Draws the next frame, unless all are drawn, and measures it.
    ///
    /// # Errors
    /// As [`Renderer::render_cancellable`]. A frame that was cancelled does not count and is drawn again by the next
    /// step; after any other error every step fails.
    pub fn step(
        &mut self,
        clock: &mut dyn FnMut() -> Duration,
        cancel: &Cancel,
    ) -> Result<SweepProgress, RenderError> {
        if self.reference.is_none() {
            self.draw_reference(cancel)?;
        } else if let Some(index) = self.next() {
            let time = match self.draw(index, clock, cancel) {
                Ok(time) => time,
                Err(error) => {
                    self.left.push(index);
                    return Err(error);
                }
            };
            let error = self.reference.as_ref().map(|reference| rmse(&self.frame, reference));
            let known = &mut self.qualities[index];
            if self.round > 1 {
                known.times.push(time);
            } else {
                known.error = error;
            }
        }
        Ok(self.progress())
    }

    /// What was measured so far: the qualities of which an error and at least one time are known.
    #[must_use]
    pub fn frontier(&self) -> Frontier {
        let preset = |quality: Quality| {
            Preset::ALL.into_iter().find(|preset| preset.quality().within(&self.settings) == quality)
        };
        let dot = |known: &Measurements| {
            Some(FrontierDot {
                quality: known.quality,
                preset: preset(known.quality),
                time: TimeSpread::of(&known.times)?,
                frames: known.times.len(),
                error: known.error?,
                standing: Standing::Uncertain,
            })
        };
        let dots = self.qualities.iter().filter_map(dot).collect();
        Frontier::new(dots, self.floor, self.reference_quality())
    }

    fn reference_quality(&self) -> Quality {
        Preset::Reference.quality().within(&self.settings)
    }

    fn draw_reference(&mut self, cancel: &Cancel) -> Result<(), RenderError> {
        let quality = self.reference_quality();
        *self.renderer.settings_mut() = of_quality(&self.settings, quality);
        let mut frame = Frame::default();
        self.renderer.render_cancellable(&self.scene, &self.camera, cancel, &mut frame)?;
        self.floor = rounding_floor(&frame);
        self.reference = Some(frame);
        let reference = self.qualities.iter_mut().find(|known| known.quality == quality);
        reference.expect("the reference is among them").error = Some(0.0);
        Ok(())
    }

    /// The next quality to draw; begins a round if the last one is complete.
    fn next(&mut self) -> Option<usize> {
        if self.left.is_empty() {
            if self.round > self.rounds {
                return None;
            }
            self.round += 1;
            self.left = (0..self.qualities.len()).collect();
            if self.round == 1 {
                self.left.retain(|&index| self.qualities[index].error.is_none());
            }
            self.shuffle();
        }
        self.left.pop()
    }

    /// Fisher and Yates' shuffle of what is left in the round.
    fn shuffle(&mut self) {
        for last in (1..self.left.len()).rev() {
            let other = self.next_random() % (last as u64 + 1);
            self.left.swap(last, other as usize);
        }
    }

    /// SplitMix64 (G. Steele, D. Lea and C. Flood, "Fast splittable pseudorandom number generators", 2014).
    fn next_random(&mut self) -> u64 {
        self.random = self.random.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.random ^ (self.random >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// Draws a quality, and returns how long that took.
    fn draw(
        &mut self,
        index: usize,
        clock: &mut dyn FnMut() -> Duration,
        cancel: &Cancel,
    ) -> Result<Duration, RenderError> {
        *self.renderer.settings_mut() = of_quality(&self.settings, self.qualities[index].quality);
        let start = clock();
        self.renderer.render_cancellable(&self.scene, &self.camera, cancel, &mut self.frame)?;
        Ok(clock().saturating_sub(start))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effect_settings::Shadows;
    use crate::settings::ShadingModel;
    use crate::{render, showcase};

    /// A sweep of a small image without shadows.
    fn sweep(options: SweepOptions) -> Sweep {
        let (scene, settings) = (showcase(), RenderSettings::new(24, 16));
        let camera = scene.overview(settings.aspect());
        Sweep::new(scene, camera, &settings, options)
    }

    fn presets() -> SweepOptions {
        let qualities = Preset::ALL.map(Preset::quality).to_vec();
        SweepOptions { qualities, rounds: 3, seed: 7 }
    }

    /// On this clock the frames take 1, 2, 3 … milliseconds.
    fn clock() -> impl FnMut() -> Duration {
        let (mut now, mut calls) = (Duration::ZERO, 0);
        move || {
            calls += 1;
            now += Duration::from_millis(calls / 2);
            now
        }
    }

    #[test]
    fn every_quality_is_timed_in_every_round_and_compared_with_the_reference() {
        let (mut sweep, mut clock) = (sweep(presets()), clock());
        // The settings have 3×3 samples, which no preset has.
        assert_eq!(sweep.progress(), SweepProgress { done: 0, of: 5 * 4 });
        assert!(sweep.frontier().dots.is_empty(), "nothing is known");
        for done in 1..=20 {
            let progress = sweep.step(&mut clock, &Cancel::default()).expect("drawn");
            assert_eq!(progress, SweepProgress { done, of: 20 });
        }
        let frontier = sweep.frontier();
        let after = sweep.step(&mut clock, &Cancel::default()).expect("nothing to do");
        assert!(after.is_done() && sweep.frontier() == frontier, "nothing more is drawn");
        let (scene, camera) = (showcase(), sweep.camera);
        let image = |quality| render(&scene, &camera, &of_quality(&sweep.settings, quality)).expect("drawn");
        let reference = image(Preset::Reference.quality());
        for dot in &frontier.dots {
            assert_eq!(dot.error, rmse(&image(dot.quality), &reference), "{}", dot.quality);
            assert_eq!(dot.frames, 3, "{}", dot.quality);
        }
        let presets: Vec<_> = frontier.dots.iter().map(|dot| dot.preset).collect();
        assert_eq!(presets[..4], Preset::ALL.map(Some), "in the order of the options");
        assert_eq!((presets[4], frontier.dots.len()), (None, 5), "and that of the settings");
        let mut times: Vec<u128> =
            sweep.qualities.iter().flat_map(|known| &known.times).map(Duration::as_millis).collect();
        times.sort_unstable();
        // The reference's first frame is not timed, nor do the four of the first round count.
        assert_eq!(times, (5..20).collect::<Vec<_>>(), "all frames of the later rounds");
    }

    #[test]
    fn the_order_is_random_and_follows_from_the_seed() {
        let order = |seed| {
            let mut sweep = sweep(SweepOptions { seed, ..SweepOptions::default() });
            sweep.reference = Some(Frame::default());
            (0..40).map_while(|_| sweep.next()).collect::<Vec<_>>()
        };
        assert_eq!(order(1), order(1));
        assert_ne!(order(1), order(2));
        let count = sweep(SweepOptions::default()).qualities.len();
        let mut round = order(1)[..count].to_vec();
        round.sort_unstable();
        assert_eq!(round, (0..count).collect::<Vec<_>>(), "each once in a round");
    }

    #[test]
    fn cancelled_frames_are_drawn_again() {
        let (mut sweep, mut clock) = (sweep(presets()), clock());
        let cancelled = Cancel::default();
        cancelled.cancel();
        while !sweep.progress().is_done() {
            let before = sweep.progress();
            assert_eq!(sweep.step(&mut clock, &cancelled), Err(RenderError::Cancelled));
            assert_eq!(sweep.progress(), before, "it does not count");
            sweep.step(&mut clock, &Cancel::default()).expect("drawn");
        }
        assert!(sweep.frontier().dots.iter().all(|dot| dot.frames == 3));
    }

    #[test]
    fn what_a_frame_does_not_distinguish_is_measured_once() {
        let distinct = |shadows| {
            let (scene, mut settings) = (showcase(), RenderSettings::new(24, 16));
            settings.effects.shadows = shadows;
            let camera = scene.overview(settings.aspect());
            let sweep = Sweep::new(scene, camera, &settings, SweepOptions::default());
            sweep.qualities.iter().map(|known| known.quality).collect::<Vec<_>>()
        };
        let (without, with) = (distinct(Shadows::Off), distinct(Shadows::Rays));
        let samples = |quality: &Quality| {
            let is_by_pixel = quality.shading == ShadingModel::Phong;
            (is_by_pixel, quality.samples_per_axis, quality.samples)
        };
        let mut once: Vec<_> = without.iter().map(samples).collect();
        once.sort_unstable();
        assert!(once.is_sorted_by(|a, b| a < b), "without shadows, samples are all: {once:?}");
        assert!(with.len() > without.len() + 3 && with.len() < 26, "{} and {}", with.len(), without.len());
    }

    #[test]
    fn settings_that_cannot_be_drawn_fail_at_every_step() {
        let settings = RenderSettings { width: 0, ..RenderSettings::new(24, 16) };
        let mut sweep = Sweep::new(showcase(), Camera::default(), &settings, presets());
        for _ in 0..2 {
            let failed = sweep.step(&mut clock(), &Cancel::default());
            assert!(matches!(failed, Err(error) if error != RenderError::Cancelled));
        }
        assert_eq!(sweep.progress().done, 0);
    }
}
