//! Everything between an event and an image, without any window: events and times go in, pixels and
//! wake-up times come out. So all of it can be tested without a display.

mod controls;
mod images;
mod offers;
mod wrapping;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use trigon_camera::Viewport;
use trigon_math::{Bounds3, DVec2, DVec3};
use trigon_scene::{Frame, RenderSettings};

use crate::canvas::Canvas;
use crate::handler::{AnimationState, Handler, Tick};
use crate::input::{InputEvent, Modifiers, Pointer};
use crate::interaction::Interaction;
use crate::interface::{Interface, Moment};
use crate::keymap::HeldKeys;
use crate::pacing::{AnimationFrames, Change, Pacing, Wake};
use crate::refinement::Gallery;
use crate::shared_scene::Revision;
use crate::shown::DrawnNodes;
use crate::stage::{FrameReport, Stage, Subject, Visibility};
use crate::worker::{Redrawn, Worker};
use offers::TakenInput;
use wrapping::Wrapping;

/// The time step of an animation's first frame.
const FIRST_STEP: Duration = Duration::from_micros(16_667);

/// The state of a window.
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
    /// Whether the pointer has moved since the application was told.
    has_moved: bool,
    pacing: Pacing,
    animation: AnimationState,
    /// When frames were last stepped; `None` if nothing moves by itself.
    stepped: Option<Duration>,
    dropped: Vec<PathBuf>,
    /// The world point that zooming to the pointer keeps in place while the pointer rests.
    anchor: Option<(DVec2, Option<DVec3>)>,
    /// Of the scene, as it was at this revision.
    bounds: Option<(Revision, Bounds3)>,
    visibility: Visibility,
    /// Whether the list of keys was shown when it was last looked at.
    listed: Visibility,
    /// What the last requested image shows.
    subject: Option<Subject>,
    /// The nodes that it shows, of the scene at this revision.
    nodes: Option<(Revision, Arc<DrawnNodes>)>,
    /// The images of the window, and what they show.
    gallery: Gallery,
    drawn_subject: Option<Subject>,
    /// The one on the canvas.
    shown: Option<Arc<Frame>>,
    /// How the last image differs from the one before it.
    redrawn: Option<Redrawn>,
    /// Requested images that are not begun.
    images: Vec<RenderSettings>,
    canvas: Canvas,
    /// Whether the canvas still has to take that image, or another size.
    stale: bool,
    /// When the current frame was handed over for presentation.
    composed: Duration,
    /// The recorded events, if recording.
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
            has_moved: false,
            pacing: Pacing::new(),
            animation: AnimationState::Resting,
            stepped: None,
            dropped: Vec::new(),
            anchor: None,
            bounds: None,
            visibility: Visibility::Shown,
            listed: Visibility::Hidden,
            subject: None,
            nodes: None,
            gallery: Gallery::default(),
            drawn_subject: None,
            shown: None,
            redrawn: None,
            images: Vec::new(),
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

    /// Starts recording events.
    pub(crate) fn record(&mut self) {
        self.recorded = Some(Interaction::default());
    }

    /// The events since [`record`](Self::record).
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

    /// Another thread requested a pass of the interface.
    pub(crate) fn interface_requested_redraw(&mut self, now: Duration) {
        self.pacing.changed(Change::Overlay, now);
    }

    /// All events that arrived together have been handled.
    pub(crate) fn settle(&mut self, now: Duration) {
        // What moves shows in the next image, which begins after that.
        if !self.pacing.expects_draft(now) {
            self.offer_moves(now);
        }
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

    /// Brings the canvas up to date; `None` if nothing on it has changed, or if there is nothing to
    /// draw on. `clock` returns the time, for measuring the frame.
    pub(crate) fn draw(&mut self, now: Duration, clock: &dyn Fn() -> Duration) -> Option<&Canvas> {
        if self.is_hidden() {
            return None;
        }
        if self.pacing.can_step() {
            self.step(now);
        }
        let (frames, has_preview) = (self.frames(), || self.stage.preview_settings().is_some());
        if let Some(quality) = self.pacing.begin(now, frames, has_preview) {
            self.begin_image(quality);
            self.collect(now);
        }
        self.composed = clock();
        // Not before the next image is started, which does not have to wait for it.
        self.show_image();
        self.pacing.composed();
        self.run_interface(now);
        self.canvas.paint(&mut self.interface.painter).then_some(&self.canvas)
    }

    /// When the image of the last frame was ready, by the clock that the frame was given.
    #[cfg(any(test, feature = "kittest"))]
    pub(crate) fn composed_at(&self) -> Duration {
        self.composed
    }

    /// Whether the image on screen is the one that the settings define.
    #[cfg(any(test, feature = "kittest"))]
    pub(crate) fn shows_full(&self) -> bool {
        self.pacing.shows_full()
    }

    /// The size of the image that the canvas has still to take, if any.
    #[cfg(any(test, feature = "kittest"))]
    pub(crate) fn new_image(&self) -> Option<[u32; 2]> {
        self.shown.as_ref().filter(|_| self.stale).map(|frame| [frame.width, frame.height])
    }

    /// The last drawn canvas; empty before.
    pub(crate) fn canvas(&self) -> &Canvas {
        &self.canvas
    }

    /// The frame was presented.
    pub(crate) fn presented(&mut self, now: Duration) {
        let present = now.saturating_sub(self.composed);
        self.stage.set_report(FrameReport { present, ..self.stage.report() });
    }

    /// An event has happened.
    pub(crate) fn event(&mut self, event: InputEvent, now: Duration) {
        if let Some(recorded) = &mut self.recorded {
            recorded.record(event.clone(), now);
        }
        if !event.is_movement() {
            self.offer_moves(now);
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
            InputEvent::Hidden => self.visibility = Visibility::Hidden,
            InputEvent::Shown => {
                self.visibility = Visibility::Shown;
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
        width == 0 || height == 0 || self.visibility == Visibility::Hidden
    }

    fn frames(&self) -> AnimationFrames {
        if self.animation == AnimationState::Running || !self.held.is_empty() {
            AnimationFrames::Wanted
        } else {
            AnimationFrames::None
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
        // The first size is not a movement.
        let change = if self.shown.is_some() { Change::Moving } else { Change::Settled };
        self.pacing.changed(change, now);
        self.stale = true;
    }

    /// The interface may show the effect of any event, and the image is redrawn if its content has
    /// changed.
    fn note(&mut self, now: Duration) {
        self.follow_list();
        let changed = self.subject.as_ref() != Some(&self.stage.subject());
        self.pacing.changed(if changed { Change::Settled } else { Change::Overlay }, now);
        if changed {
            self.anchor = None;
        }
        self.plan(now);
    }

    /// Handles what any call of the handler may have changed.
    fn after_handler(&mut self, now: Duration) {
        self.note(now);
        self.images.append(&mut self.stage.wishes().images);
        self.begin_requested(now);
        if std::mem::take(&mut self.stage.wishes().animate) {
            self.animation = AnimationState::Running;
        }
    }

    /// Advances the animation and held keys.
    fn step(&mut self, now: Duration) {
        if self.frames() == AnimationFrames::None {
            self.stepped = None;
            return;
        }
        let delta = self.stepped.map_or(FIRST_STEP, |last| now.saturating_sub(last));
        self.stepped = Some(now);
        self.move_held(now);
        if self.animation == AnimationState::Running {
            self.animation = self.handler.frame(&mut self.stage, Tick { time: now, delta });
            self.after_handler(now);
        }
        self.pacing.changed(Change::Settled, now);
    }

    /// Runs a pass of the interface.
    fn run_interface(&mut self, now: Duration) {
        self.stage.set_moving(self.pacing.is_moving(now, self.frames()));
        self.stage.set_resting(self.pacing.is_resting(now, self.frames()));
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
        // A widget may have changed what is shown, and asked for images.
        if before != self.stage.subject() || !self.stage.wishes().images.is_empty() {
            self.after_handler(now);
        }
        if std::mem::take(&mut self.stage.wishes().animate) {
            self.animation = AnimationState::Running;
        }
        self.follow_list();
        self.plan(now);
    }

    /// The list of keys has the keyboard from the moment it opens, or the letters of a name would be keys; and no longer
    /// once it is closed.
    fn follow_list(&mut self) {
        let before = std::mem::replace(&mut self.listed, self.stage.cheat_sheet);
        match (before, self.listed) {
            (Visibility::Hidden, Visibility::Shown) => self.interface.search_keys(),
            (Visibility::Shown, Visibility::Hidden) => self.interface.end_search(),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests;
