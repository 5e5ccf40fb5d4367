//! What happens between an event and a picture, without any window: events and
//! moments go in, pixels and "wake me then" come out. So all of it can be
//! tested without a display.

mod controls;
mod offers;
mod pictures;
mod wrapping;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use trigon_camera::Viewport;
use trigon_math::{Bounds3, DVec2, DVec3};
use trigon_scene::{Frame, RenderSettings};

use crate::canvas::Canvas;
use crate::handler::{Animation, Handler, Tick};
use crate::input::{HeldKeys, InputEvent, Modifiers, Pointer};
use crate::interaction::Interaction;
use crate::interface::{Interface, Moment};
use crate::pacing::{Change, Frames, Pacing, Wake};
use crate::refinement::Gallery;
use crate::shared_scene::Revision;
use crate::shown::DrawnNodes;
use crate::stage::{FrameReport, Stage, Subject, Visibility};
use crate::worker::Worker;
use offers::TakenInput;
use wrapping::Wrapping;

/// The step of an animation's first frame.
const FIRST_STEP: Duration = Duration::from_micros(16_667);

/// A window's life.
pub(crate) struct Session<'a> {
    stage: Stage,
    handler: &'a mut dyn Handler,
    interface: Interface,
    worker: Worker,
    modifiers: Modifiers,
    pointer: Pointer,
    held: HeldKeys,
    /// The buttons and keys that the application took.
    taken: TakenInput,
    wrapping: Wrapping,
    pacing: Pacing,
    animation: Animation,
    /// When frames were last stepped; `None` while nothing moves by itself.
    stepped: Option<Duration>,
    dropped: Vec<PathBuf>,
    /// What zooming to the pointer keeps in place, for as long as that rests.
    anchor: Option<(DVec2, Option<DVec3>)>,
    /// Of the scene, as it was at this revision.
    bounds: Option<(Revision, Bounds3)>,
    seen: Visibility,
    /// What the picture that was asked for last is of.
    subject: Option<Subject>,
    /// The nodes that it shows, of the scene at this revision.
    nodes: Option<(Revision, Arc<DrawnNodes>)>,
    /// The pictures of the window, and what they are of.
    gallery: Gallery,
    pictured: Option<Subject>,
    /// The one on the canvas.
    shown: Option<Arc<Frame>>,
    /// Pictures that were asked for and not begun.
    pictures: Vec<RenderSettings>,
    canvas: Canvas,
    /// Whether the canvas is yet to take that picture, or another size.
    stale: bool,
    /// When the current frame was handed over to be presented.
    composed: Duration,
    /// What has come in, if it is to be remembered.
    recorded: Option<Interaction>,
}

impl<'a> Session<'a> {
    pub(crate) fn new(stage: Stage, handler: &'a mut dyn Handler, worker: Worker) -> Self {
        Self {
            stage,
            handler,
            interface: Interface::new(),
            worker,
            modifiers: Modifiers::NONE,
            pointer: Pointer::default(),
            held: HeldKeys::default(),
            taken: TakenInput::default(),
            wrapping: Wrapping::default(),
            pacing: Pacing::new(),
            animation: Animation::Resting,
            stepped: None,
            dropped: Vec::new(),
            anchor: None,
            bounds: None,
            seen: Visibility::Shown,
            subject: None,
            nodes: None,
            gallery: Gallery::default(),
            pictured: None,
            shown: None,
            pictures: Vec::new(),
            canvas: Canvas::default(),
            stale: true,
            composed: Duration::ZERO,
            recorded: None,
        }
    }

    pub(crate) fn stage(&self) -> &Stage {
        &self.stage
    }

    pub(crate) fn interface(&mut self) -> &mut Interface {
        &mut self.interface
    }

    /// Remembers from now on what comes in.
    pub(crate) fn record(&mut self) {
        self.recorded = Some(Interaction::default());
    }

    /// What has come in since [`record`](Self::record).
    pub(crate) fn take_recorded(&mut self) -> Option<Interaction> {
        self.recorded.take()
    }

    /// The window is open and its size is known.
    pub(crate) fn start(&mut self, now: Duration) {
        self.handler.start(&mut self.stage);
        self.stage.reset_view();
        self.stage.animate();
        self.after_handler(now);
        self.step(now);
    }

    /// Whether the window is to be closed.
    pub(crate) fn is_over(&mut self) -> bool {
        self.stage.wishes().exit
    }

    /// [`crate::Waker::wake`] was called.
    pub(crate) fn woken(&mut self, now: Duration) {
        self.handler.woken(&mut self.stage);
        self.after_handler(now);
    }

    /// The interface has asked for a pass from another thread.
    pub(crate) fn interface_asked(&mut self, now: Duration) {
        self.pacing.changed(Change::Overlay, now);
    }

    /// All events that came together have been handled.
    pub(crate) fn settle(&mut self, now: Duration) {
        if !self.dropped.is_empty() {
            let paths = std::mem::take(&mut self.dropped);
            self.handler.dropped(&mut self.stage, paths, self.modifiers);
            self.after_handler(now);
        }
        self.pacing.lose_patience(now);
        if self.pacing.is_useless() {
            self.worker.cancel();
            self.collect(now);
        }
    }

    /// When to draw next.
    pub(crate) fn next(&self, now: Duration) -> Wake {
        if self.is_hidden() {
            return Wake::Never;
        }
        let expiries = [self.stage.overlay.next_expiry(), self.interface.due()];
        self.pacing.next(now, self.frames(), expiries.into_iter().flatten().min())
    }

