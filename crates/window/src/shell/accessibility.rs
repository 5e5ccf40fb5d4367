//! Names and actions of widgets for screen readers. Nothing is computed until a screen reader asks for it.

use egui_winit::accesskit_winit::{Event, WindowEvent};

use super::{Shell, UserEvent};
use crate::input::InputEvent;

impl From<Event> for UserEvent {
    fn from(event: Event) -> Self {
        Self::Accessibility(event.window_event)
    }
}

impl Shell<'_> {
    pub(super) fn accessibility(&mut self, event: WindowEvent) {
        let now = self.now();
        let context = self.session.interface().context();
        match event {
            WindowEvent::InitialTreeRequested => {
                context.enable_accesskit();
                self.session.interface_requested_redraw(now);
            }
            WindowEvent::ActionRequested(request) => {
                let action = egui::Event::AccessKitActionRequest(request);
                self.session.event(InputEvent::Interface(action), now);
            }
            WindowEvent::AccessibilityDeactivated => context.disable_accesskit(),
        }
    }
}
