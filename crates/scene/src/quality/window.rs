//! Regions of an image, each drawn by a camera of its own.

use trigon_camera::{Camera, Viewport};

use crate::settings::RenderSettings;

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
