//! What a budget learns from, beside the pictures that it was asked for: parts of a picture
//! in several qualities and in the reference.

use std::time::Duration;

use trigon_camera::Camera;

use super::budget::of_quality;
use super::window::Window;
use super::{Quality, TimeBudget};
use crate::frame::Frame;
use crate::render::{RenderError, Renderer};
use crate::scene::Scene;
use crate::settings::{Outputs, RenderSettings};

/// The part of a picture's width and height that is drawn in all qualities to begin with,
/// and the most pixels of its sides.
const FIRST_WINDOW: (f64, u32) = (0.5, 256);

/// The same for looking again.
const LATER_WINDOW: (f64, u32) = (0.25, 128);

impl TimeBudget {
    /// Learns what this scene costs, and what its errors are: draws the middle of the
    /// picture in all qualities, and the whole in the quickest.
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
        let window = self.window(&whole, FIRST_WINDOW);
        let (part, there) = (window.settings(&whole), window.camera(camera, &whole));
        let mut studio = Studio { renderer, scene, clock, repetitions: 2 };
        if let Some(there) = there {
            let all = self.candidates.clone();
            for (settings, time) in self.compare(&all, &part, &there, &mut studio)? {
                self.costs.learn(&settings, time);
            }
        }
        let quickest = self.foreseen(&whole).into_iter().min_by_key(|foreseen| foreseen.time);
        let quality = quickest.expect("there are candidates").quality;
        let (frame, time) = studio.draw(&of_quality(&whole, quality), camera)?;
        self.costs.learn(&of_quality(&whole, quality), time);
        self.errors.saw(quality, &frame);
        Ok(())
    }

    /// Looks again how far the last quality and its neighbours are from the reference,
    /// at some part of the picture, if that is foreseen to fit into some time; says
    /// whether it did. A camera that moves on sees other things.
    ///
    /// # Errors
    /// As [`Renderer::render`].
    pub fn look_again(
        &mut self,
        renderer: &mut Renderer,
        (scene, camera): (&Scene, &Camera),
        spare: Duration,
        clock: &mut dyn FnMut() -> Duration,
    ) -> Result<bool, RenderError> {
        let whole = colors_alone(renderer.settings());
        let window = self.window(&whole, LATER_WINDOW);
        let part = window.settings(&whole);
        let qualities = self.about_the_last(&whole);
        let foreseen = |&quality: &Quality| self.costs.predict(&of_quality(&part, quality));
        let time: Duration = qualities.iter().chain([&self.reference]).map(foreseen).sum();
        let fits = self.patience.with_margin(time) <= spare;
        let Some(there) = window.camera(camera, &whole).filter(|_| fits) else { return Ok(false) };
        // Costs are not learnt from it: what lies in the window is not what lies in the picture.
        self.compare(&qualities, &part, &there, &mut Studio { renderer, scene, clock, repetitions: 1 })?;
        Ok(true)
    }

    /// The last quality and those before and after it.
    fn about_the_last(&self, settings: &RenderSettings) -> Vec<Quality> {
        let all = self.foreseen(settings);
        let at = all.iter().position(|foreseen| Some(foreseen.quality) == self.last).unwrap_or(0);
        all[at.saturating_sub(1)..all.len().min(at + 2)].iter().map(|foreseen| foreseen.quality).collect()
    }

    /// The next window.
    fn window(&mut self, whole: &RenderSettings, (part, most): (f64, u32)) -> Window {
        let window = Window::nth(self.windows, whole, part, most);
        self.windows = self.windows.wrapping_add(1);
        window
    }

    /// Draws the reference and some qualities of the same thing, and learns their errors
    /// from it; returns how long those took that are not the reference.
    fn compare(
        &mut self,
        qualities: &[Quality],
        settings: &RenderSettings,
        camera: &Camera,
        studio: &mut Studio<'_>,
    ) -> Result<Vec<(RenderSettings, Duration)>, RenderError> {
        let best = of_quality(settings, self.reference);
        // Once: nobody will wait for it.
        let (reference, _) = Studio { repetitions: 1, ..studio.reborrow() }.draw(&best, camera)?;
        self.errors.learn(Quality::of(&best), &reference, &reference);
        let mut times = Vec::new();
        for quality in qualities {
            let settings = of_quality(settings, *quality);
            if settings != best {
                let (picture, time) = studio.draw(&settings, camera)?;
                self.errors.learn(Quality::of(&settings), &picture, &reference);
                times.push((settings, time));
            }
        }
        Ok(times)
    }
}

/// Errors are of colours; other outputs would only take time.
fn colors_alone(settings: &RenderSettings) -> RenderSettings {
    RenderSettings { outputs: Outputs::default(), ..settings.clone() }
}

/// Where pictures are drawn by the clock.
struct Studio<'a> {
    renderer: &'a mut Renderer,
    scene: &'a Scene,
    clock: &'a mut dyn FnMut() -> Duration,
    /// How often each is drawn; the shortest time counts, as the first may fill caches.
    repetitions: u32,
}

impl Studio<'_> {
    fn reborrow(&mut self) -> Studio<'_> {
        let Self { renderer, scene, clock, repetitions } = self;
        Studio { renderer, scene, clock, repetitions: *repetitions }
    }

    /// A picture, and how long it takes. The renderer's settings stay.
    fn draw(&mut self, settings: &RenderSettings, camera: &Camera) -> Result<(Frame, Duration), RenderError> {
        let before = std::mem::replace(self.renderer.settings_mut(), settings.clone());
        let (mut frame, mut shortest, mut drawn) = (Frame::default(), Duration::MAX, Ok(()));
        for _ in 0..self.repetitions {
            let start = (self.clock)();
            drawn = drawn.and_then(|()| self.renderer.render_into(self.scene, camera, &mut frame));
            shortest = shortest.min((self.clock)().saturating_sub(start));
        }
        *self.renderer.settings_mut() = before;
        drawn.map(|()| (frame, shortest))
    }
}
