//! Extra measurements for a budget: small regions of the image, drawn at several qualities and at that of the reference.
//! A camera of its own draws each region.

use std::time::Duration;

use trigon_camera::{Camera, Viewport};

use super::budget::of_quality;
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
        // Makes what lasts from frame to frame, such as a tree for rays, before times count.
        let dot = RenderSettings { width: 1, height: 1, ..whole.clone() };
        studio.draw(&of_quality(&dot, self.reference), camera, 1)?;
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
        // It takes long, so it is drawn once.
        let (reference, longest) = studio.draw(&best, camera, 1)?;
        self.errors.learn(Quality::of(&best), &reference, &reference);
        let mut drawn: Vec<RenderSettings> = Vec::new();
        for (quality, sum) in self.candidates.iter().zip(times) {
            let settings = of_quality(part, *quality);
            if settings == best {
                *sum += longest;
            } else if !drawn.contains(&settings) {
                let (image, time) = studio.draw(&settings, camera, MEASURED)?;
                self.errors.learn(Quality::of(&settings), &image, &reference);
                *sum += time;
                drawn.push(settings);
            }
        }
        Ok(())
    }
}

/// Errors are of colours; other outputs would only take time.
pub(super) fn colors_alone(settings: &RenderSettings) -> RenderSettings {
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

/// A part of an image, in pixels from the top left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Window {
    corner: [u32; 2],
    size: [u32; 2],
}

/// How large windows are.
#[derive(Clone, Copy, Debug)]
pub(super) struct WindowSize {
    /// The part of the image's width and height that they have.
    pub(super) share: f64,
    /// The most pixels of their sides.
    pub(super) most: u32,
}

impl Window {
    /// One of a sequence that comes about everywhere.
    ///
    /// The first lies in the middle, the others at the points of the sequence R2 (M.
    /// Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018).
    pub(super) fn nth(
        number: u32,
        settings: &RenderSettings,
        WindowSize { share, most }: WindowSize,
    ) -> Self {
        const STEPS: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];
        let whole = [settings.width, settings.height];
        let size = whole.map(|side| ((f64::from(side) * share) as u32).clamp(1, most.max(1)));
        let offset = |axis: usize| {
            let free = f64::from(whole[axis].saturating_sub(size[axis]));
            let point = 0.5 + f64::from(number) * STEPS[axis];
            (free * (point - point.floor())) as u32
        };
        Self { corner: [offset(0), offset(1)], size }
    }

    /// The settings of an image of it alone.
    pub(super) fn settings(&self, whole: &RenderSettings) -> RenderSettings {
        RenderSettings { width: self.size[0], height: self.size[1], ..whole.clone() }
    }

    /// The camera that sees of an image what lies in the window, pixel on pixel; `None`
    /// where numbers do not reach.
    pub(super) fn camera(&self, camera: &Camera, whole: &RenderSettings) -> Option<Camera> {
        let whole = Viewport { width: whole.width, height: whole.height };
        camera.part(whole, self.corner, self.size).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quality::rmse;
    use crate::{Background, Frame, render, showcase};
    use trigon_math::Vec3;

    #[test]
    fn windows_come_about_everywhere() {
        let settings = RenderSettings::new(100, 60);
        let middle = Window { corner: [37, 22], size: [25, 15] };
        assert_eq!(
            Window::nth(0, &settings, WindowSize { share: 0.25, most: 999 }),
            middle,
            "the first is in the middle"
        );
        assert_eq!(
            Window::nth(0, &settings, WindowSize { share: 0.25, most: 8 }).size,
            [8, 8],
            "none is too large"
        );
        assert_eq!(
            Window::nth(7, &RenderSettings::new(1, 1), WindowSize { share: 0.1, most: 9 }).size,
            [1, 1],
            "nor too small"
        );
        for quarter in 0..4 {
            let inside = |window: &Window| {
                let [x, y] = [0, 1].map(|axis| window.corner[axis] + window.size[axis] / 2);
                (x / 50 + y / 30 * 2) == quarter
            };
            let seen = (0..16)
                .map(|number| Window::nth(number, &settings, WindowSize { share: 0.25, most: 999 }))
                .filter(inside)
                .count();
            assert!((2..=6).contains(&seen), "of 16, the quarter {quarter} has {seen}");
        }
    }

    #[test]
    fn a_window_shows_the_pixels_of_the_whole() {
        let scene = showcase();
        let background = Background::Color(Vec3::splat(0.2));
        let settings = RenderSettings { background, ..RenderSettings::new(80, 48) };
        let overview = scene.overview(settings.aspect());
        let orthographic = overview.projection.to_orthographic(9.0).expect("in range");
        for camera in [overview, scene.cameras()[0].1, overview.with_projection(orthographic)] {
            let whole = render(&scene, &camera, &settings).expect("drawn");
            let window = Window::nth(1, &settings, WindowSize { share: 0.5, most: 999 });
            let there = window.camera(&camera, &settings).expect("in range");
            let part = render(&scene, &there, &window.settings(&settings)).expect("drawn");
            let cut = cut(&whole, &window);
            // Vertices are snapped to 1/256 pixel in both, so that few of nine samples of an edge differ,
            // and those by less than white. Half a pixel beside it is off by ten times as much.
            let error = rmse(&part, &cut);
            assert!(error < 0.004, "{:?}: {error}", camera.projection);
        }
    }

    fn cut(whole: &Frame, window: &Window) -> Frame {
        let ([left, top], [width, height]) = (window.corner, window.size);
        let places = (0..width * height).map(|i| (left + i % width, top + i / width));
        let color = places.flat_map(|(x, y)| whole.pixel(x, y)).collect();
        Frame { width, height, color, ..Frame::default() }
    }
}
