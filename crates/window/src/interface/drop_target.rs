//! The hint that is shown while files are dragged over the window.

use egui::{Align2, Color32, Context, FontId, Id, LayerId, Order, Stroke, StrokeKind};

use super::corners::INK;
use crate::stage::Stage;

/// In points, from the window's edges.
const GAP: f32 = 12.0;
const SHADE: Color32 = Color32::from_black_alpha(150);

/// Shows a frame and what a drop would do, if files are over the window.
pub(super) fn show(context: &Context, stage: &Stage) {
    let text = match stage.hovered_files {
        0 => return,
        1 => "Drop the file to open it".to_owned(),
        count => format!("Drop the {count} files to open them"),
    };
    let painter = context.layer_painter(LayerId::new(Order::Foreground, Id::unique("drop target")));
    let area = context.content_rect();
    painter.rect_filled(area, 0, SHADE);
    painter.rect_stroke(area.shrink(GAP), 6, Stroke::new(2.0, INK), StrokeKind::Inside);
    painter.text(area.center(), Align2::CENTER_CENTER, text, FontId::proportional(20.0), INK);
}
