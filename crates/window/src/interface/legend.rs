//! The legend of the heat map.

use egui::{Align2, Area, Color32, Context, Frame, Id, Order, RichText, vec2};

use super::corners::{BACKDROP, GAP, INK};
use crate::refinement::{CLASSES, Class, Comparison, Difference};
use crate::stage::Stage;

/// In points.
const SWATCH: egui::Vec2 = vec2(14.0, 14.0);

/// In a view narrower than this many points the swatches take two rows.
const ONE_ROW: f32 = 640.0;

/// Shows it under the map, centred in the area that no panel covers.
pub(super) fn show(context: &Context, free: egui::Rect, stage: &Stage) {
    if stage.comparison != Comparison::Shown {
        return;
    }
    let difference = stage.quality_report().and_then(|report| report.difference);
    let area = Area::new(Id::unique("legend")).order(Order::Background).interactable(false).fade_in(false);
    let area = area.anchor(Align2::CENTER_BOTTOM, vec2(0.0, -GAP)).constrain_to(free);
    let before = context.memory(|memory| memory.area_rect(Id::unique("legend")));
    let shown = area.show(context, |ui| {
        ui.set_max_width((free.width() - 4.0 * GAP).max(1.0));
        Frame::new().fill(BACKDROP).inner_margin(6).corner_radius(4).show(ui, |ui| match difference {
            None => {
                ui.label(RichText::new("drawing the reference for comparison").color(INK));
            }
            Some(difference) => {
                ui.label(RichText::new(figures(&difference)).color(INK));
                ui.label(RichText::new("levels of 255:").color(INK));
                let count = if free.width() < ONE_ROW { CLASSES.len().div_ceil(2) } else { CLASSES.len() };
                for classes in CLASSES.chunks(count) {
                    ui.horizontal(|ui| swatches(ui, classes));
                }
            }
        });
    });
    // It is placed by its size in the pass before, and others make room for it.
    if before != Some(shown.response.rect) {
        context.request_discard("the legend has another place");
    }
}

fn swatches(ui: &mut egui::Ui, classes: &[Class]) {
    for class in classes {
        let (rect, _) = ui.allocate_exact_size(SWATCH, egui::Sense::hover());
        let [r, g, b] = class.color;
        ui.painter().rect_filled(rect, 2, Color32::from_rgb(r, g, b));
        ui.label(RichText::new(class.label).monospace().color(INK));
    }
}

/// "difference from the reference:", and below it "RMSE 0.0123, worst 0.510 (120 levels), in 3.1 % of the pixels"
fn figures(difference: &Difference) -> String {
    let Difference { rmse, worst, worst_levels, share } = *difference;
    if share == 0.0 {
        return "no difference from the reference".to_owned();
    }
    format!(
        "difference from the reference:\nRMSE {rmse:.4}, worst {worst:.3} ({worst_levels} levels), in {:.1} % of the pixels",
        share * 100.0
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_have_their_units() {
        let difference = Difference { rmse: 0.012_34, worst: 0.51, worst_levels: 120, share: 0.031 };
        let text = figures(&difference);
        assert!(text.ends_with("RMSE 0.0123, worst 0.510 (120 levels), in 3.1 % of the pixels"), "{text}");
        assert_eq!(figures(&Difference::default()), "no difference from the reference", "of equal images");
    }
}
