//! What is written over a picture, in its order: the mark of the selection,
//! texts in their corners, messages, the cheat sheet over all.

use std::time::Duration;

use trigon_camera::Projector;

use crate::canvas::Canvas;
use crate::keymap::sheet;
use crate::overlay::{Block, Corner, Font, draw_block, draw_box, draw_sheet};
use crate::stage::{FrameReport, Stage, Visibility};

/// Draws everything that lies over the picture.
pub(crate) fn compose(canvas: &mut Canvas, stage: &mut Stage, now: Duration) {
    if let Some(bounds) = stage.selection_bounds() {
        let projector = Projector::new(&stage.camera(), stage.viewport());
        draw_box(canvas, &projector, &bounds, stage.scale().round().max(1.0) as i32);
    }
    let font = Font::for_scale(stage.scale());
    let messages = stage.overlay.messages(now);
    for corner in Corner::ALL {
        let own = stage.overlay.lines(corner).iter().cloned();
        let lines: Vec<String> = match corner {
            Corner::TopRight if stage.frame_time == Visibility::Shown => {
                own.chain([frame_time(stage.report())]).collect()
            }
            Corner::BottomLeft => messages.iter().cloned().chain(own).collect(),
            _ => own.collect(),
        };
        draw_block(canvas, font, Block { corner, lines: &lines });
    }
    if stage.cheat_sheet == Visibility::Shown {
        draw_sheet(canvas, font, &sheet(&stage.keymap));
    }
}

/// "12.3 ms, 81 fps": how long a frame takes, and how many of them would fit
/// into a second.
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
    fn frame_time_reads_as_both_units() {
        let render = Duration::from_micros(10_000);
        let text = frame_time(FrameReport { render, present: Duration::from_micros(2_500) });
        assert_eq!(text, "12.5 ms, 80 fps", "the whole frame counts");
        assert_eq!(frame_time(FrameReport::default()), "- ms", "before the first frame");
    }
}
