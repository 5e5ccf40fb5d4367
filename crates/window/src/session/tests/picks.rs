//! What is under the pointer, in the image that is in the window.

use std::sync::Arc;

use super::*;
use crate::drawer::Drawer;
use trigon_camera::{Camera, Projector};
use trigon_mesh::Mesh;
use trigon_scene::{Cancel, NodeId, Scene};

/// A pixel of the cube on the right.
const AT: DVec2 = DVec2::new(70.0, 32.0);

fn name(session: &Session<'_>, node: NodeId) -> String {
    session.stage.scene.node(node).expect("picked").name.clone()
}

/// What a ray meets: the name of the object and the point, by the cubes' places.
fn picked(session: &Session<'_>, at: DVec2) -> Option<(String, DVec3)> {
    session.stage.pick(at).map(|(hit, point)| (name(session, hit.node), point))
}

#[test]
fn before_there_is_an_image_nothing_is_picked() {
    let mut handler = Recorder::default();
    let session = started(&mut handler);
    assert_eq!(session.stage.pick(AT), None, "nothing is seen yet");
}

#[test]
fn a_pick_is_of_the_image_that_is_seen() {
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    let before = picked(&session, AT).expect("a cube");
    assert_eq!(before.0, "right", "the cube on the right");
    let camera = session.stage.camera();
    let projector = Projector::new(&camera, SIZE);
    let seen = projector.to_screen(before.1).expect("before the eye");
    assert!(seen.distance(AT) < 1e-3, "the point is where it was asked for: {seen}");
    // From behind left is right; but that is not drawn yet.
    session.stage.orbit.orbit(std::f64::consts::PI, 0.0);
    session.note(ms(1000));
    assert_eq!(picked(&session, AT).expect("a cube"), before, "what the user sees is what is picked");
    run(&mut session, ms(1000));
    let (other, point) = picked(&session, AT).expect("a cube");
    assert_eq!(other, "left", "now the other one is there");
    assert!(point.z < before.1.z - 0.9, "and its back: {point}");
}

/// The node's place was taken by another one, which an image from before cannot show.
#[test]
fn a_node_that_is_gone_is_not_picked_nor_is_who_took_its_place() {
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    let (hit, _) = session.stage.pick(AT).expect("a cube");
    session.stage.scene.remove(hit.node);
    assert_eq!(session.stage.pick(AT), None, "it is gone");
    let stranger = session.stage.scene.add_object("stranger", primitives::cube(9.0), Material::default());
    assert_eq!(stranger.index(), hit.node.index(), "its place is used again");
    assert_eq!(session.stage.pick(AT), None, "the image does not show that one");
}

/// The mesh is replaced by an empty one: what is picked has been drawn before, and nothing
/// of the scene's geometry is asked.
#[test]
fn faces_of_a_mesh_that_was_replaced_are_not_told() {
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    let (hit, point) = session.stage.pick(AT).expect("a cube");
    assert!(hit.face.is_some(), "a face of it");
    let mesh = session.stage.scene.node(hit.node).and_then(|node| node.mesh).expect("a mesh");
    session.stage.scene.replace_mesh(mesh, Mesh::default()).expect("it is there");
    let (now, still) = session.stage.pick(AT).expect("still to be seen");
    assert_eq!((now.node, now.face, still), (hit.node, None, point), "the node, without a face");
}

#[test]
fn drafts_are_picked_where_they_are_shown() {
    let (ring, rung) = std::sync::mpsc::channel();
    let ring = move || {
        // Fails when the test is over.
        let _ = ring.send(());
    };
    let mut handler = Recorder::default();
    // By this clock images take no time.
    let mut session = session_of(stage(), &mut handler, Worker::of_threads(ring, || Duration::ZERO));
    let is_small =
        |session: &Session<'_>| session.shown.as_ref().is_some_and(|frame| frame.width < SIZE.width);
    let mut now = rest_beside(&mut session, &rung, ms(0));
    // Three drafts took so long that the next one is small.
    for _ in 0..3 {
        session.pacing.changed(Change::Moving, now);
        session.pacing.begin(now, AnimationFrames::None, || false);
        session.pacing.finished(ms(300), ms(300));
    }
    now += ms(1000);
    drag(&mut session, PointerButton::Left, DVec2::new(20.0, 0.0), now);
    now = live_until(&mut session, &rung, now, is_small);
    assert!(is_small(&session), "a draft is shown");
    let draft = picked(&session, AT).expect("a cube");
    let seen = Projector::new(&session.stage.camera(), SIZE).to_screen(draft.1).expect("before the eye");
    // The draft's aspect is that of its own whole pixels.
    assert!(seen.distance(AT) < 3.0, "about where it was asked for: {seen}");
    rest_beside(&mut session, &rung, now);
    assert!(!is_small(&session), "the same in full");
    let full = picked(&session, AT).expect("a cube");
    assert_eq!(draft.0, full.0, "the same cube");
    assert!(draft.1.distance(full.1) < 0.2, "at about the same point: {} and {}", draft.1, full.1);
}

/// Paints everything in one colour, and says nothing of what is where.
struct Flat;

