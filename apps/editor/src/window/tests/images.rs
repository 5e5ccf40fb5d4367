//! Rendered images, screenshots and shadows.

use std::sync::mpsc::{Receiver, Sender, channel};

use serde_json::json;
use trigon_document::scene::quality::Preset;
use trigon_document::scene::{Frame, Shadows, render};
use trigon_io::{Limits, load_image};
use trigon_window::scene::math::DVec3;

use super::sessions::{SIZE, at_the_editor};
use super::*;
use crate::request::{DisplayMode, FileRequest, ImageKind, SolidColor, ViewRequest};
use crate::window::images::{Rendered, RenderedImage, Rendering};

impl Worked {
    fn view(&mut self, request: ViewRequest) {
        self.editor.perform(&mut self.stage, Request::View(request));
    }

    fn run_all(&mut self, commands: &[serde_json::Value]) {
        for command in commands {
            self.editor.run(serde_json::from_value(command.clone()).expect("a command"));
        }
    }

    /// A small image, soon drawn.
    fn choose_small(&mut self) {
        let choices = &mut self.editor.images.choices;
        (choices.width, choices.height, choices.preset) = (64, 48, Preset::Draft);
    }

    fn press_f12(&mut self) {
        assert_eq!(self.key(WindowKey::Function(12), Modifiers::NONE), Taken::Yes, "F12 is the editor's");
    }

    fn rendered(&self) -> &Frame {
        &self.editor.images.rendered.as_ref().expect("there is an image").frame
    }
}

/// An image that waits at a gate, which the sender opens by the result.
fn gated() -> (Rendering, Sender<Rendered>, Receiver<()>) {
    let ((open, gate), (wake, woken)) = (channel(), channel());
    let draw = move |_: &_| gate.recv().expect("the test opens the gate");
    let rendering = Rendering::start(draw, move || wake.send(()).expect("the test waits"));
    (rendering, open, woken)
}

fn tiny() -> RenderedImage {
    RenderedImage::new(Frame { width: 1, height: 1, color: vec![9, 8, 7, 255], ..Frame::default() })
}

#[test]
fn rendered_display_shows_shadows_of_the_lights_of_the_document_alone() {
    let mut worked = Worked::new();
    assert_eq!(worked.stage.settings.effects.shadows, Shadows::Off, "solid has none");
    worked.view(ViewRequest::Display(DisplayMode::Rendered));
    assert!(
        matches!(worked.stage.settings.effects.shadows, Shadows::Maps { .. }),
        "the document has a light"
    );
    worked.run_all(&[
        json!({ "op": "add_object", "object": { "shape": "plane", "width": 12.0, "depth": 12.0 },
                             "position": [0.0, -1.0, 0.0] }),
    ]);
    worked.view(ViewRequest::FrameAll);
    let mut settings = worked.stage.settings.clone();
    (settings.width, settings.height, settings.samples_per_axis) = (160, 120, 1);
    settings.effects.outline = None;
    let draw = |settings: &_| render(&worked.stage.scene, &worked.stage.camera(), settings).expect("drawn");
    let with = draw(&settings);
    settings.effects.shadows = Shadows::Off;
    let without = draw(&settings);
    assert!(with.color.iter().zip(&without.color).all(|(with, without)| with <= without), "shadows are dark");
    let darker = with
        .color
        .iter()
        .zip(&without.color)
        .filter(|(with, without)| with.saturating_add(20) < **without)
        .count();
    assert!(darker > 3 * 50, "the cube's shadow on the plane: {darker}");
    let light = json!({ "op": "select", "objects": ["Light"] });
    worked.run_all(&[light, json!({ "op": "delete_objects" })]);
    let Worked { editor, stage } = &mut worked;
    editor.show(stage);
    assert_eq!(stage.settings.effects.shadows, Shadows::Off, "the studio's lights have none");
}

