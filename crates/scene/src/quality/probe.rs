//! Extra measurements for a budget: small regions of the image, drawn at several qualities and at that of the
//! reference.

use std::time::Duration;

use trigon_camera::Camera;

use super::budget::of_quality;
use super::window::{Window, WindowSize};
use super::{ErrorModel, Quality, TimeBudget};
use crate::frame::Frame;
use crate::render::{RenderError, Renderer};
use crate::scene::Scene;
use crate::settings::{Outputs, RenderSettings};

/// How many parts of an image are drawn in all qualities to begin with. They lie about
/// everywhere: the middle of an image is not like its rest.
const FIRST_WINDOWS: u32 = 9;

/// Their size.
const FIRST_WINDOW: WindowSize = WindowSize { share: 1.0 / 6.0, most: 96 };

/// The same for looking again.
const LATER_WINDOW: WindowSize = WindowSize { share: 1.0 / 8.0, most: 64 };

/// How often an image is drawn whose time counts: the first may fill caches.
const MEASURED: u32 = 2;

impl TimeBudget {
    /// Learns what this scene costs, and what its errors are: draws parts of the image,
    /// together a quarter of it, in all qualities, and the whole in the quickest.
    ///
    /// # Errors
    /// As [`Renderer::render`].
    pub fn calibrate(
        &mut self,
        renderer: &mut Renderer,
        scene: &Scene,
        camera: &Camera,
        clock: &mut dyn FnMut() -> Duration,
    ) -> Result<(), RenderError> {
        let whole = colors_alone(renderer.settings());
        self.errors = ErrorModel::default();
        let mut studio = Studio { renderer, scene, clock };
        let mut times = vec![Duration::ZERO; self.candidates.len()];
        let mut part = whole.clone();
        for _ in 0..FIRST_WINDOWS {
            let window = self.window(&whole, FIRST_WINDOW);
            part = window.settings(&whole);
            let Some(there) = window.camera(camera, &whole) else { continue };
            self.compare(&part, &there, &mut studio, &mut times)?;
        }
        for (quality, time) in self.candidates.iter().zip(times).filter(|(_, time)| !time.is_zero()) {
            // Their mean: what lies in one window is not what lies in the image.
            self.costs.learn(&of_quality(&part, *quality), time / FIRST_WINDOWS);
        }
        let quickest = self.predictions(&whole).into_iter().min_by_key(|predicted| predicted.time);
        let quality = quickest.expect("there are candidates").quality;
        let (frame, time) = studio.draw(&of_quality(&whole, quality), camera, MEASURED)?;
        self.costs.learn(&of_quality(&whole, quality), time);
        self.errors.saw(quality, &frame);
        Ok(())
    }

    /// Looks again how far the last quality is from the reference, at some part of the
    /// image, if that is foreseen to fit into some time; says whether it did. A camera
    /// that moves on sees other things.
    ///
    /// # Errors
    /// As [`Renderer::render`].
    pub fn look_again(
        &mut self,
        renderer: &mut Renderer,
        scene: &Scene,
        camera: &Camera,
        spare: Duration,
        clock: &mut dyn FnMut() -> Duration,
    ) -> Result<bool, RenderError> {
        let whole = colors_alone(renderer.settings());
        let window = self.window(&whole, LATER_WINDOW);
        let part = window.settings(&whole);
        let Some(quality) = self.last else { return Ok(false) };
        let both = [self.reference, quality].map(|quality| of_quality(&part, quality));
        let time = both.iter().map(|settings| self.costs.predict(settings)).sum();
        let fits = self.patience.with_margin(time) <= spare;
        let Some(there) = window.camera(camera, &whole).filter(|_| fits) else { return Ok(false) };
        let mut studio = Studio { renderer, scene, clock };
        let [(reference, _), (image, _)] =
            [studio.draw(&both[0], &there, 1)?, studio.draw(&both[1], &there, 1)?];
        // Costs are not learnt from it: a window is not the image.
        self.errors.correct(quality, &image, &reference);
        Ok(true)
    }

    /// The next window.
    fn window(&mut self, whole: &RenderSettings, size: WindowSize) -> Window {
        let window = Window::nth(self.windows, whole, size);
        self.windows = self.windows.wrapping_add(1);
        window
    }

    /// Draws the reference and all candidates of a part, learns their errors from it, and
    /// adds up how long each took.
    fn compare(
        &mut self,
        part: &RenderSettings,
        camera: &Camera,
        studio: &mut Studio<'_>,
        times: &mut [Duration],
    ) -> Result<(), RenderError> {
        let best = of_quality(part, self.reference);
        let (reference, _) = studio.draw(&best, camera, 1)?;
        self.errors.learn(Quality::of(&best), &reference, &reference);
        for (quality, sum) in self.candidates.iter().zip(times) {
            let settings = of_quality(part, *quality);
            // The reference takes long and nobody waits for it.
            if settings != best {
                let (image, time) = studio.draw(&settings, camera, MEASURED)?;
                self.errors.learn(Quality::of(&settings), &image, &reference);
                *sum += time;
            }
        }
        Ok(())
    }
}

/// Errors are of colours; other outputs would only take time.
fn colors_alone(settings: &RenderSettings) -> RenderSettings {
    RenderSettings { outputs: Outputs::default(), ..settings.clone() }
}

/// Where images are drawn by the clock.
struct Studio<'a> {
    renderer: &'a mut Renderer,
    scene: &'a Scene,
    clock: &'a mut dyn FnMut() -> Duration,
}

impl Studio<'_> {
    /// An image, and how long it takes: the shortest time of so many. The renderer's
    /// settings stay.
    fn draw(
        &mut self,
        settings: &RenderSettings,
        camera: &Camera,
        repetitions: u32,
    ) -> Result<(Frame, Duration), RenderError> {
        let before = std::mem::replace(self.renderer.settings_mut(), settings.clone());
        let (mut frame, mut shortest, mut drawn) = (Frame::default(), Duration::MAX, Ok(()));
        for _ in 0..repetitions {
            let start = (self.clock)();
            drawn = drawn.and_then(|()| self.renderer.render_into(self.scene, camera, &mut frame));
            shortest = shortest.min((self.clock)().saturating_sub(start));
        }
        *self.renderer.settings_mut() = before;
        drawn.map(|()| (frame, shortest))
    }
}
