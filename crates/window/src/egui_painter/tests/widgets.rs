//! Real interfaces: what egui makes of widgets, drawn by this painter.

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

use super::*;

const SCREEN: [u32; 2] = [640, 400];

/// A context with a painter and a window of pixels.
struct Screen {
    context: egui::Context,
    painter: EguiPainter,
    pixels: Vec<[u8; 4]>,
    scale: f32,
}

impl Screen {
    fn new(scale: f32) -> Self {
        let pixels = vec![[0; 4]; (SCREEN[0] * SCREEN[1]) as usize];
        Self { context: egui::Context::default(), painter: EguiPainter::default(), pixels, scale }
    }

    /// A pass of the interface, and what it painted.
    fn pass(&mut self, ui: impl FnMut(&mut egui::Ui)) -> Vec<Rect> {
        let size = egui::vec2(SCREEN[0] as f32, SCREEN[1] as f32) / self.scale;
        let mut input = egui::RawInput {
            screen_rect: Some(egui::Rect::from_min_size(egui::Pos2::ZERO, size)),
            max_texture_side: Some(MAX_TEXTURE_SIDE),
            ..Default::default()
        };
        let viewport = input.viewports.get_mut(&egui::ViewportId::ROOT).expect("every input has the root");
        viewport.native_pixels_per_point = Some(self.scale);
        let mut output = self.context.run_ui(input, ui);
        self.painter.update_textures(&mut output.textures_delta);
        let primitives = self.context.tessellate(output.shapes, output.pixels_per_point);
        self.painter.set_primitives(primitives, output.pixels_per_point);
        let beneath = vec![[30, 60, 90, 255]; self.pixels.len()];
        self.painter.paint(SCREEN, &mut self.pixels, &beneath).expect("the sides fit")
    }
}

/// Rows of labels around one that counts.
fn counter(ui: &mut egui::Ui, count: u32) {
    egui::CentralPanel::default().show(ui, |ui| {
        for row in 0..8 {
            ui.label(format!("row {row} says what it always says"));
        }
        ui.label(format!("frame {count}"));
        for row in 0..4 {
            let _ = ui.button(format!("button {row}"));
        }
    });
}

#[test]
fn a_label_that_changes_is_all_that_is_painted() {
    for scale in [1.0, 1.25, 2.0] {
        let mut screen = Screen::new(scale);
        (0..3).for_each(|_| drop(screen.pass(|ui| counter(ui, 10))));
        assert_eq!(screen.pass(|ui| counter(ui, 10)), [], "nothing changed at scale {scale}");
        // 9 to 10 is a glyph more; 11 is as many.
        for count in [11, 9, 10] {
            screen.pass(|ui| counter(ui, count));
        }
        for count in [11, 9, 10] {
            let painted = screen.pass(|ui| counter(ui, count));
            let pixels: i32 =
                painted.iter().map(|rect| (rect.max[0] - rect.min[0]) * (rect.max[1] - rect.min[1])).sum();
            // A glyph, or a word and where it was, in cells of 32 pixels.
            let most = 4 * 32 * 32 * (scale * scale).ceil() as i32;
            assert!(
                (1..=most).contains(&pixels),
                "{pixels} pixels for one label at scale {scale}: {painted:?}"
            );
            let mut fresh = Screen::new(scale);
            fresh.pass(|ui| counter(ui, count));
            fresh.pass(|ui| counter(ui, count));
            assert!(screen.pixels == fresh.pixels, "as if all had been painted");
        }
    }
}

/// Slanting lines over all of the screen: some are there in every pass, two come and go.
#[test]
fn lines_that_come_and_go_leave_the_others_alone() {
    let lines = |ui: &mut egui::Ui, few: bool| {
        let stroke = egui::Stroke::new(1.0, egui::Color32::WHITE);
        for row in 0..60 {
            let is_short = row == 10 || row == 50;
            if few && is_short {
                continue;
            }
            let from = egui::pos2(3.0, 5.0 * row as f32);
            let to = from + if is_short { egui::vec2(20.0, 10.0) } else { egui::vec2(600.0, 90.0) };
            ui.painter().line_segment([from, to], stroke);
        }
    };
    let [mut screen, mut fresh] = [Screen::new(1.0), Screen::new(1.0)];
    screen.pass(|ui| lines(ui, false));
    for few in [true, false] {
        let painted = screen.pass(|ui| lines(ui, few));
        let pixels: i32 =
            painted.iter().map(|rect| (rect.max[0] - rect.min[0]) * (rect.max[1] - rect.min[1])).sum();
        assert!((1..=8 * 32 * 32).contains(&pixels), "{pixels} pixels for two short lines: {painted:?}");
        fresh.painter.invalidate();
        fresh.pass(|ui| lines(ui, few));
        assert!(screen.pixels == fresh.pixels, "as if all had been painted");
    }
}

