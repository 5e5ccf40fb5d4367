//! The default bindings of every window. Letters, digits and mouse follow F3D (`interactor_impl.cxx`);
//! functions that F3D does not have are on keys that it leaves free.

use std::borrow::Cow;
use std::f64::consts::FRAC_PI_2;

use trigon_camera::AxisView;
use trigon_math::DVec3;

use super::action::{Action, CameraMotion, ClickAction, DragAction, Motion, ObjectMotion};
use super::binding::{Binding, ClickBinding, DragBinding, MenuEntry};
use crate::input::{Chord, Key, Modifiers, PointerButton};

/// Radians per second: a turn in four seconds.
const TURN: f64 = FRAC_PI_2;
/// Heights of the image per second.
const SHIFT: f64 = 0.5;
/// Logarithm of the magnification per second: twice as large in 0.7 s.
const ZOOM: f64 = 1.0;

/// Text grows by this factor: three steps double it.
const TEXT_STEP: f32 = 1.25;

/// The four arrows, and where each points.
const ARROWS: [(Key, f64, f64); 4] =
    [(Key::Left, -1.0, 0.0), (Key::Right, 1.0, 0.0), (Key::Up, 0.0, 1.0), (Key::Down, 0.0, -1.0)];

pub(super) fn bindings() -> Vec<Binding> {
    let ctrl = |c| Chord::new(Modifiers::CTRL, Key::Character(c));
    let window = vec![
        bind(Key::Menu, "menu", Action::OpenMenu, "menu"),
        bind(Chord::new(Modifiers::SHIFT, Key::Function(10)), "menu", Action::OpenMenu, "menu"),
        bind(Key::Function(11), "full_screen", Action::ToggleFullScreen, "full screen"),
        bind(ctrl('='), "text.larger", Action::ScaleText(TEXT_STEP), "larger, smaller text"),
        bind(ctrl('-'), "text.smaller", Action::ScaleText(1.0 / TEXT_STEP), "larger, smaller text"),
        bind(Key::Function(6), "interface", Action::EnterInterface, "into the interface (Escape: out of it)"),
        bind('h', "cheat_sheet", Action::ToggleCheatSheet, "this list"),
        bind(Key::Escape, "dismiss", Action::Dismiss, "close panels, select nothing"),
        bind(ctrl('q'), "quit", Action::Quit, "quit"),
    ];
    let sections = [
        ("View", views()),
        ("Display", display()),
        ("Camera", camera()),
        ("Objects", objects()),
        ("Window", window),
    ];
    let all = sections.into_iter().flat_map(|(section, bindings)| {
        bindings.into_iter().map(move |binding| Binding { section: section.into(), ..binding })
    });
    all.collect()
}

/// What is used most, in the order of the menu.
pub(super) fn menu() -> Vec<MenuEntry> {
    let command = |name, label| MenuEntry::Command { name, label };
    vec![
        command("reset_view", "Reset the view"),
        command("view.front", "Front view"),
        command("view.right", "Right view"),
        command("view.top", "Top view"),
        command("view.isometric", "Isometric view"),
        command("orthographic", "Perspective / orthographic"),
        MenuEntry::Line,
        command("edges", "Edges"),
        command("wireframe", "Faces, wires, hidden lines"),
        MenuEntry::Line,
        command("full_screen", "Full screen"),
        command("cheat_sheet", "Keys and commands"),
        command("quit", "Quit"),
    ]
}

fn bind(chord: impl Into<Chord>, name: &'static str, action: Action, description: &'static str) -> Binding {
    let (chord, section) = (chord.into(), Cow::Borrowed(""));
    Binding { name: name.into(), chord, action, description: description.into(), section }
}