#[test]
fn f12_without_a_camera_offers_the_view_and_enter_renders_it() {
    let mut harness = harness();
    harness.state_mut().choose_small();
    harness.state_mut().press_f12();
    harness.run();
    harness.get_by_label_contains("The scene has no camera");
    harness.key_press(Key::Enter);
    harness.run_steps(2);
    harness.state_mut().editor.images.finish();
    harness.run();
    let worked = harness.state();
    let frame = worked.rendered();
    assert_eq!((frame.width, frame.height), (64, 48), "as chosen");
    let scene = worked.stage.scene.clone();
    let settings = worked.editor.images.choices.settings(&scene);
    let expected = render(&scene, &worked.stage.camera(), &settings).expect("it can be drawn");
    assert!(frame.color != vec![frame.color[0]; frame.color.len()], "something is in it");
    assert_eq!(settings.effects.shadows, Preset::Draft.quality().shadows, "with the shadows of the light");
    // The stage's materials are those of Solid: of the cube they are the same.
    assert!(*frame == expected, "what the view sees");
    harness.get_by_label_contains("64 × 48 pixels");
}

#[test]
fn f12_renders_what_the_camera_sees() {
    let mut worked = Worked::new();
    worked.choose_small();
    worked.run_all(&[json!({ "op": "add_camera", "position": [0.0, 0.0, 9.0] })]);
    worked.press_f12();
    assert!(worked.editor.images.is_open && worked.editor.images.rendering.is_some(), "at once");
    worked.editor.images.finish();
    let (_, camera) = worked.editor.document.nodes().cameras()[0];
    assert!(camera.position.distance(DVec3::new(0.0, 0.0, 9.0)) < 1e-9, "it stands before the cube");
    let scene = worked.editor.document.scene_to_render();
    let settings = worked.editor.images.choices.settings(&scene);
    let expected = render(&scene, &camera, &settings).expect("it can be drawn");
    assert!(*worked.rendered() == expected, "the same as the renderer draws alone");
    assert!(worked.rendered().pixel(32, 24) != worked.rendered().pixel(1, 1), "the cube is in the middle");
}

#[test]
fn escape_cancels_what_is_rendered_then_closes_the_window() {
    let mut harness = harness();
    let (rendering, open, woken) = gated();
    harness.state_mut().editor.images.begin(rendering);
    harness.run_steps(3);
    harness.get_by_label("progress of the image");
    let escape = |worked: &mut Worked| assert_eq!(worked.key(WindowKey::Escape, Modifiers::NONE), Taken::Yes);
    escape(harness.state_mut());
    harness.run();
    assert!(harness.state().editor.images.rendering.is_none(), "it is abandoned");
    harness.get_by_label("Rendering was cancelled.");
    open.send(Ok(tiny())).expect("it waits at the gate");
    woken.recv().expect("it ends");
    harness.state_mut().editor.collect_images();
    assert!(harness.state().editor.images.rendered.is_none(), "its image is nobody's");
    escape(harness.state_mut());
    harness.run();
    assert!(!harness.state().editor.images.is_open, "the window is closed");
    assert!(harness.query_by_label("Through Camera").is_none());
}

#[test]
fn the_document_can_be_edited_while_an_image_is_rendered() {
    let mut worked = Worked::new();
    let (rendering, open, woken) = gated();
    worked.editor.images.begin(rendering);
    worked.key(WindowKey::Character('d'), Modifiers::SHIFT);
    assert_eq!(worked.objects(), 3, "a copy of the cube");
    open.send(Ok(tiny())).expect("it waits at the gate");
    woken.recv().expect("it ends");
    worked.editor.collect_images();
    assert_eq!(worked.rendered().color, [9, 8, 7, 255], "the image is there");
    open.send(Ok(tiny())).expect_err("and nothing renders any more");
}

