//! A window without a display, for tests of whole applications: the same session as behind a real window,
//! driven by mouse and keyboard alone. Its clock advances only by simulated input, and its worker draws on
//! the calling thread, so the same input gives the same images everywhere.

mod hands;
mod live;

use std::sync::mpsc::{Receiver, Sender, channel};
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

pub use live::LiveFrame;

/// The duration of one movement, press or release. Twice this is too slow for a double click in egui.
const HAND: Duration = Duration::from_millis(400);

/// The interval of frames during a continuing movement: 60 a second.
const FRAME: Duration = Duration::from_micros(16_667);

/// An application that runs without a display.
pub struct HeadlessWindow<'a> {
    session: Session<'a>,
    now: Duration,
    pointer: DVec2,
    modifiers: Modifiers,
    /// The interface's output for screen readers.
    tree: Option<State>,
    rings: Receiver<Wakeup>,
    /// The clock that measures frames.
    clock: Clock,
    frames: Vec<DrawnFrame>,
    /// Whether its time is that of the clock, and images come when they are finished.
    is_live: bool,
}

/// The time since any fixed moment.
type Clock = Box<dyn Fn() -> Duration>;

/// What other threads report.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Wakeup {
    /// [`crate::Waker::wake`].
    Application,
    /// An image is finished.
    Image,
}

/// A drawn frame: when it began and ended. The window's own time stands still meanwhile.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct DrawnFrame {
    /// When all previous events had been handled.
    pub begun: Duration,
    /// When the image of the scene was ready, if a new one was due.
    pub drawn: Duration,
    /// When the interface had been painted over it.
    pub ended: Duration,
    /// Whether the image is current and drawn in full: neither a draft nor outdated.
    pub is_full: bool,
}

/// An element of the interface, as screen readers report it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Widget {
    /// Its name.
    pub label: String,
    /// Its text or value.
    pub value: Option<String>,
    /// Its centre, in physical pixels.
    pub center: DVec2,
    /// Whether it is disabled.
    pub is_disabled: bool,
    /// Whether it is on, if it is a switch.
    pub is_on: Option<bool>,
    /// Its role.
    pub role: Role,
}

impl<'a> HeadlessWindow<'a> {
    /// Opens a window of a size in physical pixels, and draws until it rests.
    #[must_use]
    pub fn open(stage: Stage, handler: &'a mut dyn Handler, size: Viewport) -> Self {
        Self::open_measured(stage, handler, size, || Duration::ZERO)
    }

    /// The same, with frames measured by a clock: the time since any fixed moment. Nothing depends on that:
    /// drafts are drawn in the window's full size however long they take.
    #[must_use]
    pub fn open_measured(
        stage: Stage,
        handler: &'a mut dyn Handler,
        size: Viewport,
        clock: impl Fn() -> Duration + 'static,
    ) -> Self {
        let (ring, rings) = channel();
        connect(&stage, ring);
        let mut window = Self::with_worker(stage, handler, Worker::of_caller(), rings, Box::new(clock));
        window.start(size);
        window
    }

    /// A window that is not open yet.
    fn with_worker(
        stage: Stage,
        handler: &'a mut dyn Handler,
        worker: Worker,
        rings: Receiver<Wakeup>,
        clock: Clock,
    ) -> Self {
        let mut session = Session::new(stage, handler, worker);
        session.interface().context().enable_accesskit();
        // Animations of colours and panels are not needed.
        session.interface().context().all_styles_mut(|style| style.animation_time = 0.0);
        session.record();
        Self {
            session,
            now: Duration::ZERO,
            pointer: DVec2::ZERO,
            modifiers: Modifiers::NONE,
            tree: None,
            rings,
            clock,
            frames: Vec::new(),
            is_live: false,
        }
    }

    fn start(&mut self, size: Viewport) {
        self.event(InputEvent::Resized { width: size.width, height: size.height });
        self.session.start(self.now);
        self.rest();
    }

    /// The contents of the window.
    #[must_use]
    pub fn stage(&self) -> &Stage {
        self.session.stage()
    }

    /// Whether it was closed.
    pub fn is_closed(&mut self) -> bool {
        self.session.is_over()
    }

    /// Rows of pixels from the top: red, green, blue, and an unused alpha.
    #[must_use]
    pub fn pixels(&self) -> Vec<[u8; 4]> {
        self.session.canvas().pixels().iter().map(|&[b, g, r, a]| [r, g, b, a]).collect()
    }