#[test]
fn textures_are_kept_while_nothing_is_painted() {
    let mut screen = Screen::new(1.0);
    let mut output = screen.context.run_ui(egui::RawInput::default(), |ui| counter(ui, 1));
    screen.painter.update_textures(&mut output.textures_delta);
    assert!(output.textures_delta.is_empty(), "taken over, though the pass was not painted");
    screen.pass(|ui| counter(ui, 1));
    let mut other = Screen::new(1.0);
    (0..2).for_each(|_| drop(other.pass(|ui| counter(ui, 1))));
    assert!(screen.pixels == other.pixels, "the letters are there");
}

/// A texture that is freed in the pass that shows it last, and one that changes in part.
#[test]
fn textures_change_in_part_and_go() {
    let mut screen = Screen::new(1.0);
    let color = |color| egui::ColorImage::filled([8, 8], color);
    let mut texture = Some(screen.context.load_texture("t", color(egui::Color32::RED), Default::default()));
    let image = |ui: &mut egui::Ui, texture: &egui::TextureHandle| {
        let uv = egui::Rect::from_min_max(egui::Pos2::ZERO, egui::pos2(1.0, 1.0));
        let rect = egui::Rect::from_min_size(egui::pos2(100.0, 100.0), egui::vec2(80.0, 80.0));
        ui.painter().image(texture.id(), rect, uv, egui::Color32::WHITE);
    };
    let at = |screen: &Screen, x: usize, y: usize| screen.pixels[y * SCREEN[0] as usize + x];
    screen.pass(|ui| image(ui, texture.as_ref().expect("still there")));
    assert_eq!(at(&screen, 140, 140), [255, 0, 0, 255], "red");
    let part = egui::ColorImage::filled([2, 2], egui::Color32::GREEN);
    texture.as_mut().expect("still there").set_partial([0, 0], part, Default::default());
    let painted = screen.pass(|ui| image(ui, texture.as_ref().expect("still there")));
    assert_eq!(at(&screen, 105, 105), [0, 255, 0, 255], "the corner is green");
    assert_eq!(at(&screen, 170, 170), [255, 0, 0, 255], "the rest is not");
    assert!(!painted.is_empty(), "though the triangles are the same");
    screen.pass(|ui| image(ui, &texture.take().expect("shown for the last time")));
    assert_eq!(at(&screen, 170, 170), [255, 0, 0, 255], "freed after painting");
    screen.pass(|_| {});
    assert_eq!(at(&screen, 170, 170), [30, 60, 90, 255], "and gone");
}

#[test]
fn interface_tests_are_drawn_by_this_painter() {
    let mut harness =
        Harness::builder().with_size([240.0, 120.0]).renderer(EguiTestRenderer::default()).build_ui_state(
            |ui, clicks: &mut u32| {
                if ui.button("press").clicked() {
                    *clicks += 1;
                }
                ui.label(format!("{clicks} clicks"));
            },
            0,
        );
    let before = harness.render().expect("drawn");
    harness.get_by_label("press").click();
    harness.run();
    assert_eq!(*harness.state(), 1, "the button was pressed");
    let after = harness.render().expect("drawn");
    assert_eq!((before.width(), before.height()), (240, 120), "as large as the harness");
    assert!(before != after, "and the label shows it");
}

/// egui's demo library, drawn whole and piece by piece: the same bytes. Set
/// `TRIGON_IMAGES` to a folder to look at it.
#[test]
fn the_demo_library_is_drawn() {
    for scale in [1.0, 2.0] {
        let mut screen = Screen::new(scale);
        let mut demo = egui_demo_lib::DemoWindows::default();
        // Long enough for windows to appear.
        let passes: Vec<usize> = (0..30).map(|_| screen.pass(|ui| demo.ui(ui)).len()).collect();
        assert_eq!(passes[0], 1, "at first all is painted");
        let piecewise = screen.pixels.clone();
        screen.painter.invalidate();
        let beneath = vec![[30, 60, 90, 255]; piecewise.len()];
        screen.painter.paint(SCREEN, &mut screen.pixels, &beneath).expect("the sides fit");
        assert!(piecewise == screen.pixels, "what was left out had not changed");
        let colors: std::collections::HashSet<_> = piecewise.iter().collect();
        assert!(colors.len() > 100, "there is text, smoothed: {} colours", colors.len());
        if let Some(folder) = std::env::var_os("TRIGON_IMAGES") {
            let path = std::path::Path::new(&folder).join(format!("demo-{scale}.png"));
            let image = image::RgbaImage::from_raw(SCREEN[0], SCREEN[1], piecewise.into_flattened());
            image.expect("four bytes for each pixel").save(path).expect("the folder can be written to");
        }
    }
}
