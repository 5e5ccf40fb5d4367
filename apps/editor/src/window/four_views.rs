//! Four views in the part of the window that no panel covers.

use trigon_window::egui::Rect;
use trigon_window::scene::camera::Viewport;
use trigon_window::{Area, Hands, Stage};

use super::editor::Editor;
use super::panes::{point, points};

impl Editor {
    /// Shows four views, or one again.
    pub(crate) fn toggle_four_views(&mut self, stage: &mut Stage) {
        stage.four_views = match stage.four_views {
            Some(_) => None,
            None => Some(area(stage, self.free)),
        };
    }

    /// Whether the pointer is on the image, beside all panels.
    pub(super) fn is_in_view(&self, stage: &Stage, hands: Hands) -> bool {
        let Some((free, at)) = self.free.zip(hands.pointer) else { return true };
        free.contains(point(stage, at))
    }

    /// Four views fill what no panel covers.
    pub(crate) fn fit_four_views(&self, stage: &mut Stage) {
        if stage.four_views.is_some() {
            stage.four_views = Some(area(stage, self.free));
        }
    }
}

fn area(stage: &Stage, free: Option<Rect>) -> Area {
    let Some(free) = free else { return Area { min: [0, 0], size: stage.viewport() } };
    let pixels = |points_of: f32| (f64::from(points_of.max(0.0)) * points(stage)).round() as u32;
    let (min, max) = (free.min, free.max);
    let [left, top] = [pixels(min.x), pixels(min.y)];
    let (width, height) = (pixels(max.x).saturating_sub(left), pixels(max.y).saturating_sub(top));
    Area { min: [left, top], size: Viewport { width, height } }
}
