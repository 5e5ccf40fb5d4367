//! Figures and buffers of a small image.

use egui_kittest::kittest::Queryable;
use trigon_document::Document;
use trigon_window::scene::math::Vec3;
use trigon_window::scene::{Material, mesh::primitives, render};
use trigon_window::{Comparison, Refinement};

use super::super::ShownDocument;
use super::super::testing::Case;
use super::*;

fn scene() -> Scene {
    let mut scene = Scene::new();
    let red = Material::from_color(Vec3::X).with_name("red");
    scene.add_object("ball", primitives::icosphere(1.0, 2), red);
    scene
}

fn case(width: f32) -> Case<DevelopmentState> {
    let scene = scene();
    let camera = scene.overview(1.0);
    let panel = move |ui: &mut Ui,
                      _: ShownDocument<'_>,
                      state: &mut DevelopmentState,
                      requests: &mut Vec<Request>| {
        let view = DrawnView {
            scene: &scene,
            camera,
            settings: RenderSettings::new(64, 64),
            report: FrameReport::default(),
            quality: None,
            comparison: Comparison::Off,
            refinement: Refinement::Settings,
        };
        development(ui, &view, state, requests);
    };
    Case::new([width, 1500.0], Document::default(), DevelopmentState::default(), panel)
}

#[test]
fn an_image_is_inspected_when_it_is_asked_for() {
    let mut case = case(260.0);
    assert!(case.harness.query_by_label("Buffer image").is_none(), "not asked for yet");
    case.click("Inspect the image");
    let inspected = case.harness.state().state.inspected.as_ref().expect("it was drawn");
    assert!(inspected.stats.tiles > 0 && inspected.plan.is_some(), "with figures and effects");
    case.choose("Buffer", "Objects");
    case.click("Buffer image");
    assert!(case.harness.query_by_label("Object: ball (number 0)").is_some(), "the middle is the ball");
    assert!(case.harness.query_by_label("Material: red").is_some(), "in its material");
    case.image("development");
    case.click("Compare with the reference");
    assert_eq!(case.take_requests(), [Request::Compare(Comparison::Measured)], "the stage compares");
}

#[test]
fn buffers_show_what_they_hold() {
    let scene = scene();
    let settings = RenderSettings { outputs: Outputs::ALL, ..RenderSettings::new(32, 16) };
    let frame = render(&scene, &scene.overview(2.0), &settings).expect("small");
    for buffer in Buffer::ALL {
        let image = buffer.image(&frame, 16);
        assert_eq!(image.size, [16, 8], "half as large");
        // The middle of the ball, and background.
        assert_ne!(image.pixels[4 * 16 + 8], image.pixels[0], "{}", buffer.name());
    }
    let lines = report::lines(&scene, &frame, [0, 0]);
    assert_eq!(lines[2], "Background", "nothing is there");
}

#[test]
fn a_narrow_panel_clips_no_label() {
    let mut case = case(160.0);
    case.click("Inspect the image");
    case.click("Buffer image");
    case.assert_nothing_is_clipped();
    case.image("development_narrow");
}
