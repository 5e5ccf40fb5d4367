//! Figures and buffers of a small image.

use egui_kittest::kittest::Queryable;
use trigon_document::Document;
use trigon_window::scene::math::{DVec3, Vec3};
use trigon_window::scene::{Material, Node, Transform, mesh::primitives, render};
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

/// Pixels of an image half as large, each with the index of the pixel of the frame that it shows.
fn half(frame: &Frame, buffer: Buffer) -> Vec<(usize, [u8; 4])> {
    let image = buffer.image(frame, frame.width / 2);
    assert_eq!(image.size, [frame.width / 2, frame.height / 2].map(|side| side as usize), "half as large");
    let [width, _] = image.size;
    let shown = image.pixels.iter().enumerate();
    shown
        .map(|(at, color)| (at / width * 2 * frame.width as usize + at % width * 2, color.to_array()))
        .collect()
}

#[test]
fn buffers_show_what_they_hold() {
    let mut scene = scene();
    let blue = Material::from_color(Vec3::Z).with_name("blue");
    let cube = scene.add_mesh("cube", primitives::cube(1.0));
    let beside = Node::from_mesh(cube, scene.add_material(blue));
    scene.add(beside.with_transform(Transform::from_translation(DVec3::X * 2.0)));
    let settings = RenderSettings { outputs: Outputs::ALL, ..RenderSettings::new(32, 16) };
    let frame = render(&scene, &scene.overview(2.0), &settings).expect("small");
    let depth = frame.depth.as_ref().expect("requested");
    assert!(depth[0].is_infinite() && depth.iter().any(|depth| depth.is_finite()), "bodies and background");

    for (at, color) in half(&frame, Buffer::Color) {
        assert_eq!(color, frame.color[4 * at..4 * at + 4], "pixel {at}");
    }
    // Nearer is brighter, and nothing is black.
    let mut grays: Vec<(f32, u8)> = Vec::new();
    for (at, [red, green, blue, _]) in half(&frame, Buffer::Depth) {
        assert!(red == green && green == blue, "pixel {at} is gray");
        grays.push((depth[at], red));
    }
    grays.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert!(grays.is_sorted_by(|a, b| a.1 >= b.1), "{grays:?}");
    assert!(grays.iter().all(|(depth, gray)| depth.is_infinite() == (*gray == 0)), "{grays:?}");
    // Two pixels have one color if they have one id.
    let lists = [
        (Buffer::Objects, &frame.object_ids),
        (Buffer::Faces, &frame.face_ids),
        (Buffer::Triangles, &frame.triangle_ids),
        (Buffer::Materials, &frame.material_ids),
    ];
    for (buffer, ids) in lists {
        let ids = ids.as_ref().expect("requested");
        let shown = half(&frame, buffer);
        for (at, color) in &shown {
            assert_eq!(ids[*at] == u32::MAX, *color == [0, 0, 0, 255], "{}: background", buffer.name());
            for (other, of_other) in &shown {
                assert_eq!(ids[*at] == ids[*other], color == of_other, "{}: {at}, {other}", buffer.name());
            }
        }
    }
    let (normals, uvs) = (frame.normals.as_ref().expect("requested"), frame.uvs.as_ref().expect("requested"));
    let objects = frame.object_ids.as_ref().expect("requested");
    let byte = |share: f32| (share * 255.0) as u8;
    for (at, color) in half(&frame, Buffer::Normals) {
        let expected = normals[at].to_array().map(|axis| byte(0.5 + 0.5 * axis));
        let expected = if depth[at].is_finite() { expected } else { [0; 3] };
        assert_eq!(color[..3], expected, "the normal of pixel {at}");
    }
    for (at, color) in half(&frame, Buffer::Uvs) {
        assert_eq!(color[..3], [byte(uvs[at].x.fract()), byte(uvs[at].y.fract()), 0], "pixel {at}");
    }
    for (at, color) in half(&frame, Buffer::Albedo) {
        let expected = match objects[at] {
            0 => [255, 0, 0],
            1 => [0, 0, 255],
            _ => [0; 3],
        };
        assert_eq!(color[..3], expected, "pixel {at}");
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
