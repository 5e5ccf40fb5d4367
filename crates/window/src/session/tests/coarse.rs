//! Scenes with so many triangles that drafts show coarser meshes. In tests thousands are many.

use super::*;
use trigon_mesh::MeshChange;
use trigon_scene::{MeshId, Style};

/// On the ring.
const AT: DVec2 = DVec2::new(48.0, 14.0);

/// A ring of 10,000 triangles, whose axis leads to the eye.
fn ring_stage() -> Stage {
    let mut stage = Stage::new("test");
    stage.scene.add_object("ring", primitives::torus(1.0, 0.4, 100, 50), Material::default());
    stage.settings.samples_per_axis = 1;
    stage.set_home_direction(DVec3::NEG_Y);
    stage
}

/// Draws until a draft is there.
fn draft(session: &mut Session<'_>, now: Duration) {
    session.event(InputEvent::Wheel(0.01), now);
    draw(session, now);
    assert!(!session.shows_full(), "a draft");
}

fn mesh(session: &Session<'_>) -> MeshId {
    session.stage.scene.meshes().iter().next().expect("it was added").0
}

#[test]
fn only_drafts_show_coarser_meshes_once_they_are_made() {
    let mut handler = Recorder::default();
    let mut session = session_of(ring_stage(), &mut handler, Worker::of_caller());
    draw(&mut session, ms(0));
    assert!(!session.stage.report().is_coarse && session.stage.pick(AT).is_some(), "none was made yet");
    run(&mut session, ms(0));
    let (before, orbit) = (session.shown.clone().expect("an image"), session.stage.orbit);
    draft(&mut session, ms(10_000));
    assert!(session.stage.report().is_coarse, "now there is one");
    assert_eq!(session.stage.pick(AT), None, "nothing exact is known from it");
    assert!(session.stage.snap(AT, 5.0).is_none(), "nor is there anything to snap to");
    assert!(session.stage.distances_at([AT].into_iter())[0].is_some(), "but how far away it is");
    session.stage.orbit = orbit;
    session.note(ms(20_000));
    run(&mut session, ms(20_000));
    assert!(session.shown == Some(before), "at rest there are the bytes that there were without one");
    assert!(!session.stage.report().is_coarse && session.stage.pick(AT).is_some(), "as before");
}

#[test]
fn drafts_with_edges_and_of_a_changed_mesh_are_as_they_were() {
    let mut handler = Recorder::default();
    let mut session = session_of(ring_stage(), &mut handler, Worker::of_caller());
    run(&mut session, ms(0));
    session.stage.settings.style = Style::SurfaceWithEdges;
    draft(&mut session, ms(10_000));
    assert!(!session.stage.report().is_coarse && session.stage.pick(AT).is_some(), "edges are exact");
    session.stage.settings.style = Style::Surface;
    draft(&mut session, ms(20_000));
    assert!(session.stage.report().is_coarse, "surfaces need not be");
    let change = MeshChange { positions: vec![(0, trigon_math::Vec3::ONE)], ..MeshChange::default() };
    let id = mesh(&session);
    session.stage.scene.change_mesh(id, &change).expect("it exists");
    draft(&mut session, ms(30_000));
    assert!(!session.stage.report().is_coarse && session.stage.pick(AT).is_some(), "the mesh is another one");
    run(&mut session, ms(30_000));
    draft(&mut session, ms(40_000));
    assert!(session.stage.report().is_coarse, "which has a coarser one, too, after it was shown at rest");
}

/// A click on a draft would have selected nothing.
#[test]
fn clicks_on_coarser_meshes_leave_the_selection_as_it_is() {
    let mut handler = Recorder::default();
    let mut session = session_of(ring_stage(), &mut handler, Worker::of_caller());
    run(&mut session, ms(0));
    let node = session.stage.pick(AT).expect("the ring").0.node;
    session.stage.selection = Some(node);
    draft(&mut session, ms(10_000));
    session.event(InputEvent::PointerMoved(AT), ms(10_001));
    for press in [Press::Down, Press::Up] {
        session.event(InputEvent::Button(PointerButton::Left, press), ms(10_002));
    }
    assert_eq!(session.stage.selection, Some(node), "it is still selected");
    let messages = session.stage.overlay.messages(ms(10_003));
    assert!(messages.iter().any(|message| message.contains("click again")), "{messages:?}");
}

/// They are made on a thread of their own, which the window does not wait for.
#[test]
fn a_worker_on_threads_makes_them_beside_the_window() {
    let (ring, rung) = std::sync::mpsc::channel();
    let ring = move || {
        // Fails when the test is over.
        let _ = ring.send(());
    };
    let mut handler = Recorder::default();
    let mut session = session_of(ring_stage(), &mut handler, Worker::of_threads(ring, || Duration::ZERO));
    rest_beside(&mut session, &rung, ms(0));
    while !session.stage.scene.has_coarse_meshes() {
        std::thread::yield_now();
    }
    session.event(InputEvent::Wheel(0.01), ms(10_000));
    live_until(&mut session, &rung, ms(10_000), |session| session.stage.report().is_coarse);
    assert!(session.stage.report().is_coarse && !session.shows_full(), "a draft");
}
