//! The 3D cursor, and the origins of selected objects.

use trigon_document::Document;
use trigon_document::scene::math::DVec3;
use trigon_window::egui::{Color32, Painter, Stroke, vec2};

use super::SELECTED;
use super::view::OverlayView;

/// Of the cursor's ring, in logical pixels.
const RADIUS: f32 = 10.0;
/// Pieces of the ring, which change their colour.
const PIECES: usize = 16;
/// Of an origin, in logical pixels.
const DOT: f32 = 3.0;

/// Draws the 3D cursor: a ring of red and white with a cross, readable on any image.
pub(crate) fn draw_cursor(painter: &Painter, view: &OverlayView, cursor: DVec3) {
    let Some(center) = view.point(cursor) else { return };
    let at = |piece: usize| {
        let turn = piece as f32 / PIECES as f32 * std::f32::consts::TAU;
        center + RADIUS * trigon_window::egui::Vec2::angled(turn)
    };
    for piece in 0..PIECES {
        let color = if piece % 2 == 0 { Color32::from_rgb(230, 40, 40) } else { Color32::WHITE };
        painter.line_segment([at(piece), at(piece + 1)], Stroke::new(1.5, color));
    }
    for direction in [vec2(1.0, 0.0), vec2(-1.0, 0.0), vec2(0.0, 1.0), vec2(0.0, -1.0)] {
        let ends = [center + direction * (RADIUS * 0.5), center + direction * (RADIUS * 1.5)];
        painter.line_segment(ends, Stroke::new(1.0, Color32::from_gray(20)));
    }
}

/// Draws a dot at the origin of each selected object, the active one's brighter.
pub(crate) fn draw_origins(painter: &Painter, document: &Document, view: &OverlayView) {
    let selection = document.selection();
    let places = document.nodes().visible_transforms();
    for &id in &selection.objects {
        let Some(world) = places.get(id.index()).copied().flatten() else { continue };
        if let Some(center) = view.point(world.translation) {
            let color = if selection.active == Some(id) { Color32::WHITE } else { SELECTED };
            painter.circle_filled(center, DOT, color);
            painter.circle_stroke(center, DOT, Stroke::new(1.0, Color32::BLACK));
        }
    }
}
