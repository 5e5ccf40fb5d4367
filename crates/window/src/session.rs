//! What happens between an event and a picture, without any window: events and
//! moments go in, pictures and "wake me then" come out. So all of it can be
//! tested without a display.

use std::path::PathBuf;
use std::time::Duration;

use trigon_camera::Viewport;
use trigon_math::{Bounds3, DVec2, DVec3};

use crate::canvas::Canvas;
use crate::commands;
use crate::compose::compose;
use crate::handler::{Animation, Handler, Tick};
use crate::input::{
    Chord, Gesture, HeldKeys, InputEvent, KeyCode, KeyPress, Modifiers, Pointer, PointerButton,
};
use crate::keymap::{Action, DragAction};
use crate::motion;
use crate::pacing::{Change, Frames, Pacing, Quality, Wake, Work};
use crate::stage::{FrameReport, Stage, Visibility};

/// The step of an animation's first frame, and of a key's first moment.
const FIRST_STEP: Duration = Duration::from_micros(16_667);

/// A held key moves by no more than this much time at once, whatever a frame took.
const LONGEST_STEP: Duration = Duration::from_millis(100);

/// A window's life.
pub(crate) struct Session<'a> {
    stage: Stage,
    handler: &'a mut dyn Handler,
    modifiers: Modifiers,
    pointer: Pointer,
    held: HeldKeys,
    pacing: Pacing,
    animation: Animation,
    /// When frames were last stepped; `None` while nothing moves by itself.
    stepped: Option<Duration>,
    dropped: Vec<PathBuf>,
    /// What zooming to the pointer keeps in place, for as long as that rests.
    anchor: Option<(DVec2, Option<DVec3>)>,
    /// Of the scene; `None` if it may have changed.
    bounds: Option<Bounds3>,
    seen: Visibility,
    canvas: Canvas,
    /// The last rendering, under the overlay.
    frame: Option<trigon_scene::Frame>,
    /// When the current frame was handed over to be presented.
    composed: Duration,
}

impl<'a> Session<'a> {
    pub(crate) fn new(stage: Stage, handler: &'a mut dyn Handler) -> Self {
        Self {
            stage,
            handler,
            modifiers: Modifiers::NONE,
            pointer: Pointer::default(),
            held: HeldKeys::default(),
            pacing: Pacing::new(),
            animation: Animation::Resting,
            stepped: None,
            dropped: Vec::new(),
            anchor: None,
            bounds: None,
            seen: Visibility::Shown,
            canvas: Canvas::default(),
            frame: None,
            composed: Duration::ZERO,
        }
    }

