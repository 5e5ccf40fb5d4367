//! Simulated user input for a window without a display. Each function sends the interface and the session the
//! events of the window system, in their order.

use egui::{Event, MouseWheelSource, MouseWheelUnit, TouchPhase};
use std::path::PathBuf;

use trigon_camera::Viewport;
use trigon_math::DVec2;

use super::HeadlessWindow;
use crate::input::{Chord, InputEvent, Key, KeyCode, KeyPress, Modifiers, PointerButton, Press};

/// The number of intermediate positions of a pointer movement: tools see where it came from.
const STEPS: u32 = 4;

impl HeadlessWindow<'_> {
    /// Moves the pointer to a position in physical pixels, in a straight line.
    pub fn move_to(&mut self, to: DVec2) {
        let from = self.pointer;
        for step in 1..=STEPS {
            self.pointer = from.lerp(to, f64::from(step) / f64::from(STEPS));
            let at = self.in_points();
            self.interface(Event::PointerMoved(at));
            self.event(InputEvent::PointerMoved(self.pointer));
        }
        self.rest();
    }

    /// Moves the pointer to a position in physical pixels at once, and draws one frame, as during a
    /// continuing movement. Work that waits for the pointer to rest is not done.
    pub fn move_on_to(&mut self, to: DVec2) {
        self.pointer = to;
        let at = self.in_points();
        self.interface(Event::PointerMoved(at));
        self.event(InputEvent::PointerMoved(to));
        self.frame();
    }

    /// Sets the held modifier keys.
    pub fn hold(&mut self, modifiers: Modifiers) {
        if self.modifiers != modifiers {
            self.modifiers = modifiers;
            self.event(InputEvent::Modifiers(modifiers));
            self.rest();
        }
    }

    /// Presses a button at the pointer's position.
    pub fn press(&mut self, button: PointerButton) {
        self.button(button, Press::Down);
    }

    /// Releases a button at the pointer's position.
    pub fn release(&mut self, button: PointerButton) {
        self.button(button, Press::Up);
    }

    /// Drags files over the window.
    pub fn hover(&mut self, files: &[PathBuf]) {
        files.iter().for_each(|file| self.event(InputEvent::FileHovered(file.clone())));
        self.rest();
    }

    /// Drops files onto the window, all at once.
    pub fn drop_files(&mut self, files: &[PathBuf]) {
        files.iter().for_each(|file| self.event(InputEvent::FileDropped(file.clone())));
        self.rest();
    }

    /// Gives the window another size in physical pixels, and so many of them for a logical one.
    pub fn resize(&mut self, size: Viewport, scale: f64) {
        self.event(InputEvent::Scaled(scale));
        self.event(InputEvent::Resized { width: size.width, height: size.height });
        self.rest();
    }

    /// Turns the wheel by lines away from the user.
    pub fn wheel(&mut self, lines: f64) {
        let (delta, modifiers) = (egui::vec2(0.0, lines as f32), self.of_interface());
        let (unit, phase, source) = (MouseWheelUnit::Line, TouchPhase::Move, MouseWheelSource::Wheel);
        self.interface(Event::MouseWheel { unit, delta, phase, source, modifiers });
        self.event(InputEvent::Wheel(lines));
        self.rest();
    }

    /// Presses and releases a key with its modifiers. A key that types something also types it.
    pub fn key(&mut self, chord: Chord) {
        self.strike(chord, Self::rest);
    }

    /// The same, but the key is down for one frame only: less is drawn of movements that last as long as it is held.
    pub fn tap(&mut self, chord: Chord) {
        self.strike(chord, Self::frame);
    }

    fn strike(&mut self, chord: Chord, hold_down: fn(&mut Self)) {
        let held = self.modifiers;
        self.hold(chord.modifiers);
        let typed = typed(chord.key).filter(|_| !chord.modifiers.contains(Modifiers::CTRL));
        let press =
            |code| KeyPress { code, logical: Some(chord.key), physical: on_pad(chord.key), repeat: false };
        // Keys are pressed one at a time.
        let code = KeyCode(1);
        self.key_to_interface(chord.key, true);
        if let Some(typed) = typed {
            self.interface(Event::Text(typed.to_string()));
        }
        self.event(InputEvent::KeyDown(press(code)));
        hold_down(self);
        self.key_to_interface(chord.key, false);
        self.event(InputEvent::KeyUp(code));
        self.rest();
        self.hold(held);
    }

    fn button(&mut self, button: PointerButton, press: Press) {
        let (pos, modifiers, pressed) = (self.in_points(), self.of_interface(), press == Press::Down);
        let theirs = match button {
            PointerButton::Left => egui::PointerButton::Primary,
            PointerButton::Right => egui::PointerButton::Secondary,
            PointerButton::Middle => egui::PointerButton::Middle,
        };
        self.interface(Event::PointerButton { pos, button: theirs, pressed, modifiers });
        self.event(InputEvent::Button(button, press));
        self.rest();
    }

    fn key_to_interface(&mut self, key: Key, pressed: bool) {
        let name = match key {
            Key::Numpad(typed) => typed.to_string(),
            other => other.to_string(),
        };
        let Some(key) = egui::Key::from_name(&name) else { return };
        let modifiers = self.of_interface();
        self.interface(Event::Key { key, physical_key: None, pressed, repeat: false, modifiers });
    }

    pub(super) fn interface(&mut self, event: Event) {
        self.event(InputEvent::Interface(event));
    }

    pub(super) fn in_points(&mut self) -> egui::Pos2 {
        let at = self.pointer / f64::from(self.session.interface().context().pixels_per_point());
        egui::pos2(at.x as f32, at.y as f32)
    }

    fn of_interface(&self) -> egui::Modifiers {
        let has = |modifier| self.modifiers.contains(modifier);
        let (ctrl, command) = (has(Modifiers::CTRL), has(Modifiers::CTRL));
        egui::Modifiers {
            alt: has(Modifiers::ALT),
            ctrl,
            shift: has(Modifiers::SHIFT),
            mac_cmd: false,
            command,
        }
    }
}

/// The text that a key types.
fn typed(key: Key) -> Option<char> {
    match key {
        Key::Character(typed) | Key::Numpad(typed) => Some(typed),
        Key::Space => Some(' '),
        _ => None,
    }
}

/// A number pad key also acts as the corresponding main key.
fn on_pad(key: Key) -> Option<Key> {
    match key {
        Key::Numpad(typed) => Some(Key::Character(typed)),
        _ => None,
    }
}