impl Drawer for Flat {
    fn draw(&self, _: &Scene, _: &Camera, settings: &RenderSettings, _: &Cancel) -> Result<Frame, String> {
        let RenderSettings { width, height, .. } = *settings;
        Ok(Frame { width, height, color: vec![9; 4 * width as usize * height as usize], ..Frame::default() })
    }
}

#[test]
fn what_another_drawer_shows_is_picked_all_the_same() {
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    let before = session.stage.pick(AT);
    session.stage.drawer = Some(Arc::new(Flat));
    session.note(ms(1000));
    run(&mut session, ms(1000));
    assert!(session.shown.as_deref().is_some_and(|frame| frame.color[0] == 9), "its image is shown");
    assert!(before.is_some() && session.stage.pick(AT) == before, "the renderer tells what is where");
}

/// In a part of the window the point is where it was asked for, too.
#[test]
fn a_view_in_a_part_of_the_window_shows_and_picks_the_scene_there() {
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    let size = Viewport { width: SIZE.width / 2, height: SIZE.height - 20 };
    session.stage.view_area = Some(crate::Area { min: [15, 10], size });
    session.note(ms(1000));
    run(&mut session, ms(1000));
    let pane = session.stage.panes()[0];
    assert_eq!((pane.area.min, pane.area.size), ([15, 10], size));
    let projector = Projector::new(&session.stage.camera_of(&pane), size);
    let at = projector.to_screen(DVec3::X * 2.0).expect("before the eye") + pane.area.origin();
    let (name, point) = picked(&session, at).expect("a cube");
    let seen = projector.to_screen(point).expect("before the eye") + pane.area.origin();
    assert!(seen.distance(at) < 1e-3, "{at} and {seen}");
    assert_eq!(name, "right");
    let beside = DVec2::new(12.0, at.y);
    assert_eq!(session.stage.pick(beside), None, "a panel is there");
}

/// In each of four views the point is where it was asked for, as that view's camera sees it.
#[test]
fn each_of_four_views_shows_and_picks_the_scene_from_its_side() {
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    session.stage.four_views = true;
    session.note(ms(1000));
    run(&mut session, ms(1000));
    let panes = session.stage.panes();
    assert_eq!(panes.len(), 4);
    for pane in &panes {
        let projector = Projector::new(&session.stage.camera_of(pane), pane.area.size);
        // The middle of the cube on the right.
        let at = projector.to_screen(DVec3::X * 2.0).expect("before the eye") + pane.area.origin();
        let (name, point) = picked(&session, at).expect("a cube");
        let seen = projector.to_screen(point).expect("before the eye") + pane.area.origin();
        assert!(seen.distance(at) < 1e-3, "{:?}: {at} and {seen}", pane.side);
        assert_eq!(name, "right", "{:?}", pane.side);
    }
    assert_eq!(session.stage.pick(SIZE.size() * 0.5), None, "between them is nothing");
}

#[test]
fn distances_are_those_of_surfaces_along_the_line_of_sight() {
    let mut handler = Recorder::default();
    let session = begun(&mut handler);
    let camera = session.stage.camera();
    let projector = Projector::new(&camera, SIZE);
    // The eye looks straight at the fronts of both cubes, half a metre before their middles.
    for middle in [DVec3::ZERO, DVec3::X * 2.0] {
        let at = projector.to_screen(middle + DVec3::Z * 0.5).expect("before the eye");
        let distances = session.stage.distances_at([DVec2::ONE, at].into_iter());
        let [None, Some(distance)] = distances[..] else { panic!("{distances:?}: a cube beside nothing") };
        assert!((distance - (camera.position.z - 0.5)).abs() < 1e-5, "{distance} at {at}");
    }
    let beside = [DVec2::ONE, DVec2::new(-1.0, 32.0), DVec2::new(70.0, 64.0)];
    assert_eq!(session.stage.distances_at(beside.into_iter()), [None; 3], "nothing is seen there");
}

/// What was known of the scene's size before put it in front of the near plane, or beyond the far one.
#[test]
fn what_is_added_before_or_behind_all_else_is_seen() {
    for (depth, has_parallel_lines) in [(3.0, false), (3.0, true), (-500.0, false), (-500.0, true)] {
        let mut handler = Recorder::default();
        let mut session = begun(&mut handler);
        if has_parallel_lines {
            session.stage.orbit.toggle_orthographic();
            session.note(ms(1000));
            run(&mut session, ms(1000));
        }
        assert!(session.stage.camera().position.z > 3.5, "the eye is farther away");
        let between = SIZE.size() * 0.5;
        assert_eq!(session.stage.pick(between), None, "between the cubes is nothing");
        let side = if depth > 0.0 { 0.2 } else { 200.0 };
        let added = session.stage.scene.add_object("added", primitives::cube(side), Material::default());
        let position = DVec3::new(1.0, 0.0, depth - side as f64 * 0.5);
        session.stage.scene.node_mut(added).expect("just added").transform.translate(position);
        session.note(ms(2000));
        run(&mut session, ms(2000));
        let (name, point) = picked(&session, between).expect("it is seen");
        assert_eq!(name, "added", "at {depth}");
        assert!((point.z - depth).abs() < 0.01, "its front at {depth}: {point}");
    }
}
