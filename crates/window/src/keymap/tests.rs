//! Tables of bindings.

use super::*;
use crate::input::{Chord, Key, Modifiers, PointerButton};

fn names(keymap: &Keymap) -> Vec<&str> {
    keymap.bindings().iter().map(|binding| &*binding.name).collect()
}

fn in_section(chord: char, name: &'static str, section: &'static str) -> Binding {
    let (chord, action) = (chord.into(), Action::Command);
    Binding { name: name.into(), chord, action, description: name.into(), section: section.into() }
}

#[test]
fn a_key_does_what_it_was_bound_to_last() {
    let mut keymap = Keymap::empty();
    assert!(keymap.bindings().is_empty() && keymap.drags().is_empty() && keymap.clicks().is_empty());
    keymap.bind('a', "one", Action::Quit, "quits");
    keymap.bind(Chord::new(Modifiers::CTRL, Key::Character('a')), "two", Action::ResetView, "resets");
    keymap.bind('b', "three", Action::ToggleEdges, "edges");
    keymap.bind('a', "four", Action::CycleSamples, "samples");
    assert_eq!(names(&keymap), ["two", "three", "four"], "the first is unbound");
    let action = |keymap: &Keymap, chord: Chord| keymap.find(chord).map(|binding| binding.action);
    assert_eq!(action(&keymap, 'a'.into()), Some(Action::CycleSamples));
    assert_eq!(action(&keymap, Chord::new(Modifiers::CTRL, Key::Character('a'))), Some(Action::ResetView));
    assert_eq!(action(&keymap, Chord::new(Modifiers::ALT, Key::Character('a'))), None, "exactly these");
    keymap.unbind('b');
    assert_eq!((names(&keymap), action(&keymap, 'b'.into())), (vec!["two", "four"], None), "it is free");
}

#[test]
fn headings_stand_in_the_order_in_which_they_come_up() {
    let mut keymap = Keymap::empty();
    for (chord, name, section) in
        [('a', "one", "First"), ('b', "two", "Second"), ('c', "three", "First"), ('d', "four", "Second")]
    {
        keymap.add(in_section(chord, name, section));
    }
    assert_eq!(names(&keymap), ["one", "three", "two", "four"]);
}

#[test]
fn the_menu_offers_what_is_bound() {
    let mut keymap = Keymap::empty();
    keymap.bind('a', "one", Action::Quit, "quits");
    let command = |name| MenuEntry::Command { name, label: "label" };
    keymap.set_menu([command("one"), MenuEntry::Line, command("unknown"), command("one")]);
    let offered: Vec<_> = keymap.menu().map(|(entry, bound)| (*entry, bound.map(|b| b.action))).collect();
    let one = (command("one"), Some(Action::Quit));
    assert_eq!(offered, [one, (MenuEntry::Line, None), one]);
}

#[test]
fn a_drag_is_bound_to_a_button_with_exactly_its_modifiers() {
    let drag = |button, modifiers, action| DragBinding { button, modifiers, action, description: "".into() };
    let mut keymap = Keymap::empty();
    let (left, right, ctrl) = (PointerButton::Left, PointerButton::Right, Modifiers::CTRL);
    keymap.bind_drag(drag(left, Modifiers::NONE, DragAction::Orbit));
    keymap.bind_drag(drag(left, ctrl, DragAction::Roll));
    keymap.bind_drag(drag(right, Modifiers::NONE, DragAction::Zoom));
    keymap.bind_drag(drag(left, Modifiers::NONE, DragAction::Pan));
    assert_eq!(keymap.drags().len(), 3, "one took another's place");
    assert_eq!(keymap.find_drag(left, Modifiers::NONE), Some(DragAction::Pan));
    assert_eq!(keymap.find_drag(left, ctrl), Some(DragAction::Roll));
    assert_eq!(keymap.find_drag(right, Modifiers::NONE), Some(DragAction::Zoom));
    assert_eq!(keymap.find_drag(right, ctrl), None);
    assert_eq!(keymap.find_drag(left, ctrl | Modifiers::SHIFT), None, "not with one more");
    assert_eq!(keymap.find_drag(PointerButton::Middle, Modifiers::NONE), None);
}

#[test]
fn of_the_clicks_whose_modifiers_are_held_the_most_particular_is_meant() {
    let click =
        |button, modifiers, action| ClickBinding { button, modifiers, action, description: "".into() };
    let mut keymap = Keymap::empty();
    let (left, right, ctrl) = (PointerButton::Left, PointerButton::Right, Modifiers::CTRL);
    let both = ctrl | Modifiers::SHIFT;
    keymap.bind_click(click(left, both, ClickAction::LookAtFromAsNear));
    keymap.bind_click(click(left, ctrl, ClickAction::OpenMenu));
    keymap.bind_click(click(left, Modifiers::NONE, ClickAction::Select));
    keymap.bind_click(click(right, ctrl, ClickAction::OpenMenu));
    keymap.bind_click(click(left, ctrl, ClickAction::LookAt));
    assert_eq!(keymap.clicks().len(), 4, "one took another's place");
    assert_eq!(keymap.find_click(left, Modifiers::NONE), Some(ClickAction::Select));
    assert_eq!(keymap.find_click(left, Modifiers::ALT), Some(ClickAction::Select), "others do not matter");
    assert_eq!(keymap.find_click(left, ctrl), Some(ClickAction::LookAt));
    assert_eq!(keymap.find_click(left, both), Some(ClickAction::LookAtFromAsNear));
    assert_eq!(keymap.find_click(right, both), Some(ClickAction::OpenMenu));
    assert_eq!(keymap.find_click(right, Modifiers::SHIFT), None);
    assert_eq!(keymap.find_click(PointerButton::Middle, ctrl), None);
}
