//! Translates winit's events into ours, and decides nothing.

use std::hash::{DefaultHasher, Hash, Hasher};

use trigon_math::DVec2;
use winit::event::{ElementState, KeyEvent, MouseButton, MouseScrollDelta, WindowEvent};
use winit::keyboard::{self, ModifiersState, NamedKey, PhysicalKey};
use winit::platform::modifier_supplement::KeyEventExtModifierSupplement;

use super::{InputEvent, Key, KeyCode, KeyPress, Modifiers, PointerButton, Press, WheelDelta, wheel_lines};

/// Our event for one of winit's; `None` for those that mean nothing to us.
/// `scale` is physical pixels per logical one.
pub(crate) fn translate(event: &WindowEvent, scale: f64) -> Option<InputEvent> {
    Some(match event {
        WindowEvent::CursorMoved { position, .. } => {
            InputEvent::PointerMoved(DVec2::new(position.x, position.y))
        }
        WindowEvent::MouseInput { state, button, .. } => {
            InputEvent::Button(pointer_button(*button)?, press(*state))
        }
        WindowEvent::MouseWheel { delta, .. } => InputEvent::Wheel(wheel_lines(wheel_delta(*delta), scale)),
        WindowEvent::PinchGesture { delta, .. } if delta.is_finite() => InputEvent::Pinch(*delta),
        WindowEvent::KeyboardInput { event, is_synthetic: false, .. } => key_event(event)?,
        WindowEvent::KeyboardInput { event, .. } if event.state == ElementState::Released => {
            key_event(event)?
        }
        WindowEvent::ModifiersChanged(modifiers) => InputEvent::Modifiers(modifier_set(modifiers.state())),
        WindowEvent::Focused(false) => InputEvent::FocusLost,
        WindowEvent::Focused(true) => InputEvent::FocusGained,
        WindowEvent::HoveredFile(path) => InputEvent::FileHovered(path.clone()),
        WindowEvent::HoveredFileCancelled => InputEvent::HoverEnded,
        WindowEvent::DroppedFile(path) => InputEvent::FileDropped(path.clone()),
        WindowEvent::Resized(size) => InputEvent::Resized { width: size.width, height: size.height },
        WindowEvent::ScaleFactorChanged { scale_factor, .. } => InputEvent::Scaled(*scale_factor),
        WindowEvent::Occluded(true) => InputEvent::Hidden,
        WindowEvent::Occluded(false) => InputEvent::Shown,
        WindowEvent::CloseRequested => InputEvent::CloseRequested,
        _ => return None,
    })
}

fn press(state: ElementState) -> Press {
    match state {
        ElementState::Pressed => Press::Down,
        ElementState::Released => Press::Up,
    }
}

fn pointer_button(button: MouseButton) -> Option<PointerButton> {
    Some(match button {
        MouseButton::Left => PointerButton::Left,
        MouseButton::Right => PointerButton::Right,
        MouseButton::Middle => PointerButton::Middle,
        _ => return None,
    })
}

fn wheel_delta(delta: MouseScrollDelta) -> WheelDelta {
    match delta {
        MouseScrollDelta::LineDelta(x, y) => WheelDelta::Lines(DVec2::new(f64::from(x), f64::from(y))),
        MouseScrollDelta::PixelDelta(pixels) => WheelDelta::Pixels(DVec2::new(pixels.x, pixels.y)),
    }
}

fn modifier_set(state: ModifiersState) -> Modifiers {
    let control = if cfg!(target_os = "macos") { ModifiersState::SUPER } else { ModifiersState::CONTROL };
    [
        (control, Modifiers::CTRL),
        (ModifiersState::ALT, Modifiers::ALT),
        (ModifiersState::SHIFT, Modifiers::SHIFT),
    ]
    .into_iter()
    .filter(|&(theirs, _)| state.contains(theirs))
    .fold(Modifiers::NONE, |all, (_, ours)| all | ours)
}

fn key_event(event: &KeyEvent) -> Option<InputEvent> {
    let mut hasher = DefaultHasher::new();
    event.physical_key.hash(&mut hasher);
    let code = KeyCode(hasher.finish());
    match event.state {
        ElementState::Released => Some(InputEvent::KeyUp(code)),
        ElementState::Pressed => Some(InputEvent::KeyDown(KeyPress {
            code,
            logical: pad_key(event.physical_key).or_else(|| logical_key(&event.key_without_modifiers())),
            physical: physical_key(event.physical_key, &event.key_without_modifiers()),
            repeat: event.repeat,
        })),
    }
}

