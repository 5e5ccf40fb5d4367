//! What an image through the scene's camera will hold, while the view looks through it.

use trigon_document::scene::camera::{Camera, Projector, Viewport};
use trigon_document::scene::math::DVec2;
use trigon_window::egui::{Color32, Painter, Rect, Stroke, StrokeKind};

use super::view::OverlayView;

/// Of what lies outside.
const SHADE: Color32 = Color32::from_black_alpha(110);

/// Draws the frame of an image of a size, and darkens what is outside.
pub(crate) fn draw_camera_frame(painter: &Painter, view: &OverlayView, camera: &Camera, image: Viewport) {
    let Some(frame) = frame(view, camera, image) else { return };
    let whole = view.rect();
    let inside = frame.intersect(whole);
    for part in around(whole, inside) {
        painter.rect_filled(part, 0.0, SHADE);
    }
    painter.rect_stroke(frame, 0.0, Stroke::new(1.5, Color32::WHITE), StrokeKind::Inside);
}

/// Where the corners of a camera's image are seen.
fn frame(view: &OverlayView, camera: &Camera, image: Viewport) -> Option<Rect> {
    /// Any distance does: the eye is the same.
    const DISTANCE: f64 = 1.0;
    let projector = Projector::new(camera, image);
    let corner = |at: DVec2| view.point(projector.at_distance(at, DISTANCE)?);
    Some(Rect::from_two_pos(corner(DVec2::ZERO)?, corner(image.size())?))
}

/// What of a rectangle is above, below and beside another one within it.
fn around(whole: Rect, inside: Rect) -> [Rect; 4] {
    let at = |left: f32, top: f32, right: f32, bottom: f32| {
        Rect::from_min_max((left, top).into(), (right, bottom).into())
    };
    [
        at(whole.min.x, whole.min.y, whole.max.x, inside.min.y),
        at(whole.min.x, inside.max.y, whole.max.x, whole.max.y),
        at(whole.min.x, inside.min.y, inside.min.x, inside.max.y),
        at(inside.max.x, inside.min.y, whole.max.x, inside.max.y),
    ]
}

#[cfg(test)]
mod tests {
    use trigon_document::scene::camera::Projection;
    use trigon_document::scene::math::{DVec3, elementary};

    use super::*;

    #[test]
    fn the_frame_of_a_camera_is_what_its_image_will_hold() {
        // Half as high at any distance as what the view sees.
        let narrow = Projection::perspective(2.0 * elementary::atan2(0.25, 1.0), 0.1, None).expect("valid");
        let wide = Projection::perspective(2.0 * elementary::atan2(0.5, 1.0), 0.1, None).expect("valid");
        let eye = Camera::look_at(DVec3::new(3.0, 1.0, 2.0), DVec3::ZERO, DVec3::Y);
        let view = OverlayView::new(&eye.with_projection(wide), Viewport { width: 400, height: 300 }, 1.0);
        let image = Viewport { width: 200, height: 100 };
        let found = frame(&view, &eye.with_projection(narrow), image).expect("before the eye");
        let expected = Rect::from_min_max((50.0, 75.0).into(), (350.0, 225.0).into());
        assert!((found.min - expected.min).length() + (found.max - expected.max).length() < 1e-3, "{found}");
        let area = |rect: &Rect| rect.width() * rect.height();
        let whole = view.rect();
        let outside: f32 = around(whole, found).iter().map(area).sum();
        assert!((outside + area(&found) - area(&whole)).abs() < 1.0, "the rest of the view");
    }
}
