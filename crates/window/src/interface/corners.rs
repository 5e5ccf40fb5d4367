//! Lines of text in the corners, and messages above the lower left ones.

use std::time::Duration;

use egui::{Align, Align2, Area, Color32, Context, Frame, Id, Layout, Order, RichText, vec2};

use crate::overlay::Corner;
use crate::pacing::{Progress, REST};
use crate::stage::{FrameReport, Stage, Visibility};

/// White on a dark backdrop is readable over any image.
pub(super) const INK: Color32 = Color32::from_gray(240);
pub(super) const BACKDROP: Color32 = Color32::from_rgba_premultiplied(10, 11, 14, 170);

/// From the edges, in points.
pub(super) const GAP: f32 = 8.0;

/// Between text and the edge of its backdrop, in points.
const MARGIN: f32 = 6.0;

/// Writes all corners of the area that no panel covers; returns the area between the upper and the lower ones.
pub(super) fn show(context: &Context, free: egui::Rect, stage: &mut Stage, now: Duration) -> egui::Rect {
    let messages = stage.overlay.messages(now);
    let all = Corner::ALL.map(|corner| {
        let mut lines = stage.overlay.lines(corner).to_vec();
        match corner {
            Corner::TopRight => lines.extend(times(context, stage)),
            Corner::BottomRight => {
                lines.extend(stage.report().is_coarse.then(|| String::from("draft with coarser meshes")));
                lines.extend(stage.progress().map(|of| progress(of, stage.percent())));
            }
            Corner::BottomLeft => drop(lines.splice(..0, messages.iter().cloned())),
            _ => {}
        }
        (corner, lines)
    });
    let mut left = free;
    for (corner, lines) in all.iter().filter(|(_, lines)| !lines.is_empty()) {
        let row = all.each_ref().map(|(other, lines)| {
            let is_beside = is_lower(*other) == is_lower(*corner);
            if is_beside { natural_width(context, lines) } else { 0.0 }
        });
        let written = write(context, corner_layout(*corner, free, row), *corner, lines);
        if is_lower(*corner) {
            left.max.y = left.max.y.min(written.min.y);
        } else {
            left.min.y = left.min.y.max(written.max.y);
        }
    }
    left
}

/// Where a corner is written.
struct CornerLayout {
    /// The area that no panel covers.
    free: egui::Rect,
    /// The most that it takes of its width.
    width: f32,
    /// How far it is moved to the right to make room for a wider one at the left.
    shift: f32,
}

/// The width of lines that are not wrapped, with their frame; 0 of none.
fn natural_width(context: &Context, lines: &[String]) -> f32 {
    let font = egui::TextStyle::Monospace.resolve(&context.global_style());
    let width = |line: &String| {
        let text = context.fonts_mut(|fonts| fonts.layout_no_wrap(line.clone(), font.clone(), INK));
        text.size().x + 2.0 * MARGIN
    };
    lines.iter().map(width).fold(0.0, f32::max).ceil()
}

