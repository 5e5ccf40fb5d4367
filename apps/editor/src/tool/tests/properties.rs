//! What holds for any hands and any view.

use proptest::prelude::*;
use trigon_document::mesh::math::{DVec2, DVec3};
use trigon_window::{Hands, Input, Key, Modifiers, PointerButton};

use super::super::view::tests::views;
use super::super::{
    BevelTool, ExtrudeTool, InsetTool, LoopCutTool, SnapSettings, Tool, ToolState, TransformKind,
};
use super::{Session, settings};

/// What hands may do to a tool, in any order.
fn any_input() -> impl Strategy<Value = (DVec2, Modifiers, Input)> {
    let keys = "xyzXYZgrsobciapv0123456789.-/=<>".chars().collect::<Vec<_>>();
    let key = prop::sample::select(keys).prop_map(|character| {
        let logical = Some(match character {
            '<' => Key::Backspace,
            '>' => Key::Tab,
            character => Key::Character(character.to_ascii_lowercase()),
        });
        Input::Key { logical, physical: None, repeat: false }
    });
    let input = prop_oneof![
        6 => Just(Input::PointerMoved),
        6 => key,
        1 => Just(Input::ModifiersChanged),
        1 => Just(Input::Pressed(PointerButton::Middle)),
        1 => Just(Input::Released(PointerButton::Middle)),
        1 => (-3.0f64..3.0).prop_map(Input::Wheel),
    ];
    let modifiers = prop::sample::select(vec![Modifiers::NONE, Modifiers::SHIFT, Modifiers::CTRL]);
    (prop::array::uniform2(-200.0f64..1500.0).prop_map(DVec2::from), modifiers, input)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn whatever_hands_do_cancelling_restores_the_first_bytes(
        view in views(), which in 0usize..12, kind in 0usize..3, inputs in prop::collection::vec(any_input(), 0..25)
    ) {
        let mut session = Session::editing("grid", ["vertex", "edge", "face"][kind], &[6, 7]);
        session.view = view;
        let first = session.bytes();
        let kinds = [TransformKind::Translate, TransformKind::Rotate, TransformKind::Trackball, TransformKind::Scale, TransformKind::ShrinkFatten, TransformKind::ToSphere, TransformKind::PushPull];
        let (hands, snap) = (session.hands, SnapSettings::default());
        let mut tool: Box<dyn Tool> = match which {
            7 => Box::new(ExtrudeTool::start(false, snap, &mut session.document, hands, &view).expect("selected")),
            8 => Box::new(InsetTool::start(&mut session.document, hands, &view).expect("selected")),
            9 => Box::new(BevelTool::start(false, &mut session.document, hands, &view).expect("selected")),
            10 => Box::new(BevelTool::start(true, &mut session.document, hands, &view).expect("selected")),
            11 => Box::new(LoopCutTool::start(&session.document, hands).expect("edit mode")),
            kind => Box::new(session.transform(kinds[kind], settings())),
        };
        let mut state = ToolState::Running;
        // E S and E R confirm, and go on with another tool.
        let goes_over = |input: &Input| matches!(input, Input::Key { logical: Some(Key::Character('s' | 'r')), .. });
        for (place, modifiers, input) in inputs.into_iter().filter(|(.., input)| which != 7 || !goes_over(input)) {
            session.hands = Hands { pointer: Some(place), modifiers };
            state = session.input(&mut *tool, input);
            prop_assert!(!tool.status().is_empty() || state == ToolState::Running);
            prop_assert!(tool.marks().lines.iter().flatten().all(|place| place.is_finite()));
        }
        prop_assert_eq!(state, ToolState::Running, "nothing of this ends a tool");
        prop_assert_eq!(session.input(&mut *tool, Input::Pressed(PointerButton::Right)), ToolState::Cancelled);
        prop_assert!(session.bytes() == first, "the first bytes");
    }

    #[test]
    fn a_dragged_object_stays_under_the_pointer(view in views(), x in 0.0f64..1280.0, y in 0.0f64..720.0) {
        let mut session = Session::object("cube");
        session.view = view;
        let start = view.screen(DVec3::ZERO).expect("the camera looks at it");
        session.hands.pointer = Some(start);
        let mut tool = session.transform(TransformKind::Translate, settings());
        session.drag(&mut tool, x, y);
        let end = view.screen(session.place()).expect("in front");
        prop_assert!(end.distance(DVec2::new(x, y)) < 0.5, "{} instead of ({x}, {y})", end);
    }
}
