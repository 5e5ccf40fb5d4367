//! Tools that make geometry, and those that follow it.

use trigon_document::mesh::math::{DVec3, Vec3};
use trigon_document::modelling::FaceId;
use trigon_window::{Input, PointerButton};

use super::super::{
    BevelTool, ExtrudeTool, FaceTool, InsetTool, LoopCutTool, SnapSettings, Tool, ToolState, TransformKind,
};
use super::{Session, settings};

#[test]
fn shrinking_and_fattening_moves_along_normals() {
    let mut session = Session::editing("grid", "face", &[]);
    let before = session.positions();
    let mut tool = session.transform(TransformKind::ShrinkFatten, settings());
    session.drag(&mut tool, 400.0, 250.0);
    session.moved(&before, |p| p + DVec3::Y * 0.5);
    session.keys(&mut tool, "2-!");
    session.moved(&before, |p| p + DVec3::Y * -2.0);
}

#[test]
fn pushing_and_rounding_are_about_the_middle() {
    for (kind, keys) in [(TransformKind::ToSphere, "1!"), (TransformKind::PushPull, "2!")] {
        let mut session = Session::editing("cube", "vertex", &[]);
        let before = session.positions();
        let mut tool = session.transform(kind, settings());
        session.drag(&mut tool, 450.0, 300.0);
        session.keys(&mut tool, keys);
        let pushed = if kind == TransformKind::PushPull { 2.0 } else { 0.0 };
        // The corners of a cube lie on a sphere already.
        session.moved(&before, |p| p + p.normalize() * pushed);
    }
}

#[test]
fn edges_and_vertices_slide() {
    for kind in ["edge", "vertex"] {
        let mut session = Session::editing("grid", "vertex", &[12]);
        if kind == "edge" {
            let (_, mesh) = session.mesh();
            let line = mesh
                .edges()
                .filter(|&edge| mesh.edge_vertices(edge).iter().all(|&v| mesh.position(v).x == 0.0));
            let line: Vec<u32> = line.map(|edge| edge.index()).collect();
            session = Session::editing("grid", "edge", &line);
        }
        let before = session.positions();
        let mut tool = session.transform(TransformKind::Translate, settings());
        if kind == "edge" {
            session.keys(&mut tool, "g");
        } else {
            tool = tool.sliding(&mut session.document, &session.view);
        }
        session.drag(&mut tool, 425.0, 300.0);
        let moved =
            |p: DVec3| if p.x == 0.0 && (kind == "edge" || p.z == 0.0) { p + DVec3::X * 0.25 } else { p };
        session.moved(&before, moved);
        assert_eq!(session.keys(&mut tool, "!"), ToolState::Confirmed, "{kind}");
    }
}

#[test]
fn extruding_moves_along_the_normal_and_cancelling_leaves_nothing() {
    let mut session = Session::editing("grid", "face", &[5]);
    let (first, [vertices, faces]) = (session.bytes(), [25, 16]);
    let mut tool = ExtrudeTool::start(
        false,
        SnapSettings::default(),
        &mut session.document,
        session.hands,
        &session.view,
    )
    .expect("a face is selected");
    let counts = |session: &Session| [session.mesh().1.vertex_count(), session.mesh().1.face_count()];
    assert_eq!(counts(&session), [vertices + 4, faces + 4], "it is there at once");
    session.drag(&mut tool, 400.0, 200.0);
    let top = session.positions().iter().map(|place| place.y).fold(0.0, f32::max);
    assert!((top - 1.0).abs() < 1e-6, "100 pixels upwards: {top}");
    assert_eq!(session.keys(&mut tool, "?"), ToolState::Cancelled);
    assert_eq!(session.bytes(), first, "no doubled vertices");
    let mut tool = ExtrudeTool::start(
        false,
        SnapSettings::default(),
        &mut session.document,
        session.hands,
        &session.view,
    )
    .expect("a face is selected");
    session.keys(&mut tool, "x2!");
    let right = session.positions().iter().filter(|place| place.x > 0.9 && place.y == 0.0).count();
    assert_eq!((counts(&session), right), ([vertices + 4, faces + 4], 14), "four beside ten, sideways");
}

