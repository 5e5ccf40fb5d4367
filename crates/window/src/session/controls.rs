//! Applies user input to camera, objects and interface. The interface comes first: events on a
//! panel or in a text field belong to it. Then the application gets the event (`offers`), and what
//! it does not take goes to camera, keymap and clicks. A button belongs to whatever it was pressed
//! on until it is released; and all are informed of releases.

use std::time::Duration;

use egui::Event;
use trigon_math::{DVec2, DVec3};

use super::Session;
use crate::commands;
use crate::input::{
    Chord, Gesture, Input, InputEvent, InputOwner, Key, KeyCode, KeyPress, Modifiers, PointerButton, Press,
    Taken,
};
use crate::keymap::{Action, Binding, ClickAction, DragAction, Motion, STEP};
use crate::motion;
use crate::pacing::Change;
use crate::stage::Visibility;

impl Session<'_> {
    pub(super) fn control(&mut self, input: InputEvent, now: Duration) {
        match input {
            InputEvent::Interface(event) => self.interface_event(event, now),
            InputEvent::PointerMoved(to) => self.pointer_moved(to, now),
            InputEvent::Button(button, press) => self.button(button, press, now),
            InputEvent::Wheel(_) | InputEvent::Pinch(_) if self.is_on_interface() => {}
            InputEvent::Wheel(lines) => self.wheel(lines, now),
            InputEvent::Pinch(power) => self.pinch(power, now),
            InputEvent::KeyDown(key) if self.keys_are_the_interfaces() => self.leave_search(key, now),
            InputEvent::KeyDown(key) => self.key(key, now),
            InputEvent::KeyUp(code) => self.released(code, now),
            InputEvent::Modifiers(modifiers) => {
                self.modifiers = modifiers;
                self.offer(Input::ModifiersChanged, now);
            }
            InputEvent::FocusLost => self.focus_lost(now),
            InputEvent::FocusGained => {
                self.offer(Input::FocusGained, now);
            }
            _ => {}
        }
    }

    fn pointer_moved(&mut self, to: DVec2, now: Duration) {
        self.wrap(to, now);
        let gesture = self.pointer.moved(to, self.stage.scale());
        if self.pointer.is_held() {
            self.gesture(gesture, now);
        } else if self.stage.wraps_pointer {
            self.has_moved = true;
        } else {
            self.offer(Input::PointerMoved, now);
        }
    }

    /// Offers the movements that wait, as one: a mouse reports up to a thousand a second, each of which may change
    /// thousands of vertices.
    pub(super) fn offer_moves(&mut self, now: Duration) {
        if std::mem::take(&mut self.has_moved) {
            self.offer(Input::PointerMoved, now);
        }
    }

    fn button(&mut self, button: PointerButton, press: Press, now: Duration) {
        match press {
            Press::Down if self.is_on_interface() => {}
            Press::Down if self.offer_press(button, now) == Taken::Yes => {}
            Press::Up if self.offer_release(button, now) == Taken::Yes => {}
            _ => {
                let gesture = self.pointer.button(button, press, self.modifiers);
                self.gesture(gesture, now);
            }
        }
    }

    fn focus_lost(&mut self, now: Duration) {
        self.move_held(now);
        self.held.clear();
        self.stage.end_move();
        self.pointer.cancel();
        self.modifiers = Modifiers::NONE;
        self.taken.clear();
        self.offer(Input::FocusLost, now);
    }

    /// Events for the interface. It receives keys only while a widget has the keyboard, and the
    /// wheel only while the pointer is on it.
    fn interface_event(&mut self, event: Event, now: Duration) {
        let wanted = match event {
            Event::Key { .. }
            | Event::Text(_)
            | Event::Copy
            | Event::Cut
            | Event::Paste(_)
            | Event::Ime(_) => self.keys_are_the_interfaces(),
            Event::MouseWheel { .. } | Event::Zoom(_) | Event::Rotate(_) => self.is_on_interface(),
            Event::PointerButton { pressed: true, .. } => !self.is_applications(),
            _ => true,
        };
        if !wanted {
            return;
        }
        // Where a movement waits for the application, the interface shows it together with what that makes of it.
        let waits = self.stage.wraps_pointer && matches!(event, Event::PointerMoved(_));
        self.interface.event(event);
        if !waits {
            self.pacing.changed(Change::Overlay, now);
        }
    }

    /// Whether the pointer is on the interface, and not dragging something beneath it.
    fn is_on_interface(&self) -> bool {
        let at = self.pointer.position().filter(|_| !self.pointer.is_held() && !self.is_applications());
        at.is_some_and(|at| self.interface.wants_pointer(at))
    }

    /// Whether the pointer belongs to the application, wherever it is.
    fn is_applications(&self) -> bool {
        self.stage.input_owner == InputOwner::Application || self.taken.has_button()
    }

    /// Escape closes the list of keys while it is searched. Every other key is the search's.
    fn leave_search(&mut self, key: KeyPress, now: Duration) {
        if key.logical == Some(Key::Escape) && self.interface.searches_keys() {
            self.stage.cheat_sheet = Visibility::Hidden;
            self.note(now);
        }
    }

    /// Whether a widget has the keyboard.
    fn keys_are_the_interfaces(&self) -> bool {
        self.stage.input_owner == InputOwner::Interface && self.interface.wants_keyboard()
    }

    fn gesture(&mut self, gesture: Option<Gesture>, now: Duration) {
        match gesture {
            None | Some(Gesture::Released) => {}
            Some(Gesture::Drag { button, modifiers, from, to }) => {
                let Some(action) = self.stage.keymap.find_drag(button, modifiers) else { return };
                let anchor = match action {
                    DragAction::ZoomToPointer => self.anchor_at(from),
                    _ => None,
                };
                motion::drag(&mut self.stage, action, from, to, anchor);
                // The pointer went on, but the drag goes on about its first point.
                if let Some((at, _)) = self.anchor.as_mut().filter(|_| action == DragAction::ZoomToPointer) {
                    *at = to;
                }
                self.pacing.changed(Change::Moving, now);
            }
            Some(Gesture::Click { button, modifiers, at }) => self.click(button, modifiers, at, now),
        }
    }

    fn click(&mut self, button: PointerButton, modifiers: Modifiers, at: DVec2, now: Duration) {
        if self.offer_click(button, modifiers, at, now) == Taken::Yes {
            return;
        }
        let Some(action) = self.stage.keymap.find_click(button, modifiers) else { return };
        match action {
            ClickAction::OpenMenu => self.stage.open_menu(Some(at)),
            ClickAction::Select if self.stage.report().is_coarse => {
                self.stage
                    .overlay
                    .notify("Not selected: only a draft of coarser meshes was shown; click again");
            }
            ClickAction::Select => {
                self.stage.selection = self.stage.pick(at).map(|(hit, _)| hit.node);
                commands::announce_selection(&mut self.stage);
            }
            ClickAction::LookAt | ClickAction::LookAtFromAsNear => {
                let Some((_, point)) = self.stage.pick(at) else { return };
                if action == ClickAction::LookAtFromAsNear {
                    // As near as the point was, not as the old target was.
                    let depth = -self.stage.camera().to_camera(point).z;
                    self.stage.orbit.set_distance(depth);
                }
                self.stage.orbit.set_target(point);
            }
        }
        self.note(now);
    }

    fn wheel(&mut self, lines: f64, now: Duration) {
        if self.offer(Input::Wheel(lines), now) == Taken::Yes {
            return;
        }
        let to_pointer = self.modifiers.contains(Modifiers::CTRL);
        let pointer = self.pointer.position().filter(|_| to_pointer);
        let anchor = pointer.and_then(|at| self.anchor_at(at));
        motion::wheel(&mut self.stage, lines, anchor);
        self.pacing.changed(Change::Moving, now);
    }

    fn pinch(&mut self, power: f64, now: Duration) {
        if self.offer(Input::Pinch(power), now) == Taken::No {
            motion::zoom(&mut self.stage, power, None);
            self.pacing.changed(Change::Moving, now);
        }
    }

    /// What is under the pointer, or else the point at the target's distance.
    /// Asked again for the same place, it is the same point: zooming keeps it there.
    fn anchor_at(&mut self, at: DVec2) -> Option<DVec3> {
        if let Some((known, anchor)) = self.anchor
            && known == at
        {
            return anchor;
        }
        let hit = self.stage.pick(at).map(|(_, point)| point);
        let anchor = hit.or_else(|| {
            let pane = self.stage.pane_at(at);
            let projector = trigon_camera::Projector::new(&self.stage.camera_of(&pane), pane.area.size);
            projector.at_distance(at - pane.area.origin(), self.stage.orbit.distance())
        });
        self.anchor = Some((at, anchor));
        anchor
    }

    fn key(&mut self, key: KeyPress, now: Duration) {
        // Keys of the keymap that act while they are down have a clock of their own.
        if self.offer_key(key, now) == Taken::Yes || key.repeat {
            return;
        }
        let chords = [key.logical, key.physical].into_iter().flatten();
        let found = chords
            .map(|key| Chord::new(self.modifiers, key))
            .find_map(|chord| self.stage.keymap.find(chord))
            .cloned();
        let Some(binding) = found else { return };
        match binding.action {
            Action::Hold(motion) => {
                self.move_held(now);
                if matches!(motion, Motion::Object(_)) {
                    if self.stage.selection.is_none() {
                        commands::say_nothing_is_selected(&mut self.stage);
                    }
                    self.stage.begin_move();
                }
                let steps = self.held.press(key.code, motion, now);
                (0..steps).for_each(|_| motion::hold(&mut self.stage, motion, STEP.as_secs_f64()));
                self.pacing.changed(Change::Moving, now);
            }
            _ => self.act(&binding, now),
        }
    }

    /// Does what a key does that is not held.
    pub(super) fn act(&mut self, binding: &Binding, now: Duration) {
        match binding.action {
            Action::Command => {
                self.handler.command(&mut self.stage, &binding.name);
                self.after_handler(now);
            }
            Action::EnterInterface => {
                self.interface.take_keyboard();
                self.note(now);
            }
            other => {
                commands::act(&mut self.stage, other);
                self.note(now);
            }
        }
    }

    fn released(&mut self, code: KeyCode, now: Duration) {
        self.offer_key_release(code, now);
        if self.held.is_empty() {
            return;
        }
        self.move_held(now);
        self.held.release(code);
        if !self.held.motions().any(|motion| matches!(motion, Motion::Object(_))) {
            self.stage.end_move();
        }
        self.pacing.changed(Change::Moving, now);
    }

    /// Moves by what keys that are held have not moved by yet.
    pub(super) fn move_held(&mut self, now: Duration) {
        for _ in 0..self.held.steps(now) {
            for motion in self.held.motions() {
                motion::hold(&mut self.stage, motion, STEP.as_secs_f64());
            }
        }
    }
}
