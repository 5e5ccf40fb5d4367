//! From the world to logical pixels.

use trigon_document::scene::camera::{Camera, Projector, Ray, Viewport};
use trigon_document::scene::math::{DVec2, DVec3};
use trigon_window::clip_line;
use trigon_window::egui::{Pos2, Rect, pos2};

use crate::up::Up;

/// A camera, the image that it sees, and how large its pixels are.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OverlayView {
    projector: Projector,
    /// Physical pixels to a logical one.
    scale: f64,
    /// Where the image is in the window, in physical pixels.
    origin: DVec2,
    /// In which axes it is shown.
    up: Up,
}

impl OverlayView {
    /// For an image in physical pixels.
    pub(crate) fn new(camera: &Camera, viewport: Viewport, scale: f64) -> Self {
        Self { projector: Projector::new(camera, viewport), scale, origin: DVec2::ZERO, up: Up::Y }
    }

    /// The same image at another position in the window, in physical pixels.
    pub(crate) fn placed_at(self, origin: DVec2) -> Self {
        Self { origin, ..self }
    }

    /// The same image in other axes.
    pub(crate) fn with_up(self, up: Up) -> Self {
        Self { up, ..self }
    }

    pub(crate) fn up(&self) -> Up {
        self.up
    }

    pub(crate) fn camera(&self) -> &Camera {
        self.projector.camera()
    }

    /// Metres along the line of sight from the eye.
    pub(crate) fn distance(&self, point: DVec3) -> f64 {
        -self.projector.to_camera(point).z
    }

    /// Where a point is drawn; `None` behind the eye.
    pub(crate) fn point(&self, point: DVec3) -> Option<Pos2> {
        let is_visible = self.distance(point) >= self.nearest();
        self.projector.to_screen(point).filter(|_| is_visible).map(|at| self.logical(at))
    }

    /// How many metres a logical pixel is at a point's distance.
    pub(crate) fn pixel_size(&self, point: DVec3) -> f64 {
        let height = self.camera().projection.height_at(self.distance(point).max(self.nearest()));
        height * self.scale / f64::from(self.projector.viewport().height.max(1))
    }

    /// The visible part of a line in the world; `None` where there is none.
    pub(crate) fn line(&self, from: DVec3, to: DVec3) -> Option<[Pos2; 2]> {
        let [from, to] = self.projector.line_to_screen([from, to], self.nearest())?;
        let size = self.projector.viewport().size();
        clip_line(from, to, size).map(|(from, to)| [self.logical(from), self.logical(to)])
    }

    /// The distance in front of the eye at which lines are clipped, in metres: much nearer than the near
    /// plane, which lies right in front of the scene, while the floor continues. A parallel projection also
    /// shows what is behind the eye.
    fn nearest(&self) -> f64 {
        const SHARE: f64 = 1e-3;
        let projection = &self.camera().projection;
        if projection.is_orthographic() { f64::NEG_INFINITY } else { projection.near() * SHARE }
    }

    /// All points that are drawn at a physical pixel.
    pub(crate) fn ray(&self, pixel: DVec2) -> Option<Ray> {
        self.projector.ray(pixel)
    }

    /// Physical pixels of the image at a logical point of the window.
    pub(crate) fn physical(&self, at: Pos2) -> DVec2 {
        DVec2::new(f64::from(at.x), f64::from(at.y)) * self.scale - self.origin
    }

    /// The logical point of the window at physical pixels of the image.
    pub(crate) fn logical(&self, at: DVec2) -> Pos2 {
        let at = (at + self.origin) / self.scale;
        pos2(at.x as f32, at.y as f32)
    }

    /// The part of the window that the image fills, in logical pixels.
    pub(crate) fn rect(&self) -> Rect {
        Rect::from_two_pos(self.logical(DVec2::ZERO), self.logical(self.projector.viewport().size()))
    }
}

/// From a point to the line between two others, in pixels.
pub(crate) fn distance_to_line([a, b]: [Pos2; 2], point: Pos2) -> f32 {
    let along = b - a;
    let length = along.length_sq();
    let share = if length > 0.0 { ((point - a).dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
    (a + along * share).distance(point)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Looks at the origin from 10 m in front of it, 800 × 600 physical pixels, two to a logical one.
    pub(in super::super) fn front() -> OverlayView {
        let camera = Camera::look_at(DVec3::new(0.0, 0.0, 10.0), DVec3::ZERO, DVec3::Y);
        OverlayView::new(&camera, Viewport { width: 800, height: 600 }, 2.0)
    }

    #[test]
    fn the_target_is_in_the_middle_in_logical_pixels() {
        let view = front();
        assert_eq!(view.point(DVec3::ZERO), Some(pos2(200.0, 150.0)));
        assert_eq!(view.point(DVec3::new(0.0, 0.0, 11.0)), None, "behind the eye");
        let size = view.pixel_size(DVec3::ZERO);
        let beside = view.point(DVec3::X * size * 30.0).expect("before the eye");
        assert!((beside.x - 230.0).abs() < 1e-3, "30 pixels to the right: {beside}");
    }

    #[test]
    fn the_near_plane_of_a_view_cuts_nothing() {
        let camera = Camera::look_at(DVec3::new(0.0, 0.0, 10.0), DVec3::ZERO, DVec3::Y);
        let projection =
            trigon_document::scene::camera::Projection::perspective(0.8, 9.0, None).expect("valid");
        let viewport = Viewport { width: 800, height: 600 };
        let view = OverlayView::new(&camera.with_projection(projection), viewport, 1.0);
        assert_eq!(view.point(DVec3::Z * 5.0), Some(pos2(400.0, 300.0)), "4 m before the plane");
    }

    #[test]
    fn a_line_past_the_eye_ends_in_the_image() {
        let view = front();
        // From the target past the eye, a little below it.
        let line = view.line(DVec3::ZERO, DVec3::new(0.0, -1.0, 20.0)).expect("its far half is seen");
        assert_eq!(line[0], pos2(200.0, 150.0));
        assert!((line[1].x - 200.0).abs() < 1e-3 && (line[1].y - 300.0).abs() < 1e-3, "{}", line[1]);
        let behind = [DVec3::new(0.0, 0.0, 11.0), DVec3::new(5.0, 0.0, 30.0)];
        assert_eq!(view.line(behind[0], behind[1]), None);
    }

    #[test]
    fn lines_stay_in_the_image_however_long_they_are() {
        let view = front();
        let line = view.line(DVec3::new(-1e9, 0.0, 0.0), DVec3::new(1e9, 0.0, 0.0)).expect("it crosses");
        for (end, x) in line.into_iter().zip([0.0, 400.0]) {
            assert!((end.x - x).abs() < 1e-2 && (end.y - 150.0).abs() < 1e-2, "{end}");
        }
    }
}
