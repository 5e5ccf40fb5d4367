//! Recorded gestures.

use super::*;

fn hands(x: f64, y: f64, modifiers: Modifiers) -> Hands {
    Hands { pointer: Some(DVec2::new(x, y)), modifiers }
}

/// Presses at one place, drags over others and lets go.
fn draw(kind: GestureKind, modifiers: Modifiers, places: &[(f64, f64)]) -> GestureState {
    let at = |place: usize| hands(places[place].0, places[place].1, modifiers);
    let mut gesture = Gesture::waiting(kind, at(0), 1.0);
    gesture.input(&Input::Pressed(PointerButton::Left), at(0));
    (1..places.len()).for_each(|place| drop(gesture.input(&Input::PointerMoved, at(place))));
    gesture.input(&Input::Released(PointerButton::Left), at(places.len() - 1))
}

fn rectangle(min: (f64, f64), max: (f64, f64)) -> Region {
    Region::Rectangle { min: min.into(), max: max.into() }
}

#[test]
fn a_box_is_dragged_from_any_corner_with_a_mode() {
    for (modifiers, mode) in [
        (Modifiers::NONE, RegionMode::Set),
        (Modifiers::SHIFT, RegionMode::Extend),
        (Modifiers::CTRL, RegionMode::Subtract),
        (Modifiers::SHIFT | Modifiers::CTRL, RegionMode::Intersect),
    ] {
        let state = draw(GestureKind::Box, modifiers, &[(50.0, 10.0), (20.0, 40.0)]);
        let expected = rectangle((20.0, 10.0), (50.0, 40.0));
        assert_eq!(state, GestureState::Ended(Some((expected, mode))), "{modifiers}");
    }
}

#[test]
fn space_moves_the_box() {
    let at = |x, y| hands(x, y, Modifiers::NONE);
    let mut gesture = Gesture::drawing(GestureKind::Box, PointerButton::Left, at(10.0, 10.0), 1.0);
    let space = |gesture: &mut Gesture| {
        let input = Input::Key { logical: Some(Key::Space), physical: None, repeat: false };
        gesture.input(&input, at(0.0, 0.0))
    };
    gesture.input(&Input::PointerMoved, at(30.0, 20.0));
    space(&mut gesture);
    gesture.input(&Input::PointerMoved, at(130.0, 220.0));
    assert_eq!(gesture.region(), rectangle((110.0, 210.0), (130.0, 220.0)), "as large as before");
    gesture.input(&Input::KeyReleased { logical: Some(Key::Space), physical: None }, at(0.0, 0.0));
    gesture.input(&Input::PointerMoved, at(150.0, 220.0));
    assert_eq!(gesture.region(), rectangle((110.0, 210.0), (150.0, 220.0)), "it grows again");
    assert_eq!(gesture.shown(), Some(gesture.region()), "drawn as it is");
}

#[test]
fn a_circle_paints_until_it_is_ended() {
    let at = |x| hands(x, 5.0, Modifiers::NONE);
    let mut gesture = Gesture::waiting(GestureKind::Circle, at(10.0), 2.0);
    let circle = |x| Region::Circle { center: DVec2::new(x, 5.0), radius: 50.0 };
    assert_eq!(gesture.shown(), Some(circle(10.0)), "shown before it paints");
    let pressed = gesture.input(&Input::Pressed(PointerButton::Left), at(10.0));
    assert_eq!(pressed, GestureState::Selects(circle(10.0), RegionMode::Extend), "at once");
    let moved = gesture.input(&Input::PointerMoved, at(30.0));
    assert_eq!(moved, GestureState::Selects(circle(30.0), RegionMode::Extend), "all along");
    assert_eq!(gesture.input(&Input::Released(PointerButton::Left), at(30.0)), GestureState::Running);
    let pressed = gesture.input(&Input::Pressed(PointerButton::Middle), at(30.0));
    assert_eq!(pressed, GestureState::Selects(circle(30.0), RegionMode::Subtract), "the middle button");
    gesture.input(&Input::Wheel(-1.0), at(30.0));
    assert_eq!(
        gesture.region(),
        Region::Circle { center: DVec2::new(30.0, 5.0), radius: 50.0 * 1.1 },
        "larger"
    );
    assert_eq!(gesture.input(&Input::Pressed(PointerButton::Right), at(30.0)), GestureState::Ended(None));
}

#[test]
fn a_lasso_keeps_its_way() {
    let way = [(0.0, 0.0), (10.0, 0.0), (10.5, 0.0), (10.0, 10.0)];
    let state = draw(GestureKind::Lasso, Modifiers::NONE, &way);
    let kept = [way[0], way[1], way[3]].map(DVec2::from).to_vec();
    assert_eq!(state, GestureState::Ended(Some((Region::Lasso(kept), RegionMode::Set))), "without trembling");
    let ctrl = hands(0.0, 0.0, Modifiers::CTRL);
    let mut gesture = Gesture::drawing(GestureKind::Lasso, PointerButton::Left, ctrl, 1.0);
    let state = gesture.input(&Input::Released(PointerButton::Left), ctrl);
    assert!(matches!(state, GestureState::Ended(Some((_, RegionMode::Set)))), "Ctrl only starts it");
    let escape = Input::Key { logical: Some(Key::Escape), physical: None, repeat: false };
    assert_eq!(gesture.input(&escape, ctrl), GestureState::Ended(None), "nothing is selected");
}
