//! A window without a display, for tests of whole applications: the same session as behind a real window, worked
//! by mouse and keyboard alone. Its time stands still but for what a hand takes, its worker draws where it is
//! asked, and so the same input gives the same pictures everywhere.

mod hands;

use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use egui::accesskit::{Role, Toggled};
use egui_kittest::kittest::{AccessKitNode, State};
use trigon_camera::Viewport;
use trigon_math::DVec2;

use crate::input::{InputEvent, Modifiers};
use crate::interaction::Interaction;
use crate::pacing::Wake;
use crate::session::Session;
use crate::worker::Worker;
use crate::{Handler, Stage};

/// What a hand takes for one movement, press or release. Twice within it is no double click of egui's.
const HAND: Duration = Duration::from_millis(400);

/// Frames of a hand that goes on are so far apart: 60 a second.
const FRAME: Duration = Duration::from_micros(16_667);

/// An application that is worked without a display.
pub struct HeadlessWindow<'a> {
    session: Session<'a>,
    now: Duration,
    pointer: DVec2,
    modifiers: Modifiers,
    /// What the interface says to screen readers.
    tree: Option<State>,
    rings: Receiver<()>,
    /// What frames are measured by.
    clock: Box<dyn Fn() -> Duration>,
    frames: Vec<DrawnFrame>,
}

/// A frame that was drawn: when that began and ended. The window's own time stands still meanwhile.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DrawnFrame {
    /// When all that happened before was dealt with.
    pub begun: Duration,
    /// When the picture of the scene was there, if another one was due.
    pub drawn: Duration,
    /// When the interface lay over it.
    pub ended: Duration,
    /// Whether the picture is the right one, drawn in full: neither a draft nor an older one.
    pub is_full: bool,
}

/// Something on the interface, as a screen reader would tell of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Widget {
    /// What it is called.
    pub label: String,
    /// What is written or chosen in it.
    pub value: Option<String>,
    /// Its middle, in physical pixels.
    pub center: DVec2,
    /// Whether it cannot be used now.
    pub is_disabled: bool,
    /// Whether it is on, if it can be on or off.
    pub is_on: Option<bool>,
    /// What it is.
    pub role: Role,
}

impl<'a> HeadlessWindow<'a> {
    /// Opens a window of a size in physical pixels, and draws until it rests.
    #[must_use]
    pub fn open(stage: Stage, handler: &'a mut dyn Handler, size: Viewport) -> Self {
        Self::open_measured(stage, handler, size, || Duration::ZERO)
    }

    /// The same, its frames measured by a clock: the time since any fixed moment. Nothing that it does depends
    /// on that: drafts are drawn in the window's full size however long they take.
    #[must_use]
    pub fn open_measured(
        stage: Stage,
        handler: &'a mut dyn Handler,
        size: Viewport,
        clock: impl Fn() -> Duration + 'static,
    ) -> Self {
        let (ring, rings) = channel();
        stage.waker().connect(move || {
            // Nobody waits any more when this fails.
            let _ = ring.send(());
        });
        let mut session = Session::new(stage, handler, Worker::of_caller());
        session.interface().context().enable_accesskit();
        // Nobody watches colours and folds move.
        session.interface().context().all_styles_mut(|style| style.animation_time = 0.0);
        session.record();
        let (pointer, modifiers) = (DVec2::ZERO, Modifiers::NONE);
        let (clock, frames) = (Box::new(clock), Vec::new());
        let mut window =
            Self { session, now: Duration::ZERO, pointer, modifiers, tree: None, rings, clock, frames };
        window.event(InputEvent::Resized { width: size.width, height: size.height });
        window.session.start(window.now);
        window.rest();
        window
    }

    /// What the window shows.
    #[must_use]
    pub fn stage(&self) -> &Stage {
        self.session.stage()
    }

    /// Whether it was closed.
    pub fn is_closed(&mut self) -> bool {
        self.session.is_over()
    }

    /// Rows of pixels from the top: red, green, blue, and an alpha that does not matter.
    #[must_use]
    pub fn pixels(&self) -> Vec<[u8; 4]> {
        self.session.canvas().pixels().iter().map(|&[b, g, r, a]| [r, g, b, a]).collect()
    }

    /// All that was done so far, to be played again in a window of the same size.
    pub fn take_recorded(&mut self) -> Interaction {
        let recorded = self.session.take_recorded();
        self.session.record();
        recorded.unwrap_or_default()
    }

