//! What a newcomer tries: the menu, undoing what was moved, views of all, the full screen.

use super::*;
use crate::keymap::matches_search;
use crate::stage::Visibility;

fn press(session: &mut Session<'_>, modifiers: Modifiers, key: Key, now: Duration) {
    session.event(InputEvent::Modifiers(modifiers), now);
    session.event(key_down(1, key), now);
    session.event(InputEvent::KeyUp(KeyCode(1)), now);
    session.event(InputEvent::Modifiers(Modifiers::NONE), now);
}

#[test]
fn a_click_with_the_right_button_opens_the_menu_and_a_drag_zooms() {
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    let before = session.stage.orbit.distance();
    drag(&mut session, PointerButton::Right, DVec2::new(0.0, -20.0), ms(1000));
    assert!(session.stage.menu.is_none(), "a drag is no click");
    assert!(session.stage.orbit.distance() < before, "it zooms");
    drag(&mut session, PointerButton::Right, DVec2::ZERO, ms(2000));
    assert!(session.stage.menu.is_some(), "the menu");
    run(&mut session, ms(2000));
    assert!(session.interface.wants_keyboard(), "arrows choose from it");
}

/// It said "2 fps" of an image that took half a second and was not followed by another one.
#[test]
fn a_picture_at_rest_has_no_rate() {
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    session.stage.frame_time = Visibility::Shown;
    assert!(!session.stage.is_moving(), "nothing has moved yet");
    drag(&mut session, PointerButton::Left, DVec2::new(20.0, 0.0), ms(1000));
    draw(&mut session, ms(1010));
    assert!(session.stage.is_moving(), "images follow one another");
    run(&mut session, ms(1020));
    assert!(!session.stage.is_moving(), "the time is written again once it rests");
}

#[test]
fn the_menu_opens_by_keys_too() {
    for (modifiers, key) in [(Modifiers::NONE, Key::Menu), (Modifiers::SHIFT, Key::Function(10))] {
        let mut handler = Recorder::default();
        let mut session = begun(&mut handler);
        press(&mut session, modifiers, key, ms(1000));
        assert!(session.stage.menu.is_some(), "{key}");
    }
}

#[test]
fn the_menu_offers_what_keys_do() {
    let keymap = Keymap::default();
    let entries = keymap.menu().filter(|(_, binding)| binding.is_some()).count();
    assert!(entries >= 10, "all of them are bound: {entries}");
}

#[test]
fn what_keys_have_moved_is_undone_and_done_again() {
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    press(&mut session, Modifiers::NONE, Key::Tab, ms(1000));
    let object = session.stage.selection.expect("the first object");
    let at = |session: &Session<'_>| session.stage.scene.node(object).expect("it is there").transform;
    let start = at(&session);
    session.event(InputEvent::Modifiers(Modifiers::ALT), ms(1100));
    session.event(key_down(2, Key::Right), ms(1100));
    session.event(InputEvent::KeyUp(KeyCode(2)), ms(1400));
    session.event(InputEvent::Modifiers(Modifiers::NONE), ms(1400));
    let moved = at(&session);
    assert_ne!(moved, start, "Alt and an arrow move it");
    assert_eq!(session.stage.moved_nodes().len(), 1, "which is known");
    press(&mut session, Modifiers::CTRL, Key::Character('z'), ms(2000));
    assert_eq!((at(&session), session.stage.moved_nodes().len()), (start, 0), "Ctrl+Z puts it back");
    for (modifiers, key) in [(Modifiers::CTRL | Modifiers::SHIFT, 'z'), (Modifiers::CTRL, 'y')] {
        press(&mut session, modifiers, Key::Character(key), ms(3000));
        assert_eq!(at(&session), moved, "redone");
        press(&mut session, Modifiers::CTRL, Key::Character('z'), ms(3100));
    }
    assert_eq!(at(&session), start, "undone");
}

#[test]
fn axis_views_fit_the_model_but_not_what_is_beside_it() {
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    press(&mut session, Modifiers::NONE, Key::Character('1'), ms(1000));
    let fitted = session.stage.orbit;
    session.stage.orbit.set_distance(1000.0);
    press(&mut session, Modifiers::NONE, Key::Character('1'), ms(2000));
    assert_eq!(session.stage.orbit, fitted, "from far away it is fitted again");
    let grid = session.stage.scene.add_object("grid", primitives::cube(100.0), Material::default());
    press(&mut session, Modifiers::NONE, Key::Character('1'), ms(3000));
    assert!(session.stage.orbit.distance() > 2.0 * fitted.distance(), "a large cube counts");
    session.stage.beside = vec![grid];
    press(&mut session, Modifiers::NONE, Key::Character('1'), ms(4000));
    assert_eq!(session.stage.orbit, fitted, "a grid does not");
}

#[test]
fn a_notch_of_the_wheel_zooms_by_a_tenth() {
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    let before = session.stage.orbit.distance();
    session.event(InputEvent::Wheel(1.0), ms(1000));
    let factor = before / session.stage.orbit.distance();
    assert!((factor - 1.1).abs() < 1e-12, "{factor}");
}

#[test]
fn escape_leaves_the_full_screen_last() {
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    for key in [Key::Function(11), Key::Tab, Key::Character('h')] {
        press(&mut session, Modifiers::NONE, key, ms(1000));
    }
    let state = |session: &Session<'_>| {
        let Stage { cheat_sheet, selection, full_screen, .. } = &session.stage;
        (*cheat_sheet == Visibility::Shown, selection.is_some(), *full_screen)
    };
    assert_eq!(state(&session), (true, true, true), "all of it");
    for expected in [(false, true, true), (false, false, true), (false, false, false)] {
        press(&mut session, Modifiers::NONE, Key::Escape, ms(2000));
        assert_eq!(state(&session), expected, "one thing at a time");
    }
}

#[test]
fn the_list_of_keys_finds_other_words_and_forgets_them_when_it_is_opened_again() {
    let found = |search: &str| {
        let rows = Keymap::default().sheet().into_iter().filter(|row| row.matches(search));
        rows.map(|row| row.description).collect::<Vec<_>>()
    };
    assert!(found("rotate").contains(&"orbit".to_owned()), "{:?}", found("rotate"));
    assert!(found("help").contains(&"this list".to_owned()), "{:?}", found("help"));
    assert!(matches_search("screenshot", "save"), "an application's own, too");
    let mut handler = Recorder::default();
    let mut session = begun(&mut handler);
    session.stage.command_search = "rotate".into();
    press(&mut session, Modifiers::NONE, Key::Character('h'), ms(1000));
    assert_eq!(session.stage.command_search, "", "all rows are there again");
}
