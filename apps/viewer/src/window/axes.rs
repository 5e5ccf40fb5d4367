//! The directions of the axes in a corner of the window: the same arrows as in images.

use trigon_math::{DQuat, Vec3};
use trigon_window::{Comparison, Stage, egui};

use crate::axes;

/// The room below them, where the window says how far an image is refined, in points.
const BELOW: f32 = 40.0;

/// The arrows, drawn anew only when the camera turns.
#[derive(Default)]
pub(super) struct AxesOverlay {
    drawn: Option<((DQuat, u32), egui::TextureHandle)>,
}

impl AxesOverlay {
    /// Shows arrows of these colours (linear RGB) at the lower right of what no panel covers.
    pub(super) fn show(&mut self, ui: &egui::Ui, stage: &Stage, colors: [Vec3; 3]) {
        let viewport = stage.viewport();
        let side = axes::side(viewport.width, viewport.height);
        let of = (stage.orbit.orientation(), side);
        if self.drawn.as_ref().is_none_or(|(known, _)| *known != of) {
            // Too large an image is the only error, and the window is larger.
            let Ok(arrows) = axes::arrows(side, of.0, colors, &stage.settings) else { return };
            let size = [side as usize; 2];
            let image = egui::ColorImage::from_rgba_unmultiplied(size, &arrows.color);
            let texture = ui.ctx().load_texture("axes", image, egui::TextureOptions::NEAREST);
            self.drawn = Some((of, texture));
        }
        let Some((_, texture)) = &self.drawn else { return };
        let size = egui::Vec2::splat(side as f32) / ui.ctx().pixels_per_point();
        let area = egui::Area::new(egui::Id::unique("axes")).order(egui::Order::Background);
        let free = ui.available_rect_before_wrap();
        let legend = ui.ctx().memory(|memory| memory.area_rect(egui::Id::unique("legend")));
        // In a narrow view the legend of the heat map takes the whole width.
        let legend = legend.filter(|_| stage.comparison == Comparison::Shown);
        let below = legend.map_or(BELOW, |legend| free.max.y - legend.min.y + 8.0);
        let area = area.anchor(egui::Align2::RIGHT_BOTTOM, [-8.0, -below]).interactable(false);
        let area = area.constrain_to(free).fade_in(false);
        area.show(ui.ctx(), |ui| ui.image((texture.id(), size)));
    }
}
