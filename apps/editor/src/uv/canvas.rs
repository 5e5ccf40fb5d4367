//! From texture coordinates to points of the window, and back.

use trigon_document::scene::math::DVec2;
use trigon_window::egui::{Pos2, Rect};

/// What part of the plane of texture coordinates a rectangle of the window shows. v grows downwards in both.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct UvCanvas {
    /// Where it is in the window, in points.
    pub(crate) rect: Rect,
    /// What is in its middle.
    pub(crate) center: DVec2,
    /// How many points a side of the image is long.
    pub(crate) side: f64,
}

impl UvCanvas {
    /// Where coordinates are drawn.
    pub(crate) fn point(&self, uv: DVec2) -> Pos2 {
        let at = (uv - self.center) * self.side;
        self.rect.center() + trigon_window::egui::vec2(at.x as f32, at.y as f32)
    }

    /// The coordinates that are drawn at a point.
    pub(crate) fn uv(&self, at: Pos2) -> DVec2 {
        let from_middle = at - self.rect.center();
        self.center + DVec2::new(from_middle.x.into(), from_middle.y.into()) / self.side
    }

    /// The square of the image.
    pub(crate) fn image(&self) -> Rect {
        Rect::from_min_max(self.point(DVec2::ZERO), self.point(DVec2::ONE))
    }
}

/// The smallest and the largest side of the image, in points.
const SIDES: [f64; 2] = [8.0, 1e5];

/// Which part is seen, wherever the canvas is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct UvCamera {
    center: DVec2,
    /// How many points a side of the image is long; none until there is a canvas, into which the image fits.
    side: Option<f64>,
}

impl Default for UvCamera {
    fn default() -> Self {
        Self { center: DVec2::splat(0.5), side: None }
    }
}

impl UvCamera {
    /// How large the image is at first, as a share of the canvas.
    const SHARE: f64 = 0.85;

    pub(crate) fn canvas(&self, rect: Rect) -> UvCanvas {
        let fitting = f64::from(rect.width().min(rect.height()).max(1.0)) * Self::SHARE;
        UvCanvas { rect, center: self.center, side: self.side.unwrap_or(fitting) }
    }

    /// Shows a box as large as fits.
    pub(crate) fn frame(&mut self, rect: Rect, low: DVec2, high: DVec2) {
        let size = (high - low).max_element();
        if !(size.is_finite() && (low + high).is_finite()) {
            return;
        }
        let fitting = f64::from(rect.width().min(rect.height()).max(1.0)) * Self::SHARE;
        self.center = (low + high) / 2.0;
        self.side = Some((fitting / size.max(1e-6)).clamp(SIDES[0], SIDES[1]));
    }

    /// What is seen follows the pointer, which moved by this many points.
    pub(crate) fn pan(&mut self, canvas: &UvCanvas, by: trigon_window::egui::Vec2) {
        self.side = Some(canvas.side);
        self.center -= DVec2::new(by.x.into(), by.y.into()) / canvas.side;
    }

    /// Magnifies; what is at the point stays there.
    pub(crate) fn zoom(&mut self, canvas: &UvCanvas, at: Pos2, factor: f64) {
        let side = (canvas.side * factor).clamp(SIDES[0], SIDES[1]);
        let fixed = canvas.uv(at);
        let from_middle = at - canvas.rect.center();
        self.center = fixed - DVec2::new(from_middle.x.into(), from_middle.y.into()) / side;
        self.side = Some(side);
    }
}

#[cfg(test)]
mod tests {
    use trigon_window::egui::pos2;

    use super::*;

    /// 400 by 300 points, and the image fills half of the height.
    fn usual() -> UvCanvas {
        let rect = Rect::from_min_max(pos2(100.0, 50.0), pos2(500.0, 350.0));
        UvCanvas { rect, center: DVec2::splat(0.5), side: 150.0 }
    }

    #[test]
    fn points_and_coordinates_are_inverse() {
        let canvas = usual();
        assert_eq!(canvas.point(DVec2::splat(0.5)), pos2(300.0, 200.0), "the middle");
        assert_eq!(canvas.point(DVec2::ZERO), pos2(225.0, 125.0), "the upper left corner of the image");
        let uv = DVec2::new(0.1, 0.9);
        assert!(canvas.uv(canvas.point(uv)).distance(uv) < 1e-6);
    }

    #[test]
    fn zooming_leaves_what_is_under_the_pointer() {
        let (mut camera, at) = (UvCamera::default(), pos2(150.0, 320.0));
        let canvas = camera.canvas(usual().rect);
        let before = canvas.uv(at);
        camera.zoom(&canvas, at, 3.0);
        let after = camera.canvas(usual().rect);
        assert!(after.uv(at).distance(before) < 1e-6 && (after.side / canvas.side - 3.0).abs() < 1e-9);
        camera.pan(&after, trigon_window::egui::vec2(10.0, -4.0));
        let panned = camera.canvas(usual().rect);
        assert!(panned.uv(at + trigon_window::egui::vec2(10.0, -4.0)).distance(before) < 1e-6, "it follows");
        camera.frame(usual().rect, DVec2::new(2.0, 2.0), DVec2::new(4.0, 3.0));
        let framed = camera.canvas(usual().rect);
        assert!(framed.rect.contains_rect(Rect::from_two_pos(
            framed.point(DVec2::new(2.0, 2.0)),
            framed.point(DVec2::new(4.0, 3.0))
        )));
    }
}