    /// The frames since the last call, in their order.
    pub fn take_frames(&mut self) -> Vec<DrawnFrame> {
        std::mem::take(&mut self.frames)
    }

    /// Waits until another thread of the application wakes the window.
    ///
    /// # Panics
    /// If no thread is left that could.
    pub fn wait(&mut self) {
        self.rings.recv().expect("the stage holds a waker");
        self.session.woken(self.now);
        self.rest();
    }

    /// All widgets of this name, in their order on the screen reader.
    #[must_use]
    pub fn widgets(&self, label: &str) -> Vec<Widget> {
        let is_meant = |widget: &Widget| widget.label == label;
        self.all_widgets().into_iter().filter(is_meant).collect()
    }

    /// Everything on the interface that has a name and a place.
    #[must_use]
    pub fn all_widgets(&self) -> Vec<Widget> {
        let mut found = Vec::new();
        if let Some(tree) = &self.tree {
            collect(tree.root(), &mut found);
        }
        found
    }

    /// Where panels and windows of the interface lie over the picture, in physical pixels: the left upper
    /// corner and the right lower one of each, and its name. Docked panels are one, the least box around them.
    #[must_use]
    pub fn layers(&mut self) -> Vec<(String, [DVec2; 2])> {
        let context = self.session.interface().context().clone();
        let points = f64::from(context.pixels_per_point());
        let corner = |at: egui::Pos2| DVec2::new(f64::from(at.x), f64::from(at.y)) * points;
        context.memory(|memory| {
            let shown = memory
                .areas()
                .visible_layer_ids()
                .into_iter()
                .filter(|layer| layer.order >= egui::Order::Middle);
            let shown = shown.filter_map(|layer| Some((layer, memory.area_rect(layer.id)?)));
            shown.map(|(layer, rect)| (format!("{layer:?}"), [corner(rect.min), corner(rect.max)])).collect()
        })
    }

    /// Whether the interface takes what is pressed at the pointer.
    #[must_use]
    pub fn is_on_interface(&mut self) -> bool {
        let at = self.pointer;
        self.session.interface().wants_pointer(at)
    }

    fn event(&mut self, event: InputEvent) {
        self.session.event(event, self.now);
    }

    /// Does all that follows from what was done, and lets the time of a hand pass.
    fn rest(&mut self) {
        self.session.settle(self.now);
        let until = self.now + HAND;
        while self.now < until {
            self.now = match self.session.next(self.now) {
                Wake::Now => {
                    self.draw();
                    self.now
                }
                Wake::At(later) => later.min(until),
                Wake::Never => until,
            };
        }
    }

    /// Lets the time of a frame pass, and draws what is due then.
    fn frame(&mut self) {
        self.session.settle(self.now);
        if let Wake::At(later) = self.session.next(self.now) {
            self.now = later.min(self.now + FRAME);
        }
        if self.session.next(self.now) == Wake::Now {
            self.draw();
        }
    }

    fn draw(&mut self) {
        let now = self.now;
        let begun = (self.clock)();
        if self.session.draw(now, &*self.clock).is_some() {
            self.session.presented((self.clock)());
        }
        let (drawn, is_full) = (self.session.composed_at(), self.session.shows_full());
        self.frames.push(DrawnFrame { begun, drawn, ended: (self.clock)(), is_full });
        while self.rings.try_recv().is_ok() {
            self.session.woken(now);
        }
        let Some(update) = self.session.interface().take_output().accesskit_update else { return };
        match &mut self.tree {
            Some(tree) => tree.update(update),
            None => self.tree = Some(State::new(update)),
        }
    }
}

fn collect(node: AccessKitNode<'_>, found: &mut Vec<Widget>) {
    let label = node.label().or_else(|| (node.role() == Role::Label).then(|| node.value()).flatten());
    if let (Some(label), Some(place)) = (label, node.bounding_box()) {
        found.push(Widget {
            label,
            value: node.value(),
            center: DVec2::new((place.x0 + place.x1) / 2.0, (place.y0 + place.y1) / 2.0),
            is_disabled: node.is_disabled(),
            is_on: node.toggled().map(|toggled| toggled == Toggled::True),
            role: node.role(),
        });
    }
    node.children().for_each(|child| collect(child, found));
}

#[cfg(test)]
mod tests;