/// The key by its place on a US keyboard: digits, which some layouts put behind
/// Shift, and letters where the layout has none of the Latin ones.
fn physical_key(physical: PhysicalKey, logical: &keyboard::Key) -> Option<Key> {
    let is_foreign = matches!(logical, keyboard::Key::Character(text) if !text.is_ascii());
    let pad = || match pad_key(physical) {
        Some(Key::Numpad(typed)) => Some(Key::Character(typed)),
        _ => None,
    };
    physical_digit(physical).or_else(pad).or_else(|| physical_letter(physical).filter(|_| is_foreign))
}

/// The key of the number pad, with or without its lock.
fn pad_key(key: PhysicalKey) -> Option<Key> {
    use keyboard::KeyCode as Code;
    const KEYS: [(Code, char); 15] = [
        (Code::Numpad0, '0'),
        (Code::Numpad1, '1'),
        (Code::Numpad2, '2'),
        (Code::Numpad3, '3'),
        (Code::Numpad4, '4'),
        (Code::Numpad5, '5'),
        (Code::Numpad6, '6'),
        (Code::Numpad7, '7'),
        (Code::Numpad8, '8'),
        (Code::Numpad9, '9'),
        (Code::NumpadDecimal, '.'),
        (Code::NumpadAdd, '+'),
        (Code::NumpadSubtract, '-'),
        (Code::NumpadMultiply, '*'),
        (Code::NumpadDivide, '/'),
    ];
    let PhysicalKey::Code(code) = key else { return None };
    KEYS.into_iter().find(|&(pressed, _)| pressed == code).map(|(_, typed)| Key::Numpad(typed))
}

fn physical_letter(key: PhysicalKey) -> Option<Key> {
    use keyboard::KeyCode::*;
    const LETTERS: [keyboard::KeyCode; 26] = [
        KeyA, KeyB, KeyC, KeyD, KeyE, KeyF, KeyG, KeyH, KeyI, KeyJ, KeyK, KeyL, KeyM, KeyN, KeyO, KeyP, KeyQ,
        KeyR, KeyS, KeyT, KeyU, KeyV, KeyW, KeyX, KeyY, KeyZ,
    ];
    let PhysicalKey::Code(code) = key else { return None };
    let letter = ('a'..='z').zip(LETTERS).find(|&(_, pressed)| pressed == code);
    letter.map(|(letter, _)| Key::Character(letter))
}

fn logical_key(key: &keyboard::Key) -> Option<Key> {
    match key {
        keyboard::Key::Named(named) => named_key(*named),
        keyboard::Key::Character(text) => {
            let mut lower = text.chars().flat_map(char::to_lowercase);
            let only = lower.next()?;
            lower.next().is_none().then_some(Key::Character(only))
        }
        _ => None,
    }
}

fn named_key(key: NamedKey) -> Option<Key> {
    Some(match key {
        NamedKey::Enter => Key::Enter,
        NamedKey::Escape => Key::Escape,
        NamedKey::Tab => Key::Tab,
        NamedKey::Space => Key::Space,
        NamedKey::Backspace => Key::Backspace,
        NamedKey::Delete => Key::Delete,
        NamedKey::Home => Key::Home,
        NamedKey::End => Key::End,
        NamedKey::PageUp => Key::PageUp,
        NamedKey::PageDown => Key::PageDown,
        NamedKey::ArrowLeft => Key::Left,
        NamedKey::ArrowRight => Key::Right,
        NamedKey::ArrowUp => Key::Up,
        NamedKey::ArrowDown => Key::Down,
        NamedKey::ContextMenu => Key::Menu,
        function => return function_key(function),
    })
}

fn function_key(key: NamedKey) -> Option<Key> {
    const KEYS: [NamedKey; 12] = [
        NamedKey::F1,
        NamedKey::F2,
        NamedKey::F3,
        NamedKey::F4,
        NamedKey::F5,
        NamedKey::F6,
        NamedKey::F7,
        NamedKey::F8,
        NamedKey::F9,
        NamedKey::F10,
        NamedKey::F11,
        NamedKey::F12,
    ];
    (1u8..).zip(KEYS).find(|&(_, known)| known == key).map(|(number, _)| Key::Function(number))
}

