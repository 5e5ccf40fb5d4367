//! What the window's own keys do.

use std::time::Duration;

use super::*;
use trigon_camera::AxisView;
use trigon_math::{DVec3, elementary};
use trigon_mesh::primitives;
use trigon_scene::{Material, Node};

/// Three objects, of which the second is hidden, and a node without a mesh between them.
fn stage() -> (Stage, [NodeId; 3]) {
    let mut stage = Stage::new("test");
    let cube = |stage: &mut Stage, name: &str| {
        stage.scene.add_object(name, primitives::cube(1.0), Material::default())
    };
    let objects = ["first", "hidden", "third"].map(|name| {
        stage.scene.add(Node::default());
        cube(&mut stage, name)
    });
    stage.scene.node_mut(objects[1]).expect("just added").visible = false;
    (stage, objects)
}

fn messages(stage: &mut Stage) -> Vec<String> {
    stage.overlay.messages(Duration::ZERO)
}

#[test]
fn samples_go_round_from_one_to_the_most() {
    let (mut stage, _) = stage();
    (stage.settings.samples_per_axis, stage.settings.samples) = (1, 16);
    let mut seen = Vec::new();
    for _ in 0..5 {
        act(&mut stage, Action::CycleSamples);
        assert_eq!(stage.settings.samples, 1, "each shaded by itself");
        seen.push(stage.settings.samples_per_axis);
    }
    assert_eq!(seen, [2, 3, 4, 1, 2], "along each side of a pixel");
    let said = ["9 samples per pixel", "16 samples per pixel", "1 sample per pixel", "4 samples per pixel"];
    assert_eq!(messages(&mut stage), said, "the last four, each once");
}

#[test]
fn styles_go_round() {
    let (mut stage, _) = stage();
    let mut pressed = |from: Style, action: Action| {
        stage.settings.style = from;
        act(&mut stage, action);
        stage.settings.style
    };
    let edges = [
        (Style::Surface, Style::SurfaceWithEdges),
        (Style::SurfaceWithEdges, Style::Surface),
        (Style::Wireframe, Style::Surface),
        (Style::HiddenLine, Style::Surface),
    ];
    for (from, to) in edges {
        assert_eq!(pressed(from, Action::ToggleEdges), to, "from {from:?}");
    }
    let wireframe = [
        (Style::Surface, Style::Wireframe),
        (Style::SurfaceWithEdges, Style::Wireframe),
        (Style::Wireframe, Style::HiddenLine),
        (Style::HiddenLine, Style::Surface),
    ];
    for (from, to) in wireframe {
        assert_eq!(pressed(from, Action::CycleWireframe), to, "from {from:?}");
    }
    assert_eq!(messages(&mut stage), ["Wireframe", "Hidden lines", "Surface"], "said by name");
}

#[test]
fn what_is_switched_on_is_switched_off_again() {
    let (mut stage, _) = stage();
    let is_on = |stage: &Stage| {
        [
            stage.orbit.style() == OrbitStyle::Trackball,
            stage.orbit.is_orthographic(),
            stage.cheat_sheet == Visibility::Shown,
            stage.frame_time == Visibility::Shown,
            stage.full_screen,
        ]
    };
    let actions = [
        Action::ToggleOrbitStyle,
        Action::ToggleOrthographic,
        Action::ToggleCheatSheet,
        Action::ToggleFrameTime,
        Action::ToggleFullScreen,
    ];
    let before = is_on(&stage);
    for (index, action) in actions.into_iter().enumerate() {
        let mut expected = before;
        expected[index] = !before[index];
        stage.act(action);
        assert_eq!(is_on(&stage), expected, "{action:?}: that alone");
        stage.act(action);
        assert_eq!(is_on(&stage), before, "{action:?}: and back");
    }
    assert_eq!(messages(&mut stage), ["Trackball", "Turntable"], "said by name");
}

#[test]
fn a_list_that_is_shown_again_is_not_searched() {
    let (mut stage, _) = stage();
    stage.command_search = "left over".into();
    act(&mut stage, Action::ToggleCheatSheet);
    assert_eq!(stage.command_search, "");
    act(&mut stage, Action::OpenMenu);
    assert_eq!(stage.cheat_sheet, Visibility::Hidden, "the menu takes its place");
    assert!(
        stage.menu.is_some_and(|menu| menu.requested_at.is_none() && menu.at.is_none()),
        "at the pointer"
    );
}

