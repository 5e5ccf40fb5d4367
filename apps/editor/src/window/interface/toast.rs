//! What a command did, or why it did nothing, over the view for a few seconds. The status line says it until the next
//! one, and to screen readers.

use std::time::Duration;

use trigon_window::egui::{
    Align2, Color32, Context, Id, LayerId, Order, Rect, Stroke, StrokeKind, TextStyle, vec2,
};

use crate::window::editor::{Editor, Message};

/// How long it stays, in seconds: what was refused has to be read.
const DONE: f64 = 3.0;
const REFUSED: f64 = 6.0;
/// To the border of the view, and from text to the border of the backdrop, in points.
const GAP: f32 = 14.0;
const MARGIN: f32 = 8.0;
/// It is wrapped at this width, in points.
const WIDTH: f32 = 420.0;

/// Shows it at the lower edge of the view.
pub(super) fn show(context: &Context, editor: &mut Editor, free: Rect) {
    let now = context.input(|input| input.time);
    let (message, entries) = (&editor.message, editor.entries());
    let (Message::Hint(text) | Message::Info(text) | Message::Refusal(text)) = message;
    let toast = &mut editor.panels.toast;
    if (&toast.text, toast.entries) != (text, entries) {
        toast.until = now
            + match message {
                Message::Hint(_) => 0.0,
                Message::Info(_) => DONE,
                Message::Refusal(_) => REFUSED,
            };
        (toast.text, toast.entries) = (text.clone(), entries);
    }
    let left = toast.until - now;
    // While a tool runs, its numbers count.
    if left <= 0.0 || text.is_empty() || editor.tool.is_some() {
        return;
    }
    context.request_repaint_after(Duration::from_secs_f64(left));
    let visuals = context.global_style().visuals.clone();
    let color = match message {
        Message::Refusal(_) => visuals.warn_fg_color,
        _ => visuals.strong_text_color(),
    };
    let painter = context.layer_painter(LayerId::new(Order::Foreground, Id::unique("toast")));
    let font = TextStyle::Body.resolve(&context.global_style());
    let width = WIDTH.min(free.width() - 2.0 * (GAP + MARGIN)).max(1.0);
    let text = painter.layout(text.clone(), font, color, width);
    let size = text.size() + vec2(2.0 * MARGIN, 2.0 * MARGIN);
    let backdrop = Align2::CENTER_BOTTOM.anchor_size(free.center_bottom() - vec2(0.0, GAP), size);
    let border = Stroke::new(1.0, visuals.window_stroke.color);
    painter.rect(backdrop, 6.0, visuals.window_fill, border, StrokeKind::Inside);
    painter.galley(backdrop.min + vec2(MARGIN, MARGIN), text, Color32::PLACEHOLDER);
}