#[test]
fn inset_and_bevel_have_blenders_keys() {
    let mut session = Session::editing("grid", "face", &[5]).at(500.0, 300.0);
    let mut tool = InsetTool::start(&mut session.document, session.hands, &session.view).expect("a face");
    session.keys(&mut tool, ".25>1");
    let (_, mesh) = session.mesh();
    assert_eq!((mesh.face_count(), mesh.face_area(FaceId::new(5))), (20, 0.25), "a quad of half the side");
    assert!(session.positions().iter().any(|place| place.y == 1.0), "and a metre up");
    for (key, says) in [("o", "O: outset (on)"), ("i", "I: individual (on)"), ("b", "B: boundary (off)")] {
        session.keys(&mut tool, key);
        assert!(tool.status().contains(says), "{key}: {}", tool.status());
    }
    assert_eq!(session.keys(&mut tool, "!"), ToolState::Confirmed);

    let mut session = Session::editing("cube", "edge", &[0]);
    let mut tool =
        BevelTool::start(false, &mut session.document, session.hands, &session.view).expect("an edge");
    session.keys(&mut tool, ".5");
    assert_eq!(session.mesh().1.face_count(), 7, "one face in place of the edge");
    session.input(&mut tool, Input::Wheel(2.0));
    assert_eq!(session.mesh().1.face_count(), 9, "three segments");
    session.keys(&mut tool, "s5");
    assert_eq!(session.mesh().1.face_count(), 11, "five");
    let keys = [
        ("p.25", "profile 0.250"),
        ("c", "C: clamp (on)"),
        ("h", "H: harden (on)"),
        ("k", "K: sharp (on)"),
        ("u", "U: seam (on)"),
        ("o", "O: outer (patch)"),
        ("o", "O: outer (arc)"),
        ("i", "I: inner (arc)"),
        ("v", "V: vertices (on)"),
    ];
    for (key, says) in keys {
        session.keys(&mut tool, key);
        assert!(tool.status().contains(says), "{key}: {}", tool.status());
    }
    assert_eq!(session.keys(&mut tool, "!"), ToolState::Confirmed);
}

#[test]
fn m_changes_what_the_width_of_a_bevel_measures() {
    // The distance between both rims of an edge of a cube of 2 m.
    let root = 2.0f64.sqrt();
    let widths = [
        ("", "offset", ".5", 0.5 * root),
        ("m", "width", ".5", 0.5),
        ("mm", "depth", ".25", 0.5),
        ("mmm", "percent", "25", 0.5 * root),
        ("mmmm", "absolute", ".5", 0.5 * root),
        ("mmmmm", "offset", ".5", 0.5 * root),
    ];
    for (keys, says, typed, apart) in widths {
        let mut session = Session::editing("cube", "edge", &[0]);
        let before = session.positions();
        let mut tool =
            BevelTool::start(false, &mut session.document, session.hands, &session.view).expect("an edge");
        session.keys(&mut tool, keys);
        assert!(tool.status().contains(&format!("M: {says}")), "{}", tool.status());
        session.keys(&mut tool, typed);
        let new: Vec<Vec3> =
            session.positions().into_iter().filter(|place| !before.contains(place)).collect();
        let far = |other: &Vec3| f64::from(new[0].distance(*other));
        let nearest = new[1..].iter().map(far).fold(f64::INFINITY, f64::min);
        assert!((nearest - apart).abs() < 1e-6, "{says}: {nearest}");
        session.keys(&mut tool, "?");
        assert_eq!(session.positions(), before, "cancelled");
    }
}