fn views() -> Vec<Binding> {
    let mut all = Vec::new();
    for (digit, name, opposite, view) in [
        ('1', "view.front", "view.back", AxisView::Front),
        ('3', "view.right", "view.left", AxisView::Right),
        ('7', "view.top", "view.bottom", AxisView::Top),
    ] {
        all.push(bind(digit, name, Action::View(view), "front, right, top view"));
        let chord = Chord::new(Modifiers::CTRL, Key::Character(digit));
        all.push(bind(chord, opposite, Action::View(view.opposite()), "back, left, bottom view"));
    }
    all.sort_by(|a, b| b.description.cmp(&a.description));
    all.extend([
        bind('9', "view.isometric", Action::View(AxisView::Isometric), "isometric view"),
        bind('5', "orthographic", Action::ToggleOrthographic, "perspective / orthographic"),
        bind('2', "elevation.down", Action::Elevate(-FRAC_PI_2), "rotate by 90 degrees down, up"),
        bind('8', "elevation.up", Action::Elevate(FRAC_PI_2), "rotate by 90 degrees down, up"),
        bind('4', "roll.clockwise", Action::Roll(-FRAC_PI_2), "roll by 90 degrees"),
        bind('6', "roll.counter_clockwise", Action::Roll(FRAC_PI_2), "roll by 90 degrees"),
        bind(Key::Enter, "reset_view", Action::ResetView, "reset the view"),
    ]);
    all
}

fn display() -> Vec<Binding> {
    let wireframe = Chord::new(Modifiers::SHIFT, Key::Character('e'));
    vec![
        bind('e', "edges", Action::ToggleEdges, "edges on surfaces"),
        bind(wireframe, "wireframe", Action::CycleWireframe, "surface / wireframe / hidden lines"),
        bind('a', "samples", Action::CycleSamples, "samples per pixel"),
        bind('z', "frame_time", Action::ToggleFrameTime, "frame time"),
    ]
}

fn camera() -> Vec<Binding> {
    let mut all = Vec::new();
    let mut arrows = |modifiers, name, description, motion: fn(f64, f64) -> CameraMotion| {
        all.extend(ARROWS.map(|(key, x, y)| {
            bind(Chord::new(modifiers, key), name, Action::Hold(Motion::Camera(motion(x, y))), description)
        }));
    };
    arrows(Modifiers::NONE, "orbit", "orbit", |x, y| CameraMotion::Orbit(x * TURN, y * TURN));
    arrows(Modifiers::SHIFT, "orbit", "orbit", |x, y| CameraMotion::Orbit(x * TURN, y * TURN));
    arrows(Modifiers::CTRL | Modifiers::SHIFT, "pan", "pan", |x, y| CameraMotion::Pan(x * SHIFT, y * SHIFT));
    for (key, sign) in [(Key::PageUp, 1.0), (Key::PageDown, -1.0)] {
        let zoom = Action::Hold(Motion::Camera(CameraMotion::Zoom(sign * ZOOM)));
        all.push(bind(key, "zoom", zoom, "zoom in, out"));
    }
    for (key, sign) in [(Key::PageUp, 1.0), (Key::PageDown, -1.0)] {
        let roll = Action::Hold(Motion::Camera(CameraMotion::Roll(sign * TURN)));
        all.push(bind(Chord::new(Modifiers::CTRL, key), "roll", roll, "roll"));
    }
    all.push(bind('k', "orbit_style", Action::ToggleOrbitStyle, "turntable / trackball"));
    all
}

fn objects() -> Vec<Binding> {
    let shifted = Modifiers::ALT | Modifiers::SHIFT;
    let ctrl = Chord::new(Modifiers::CTRL, Key::Character('z'));
    let ctrl_shift = Chord::new(Modifiers::CTRL | Modifiers::SHIFT, Key::Character('z'));
    let mut all = vec![
        bind(Key::Tab, "select.next", Action::SelectNext, "select the next, previous object"),
        bind(
            Chord::new(Modifiers::SHIFT, Key::Tab),
            "select.previous",
            Action::SelectPrevious,
            "select the next, previous object",
        ),
        bind('.', "look_at_selected", Action::LookAtSelected, "look at the selected object"),
        bind(ctrl, "undo", Action::UndoMove, "undo, redo moving objects"),
        bind(ctrl_shift, "redo", Action::RedoMove, "undo, redo moving objects"),
        bind(
            Chord::new(Modifiers::CTRL, Key::Character('y')),
            "redo",
            Action::RedoMove,
            "undo, redo moving objects",
        ),
    ];
    let mut object = |modifiers, key, name, description, motion| {
        all.push(bind(Chord::new(modifiers, key), name, Action::Hold(Motion::Object(motion)), description));
    };
    for (key, x, y) in ARROWS {
        let motion = ObjectMotion::Move(DVec3::new(x, y, 0.0) * SHIFT);
        object(Modifiers::ALT, key, "object.move", "move the selected object", motion);
    }
    for (key, z) in [(Key::PageUp, -1.0), (Key::PageDown, 1.0)] {
        let motion = ObjectMotion::Move(DVec3::Z * z * SHIFT);
        object(Modifiers::ALT, key, "object.move", "move the selected object", motion);
    }
    for (key, x, y) in ARROWS {
        // To the right is about the upward axis, up is backwards about the right one.
        let motion = ObjectMotion::Turn(DVec3::new(-y, x, 0.0) * TURN);
        object(shifted, key, "object.turn", "rotate the selected object", motion);
    }
    for (key, z) in [(Key::PageUp, 1.0), (Key::PageDown, -1.0)] {
        let motion = ObjectMotion::Turn(DVec3::Z * z * TURN);
        object(shifted, key, "object.turn", "rotate the selected object", motion);
    }
    all
}