/// The layout of a corner, given the widths of all in its row, by their numbers, if no line is wrapped. Lines are wrapped
/// only where not all of them fit.
fn corner_layout(corner: Corner, free: egui::Rect, row: [f32; Corner::ALL.len()]) -> CornerLayout {
    let shown = row.iter().filter(|&&width| width > 0.0).count();
    let gaps = GAP * (shown + 1) as f32;
    let width = free.width() - 4.0 * GAP;
    if row.iter().sum::<f32>() + gaps > free.width() {
        return CornerLayout {
            free,
            width: if shown == 1 { width } else { width * share(corner) },
            shift: 0.0,
        };
    }
    let [left, middle, right] = [Corner::TopLeft, Corner::Top, Corner::TopRight].map(|of| row[of as usize]);
    let beside = (free.width() - middle) / 2.0 - GAP;
    let shift = match corner {
        Corner::Top => (left + GAP - beside).max(0.0) - (right + GAP - beside).max(0.0),
        _ => 0.0,
    };
    CornerLayout { free, width: free.width(), shift }
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

/// Writes one of them. Returns where.
fn write(context: &Context, layout: CornerLayout, corner: Corner, lines: &[String]) -> egui::Rect {
    let CornerLayout { free, width, shift } = layout;
    let (anchor, offset) = match corner {
        Corner::TopLeft => (Align2::LEFT_TOP, vec2(GAP, GAP)),
        Corner::Top => (Align2::CENTER_TOP, vec2(shift, GAP)),
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
        let frame = Frame::new().fill(BACKDROP).inner_margin(MARGIN).corner_radius(4);
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
        Progress::Image { .. } => "drawing an image to save".to_owned(),
        Progress::Refining { step, of, .. } => {
            format!("refining {step}/{of}, {} left", (of + 1).saturating_sub(step))
        }
    };
    let share = percent.map(|percent| format!(", {percent} %, {} s", progress.seconds()));
    work + &share.unwrap_or_default()
}

/// What the last frame took, as far as that is to be shown.
fn times(context: &Context, stage: &Stage) -> Vec<String> {
    let is_shown = |visibility| visibility == Visibility::Shown;
    let mut lines = Vec::new();
    if is_shown(stage.frame_time) || is_shown(stage.stage_times) {
        lines.push(frame_time(stage.report(), stage.is_moving()));
        if stage.is_moving() {
            // Then there is no rate any more.
            context.request_repaint_after(REST);
        }
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

/// "12.3 ms, 81 fps": the time of an image, and the corresponding rate while images follow one another.
fn frame_time(report: FrameReport, is_moving: bool) -> String {
    let seconds = (report.render + report.present).as_secs_f64();
    if seconds <= 0.0 {
        return String::from("- ms");
    }
    let time = format!("{:.1} ms", seconds * 1e3);
    if is_moving { format!("{time}, {:.0} fps", seconds.recip()) } else { time }
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
        assert_eq!(drawing, "drawing, 0 %, 2 s", "the first image");
    }

    /// Beside a wide panel the name of the file and the counts were wrapped, although all of them fit.
    #[test]
    fn lines_that_fit_beside_each_other_were_wrapped() {
        let free = egui::Rect::from_min_size(egui::pos2(392.0, 0.0), vec2(408.0, 400.0));
        let row = [160.0, 128.0, 44.0, 0.0, 0.0];
        let layouts = Corner::ALL.map(|corner| corner_layout(corner, free, row));
        assert!(layouts.iter().all(|layout| layout.width >= 160.0), "all of them fit");
        let middle = (free.width() - row[1]) / 2.0 + layouts[Corner::Top as usize].shift;
        assert!(middle >= row[0] + 2.0 * GAP, "beside the left one: {middle}");
        assert!(middle + row[1] + 2.0 * GAP <= free.width() - row[2], "and the right one: {middle}");
        let crowded = corner_layout(Corner::TopLeft, free, [200.0, 200.0, 44.0, 0.0, 0.0]);
        assert!(crowded.width < 160.0, "in too narrow a window all of them are wrapped");
    }

    #[test]
    fn frame_time_reads_as_both_units() {
        let render = Duration::from_micros(10_000);
        let report = FrameReport { render, present: Duration::from_micros(2_500), ..FrameReport::default() };
        assert_eq!(frame_time(report, true), "12.5 ms, 80 fps", "the whole frame counts");
        assert_eq!(frame_time(report, false), "12.5 ms", "an image at rest has no rate");
        assert_eq!(frame_time(FrameReport::default(), true), "- ms", "before the first frame");
    }

    /// Before anything is written it is decided by these widths what has to be wrapped.
    #[test]
    fn lines_with_their_backdrop_are_as_wide_as_foreseen() {
        let context = Context::default();
        let free = egui::Rect::from_min_size(egui::Pos2::ZERO, vec2(800.0, 400.0));
        for lines in [vec!["short", "a line that is longer"], vec!["i"], vec!["", "12 faces", "-"]] {
            let lines: Vec<String> = lines.into_iter().map(String::from).collect();
            let (mut foreseen, mut written) = (0.0, egui::Rect::NOTHING);
            // An area has its size from the second pass on.
            for _ in 0..2 {
                let input = egui::RawInput { screen_rect: Some(free), ..egui::RawInput::default() };
                let mut output = context.run_ui(input, |ui| {
                    foreseen = natural_width(ui.ctx(), &lines);
                    let layout = corner_layout(Corner::TopLeft, free, [foreseen, 0.0, 0.0, 0.0, 0.0]);
                    written = write(ui.ctx(), layout, Corner::TopLeft, &lines);
                });
                output.textures_delta.clear();
            }
            let spare = foreseen - written.width();
            assert!((-0.1..=1.1).contains(&spare), "{lines:?}: {foreseen}, and {} taken", written.width());
        }
    }

    #[test]
    fn the_time_of_a_frame_is_told_with_its_stages_and_without_them() {
        let told = |frame_time, stage_times| {
            let mut stage = Stage::new("test");
            (stage.frame_time, stage.stage_times) = (frame_time, stage_times);
            times(&Context::default(), &stage)
        };
        let (shown, hidden) = (Visibility::Shown, Visibility::Hidden);
        assert!(told(hidden, hidden).is_empty(), "nobody wants to know");
        assert_eq!(told(shown, hidden), ["- ms"], "only the whole");
        for frame_time in [hidden, shown] {
            let lines = told(frame_time, shown);
            assert_eq!((lines.len(), lines[0].as_str()), (8, "- ms"), "seven stages below the whole");
            assert!(lines[1].starts_with("vertices") && lines[7].starts_with("interface"), "{lines:?}");
        }
    }
}