/// What trigon's own reader finds in a file, or for OpenEXR its first bytes.
#[test]
fn an_image_is_saved_in_each_format_and_read_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut worked = Worked::new();
    worked.choose_small();
    worked.view(ViewRequest::Render);
    worked.editor.images.choices.from = crate::window::images::RenderFrom::View;
    let Worked { editor, stage } = &mut worked;
    editor.render(stage);
    editor.images.finish();
    let mut save = |name: &str| {
        let path = folder.path().join(name);
        let request = FileRequest::SaveImage { kind: ImageKind::Render, path };
        worked.editor.perform(&mut worked.stage, Request::File(request));
    };
    for name in ["a", "b.webp", "c.JPG", "d.exr"] {
        save(name);
    }
    for _ in 0..4 {
        worked.editor.images.finish_writing().expect("it is written");
    }
    let read = |name: &str| load_image(folder.path().join(name), &Limits::default()).expect(name).rgba;
    assert!(read("a.png") == worked.rendered().color, "PNG has every byte, and is the usual ending");
    assert!(read("b.webp") == worked.rendered().color, "so has WebP");
    let (jpeg, own) = (read("c.JPG"), &worked.rendered().color);
    let error: u64 = jpeg.iter().zip(own).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
    assert!(error < 4 * jpeg.len() as u64, "JPEG is near: {error}");
    let exr = std::fs::read(folder.path().join("d.exr")).expect("written");
    assert_eq!(exr[..4], [0x76, 0x2f, 0x31, 0x01], "OpenEXR's magic number");
    let request = FileRequest::SaveImage { kind: ImageKind::Render, path: folder.path().join("e.bmp") };
    worked.editor.perform(&mut worked.stage, Request::File(request));
    assert!(worked.refusal().contains(".png, .jpg, .webp or .exr"), "{}", worked.refusal());
    assert!(!folder.path().join("e.bmp").exists(), "nothing is written");
}

#[test]
fn a_screenshot_is_what_the_view_shows() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("shot.png");
    at_the_editor(folder.path(), &[], SIZE, |user| {
        user.play(&format!(
            "press View\npress Save Screenshot…\ntype {}\nkeys Enter",
            path.with_extension("").display()
        ));
        while !path.exists() || user.editor.borrow().images.under_way().is_some() {
            user.window.wait();
        }
        let image = load_image(&path, &Limits::default()).expect("a PNG");
        let area = user.window.stage().visible_area();
        assert_eq!([image.width, image.height], [area.size.width, area.size.height], "as large as the view");
        // The middle of the window, where no panel, grid or gizmo is.
        let pixels = user.window.pixels();
        let at = (SIZE.height / 2 + 60) as usize * SIZE.width as usize + SIZE.width as usize / 2 + 40;
        let [r, g, b, _] = pixels[at];
        let [left, top] = area.min.map(|side| side as usize);
        let (x, y) = (at % SIZE.width as usize - left, at / SIZE.width as usize - top);
        let at = y * area.size.width as usize + x;
        assert_eq!(image.rgba[4 * at..4 * at + 3], [r, g, b], "the pixel of the window");
    });
}

#[test]
fn choosing_an_image_shows_it_and_leaves_the_display_as_it_is() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("red.png");
    trigon_io::write_png(&path, 1, 1, trigon_io::Pixels::Rgb8(&[255, 0, 0])).expect("written");
    let mut worked = Worked::new();
    let Worked { editor, stage } = &mut worked;
    let cube = editor.document.selection().active.expect("the cube");
    let material = editor.document.nodes().node(cube).expect("it is there").materials[0];
    let material = trigon_document::MaterialName::of(material);
    let slot = trigon_document::TextureSlot::default();
    editor.perform(stage, Request::File(FileRequest::Texture { material, slot, path }));
    assert_eq!((editor.view.display, editor.view.solid), (DisplayMode::Solid, SolidColor::Texture));
    let has_image =
        |stage: &Stage| stage.scene.materials.iter().any(|(_, it)| it.base_color_texture.is_some());
    assert!(has_image(stage), "the image is on the stage");
    editor.perform(stage, Request::View(ViewRequest::Solid(SolidColor::Material)));
    assert!(!has_image(stage), "and off again");
    assert!(
        editor.document.nodes().materials.iter().any(|(_, it)| it.base_color_texture.is_some()),
        "it stays"
    );
}
