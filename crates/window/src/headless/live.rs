//! A drag in real time: images are drawn on threads of their own while the interface is laid out, as behind a real
//! window. Only for measurements: what is drawn depends on the machine.

use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use egui::Event;
use trigon_camera::Viewport;
use trigon_math::DVec2;

use super::{HeadlessWindow, Wakeup, connect};
use crate::input::InputEvent;
use crate::pacing::Wake;
use crate::worker::Worker;
use crate::{Handler, Stage};

/// An image that a drag has brought to the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct LiveFrame {
    /// When the interface had been painted over it.
    pub shown: Duration,
    /// Its size in pixels: smaller than the window where the frame budget did not allow for more.
    pub size: [u32; 2],
}

impl<'a> HeadlessWindow<'a> {
    /// Opens a window of a size in physical pixels whose images are drawn on threads of their own.
    ///
    /// Until [`drag_live`](Self::drag_live) it is worked like any other, but its images come when they are finished:
    /// after input it rests until then.
    #[must_use]
    pub fn open_live(stage: Stage, handler: &'a mut dyn Handler, size: Viewport) -> Self {
        let started = Instant::now();
        let (ring, rings) = channel();
        let image = ring.clone();
        let finished = move || {
            // If this fails, nobody is waiting any more.
            let _ = image.send(Wakeup::Image);
        };
        let worker = Worker::of_threads(finished, move || started.elapsed());
        connect(&stage, ring);
        let mut window =
            Self::with_worker(stage, handler, worker, rings, Box::new(move || started.elapsed()));
        window.is_live = true;
        window.start(size);
        window
    }

    /// Moves the pointer for some time, at each interval to where a function of the time says. Returns the images
    /// that were shown meanwhile.
    pub fn drag_live(
        &mut self,
        duration: Duration,
        interval: Duration,
        position: impl Fn(Duration) -> DVec2,
    ) -> Vec<LiveFrame> {
        let begun = (self.clock)();
        let (mut due, mut shown) = (begun, Vec::new());
        while due < begun + duration {
            self.now = (self.clock)();
            while due <= self.now && due < begun + duration {
                self.pointer = position(due - begun);
                let at = self.in_points();
                self.interface(Event::PointerMoved(at));
                self.event(InputEvent::PointerMoved(self.pointer));
                due += interval;
            }
            self.turn(due, &mut shown);
        }
        shown
    }

    /// One turn of an event loop, which sleeps until a time if nothing is due before.
    fn turn(&mut self, until: Duration, shown: &mut Vec<LiveFrame>) {
        self.now = (self.clock)();
        self.session.settle(self.now);
        let wake = match self.session.next(self.now) {
            Wake::Now => {
                let new = self.session.new_image();
                self.draw();
                shown.extend(new.map(|size| LiveFrame { shown: (self.clock)(), size }));
                self.now
            }
            Wake::At(time) => time.min(until),
            Wake::Never => until,
        };
        let ring = self.rings.recv_timeout(wake.saturating_sub((self.clock)()));
        if ring == Err(RecvTimeoutError::Timeout) {
            return;
        }
        for ring in ring.into_iter().chain(self.rings.try_iter().collect::<Vec<_>>()) {
            self.ring(ring);
        }
    }

    /// Waits until nothing is left to be drawn.
    pub(super) fn rest_live(&mut self) {
        /// Longer than any image is expected to take.
        const MOST: Duration = Duration::from_secs(5);
        /// After this long without a frame it rests.
        const CALM: Duration = Duration::from_millis(600);
        let begun = (self.clock)();
        let mut last = begun;
        while (self.clock)() < (last + CALM).min(begun + MOST) {
            let mut shown = Vec::new();
            self.turn((self.clock)() + Duration::from_millis(20), &mut shown);
            if !shown.is_empty() {
                last = (self.clock)();
            }
        }
    }
}
