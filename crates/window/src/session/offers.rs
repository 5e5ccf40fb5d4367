//! Offers input to the application, after the interface and before the camera. A key or button that the
//! application takes belongs to it until it is released.

use std::time::Duration;

use trigon_math::DVec2;

use super::Session;
use crate::input::{Hands, Input, KeyCode, KeyPress, Modifiers, PointerButton, Taken};
use crate::pacing::Change;

/// The buttons and keys that are down and were taken by the application.
#[derive(Debug, Default)]
pub(super) struct TakenInput {
    buttons: Vec<PointerButton>,
    keys: Vec<KeyPress>,
}

impl TakenInput {
    pub(super) fn has_button(&self) -> bool {
        !self.buttons.is_empty()
    }

    /// No release of any of them will follow.
    pub(super) fn clear(&mut self) {
        self.buttons.clear();
        self.keys.clear();
    }
}

impl Session<'_> {
    /// Offers something that happens where the pointer is now.
    pub(super) fn offer(&mut self, input: Input, now: Duration) -> Taken {
        let hands = Hands { pointer: self.pointer.position(), modifiers: self.modifiers };
        self.offer_to(input, hands, now)
    }

    fn offer_to(&mut self, input: Input, hands: Hands, now: Duration) -> Taken {
        let before = self.stage.subject();
        let taken = self.handler.input(&mut self.stage, &input, hands);
        if taken == Taken::Yes {
            self.after_handler(now);
            // More of these follow: the images between them have to be quick.
            let goes_on = matches!(input, Input::PointerMoved | Input::Wheel(_) | Input::Pinch(_));
            if goes_on && before != self.stage.subject() {
                self.pacing.changed(Change::Moving, now);
            }
        }
        taken
    }

    /// While a button drags the camera, others wait for their turn.
    pub(super) fn offer_press(&mut self, button: PointerButton, now: Duration) -> Taken {
        if self.pointer.is_held() {
            return Taken::No;
        }
        let taken = self.offer(Input::Pressed(button), now);
        if taken == Taken::Yes && !self.taken.buttons.contains(&button) {
            self.taken.buttons.push(button);
        }
        taken
    }

    pub(super) fn offer_release(&mut self, button: PointerButton, now: Duration) -> Taken {
        if !self.taken.buttons.contains(&button) {
            return Taken::No;
        }
        self.taken.buttons.retain(|&other| other != button);
        self.offer(Input::Released(button), now);
        self.after_handler(now);
        Taken::Yes
    }

    pub(super) fn offer_click(
        &mut self,
        button: PointerButton,
        modifiers: Modifiers,
        at: DVec2,
        now: Duration,
    ) -> Taken {
        self.offer_to(Input::Clicked(button), Hands { pointer: Some(at), modifiers }, now)
    }

    pub(super) fn offer_key(&mut self, key: KeyPress, now: Duration) -> Taken {
        let KeyPress { code, logical, physical, repeat } = key;
        let taken = self.offer(Input::Key { logical, physical, repeat }, now);
        if taken == Taken::Yes && !self.taken.keys.iter().any(|other| other.code == code) {
            self.taken.keys.push(key);
        }
        taken
    }

    pub(super) fn offer_key_release(&mut self, code: KeyCode, now: Duration) {
        let Some(index) = self.taken.keys.iter().position(|key| key.code == code) else { return };
        let KeyPress { logical, physical, .. } = self.taken.keys.remove(index);
        self.offer(Input::KeyReleased { logical, physical }, now);
    }
}
