//! The outline box of the selected object, drawn by its twelve edges.

use egui::{Color32, Stroke, Ui};
use trigon_camera::{Camera, Projector};
use trigon_math::{Bounds3, DVec2, DVec3};

use crate::{Area, clip_line};

const COLOR: Color32 = Color32::from_rgba_premultiplied(200, 138, 50, 200);

/// In points.
const WIDTH: f32 = 1.5;

/// Draws the edges of a box in front of the eye, where no panel is.
pub(super) fn show(ui: &Ui, camera: &Camera, area: Area, bounds: &Bounds3) {
    let painter = ui.painter().with_clip_rect(ui.available_rect_before_wrap());
    let projector = Projector::new(camera, area.size);
    let points = f64::from(ui.ctx().pixels_per_point());
    let point = |pixel: DVec2| {
        let pixel = pixel + area.origin();
        egui::pos2((pixel.x / points) as f32, (pixel.y / points) as f32)
    };
    for (from, to) in edges(bounds) {
        let ends = projector.to_screen(from).zip(projector.to_screen(to));
        if let Some((from, to)) = ends.and_then(|(from, to)| clip_line(from, to, area.size.size())) {
            painter.line_segment([point(from), point(to)], Stroke::new(WIDTH, COLOR));
        }
    }
}

/// The twelve edges: from every corner along each axis on whose lower side it is.
fn edges(bounds: &Bounds3) -> impl Iterator<Item = (DVec3, DVec3)> {
    let (low, high) = (bounds.min, bounds.max);
    let corner = move |i: usize| {
        let side = |axis: usize| if i >> axis & 1 == 0 { low[axis] } else { high[axis] };
        DVec3::new(side(0), side(1), side(2))
    };
    (0..8usize).flat_map(move |i| {
        (0..3).filter(move |axis| i >> axis & 1 == 0).map(move |axis| (corner(i), corner(i | 1 << axis)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_has_twelve_different_edges() {
        let all: Vec<_> = edges(&Bounds3 { min: DVec3::ZERO, max: DVec3::ONE }).collect();
        assert_eq!(all.len(), 12, "{all:?}");
        for (i, (from, to)) in all.iter().enumerate() {
            assert_eq!(from.distance(*to), 1.0, "an edge changes one coordinate");
            assert!(!all[..i].contains(&(*from, *to)), "({from}, {to}) is there twice");
        }
    }
}