    /// Brings the canvas up to date; `None` if nothing on it has changed, or while there
    /// is nothing to draw on. `clock` tells the time, to measure what the frame takes.
    pub(crate) fn draw(&mut self, now: Duration, clock: &dyn Fn() -> Duration) -> Option<&Canvas> {
        if self.is_hidden() {
            return None;
        }
        if self.pacing.can_step() {
            self.step(now);
        }
        if let Some(quality) = self.pacing.begin(now, self.frames()) {
            self.begin_picture(quality);
            self.collect(now);
        }
        self.composed = clock();
        // Not before the next picture is under way: that need not wait for it.
        self.show_picture();
        self.pacing.composed();
        self.run_interface(now);
        self.canvas.paint(&mut self.interface.painter).then_some(&self.canvas)
    }

    /// When the picture of the last frame was there, by the clock that the frame was given.
    #[cfg(any(test, feature = "kittest"))]
    pub(crate) fn composed_at(&self) -> Duration {
        self.composed
    }

    /// Whether the right picture is shown, as the settings say.
    #[cfg(any(test, feature = "kittest"))]
    pub(crate) fn shows_full(&self) -> bool {
        self.pacing.shows_full()
    }

    /// What was last drawn; of no size before.
    pub(crate) fn canvas(&self) -> &Canvas {
        &self.canvas
    }

    /// The frame is in the window.
    pub(crate) fn presented(&mut self, now: Duration) {
        let present = now.saturating_sub(self.composed);
        self.stage.set_report(FrameReport { present, ..self.stage.report() });
    }

    /// Something has happened.
    pub(crate) fn event(&mut self, event: InputEvent, now: Duration) {
        if let Some(recorded) = &mut self.recorded {
            recorded.record(event.clone(), now);
        }
        match event {
            InputEvent::FileDropped(path) => {
                self.dropped.push(path);
                self.hovered(0, now);
            }
            InputEvent::FileHovered(_) => self.hovered(self.stage.hovered_files + 1, now),
            InputEvent::HoverEnded => self.hovered(0, now),
            InputEvent::Resized { width, height } => self.resized(Viewport { width, height }, now),
            InputEvent::Scaled(scale) => {
                self.stage.rescale(scale);
                self.pacing.changed(Change::Settled, now);
            }
            InputEvent::Hidden => self.seen = Visibility::Hidden,
            InputEvent::Shown => {
                self.seen = Visibility::Shown;
                self.interface.painter.invalidate();
                self.pacing.changed(Change::Overlay, now);
            }
            InputEvent::CloseRequested => {
                self.handler.close_requested(&mut self.stage);
                self.after_handler(now);
            }
            input => self.control(input, now),
        }
    }

    fn is_hidden(&self) -> bool {
        let Viewport { width, height } = self.stage.viewport();
        width == 0 || height == 0 || self.seen == Visibility::Hidden
    }

    fn frames(&self) -> Frames {
        if self.animation == Animation::Running || !self.held.is_empty() {
            Frames::Wanted
        } else {
            Frames::None
        }
    }

    /// So many files are dragged over the window.
    fn hovered(&mut self, files: usize, now: Duration) {
        self.stage.hovered_files = files;
        self.pacing.changed(Change::Overlay, now);
    }

    fn resized(&mut self, viewport: Viewport, now: Duration) {
        if viewport == self.stage.viewport() && self.shown.is_some() {
            return;
        }
        self.stage.resize(viewport);
        // The first size is no movement.
        let change = if self.shown.is_some() { Change::Moving } else { Change::Settled };
        self.pacing.changed(change, now);
        self.stale = true;
    }

    /// Whatever was done, the interface may show it; and the picture is drawn again if
    /// what it shows has changed.
    fn note(&mut self, now: Duration) {
        let changed = self.subject.as_ref() != Some(&self.stage.subject());
        self.pacing.changed(if changed { Change::Settled } else { Change::Overlay }, now);
        if changed {
            self.anchor = None;
        }
        self.plan(now);
    }

    /// What every call of the handler may have changed.
    fn after_handler(&mut self, now: Duration) {
        self.note(now);
        self.pictures.append(&mut self.stage.wishes().pictures);
        self.begin_asked(now);
        if std::mem::take(&mut self.stage.wishes().animate) {
            self.animation = Animation::Running;
        }
    }

    /// Moves what moves by itself: the animation and held keys.
    fn step(&mut self, now: Duration) {
        if self.frames() == Frames::None {
            self.stepped = None;
            return;
        }
        let delta = self.stepped.map_or(FIRST_STEP, |last| now.saturating_sub(last));
        self.stepped = Some(now);
        self.move_held(now);
        if self.animation == Animation::Running {
            self.animation = self.handler.frame(&mut self.stage, Tick { time: now, delta });
            self.after_handler(now);
        }
        self.pacing.changed(Change::Settled, now);
    }

    /// Runs a pass of the interface.
    fn run_interface(&mut self, now: Duration) {
        let (viewport, scale) = (self.stage.viewport(), self.stage.scale());
        let moment = Moment { now, viewport, scale };
        let shown_by = self.gallery.camera();
        let handler = &mut self.handler;
        let mut application = |stage: &mut Stage, ui: &mut egui::Ui| handler.interface(stage, ui);
        let before = self.stage.subject();
        let chosen = self.interface.run(moment, &mut self.stage, shown_by, &mut application);
        if let Some(binding) = chosen {
            self.act(&binding, now);
        }
        // A widget may have changed what is shown, and asked for pictures.
        if before != self.stage.subject() || !self.stage.wishes().pictures.is_empty() {
            self.after_handler(now);
        }
        if std::mem::take(&mut self.stage.wishes().animate) {
            self.animation = Animation::Running;
        }
        self.plan(now);
    }
}

#[cfg(test)]
mod tests;
