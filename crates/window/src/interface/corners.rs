//! Lines of text in the corners, and messages above the lower left ones.

use std::time::Duration;

use egui::{Align, Align2, Area, Color32, Context, Frame, Id, Layout, Order, RichText, vec2};

use crate::overlay::Corner;
use crate::pacing::Progress;
use crate::stage::{FrameReport, Stage, Visibility};

/// White on a dark backdrop is readable over any image.
pub(super) const INK: Color32 = Color32::from_gray(240);
pub(super) const BACKDROP: Color32 = Color32::from_rgba_premultiplied(10, 11, 14, 170);

/// From the edges, in points.
pub(super) const GAP: f32 = 8.0;

/// Writes all corners of the area that no panel covers; returns the area between the upper and the lower ones.
pub(super) fn show(context: &Context, free: egui::Rect, stage: &mut Stage, now: Duration) -> egui::Rect {
    let messages = stage.overlay.messages(now);
    let all = Corner::ALL.map(|corner| {
        let mut lines = stage.overlay.lines(corner).to_vec();
        match corner {
            Corner::TopRight => lines.extend(times(stage)),
            Corner::BottomRight => lines.extend(stage.progress().map(|of| progress(of, stage.percent()))),
            Corner::BottomLeft => drop(lines.splice(..0, messages.iter().cloned())),
            _ => {}
        }
        (corner, lines)
    });
    let mut left = free;
    for (corner, lines) in all.iter().filter(|(_, lines)| !lines.is_empty()) {
        let is_beside = |other: Corner| other != *corner && is_lower(other) == is_lower(*corner);
        let is_alone = !all.iter().any(|(other, lines)| is_beside(*other) && !lines.is_empty());
        let width = (free.width() - 4.0 * GAP) * if is_alone { 1.0 } else { share(*corner) };
        let written = write(context, (free, width), *corner, lines);
        if is_lower(*corner) {
            left.max.y = left.max.y.min(written.min.y);
        } else {
            left.min.y = left.min.y.max(written.max.y);
        }
    }
    left
}

fn is_lower(corner: Corner) -> bool {
    matches!(corner, Corner::BottomLeft | Corner::BottomRight)
}

/// The most of the width that a corner takes beside others. They leave a gap between them: the one in the
/// middle of the top takes half of its share from either side.
fn share(corner: Corner) -> f32 {
    match corner {
        Corner::TopLeft | Corner::TopRight => 0.36,
        Corner::Top => 0.25,
        Corner::BottomLeft => 0.66,
        Corner::BottomRight => 0.32,
    }
}

/// Writes one of them, no wider than that. Returns where.
fn write(
    context: &Context,
    (free, width): (egui::Rect, f32),
    corner: Corner,
    lines: &[String],
) -> egui::Rect {
    let (anchor, offset) = match corner {
        Corner::TopLeft => (Align2::LEFT_TOP, vec2(GAP, GAP)),
        Corner::Top => (Align2::CENTER_TOP, vec2(0.0, GAP)),
        Corner::TopRight => (Align2::RIGHT_TOP, vec2(-GAP, GAP)),
        Corner::BottomLeft => (Align2::LEFT_BOTTOM, vec2(GAP, -GAP)),
        Corner::BottomRight => (Align2::RIGHT_BOTTOM, vec2(-GAP, -GAP)),
    };
    let id = Id::unique(("corner", corner as usize));
    let before = context.memory(|memory| memory.area_rect(id));
    let area = Area::new(id).order(Order::Background);
    let area = area.anchor(anchor, offset).constrain_to(free).interactable(false).fade_in(false);
    let shown = area.show(context, |ui| {
        ui.set_max_width(width.max(1.0));
        let frame = Frame::new().fill(BACKDROP).inner_margin(6).corner_radius(4);
        frame.show(ui, |ui| {
            ui.with_layout(Layout::top_down(Align::Min), |ui| {
                for line in lines {
                    ui.label(RichText::new(line).monospace().color(INK));
                }
            });
        });
    });
    let written = shown.response.rect;
    if before.is_none_or(|before| before.size() != written.size()) {
        // egui places an anchored area by the size that it had before: longer text would leave the window.
        context.request_discard("a corner has other text");
    }
    written
}

/// "refining 3/4, 2 left, 43 %, 7 s": the share of this step that is drawn.
fn progress(progress: Progress, percent: Option<u8>) -> String {
    let work = match progress {
        Progress::Drawing { .. } => "drawing".to_owned(),
        Progress::Picture { .. } => "drawing a picture to save".to_owned(),
        Progress::Refining { step, of, .. } => {
            format!("refining {step}/{of}, {} left", (of + 1).saturating_sub(step))
        }
    };
    let share = percent.map(|percent| format!(", {percent} %, {} s", progress.seconds()));
    work + &share.unwrap_or_default()
}

/// What the last frame took, as far as that is to be shown.
fn times(stage: &Stage) -> Vec<String> {
    let is_shown = |visibility| visibility == Visibility::Shown;
    let mut lines = Vec::new();
    if is_shown(stage.frame_time) || is_shown(stage.stage_times) {
        lines.push(frame_time(stage.report()));
    }
    if is_shown(stage.stage_times) {
        lines.extend(stage_times(stage.report()));
    }
    lines
}

/// A line for each stage; of those in tiles the sum over all threads.
fn stage_times(FrameReport { stages, present, .. }: FrameReport) -> [String; 7] {
    [
        ("vertices", stages.vertices),
        ("set-up", stages.set_up),
        ("visibility", stages.visibility),
        ("shading", stages.shading),
        ("blending", stages.blending),
        ("resolve", stages.resolve),
        ("interface", present),
    ]
    .map(|(stage, time)| format!("{stage:10} {:8.2} ms", time.as_secs_f64() * 1e3))
}

/// "12.3 ms, 81 fps": the time of an image, and the corresponding rate.
fn frame_time(report: FrameReport) -> String {
    let seconds = (report.render + report.present).as_secs_f64();
    if seconds <= 0.0 {
        return String::from("- ms");
    }
    format!("{:.1} ms, {:.0} fps", seconds * 1e3, seconds.recip())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn progress_says_what_is_left_and_how_much_is_drawn() {
        let refining = |seconds| Progress::Refining { step: 3, of: 4, seconds };
        assert_eq!(progress(refining(0), None), "refining 3/4, 2 left", "at first");
        assert_eq!(progress(refining(7), Some(43)), "refining 3/4, 2 left, 43 %, 7 s", "when it takes long");
        let drawing = progress(Progress::Drawing { seconds: 2 }, Some(0));
        assert_eq!(drawing, "drawing, 0 %, 2 s", "the first picture");
    }

    #[test]
    fn frame_time_reads_as_both_units() {
        let render = Duration::from_micros(10_000);
        let report = FrameReport { render, present: Duration::from_micros(2_500), ..FrameReport::default() };
        let text = frame_time(report);
        assert_eq!(text, "12.5 ms, 80 fps", "the whole frame counts");
        assert_eq!(frame_time(FrameReport::default()), "- ms", "before the first frame");
    }
}
