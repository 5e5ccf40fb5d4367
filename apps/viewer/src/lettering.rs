//! Text over an image file: the name at the top, counts on the left, as the window shows them.

use trigon_scene::Frame;

use crate::failure::Failure;

/// What is written over an image.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Lettering {
    /// Above, in the middle.
    pub(crate) top: Vec<String>,
    /// Above, on the left.
    pub(crate) left: Vec<String>,
    /// Below, on the left.
    pub(crate) below: Vec<String>,
}

impl Lettering {
    /// Writes over an image; text is `scale` times as large as usual.
    #[cfg(feature = "window")]
    pub(crate) fn write(&self, frame: &mut Frame, scale: f32) -> Result<(), Failure> {
        if *self != Self::default() {
            painted::write(self, frame, scale).map_err(Failure::work)?;
        }
        Ok(())
    }

    /// There is no font without the window.
    #[cfg(not(feature = "window"))]
    pub(crate) fn write(&self, _: &mut Frame, _: f32) -> Result<(), Failure> {
        if *self == Self::default() {
            return Ok(());
        }
        Err(Failure::work(
            "this trigon-viewer was built without its window and has no font; leave --filename and --metadata out, or build it with the feature `window`",
        ))
    }
}

#[cfg(feature = "window")]
mod painted {
    use trigon_scene::Frame;
    use trigon_window::egui::{
        Align2, Area, Color32, Context, Frame as Panel, Id, RawInput, Rect, RichText, Vec2, pos2, vec2,
    };
    use trigon_window::{ChannelOrder, EguiPainter};

    use super::Lettering;

    /// As in the window.
    const INK: Color32 = Color32::from_gray(240);
    const BACKDROP: Color32 = Color32::from_rgba_premultiplied(10, 11, 14, 170);
    const GAP: f32 = 8.0;

    /// egui paints on premultiplied pixels; the image has straight alpha.
    pub(super) fn write(text: &Lettering, frame: &mut Frame, scale: f32) -> Result<(), String> {
        let context = Context::default();
        context.set_pixels_per_point(scale);
        let size = vec2(frame.width as f32, frame.height as f32) / scale;
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(pos2(0.0, 0.0), size)),
            max_texture_side: Some(trigon_window::MAX_TEXTURE_SIDE),
            ..RawInput::default()
        };
        let mut painter = EguiPainter::new(ChannelOrder::Rgba);
        // The first pass finds how large everything is.
        let mut shapes = Vec::new();
        for _ in 0..2 {
            let mut output = context.run_ui(input.clone(), |ui| lay_out(ui.ctx(), text));
            painter.update_textures(&mut output.textures_delta);
            shapes = output.shapes;
        }
        let primitives = context.tessellate(shapes, context.pixels_per_point());
        painter.set_primitives(primitives, context.pixels_per_point());
        painter.invalidate();
        let straight = frame.color.as_chunks::<4>().0;
        let beneath: Vec<[u8; 4]> = straight
            .iter()
            .map(|&[r, g, b, a]| Color32::from_rgba_unmultiplied(r, g, b, a).to_array())
            .collect();
        let mut pixels = beneath.clone();
        painter
            .paint([frame.width, frame.height], &mut pixels, &beneath)
            .map_err(|error| error.to_string())?;
        for ((to, after), before) in frame.color.as_chunks_mut::<4>().0.iter_mut().zip(pixels).zip(beneath) {
            // What no text covers keeps its bytes.
            if after != before {
                let [r, g, b, a] = after;
                *to = Color32::from_rgba_premultiplied(r, g, b, a).to_srgba_unmultiplied();
            }
        }
        Ok(())
    }

    fn lay_out(context: &Context, text: &Lettering) {
        for (name, anchor, offset, lines) in [
            ("top", Align2::CENTER_TOP, vec2(0.0, GAP), &text.top),
            ("left", Align2::LEFT_TOP, Vec2::splat(GAP), &text.left),
            ("below", Align2::LEFT_BOTTOM, vec2(GAP, -GAP), &text.below),
        ] {
            if lines.is_empty() {
                continue;
            }
            let area = Area::new(Id::unique(name)).anchor(anchor, offset).fade_in(false);
            area.show(context, |ui| {
                Panel::new().fill(BACKDROP).inner_margin(6).corner_radius(4).show(ui, |ui| {
                    for line in lines {
                        ui.label(RichText::new(line).monospace().color(INK));
                    }
                });
            });
        }
    }
}

#[cfg(all(test, feature = "window"))]
mod tests {
    use super::*;

    fn frame() -> Frame {
        Frame { width: 200, height: 100, color: [90, 120, 150, 255].repeat(200 * 100), ..Frame::default() }
    }

    #[test]
    fn text_covers_its_place_and_nothing_else() {
        let mut written = frame();
        let text = Lettering { top: vec!["chair.glb".to_owned()], ..Lettering::default() };
        text.write(&mut written, 1.0).expect("written");
        let changed: Vec<usize> = (0..200 * 100)
            .filter(|pixel| {
                written.color[4 * pixel..4 * pixel + 4] != frame().color[4 * pixel..4 * pixel + 4]
            })
            .collect();
        assert!(changed.len() > 500, "a backdrop with letters: {} pixels", changed.len());
        assert!(changed.iter().all(|pixel| pixel / 200 < 40 && (40..160).contains(&(pixel % 200))), "above");
        let mut large = frame();
        text.write(&mut large, 2.0).expect("written");
        let bright = |frame: &Frame| frame.color.chunks(4).filter(|pixel| pixel[0] > 200).count();
        assert!(bright(&large) > 2 * bright(&written), "larger letters");
    }

    #[test]
    fn nothing_to_write_changes_nothing() {
        let mut written = frame();
        Lettering::default().write(&mut written, 1.0).expect("nothing to do");
        assert!(written == frame(), "the same bytes");
    }
}