    /// All input so far, for replaying in a window of the same size.
    pub fn take_recorded(&mut self) -> Interaction {
        let recorded = self.session.take_recorded();
        self.session.record();
        recorded.unwrap_or_default()
    }

    /// The frames since the last call, in order.
    pub fn take_frames(&mut self) -> Vec<DrawnFrame> {
        std::mem::take(&mut self.frames)
    }

    /// Waits until another thread of the application wakes the window.
    ///
    /// # Panics
    /// No thread is left that could.
    pub fn wait(&mut self) {
        let ring = self.rings.recv().expect("the stage holds a waker");
        self.ring(ring);
        self.rest();
    }

    /// All widgets with this name, in screen reader order.
    #[must_use]
    pub fn widgets(&self, label: &str) -> Vec<Widget> {
        let is_meant = |widget: &Widget| widget.label == label;
        self.all_widgets().into_iter().filter(is_meant).collect()
    }

    /// Every element of the interface that has a name and a position.
    #[must_use]
    pub fn all_widgets(&self) -> Vec<Widget> {
        let mut found = Vec::new();
        if let Some(tree) = &self.tree {
            collect(tree.root(), &mut found);
        }
        found
    }

    /// Where the floating parts of the interface lie, in physical pixels, each with its left upper and its
    /// right lower corner: windows, menus and texts. Parts of the same order must not cover each other.
    #[must_use]
    pub fn layers(&mut self) -> Vec<(egui::LayerId, [DVec2; 2])> {
        let context = self.session.interface().context().clone();
        let points = f64::from(context.pixels_per_point());
        let corner = |at: egui::Pos2| DVec2::new(f64::from(at.x), f64::from(at.y)) * points;
        context.memory(|memory| {
            let shown = memory.areas().visible_layer_ids().into_iter();
            let shown = shown.filter_map(|layer| Some((layer, memory.area_rect(layer.id)?)));
            shown.map(|(layer, rect)| (layer, [corner(rect.min), corner(rect.max)])).collect()
        })
    }

    /// Whether the interface receives presses at the pointer's position.
    #[must_use]
    pub fn is_on_interface(&mut self) -> bool {
        let at = self.pointer;
        self.session.interface().wants_pointer(at)
    }

    fn event(&mut self, event: InputEvent) {
        self.session.event(event, self.now);
    }

    /// Handles all consequences of the input, and advances the clock by the duration of one input.
    fn rest(&mut self) {
        if self.is_live {
            return self.rest_live();
        }
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

    /// Advances the clock by one frame, and draws what is due then.
    fn frame(&mut self) {
        self.session.settle(self.now);
        if let Wake::At(later) = self.session.next(self.now) {
            self.now = later.min(self.now + FRAME);
        }
        if self.session.next(self.now) == Wake::Now {
            self.draw();
        }
    }

    fn ring(&mut self, ring: Wakeup) {
        match ring {
            Wakeup::Application => self.session.woken(self.now),
            Wakeup::Image => self.session.collect(self.now),
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
        while let Ok(ring) = self.rings.try_recv() {
            self.ring(ring);
        }
        let Some(update) = self.session.interface().take_output().accesskit_update else { return };
        match &mut self.tree {
            Some(tree) => tree.update(update),
            None => self.tree = Some(State::new(update)),
        }
    }
}

/// Lets the application's threads wake the window.
fn connect(stage: &Stage, ring: Sender<Wakeup>) {
    stage.waker().connect(move || {
        // If this fails, nobody is waiting any more.
        let _ = ring.send(Wakeup::Application);
    });
}

fn collect(node: AccessKitNode<'_>, found: &mut Vec<Widget>) {
    let label = node.label().or_else(|| (node.role() == Role::Label).then(|| node.value()).flatten());
    if let (Some(label), Some(bounds)) = (label, node.bounding_box()) {
        found.push(Widget {
            label,
            value: node.value(),
            center: DVec2::new((bounds.x0 + bounds.x1) / 2.0, (bounds.y0 + bounds.y1) / 2.0),
            is_disabled: node.is_disabled(),
            is_on: node.toggled().map(|toggled| toggled == Toggled::True),
            role: node.role(),
        });
    }
    node.children().for_each(|child| collect(child, found));
}

#[cfg(test)]
mod tests;