    pub(crate) fn stage(&self) -> &Stage {
        &self.stage
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

    /// All events that came together have been handled.
    pub(crate) fn settle(&mut self, now: Duration) {
        if !self.dropped.is_empty() {
            let paths = std::mem::take(&mut self.dropped);
            self.handler.dropped(&mut self.stage, paths, self.modifiers);
            self.after_handler(now);
        }
    }

    /// When to draw next.
    pub(crate) fn next(&self, now: Duration) -> Wake {
        if self.is_hidden() {
            return Wake::Never;
        }
        self.pacing.next(now, self.frames(), self.stage.overlay.next_expiry())
    }

    /// Draws a frame; `None` while there is nothing to draw on. `clock` tells
    /// the time, to measure what the frame takes.
    pub(crate) fn draw(&mut self, now: Duration, clock: &dyn Fn() -> Duration) -> Option<&Canvas> {
        if self.is_hidden() {
            return None;
        }
        self.step(now);
        let begun = clock();
        if let Work::Render(quality) = self.pacing.begin(now, self.frames()) {
            self.render(quality);
            let took = clock().saturating_sub(begun);
            self.pacing.took(quality, took);
            self.stage.set_report(FrameReport { render: took, ..self.stage.report() });
        }
        self.composed = clock();
        let Viewport { width, height } = self.stage.viewport();
        self.canvas.show(self.frame.as_ref()?, width, height);
        compose(&mut self.canvas, &mut self.stage, now);
        Some(&self.canvas)
    }

    /// The frame is in the window.
    pub(crate) fn presented(&mut self, now: Duration) {
        let present = now.saturating_sub(self.composed);
        self.stage.set_report(FrameReport { present, ..self.stage.report() });
    }

    /// Something has happened.
    pub(crate) fn event(&mut self, event: InputEvent, now: Duration) {
        match event {
            InputEvent::PointerMoved(to) => {
                let gesture = self.pointer.moved(to, self.stage.scale());
                self.gesture(gesture, now);
            }
            InputEvent::Button(button, press) => {
                let gesture = self.pointer.button(button, press, self.modifiers);
                self.gesture(gesture, now);
            }
            InputEvent::Wheel(lines) => self.wheel(lines, now),
            InputEvent::Pinch(power) => {
                motion::zoom(&mut self.stage, power, None);
                self.pacing.changed(Change::Moving, now);
            }
            InputEvent::KeyDown(key) => self.key(key, now),
            InputEvent::KeyUp(code) => self.released(code, now),
            InputEvent::Modifiers(modifiers) => self.modifiers = modifiers,
            InputEvent::FocusLost => {
                self.held.clear();
                self.pointer.cancel();
                self.modifiers = Modifiers::NONE;
            }
            InputEvent::FileDropped(path) => self.dropped.push(path),
            InputEvent::Resized { width, height } => self.resized(Viewport { width, height }, now),
            InputEvent::Scaled(scale) => {
                self.stage.rescale(scale);
                self.pacing.changed(Change::Settled, now);
            }
            InputEvent::Hidden => self.seen = Visibility::Hidden,
            InputEvent::Shown => {
                self.seen = Visibility::Shown;
                self.pacing.changed(Change::Overlay, now);
            }
            InputEvent::CloseRequested => self.stage.exit(),
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

    fn resized(&mut self, viewport: Viewport, now: Duration) {
        if viewport == self.stage.viewport() {
            return;
        }
        self.stage.resize(viewport);
        // The first size is no movement: the first picture is a full one.
        let change = if self.frame.is_some() { Change::Moving } else { Change::Settled };
        self.pacing.changed(change, now);
    }

    /// What every call of the handler may have changed.
    fn after_handler(&mut self, now: Duration) {
        self.bounds = None;
        self.anchor = None;
        self.pacing.changed(Change::Settled, now);
        for settings in std::mem::take(&mut self.stage.wishes().pictures) {
            match self.stage.render_picture(&settings) {
                Ok(frame) => self.handler.picture(&mut self.stage, frame),
                Err(error) => self.stage.overlay.notify(error.to_string()),
            }
        }
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
        let seconds = delta.min(LONGEST_STEP).as_secs_f64();
        for motion in self.held.motions() {
            motion::hold(&mut self.stage, motion, seconds);
            self.bounds = None;
        }
        if self.animation == Animation::Running {
            self.animation = self.handler.frame(&mut self.stage, Tick { time: now, delta });
            self.after_handler(now);
        }
        self.pacing.changed(Change::Settled, now);
    }

    fn render(&mut self, quality: Quality) {
        let bounds = *self.bounds.get_or_insert_with(|| self.stage.scene.bounds());
        let camera = self.stage.orbit.camera(&bounds);
        match self.stage.render(&camera, quality) {
            Ok(frame) => self.frame = Some(frame),
            Err(error) => self.stage.overlay.notify(error.to_string()),
        }
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
        match button {
            PointerButton::Left => {
                self.stage.selection = self.stage.pick(at).map(|(hit, _)| hit.node);
                commands::announce_selection(&mut self.stage);
                self.pacing.changed(Change::Overlay, now);
            }
            PointerButton::Middle => {
                let Some((_, point)) = self.stage.pick(at) else { return };
                if modifiers.contains(Modifiers::SHIFT) {
                    // As near as the point was, not as the old target was.
                    let depth = -self.stage.camera().to_camera(point).z;
                    self.stage.orbit.set_distance(depth);
                }
                self.stage.orbit.set_target(point);
                self.pacing.changed(Change::Settled, now);
            }
            PointerButton::Right => {}
        }
    }

    fn wheel(&mut self, lines: f64, now: Duration) {
        let to_pointer = self.modifiers.contains(Modifiers::CTRL);
        let pointer = self.pointer.position().filter(|_| to_pointer);
        let anchor = pointer.and_then(|at| self.anchor_at(at));
        motion::wheel(&mut self.stage, lines, anchor);
        self.pacing.changed(Change::Moving, now);
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
            let projector = trigon_camera::Projector::new(&self.stage.camera(), self.stage.viewport());
            projector.at_distance(at, self.stage.orbit.distance())
        });
        self.anchor = Some((at, anchor));
        anchor
    }

    fn key(&mut self, key: KeyPress, now: Duration) {
        let chords = [key.logical, key.physical].into_iter().flatten();
        let found = chords
            .map(|key| Chord::new(self.modifiers, key))
            .find_map(|chord| self.stage.keymap.find(chord))
            .cloned();
        let Some(binding) = found else { return };
        match binding.action {
            Action::Hold(motion) => {
                self.held.press(key.code, motion);
                self.pacing.changed(Change::Moving, now);
            }
            Action::Command => {
                self.handler.command(&mut self.stage, &binding.name);
                self.after_handler(now);
            }
            other => {
                commands::act(&mut self.stage, other);
                self.anchor = None;
                self.pacing.changed(commands::change_of(other), now);
            }
        }
    }

    fn released(&mut self, code: KeyCode, now: Duration) {
        if self.held.is_empty() {
            return;
        }
        self.held.release(code);
        self.pacing.changed(Change::Moving, now);
    }
}

#[cfg(test)]
mod tests;