#[test]
fn objects_that_are_seen_are_selected_in_turn() {
    let (mut stage, [first, _, third]) = stage();
    let mut select = |action| {
        act(&mut stage, action);
        stage.selection
    };
    assert_eq!(select(Action::SelectNext), Some(first), "from nothing the first");
    assert_eq!(select(Action::SelectNext), Some(third), "the hidden one is skipped");
    assert_eq!(select(Action::SelectNext), Some(first), "and again");
    assert_eq!(select(Action::SelectPrevious), Some(third), "the other way round");
    assert_eq!(select(Action::SelectPrevious), Some(first));
    assert_eq!(messages(&mut stage), ["Selected: third", "Selected: first"]);
    stage.selection = None;
    act(&mut stage, Action::SelectPrevious);
    assert_eq!(stage.selection, Some(third), "from nothing the last");
    stage.scene.node_mut(third).expect("it is there").name.clear();
    announce_selection(&mut stage);
    assert_eq!(messages(&mut stage).last().map(String::as_str), Some("Selected: an unnamed object"));
    let mut empty = Stage::new("empty");
    for action in [Action::SelectNext, Action::SelectPrevious] {
        act(&mut empty, action);
        assert_eq!(empty.selection, None, "{action:?}: there is none");
    }
    assert!(messages(&mut empty).is_empty());
}

#[test]
fn escape_leaves_one_thing_after_the_other() {
    let (mut stage, [first, ..]) = stage();
    (stage.cheat_sheet, stage.selection, stage.full_screen) = (Visibility::Shown, Some(first), true);
    let mut escaped = || {
        act(&mut stage, Action::Dismiss);
        (stage.cheat_sheet == Visibility::Shown, stage.selection.is_some(), stage.full_screen)
    };
    let left = [escaped(), escaped(), escaped(), escaped()];
    assert_eq!(
        left,
        [(false, true, true), (false, false, true), (false, false, false), (false, false, false)]
    );
}

#[test]
fn moves_are_undone_and_done_again() {
    let (mut stage, [first, ..]) = stage();
    let position = |stage: &Stage| stage.scene.world_transform(first).translation;
    act(&mut stage, Action::UndoMove);
    act(&mut stage, Action::RedoMove);
    assert_eq!(messages(&mut stage), ["no object was moved", "nothing was undone"]);
    stage.selection = Some(first);
    stage.begin_move();
    stage.scene.node_mut(first).expect("it is there").transform.translate(DVec3::X);
    stage.end_move();
    stage.selection = None;
    assert_eq!((stage.moved_nodes(), position(&stage)), (vec![first], DVec3::X));
    act(&mut stage, Action::UndoMove);
    assert_eq!((stage.selection, position(&stage)), (Some(first), DVec3::ZERO), "back, and selected");
    stage.selection = None;
    act(&mut stage, Action::RedoMove);
    assert_eq!((stage.selection, position(&stage)), (Some(first), DVec3::X), "and there again");
    assert_eq!(messages(&mut stage).len(), 2, "there is nothing else to say");
    stage.forget_moves();
    assert!(stage.moved_nodes().is_empty() && !stage.undo_move(), "of another scene");
}

#[test]
fn keys_turn_the_view() {
    let (mut stage, _) = stage();
    let eye = |stage: &Stage| stage.orbit.orientation() * DVec3::Z;
    stage.act(Action::View(AxisView::Front));
    assert!(eye(&stage).distance(DVec3::Z) < 1e-9, "from before");
    let distance = stage.orbit.distance();
    stage.orbit.set_distance(99.0);
    stage.act(Action::View(AxisView::Front));
    assert!((stage.orbit.distance() - distance).abs() < 1e-9, "all of the scene");
    stage.act(Action::Elevate(0.5));
    let (sin, cos) = elementary::sin_cos(0.5);
    assert!(eye(&stage).distance(DVec3::new(0.0, sin, cos)) < 1e-9, "{}: from above", eye(&stage));
    stage.act(Action::View(AxisView::Front));
    stage.act(Action::Roll(0.5));
    let right = stage.orbit.orientation() * DVec3::X;
    assert!(right.distance(DVec3::new(cos, sin, 0.0)) < 1e-9, "{right}: counter-clockwise");
    stage.set_home_direction(DVec3::NEG_X);
    stage.act(Action::ResetView);
    assert!(eye(&stage).distance(DVec3::X) < 1e-9, "{}: home", eye(&stage));
}

#[test]
fn text_is_half_to_four_times_as_large() {
    let (mut stage, _) = stage();
    let mut scaled = |factor: f32, times: usize| {
        (0..times).for_each(|_| act(&mut stage, Action::ScaleText(factor)));
        stage.text_scale
    };
    assert_eq!([scaled(1.5, 1), scaled(2.0, 1), scaled(2.0, 9)], [1.5, 3.0, 4.0]);
    assert_eq!([scaled(0.5, 1), scaled(0.5, 9)], [2.0, 0.5]);
}

#[test]
fn what_belongs_to_others_does_nothing_here() {
    let (mut stage, _) = stage();
    let before = format!("{:?}", stage.subject());
    for action in [Action::EnterInterface, Action::Command] {
        stage.act(action);
    }
    assert_eq!(format!("{:?}", stage.subject()), before);
    assert!(!stage.wishes().exit);
    stage.act(Action::Quit);
    assert!(stage.wishes().exit, "it is closed");
}