#[test]
fn marks_of_a_bevel_are_on_both_rims() {
    let mut session = Session::editing("cube", "edge", &[0]);
    let mut tool =
        BevelTool::start(false, &mut session.document, session.hands, &session.view).expect("an edge");
    session.keys(&mut tool, ".5ku!");
    let (_, mesh) = session.mesh();
    let marked = mesh.edges().filter(|&edge| mesh.is_sharp(edge) && mesh.is_seam(edge)).count();
    assert_eq!(marked, 2, "K and U");
}

#[test]
fn a_loop_cut_shows_its_ring_cuts_and_slides() {
    let mut session = Session::editing("cube", "vertex", &[]).at(400.0, 205.0);
    let first = session.bytes();
    let (id, mesh) = session.mesh();
    let front = mesh.faces().find(|&face| mesh.face_center(face).z == 1.0).expect("a front");
    let mut tool = LoopCutTool::start(&session.document, session.hands).expect("edit mode");
    tool.hover(&session.document, &session.view, Some((id, front)));
    assert_eq!(tool.marks().lines.len(), 4, "round the cube");
    assert!(tool.marks().lines.iter().flatten().all(|place| place.x == 0.0), "across the upper side");
    session.input(&mut tool, Input::Wheel(1.0));
    assert_eq!(tool.marks().lines.len(), 8, "two cuts");
    assert_eq!(session.bytes(), first, "nothing is cut yet");
    session.keys(&mut tool, "1");
    session.input(&mut tool, Input::Pressed(PointerButton::Left));
    assert_eq!(session.mesh().1.vertex_count(), 12, "cut");
    session.drag(&mut tool, 450.0, 205.0);
    let cut = |session: &Session| session.positions()[8..].iter().map(|place| place.x).collect::<Vec<_>>();
    assert_eq!(cut(&session), [0.5; 4], "50 pixels are half a metre, whichever way the edge runs");
    session.keys(&mut tool, "0");
    assert_eq!(cut(&session), [0.0; 4], "typed");
    assert_eq!(session.input(&mut tool, Input::Pressed(PointerButton::Left)), ToolState::Confirmed);
    session.document.undo().expect("one entry");
    assert_eq!(session.bytes(), first, "undone");
}

#[test]
fn a_loop_cut_keeps_an_even_distance_from_either_side() {
    let session = Session::editing("cube", "vertex", &[]).at(400.0, 205.0);
    let mesh = session.mesh().1;
    let lower = mesh.vertices().filter(|&vertex| mesh.position(vertex).y < 0.0);
    let lower: Vec<u32> = lower.map(|vertex| vertex.index()).collect();
    // The upper edges are 2 m long, the lower ones 4 m.
    let mut session = session.run(&[
        &format!(r#"{{ "op": "select", "elements": {lower:?} }}"#),
        r#"{ "op": "scale", "factors": [2, 1, 1] }"#,
    ]);
    let (id, mesh) = session.mesh();
    let front = mesh.faces().find(|&face| mesh.face_center(face).z == 1.0).expect("a front");
    let mut tool = LoopCutTool::start(&session.document, session.hands).expect("edit mode");
    tool.hover(&session.document, &session.view, Some((id, front)));
    session.input(&mut tool, Input::Pressed(PointerButton::Left));
    let cut = |session: &Session| {
        let mut places: Vec<f32> = session.positions()[8..].iter().map(|place| place.x).collect();
        places.sort_by(f32::total_cmp);
        places
    };
    assert_eq!(cut(&session), [0.0; 4], "in the middle of each");
    session.keys(&mut tool, "e");
    let even = cut(&session);
    assert!(even == [-1.0, -1.0, 0.0, 0.0] || even == [0.0, 0.0, 1.0, 1.0], "1 m from one side: {even:?}");
    session.keys(&mut tool, "f");
    let flipped: Vec<f32> = even.iter().rev().map(|place| -place).collect();
    assert_eq!(cut(&session), flipped, "from the other");
    assert!(tool.status().contains("E: even (on), F: from the other side (on)"), "{}", tool.status());
}