pub(super) fn drags() -> Vec<DragBinding> {
    let drag = |button, modifiers, action, description: &'static str| DragBinding {
        button,
        modifiers,
        action,
        description: description.into(),
    };
    vec![
        drag(PointerButton::Left, Modifiers::NONE, DragAction::Orbit, "orbit"),
        drag(PointerButton::Left, Modifiers::SHIFT, DragAction::Pan, "pan"),
        drag(PointerButton::Middle, Modifiers::NONE, DragAction::Pan, "pan"),
        drag(PointerButton::Left, Modifiers::CTRL, DragAction::Roll, "roll"),
        drag(PointerButton::Right, Modifiers::NONE, DragAction::Zoom, "zoom"),
        drag(PointerButton::Right, Modifiers::CTRL, DragAction::ZoomToPointer, "zoom to the pointer"),
    ]
}

pub(super) fn clicks() -> Vec<ClickBinding> {
    let click = |button, modifiers, action, description: &'static str| ClickBinding {
        button,
        modifiers,
        action,
        description: description.into(),
    };
    vec![
        click(PointerButton::Left, Modifiers::NONE, ClickAction::Select, "select the object"),
        click(PointerButton::Right, Modifiers::NONE, ClickAction::OpenMenu, "menu"),
        click(PointerButton::Middle, Modifiers::NONE, ClickAction::LookAt, "look at this point"),
        click(
            PointerButton::Middle,
            Modifiers::SHIFT,
            ClickAction::LookAtFromAsNear,
            "look at this point, keeping the distance",
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_bindings_share_a_key() {
        let all = bindings();
        for (i, binding) in all.iter().enumerate() {
            let twin = all[..i].iter().find(|other| other.chord == binding.chord);
            assert_eq!(twin, None, "{} is bound twice", binding.chord);
        }
        let all = drags();
        for (i, drag) in all.iter().enumerate() {
            let twin = all[..i].iter().any(|o| (o.button, o.modifiers) == (drag.button, drag.modifiers));
            assert!(!twin, "{drag:?} is bound twice");
        }
    }

    #[test]
    fn object_keys_stay_clear_of_f3d() {
        for binding in objects() {
            let key = binding.chord.key;
            let free = binding.chord.modifiers.contains(Modifiers::ALT)
                || [Key::Tab, Key::Character('.')].contains(&key)
                || ["undo", "redo"].contains(&binding.name.as_ref());
            assert!(free, "{} may mean something to F3D's users", binding.chord);
        }
    }

    #[test]
    fn in_a_second_a_key_moves_an_object_by_half_an_image_or_turns_it_by_a_quarter() {
        let (mut moves, mut turns) = (Vec::new(), Vec::new());
        for binding in objects() {
            match binding.action {
                Action::Hold(Motion::Object(ObjectMotion::Move(by))) => moves.push(by),
                Action::Hold(Motion::Object(ObjectMotion::Turn(by))) => turns.push(by),
                _ => {}
            }
        }
        for (found, speed) in [(moves, 0.5), (turns, FRAC_PI_2)] {
            assert_eq!(found.len(), 6, "two keys to an axis of the image: {found:?}");
            for by in DVec3::AXES.into_iter().flat_map(|axis| [axis * speed, axis * -speed]) {
                assert!(found.contains(&by), "no key for {by}: {found:?}");
            }
        }
    }
}
