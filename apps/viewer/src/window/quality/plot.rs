//! Draws error against time in the panel; a click on a dot chooses its setting.

use std::time::Duration;

use trigon_scene::quality::plot::{BLUE, Color, GREY, LogAxis, ORANGE, Plot, PlotDot};
use trigon_scene::quality::{Frontier, FrontierDot, Quality};
use trigon_window::egui::{
    Align2, Color32, FontId, Pos2, Rect, Role, Sense, Shape, Stroke, StrokeKind, Ui, Vec2, WidgetInfo, pos2,
    vec2,
};

use crate::frontier::figures;

/// The height of the plot in points, as a share of its width.
const HEIGHT: f32 = 0.68;

/// Of numbers and names in it, in points.
const LETTERS: f32 = 11.0;

/// The radius of dots in points, and of what a click may hit.
const DOT: f32 = 4.0;
const REACH: f32 = 7.0;

/// Where everything is.
struct Layout {
    plot: Plot,
    axes: [LogAxis; 2],
    /// Between the axes.
    area: Rect,
}

/// Shows a plot with what a time per frame buys, and the setting that is shown now. Returns the setting that was
/// clicked.
pub(super) fn show(ui: &mut Ui, frontier: &Frontier, limit: Duration, current: Quality) -> Option<Quality> {
    let width = ui.available_width();
    let (rect, _) = ui.allocate_exact_size(vec2(width, HEIGHT * width), Sense::hover());
    let plot = frontier.plot("", Some(limit));
    let area = Rect::from_min_max(rect.min + vec2(46.0, 18.0), rect.max - vec2(12.0, 34.0));
    let layout = Layout { axes: plot.log_axes(), plot, area };
    layout.draw_axes(ui, rect);
    layout.draw_lines(ui);
    let pairs = || frontier.dots.iter().zip(&layout.plot.dots);
    for (dot, plotted) in pairs() {
        layout.draw_dot(ui, plotted, dot.quality == current);
    }
    for (dot, plotted) in pairs().filter(|(dot, _)| dot.preset.is_some()) {
        layout.draw_name(ui, plotted, &dot.name());
    }
    let mut clicked = None;
    for (index, (dot, plotted)) in pairs().enumerate() {
        if layout.is_clicked(ui, index, dot, plotted) {
            clicked = Some(dot.quality);
        }
    }
    clicked
}

/// A colour of plots on the panel.
fn themed(ui: &Ui, color: Color) -> Color32 {
    /// On dark panels.
    const LIGHT_BLUE: Color = [0x7a, 0xb4, 0xff];
    let is_dark = ui.visuals().dark_mode;
    let [red, green, blue] = if is_dark && color == BLUE { LIGHT_BLUE } else { color };
    Color32::from_rgb(red, green, blue)
}

impl Layout {
    fn point(&self, at: [f64; 2]) -> Pos2 {
        let [x, y] = [0, 1].map(|axis| self.axes[axis].position(at[axis]) as f32);
        pos2(self.area.left() + x * self.area.width(), self.area.bottom() - y * self.area.height())
    }

    fn draw_axes(&self, ui: &Ui, rect: Rect) {
        let (painter, area) = (ui.painter(), self.area);
        let (font, text) = (FontId::proportional(LETTERS), ui.visuals().text_color());
        let line = Stroke::new(1.0, ui.visuals().weak_text_color().gamma_multiply(0.3));
        let [[left, _], [bottom, _]] = self.axes.map(|axis| axis.ends());
        for tick in self.axes[0].ticks() {
            let at = self.point([tick.value, bottom]);
            if let Some(label) = tick.label {
                painter.vline(at.x, area.y_range(), line);
                painter.text(at + vec2(0.0, 3.0), Align2::CENTER_TOP, label, font.clone(), text);
            }
        }
        for tick in self.axes[1].ticks() {
            let at = self.point([left, tick.value]);
            if let Some(label) = tick.label {
                painter.hline(area.x_range(), at.y, line);
                painter.text(at - vec2(4.0, 0.0), Align2::RIGHT_CENTER, label, font.clone(), text);
            }
        }
        painter.text(rect.left_top(), Align2::LEFT_TOP, "RMSE against reference", font.clone(), text);
        painter.text(rect.right_bottom(), Align2::RIGHT_BOTTOM, "ms per frame", font, text);
    }

    fn draw_lines(&self, ui: &Ui) {
        let painter = ui.painter();
        let weak = ui.visuals().weak_text_color();
        for (value, name) in &self.plot.levels {
            let [from, to] = self.axes[0].ends().map(|end| self.point([end, *value]));
            painter.extend(Shape::dashed_line(&[from, to], Stroke::new(1.0, weak), 5.0, 4.0));
            let at = from + vec2(3.0, -1.0);
            painter.text(at, Align2::LEFT_BOTTOM, name, FontId::proportional(LETTERS), weak);
        }
        for line in &self.plot.lines {
            let points = line.points.iter().map(|&point| self.point(point)).collect();
            painter.line(points, Stroke::new(1.0, themed(ui, line.color)));
        }
    }

    fn draw_dot(&self, ui: &Ui, dot: &PlotDot, is_current: bool) {
        let (painter, at, color) = (ui.painter(), self.point(dot.at), themed(ui, dot.color));
        if let Some(ends) = dot.spread.map(|spread| spread.map(|time| self.point([time, dot.at[1]]))) {
            painter.line_segment(ends, Stroke::new(1.0, color));
        }
        let radius = if dot.color == GREY { DOT - 1.0 } else { DOT };
        if dot.is_filled {
            painter.circle_filled(at, radius, color);
        } else {
            painter.circle(at, radius, ui.visuals().panel_fill, Stroke::new(1.5, color));
        }
        if dot.has_ring {
            painter.circle_stroke(at, DOT + 3.0, Stroke::new(1.5, themed(ui, ORANGE)));
        }
        if is_current {
            let frame = Rect::from_center_size(at, Vec2::splat(2.0 * DOT + 10.0));
            let stroke = Stroke::new(1.5, ui.visuals().strong_text_color());
            painter.rect_stroke(frame, 0.0, stroke, StrokeKind::Middle);
        }
    }

    /// Above the dot and to its right, or to its left where there is no space.
    fn draw_name(&self, ui: &Ui, dot: &PlotDot, name: &str) {
        let (font, color) = (FontId::proportional(LETTERS), ui.visuals().text_color());
        let galley = ui.painter().layout_no_wrap(name.to_owned(), font, color);
        let at = self.point(dot.at) + vec2(REACH, -REACH - galley.size().y);
        let most = self.area.right() - galley.size().x;
        ui.painter().galley(pos2(at.x.min(most), at.y.max(self.area.top())), galley, color);
    }

    fn is_clicked(&self, ui: &Ui, index: usize, dot: &FrontierDot, plotted: &PlotDot) -> bool {
        let rect = Rect::from_center_size(self.point(plotted.at), Vec2::splat(2.0 * REACH));
        let response = ui.interact(rect, ui.scope_id().with(("frontier", index)), Sense::click());
        let text = format!("{}: {}", dot.name(), figures(dot));
        response.widget_info(|| WidgetInfo::labeled(Role::Button, ui.is_enabled(), &text));
        let more = format!("{text}\n{}\n{}; click to use it", dot.quality, dot.standing.name());
        response.on_hover_text(more).clicked()
    }
}
