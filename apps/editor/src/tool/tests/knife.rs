//! The knife, from the front: clicks on the front side of a cube.

use trigon_document::mesh::math::DVec3;
use trigon_document::modelling::{EditMesh, FaceId};
use trigon_document::scene::MeshId;
use trigon_window::{Input, PointerButton};

use super::super::{FaceTool, KnifeTool, Tool, ToolState};
use super::Session;

fn front_side(session: &Session) -> (MeshId, FaceId) {
    let (id, mesh) = session.mesh();
    (id, mesh.faces().find(|&face| mesh.face_normal(face).z > 0.9).expect("there is one"))
}

/// The pointer goes to a position on the front side.
fn point(session: &mut Session, tool: &mut KnifeTool, [x, y]: [f64; 2]) {
    let at = session.view.screen(DVec3::new(x, y, 1.0)).expect("it is in front");
    session.drag(tool, at.x, at.y);
    let side = front_side(session);
    tool.hover(&session.document, &session.view, Some(side));
}

fn click(session: &mut Session, tool: &mut KnifeTool, at: [f64; 2]) {
    point(session, tool, at);
    session.input(tool, Input::Pressed(PointerButton::Left));
}

fn start() -> (Session, KnifeTool) {
    let session = Session::editing("cube", "face", &[]);
    let tool = KnifeTool::start(&session.document, session.hands).expect("it is edited");
    (session, tool)
}

fn counts(mesh: &EditMesh) -> [usize; 3] {
    [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()]
}

const WINDOW: [[f64; 2]; 5] = [[-0.4, -0.4], [0.4, -0.4], [0.4, 0.4], [-0.4, 0.4], [-0.42, -0.38]];

#[test]
fn a_stroke_closes_at_its_first_point_and_cuts_a_window() {
    let (mut session, mut tool) = start();
    let before = session.bytes();
    WINDOW.into_iter().for_each(|at| click(&mut session, &mut tool, at));
    assert_eq!(session.keys(&mut tool, "!"), ToolState::Confirmed, "{}", tool.status());
    assert_eq!(counts(&session.mesh().1), [12, 18, 8], "the window and a ring of two faces");
    session.document.undo().expect("one entry");
    assert!(session.bytes() == before, "every byte");
}

#[test]
fn c_cuts_the_back_as_well() {
    let (mut session, mut tool) = start();
    session.keys(&mut tool, "c");
    assert!(tool.status().contains("cutting through"), "{}", tool.status());
    WINDOW.into_iter().for_each(|at| click(&mut session, &mut tool, at));
    assert_eq!(session.keys(&mut tool, "!"), ToolState::Confirmed, "{}", tool.status());
    assert_eq!(counts(&session.mesh().1), [16, 24, 10], "two windows");
}

#[test]
fn e_begins_a_stroke_that_may_cross_another_one() {
    let (mut session, mut tool) = start();
    click(&mut session, &mut tool, [-1.0, 0.2]);
    click(&mut session, &mut tool, [1.0, 0.2]);
    session.keys(&mut tool, "e");
    click(&mut session, &mut tool, [0.3, -1.0]);
    click(&mut session, &mut tool, [0.3, 1.0]);
    // A third stroke is taken back.
    session.keys(&mut tool, "e");
    click(&mut session, &mut tool, [0.6, 0.6]);
    session.keys(&mut tool, "<<");
    click(&mut session, &mut tool, [0.3, 1.0]);
    assert_eq!(session.keys(&mut tool, "!"), ToolState::Confirmed, "{}", tool.status());
    assert_eq!(counts(&session.mesh().1), [13, 20, 9], "four parts that meet in a vertex");
}

#[test]
fn a_and_axes_hold_lines() {
    let (mut session, mut tool) = start();
    let mark = |tool: &KnifeTool| tool.marks().point.expect("it is over the side");
    click(&mut session, &mut tool, [-0.5, -0.5]);
    point(&mut session, &mut tool, [0.5, -0.35]);
    assert!((mark(&tool).y - -0.35).abs() < 1e-6, "free: {}", mark(&tool));
    session.keys(&mut tool, "a");
    point(&mut session, &mut tool, [0.5, -0.35]);
    assert!((mark(&tool).y - -0.5).abs() < 1e-6, "level: {}", mark(&tool));
    session.keys(&mut tool, "y");
    point(&mut session, &mut tool, [0.5, 0.25]);
    assert!(mark(&tool).distance(DVec3::new(-0.5, 0.25, 1.0)) < 1e-6, "upright: {}", mark(&tool));
    session.keys(&mut tool, "yaa");
    // Steps from the last line: a and a again let go, and twice more hold to it.
    click(&mut session, &mut tool, [0.3, 0.3]);
    session.keys(&mut tool, "aa");
    point(&mut session, &mut tool, [-0.1, 0.6]);
    let way = mark(&tool) - DVec3::new(0.3, 0.3, 1.0);
    assert!(way.dot(DVec3::new(1.0, 1.0, 0.0)).abs() < 1e-6, "at a right angle to it: {way}");
}