fn physical_digit(key: PhysicalKey) -> Option<Key> {
    use keyboard::KeyCode as Code;
    const DIGITS: [(Code, Code); 10] = [
        (Code::Digit0, Code::Numpad0),
        (Code::Digit1, Code::Numpad1),
        (Code::Digit2, Code::Numpad2),
        (Code::Digit3, Code::Numpad3),
        (Code::Digit4, Code::Numpad4),
        (Code::Digit5, Code::Numpad5),
        (Code::Digit6, Code::Numpad6),
        (Code::Digit7, Code::Numpad7),
        (Code::Digit8, Code::Numpad8),
        (Code::Digit9, Code::Numpad9),
    ];
    let PhysicalKey::Code(code) = key else { return None };
    let digit = ('0'..='9').zip(DIGITS).find(|&(_, (row, pad))| code == row || code == pad);
    digit.map(|(digit, _)| Key::Character(digit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_are_lower_case_and_single() {
        let character = |text: &str| logical_key(&keyboard::Key::Character(text.into()));
        assert_eq!(character("H"), Some(Key::Character('h')), "shortcuts know no case");
        assert_eq!(character("ff"), None, "a key that types two characters is no shortcut");
        assert_eq!(logical_key(&keyboard::Key::Named(NamedKey::F12)), Some(Key::Function(12)), "F12");
    }

    #[test]
    fn letters_are_found_by_place_where_the_layout_is_not_latin() {
        let physical = PhysicalKey::Code(keyboard::KeyCode::KeyQ);
        let typed = |text: &str| physical_key(physical, &keyboard::Key::Character(text.into()));
        assert_eq!(typed("\u{439}"), Some(Key::Character('q')), "Cyrillic short i is on the key of Q");
        assert_eq!(typed("a"), None, "on a French keyboard A is there, and means A");
    }

    #[test]
    fn digits_are_found_by_place() {
        let five = Some(Key::Character('5'));
        assert_eq!(physical_digit(PhysicalKey::Code(keyboard::KeyCode::Digit5)), five, "in the row");
        assert_eq!(physical_digit(PhysicalKey::Code(keyboard::KeyCode::Numpad5)), five, "and on the pad");
    }

    #[test]
    fn the_pad_is_told_from_the_row_and_stands_for_it() {
        let physical = |code| PhysicalKey::Code(code);
        assert_eq!(
            pad_key(physical(keyboard::KeyCode::Numpad1)),
            Some(Key::Numpad('1')),
            "a place of its own"
        );
        assert_eq!(pad_key(physical(keyboard::KeyCode::Digit1)), None, "which the row is not");
        let locked = keyboard::Key::Named(NamedKey::Delete);
        let point = physical_key(physical(keyboard::KeyCode::NumpadDecimal), &locked);
        assert_eq!(point, Some(Key::Character('.')), "whether its lock is on or not");
    }

    #[test]
    fn buttons_and_presses_are_told_apart() {
        let buttons = [MouseButton::Left, MouseButton::Right, MouseButton::Middle, MouseButton::Back];
        let expected = [PointerButton::Left, PointerButton::Right, PointerButton::Middle].map(Some);
        assert_eq!(buttons.map(pointer_button)[..3], expected);
        assert_eq!(pointer_button(MouseButton::Back), None, "it means nothing to us");
        assert_eq!([ElementState::Pressed, ElementState::Released].map(press), [Press::Down, Press::Up]);
    }

    #[test]
    fn wheels_turn_by_lines_and_touchpads_by_pixels() {
        let lines = wheel_delta(MouseScrollDelta::LineDelta(1.0, -2.0));
        assert!(matches!(lines, WheelDelta::Lines(by) if by == DVec2::new(1.0, -2.0)));
        let pixels = winit::dpi::PhysicalPosition::new(3.0, 4.5);
        let pixels = wheel_delta(MouseScrollDelta::PixelDelta(pixels));
        assert!(matches!(pixels, WheelDelta::Pixels(by) if by == DVec2::new(3.0, 4.5)));
    }

    #[test]
    fn modifiers_are_those_that_are_down() {
        let control = if cfg!(target_os = "macos") { ModifiersState::SUPER } else { ModifiersState::CONTROL };
        let pairs = [
            (control, Modifiers::CTRL),
            (ModifiersState::ALT, Modifiers::ALT),
            (ModifiersState::SHIFT, Modifiers::SHIFT),
        ];
        for bits in 0..8 {
            let down = pairs.iter().enumerate().filter(|(bit, _)| bits >> bit & 1 != 0);
            let (mut theirs, mut ours) = (ModifiersState::empty(), Modifiers::NONE);
            for (_, &(one, other)) in down {
                theirs |= one;
                ours = ours | other;
            }
            assert_eq!(modifier_set(theirs), ours);
        }
    }

    #[test]
    fn what_happens_to_the_window_is_told() {
        let told = |event| translate(&event, 1.0);
        let size = winit::dpi::PhysicalSize::new(30, 20);
        assert_eq!(told(WindowEvent::Resized(size)), Some(InputEvent::Resized { width: 30, height: 20 }));
        assert_eq!(told(WindowEvent::Occluded(true)), Some(InputEvent::Hidden));
        assert_eq!(told(WindowEvent::Occluded(false)), Some(InputEvent::Shown));
        assert_eq!(told(WindowEvent::CloseRequested), Some(InputEvent::CloseRequested));
        assert_eq!(told(WindowEvent::Focused(false)), Some(InputEvent::FocusLost));
        assert_eq!(told(WindowEvent::Focused(true)), Some(InputEvent::FocusGained));
        assert_eq!(told(WindowEvent::RedrawRequested), None, "the session knows when to draw");
        let control = if cfg!(target_os = "macos") { ModifiersState::SUPER } else { ModifiersState::CONTROL };
        let modifiers = WindowEvent::ModifiersChanged(control.into());
        assert_eq!(told(modifiers), Some(InputEvent::Modifiers(Modifiers::CTRL)));
    }

    #[test]
    fn every_named_key_has_its_name() {
        let named = [
            (NamedKey::Enter, Key::Enter),
            (NamedKey::Escape, Key::Escape),
            (NamedKey::Tab, Key::Tab),
            (NamedKey::Space, Key::Space),
            (NamedKey::Backspace, Key::Backspace),
            (NamedKey::Delete, Key::Delete),
            (NamedKey::Home, Key::Home),
            (NamedKey::End, Key::End),
            (NamedKey::PageUp, Key::PageUp),
            (NamedKey::PageDown, Key::PageDown),
            (NamedKey::ArrowLeft, Key::Left),
            (NamedKey::ArrowRight, Key::Right),
            (NamedKey::ArrowUp, Key::Up),
            (NamedKey::ArrowDown, Key::Down),
            (NamedKey::ContextMenu, Key::Menu),
            (NamedKey::F1, Key::Function(1)),
            (NamedKey::F7, Key::Function(7)),
        ];
        for (theirs, ours) in named {
            assert_eq!(logical_key(&keyboard::Key::Named(theirs)), Some(ours));
        }
        assert_eq!(named_key(NamedKey::CapsLock), None, "it is no key of ours");
        assert_eq!(logical_key(&keyboard::Key::Dead(None)), None);
    }

    #[test]
    fn places_are_those_of_a_keyboard_of_the_us() {
        use keyboard::KeyCode as Code;
        let foreign = keyboard::Key::Character("\u{439}".into());
        let pressed = |code| physical_key(PhysicalKey::Code(code), &foreign);
        for (code, letter) in [(Code::KeyA, 'a'), (Code::KeyM, 'm'), (Code::KeyZ, 'z'), (Code::Digit0, '0')] {
            assert_eq!(pressed(code), Some(Key::Character(letter)));
        }
        assert_eq!(pressed(Code::Semicolon), None, "it is no letter");
        for (code, typed) in [
            (Code::Numpad0, '0'),
            (Code::Numpad9, '9'),
            (Code::NumpadAdd, '+'),
            (Code::NumpadSubtract, '-'),
            (Code::NumpadMultiply, '*'),
            (Code::NumpadDivide, '/'),
        ] {
            assert_eq!(pad_key(PhysicalKey::Code(code)), Some(Key::Numpad(typed)));
            assert_eq!(pressed(code), Some(Key::Character(typed)), "{typed} stands for the row's");
        }
    }

    #[test]
    fn files_are_told_while_they_are_held_over_the_window_and_when_they_are_let_go() {
        let told = |event| translate(&event, 1.0);
        let path = std::path::PathBuf::from("a.obj");
        assert_eq!(told(WindowEvent::HoveredFile(path.clone())), Some(InputEvent::FileHovered(path.clone())));
        assert_eq!(told(WindowEvent::HoveredFileCancelled), Some(InputEvent::HoverEnded), "taken away again");
        assert_eq!(told(WindowEvent::DroppedFile(path.clone())), Some(InputEvent::FileDropped(path)));
    }
}
