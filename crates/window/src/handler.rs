//! The callbacks of an application. Every method has a default that does nothing.

use std::path::PathBuf;
use std::time::Duration;

use trigon_math::DVec2;
use trigon_scene::Frame;

use crate::Stage;
use crate::input::{Hands, Input, Modifiers, Taken};

/// The time of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tick {
    /// Since the window opened.
    pub time: Duration,
    /// Since the last frame of the animation; a sixtieth of a second for its
    /// first one.
    pub delta: Duration,
}

/// Whether more frames are wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AnimationState {
    /// Go on, at about 60 frames a second.
    Running,
    /// Nothing is moving any more. [`Stage::animate`] starts it again.
    Resting,
}

/// The application's callbacks. All methods are called on the window's thread, and may change
/// anything on the stage, which is redrawn after each of them.
pub trait Handler {
    /// The window has opened. [`Stage::reset_view`] follows, so objects added to the scene here are
    /// in view.
    fn start(&mut self, stage: &mut Stage) {
        let _ = stage;
    }

    /// A frame is about to be drawn. Called once at the beginning, and then as long as it returns
    /// [`AnimationState::Running`].
    fn frame(&mut self, stage: &mut Stage, tick: Tick) -> AnimationState {
        let _ = (stage, tick);
        AnimationState::Resting
    }

    /// Input that no widget took: the application may take it before the camera, the keymap and clicks do.
    /// While [`Stage::input_owner`] is the application, widgets do not get it first.
    fn input(&mut self, stage: &mut Stage, input: &Input, hands: Hands) -> Taken {
        let _ = (stage, input, hands);
        Taken::No
    }

    /// The window moved its pointer to the other side, as [`Stage::wraps_pointer`] requests; in physical
    /// pixels. This does not count as a movement.
    fn pointer_jumped(&mut self, stage: &mut Stage, to: DVec2) {
        let _ = (stage, to);
    }

    /// A key was pressed that is bound to [`crate::Action::Command`] under this name.
    fn command(&mut self, stage: &mut Stage, name: &str) {
        let _ = (stage, name);
    }

    /// Adds the application's own panels and windows over the image. Called whenever the interface
    /// may have changed, more than once if the layout needs it. Where there is no widget, mouse and
    /// keys go to camera and objects.
    fn interface(&mut self, stage: &mut Stage, ui: &mut egui::Ui) {
        let _ = (stage, ui);
    }

    /// Files or folders were dropped onto the window, all of one drop together.
    fn dropped(&mut self, stage: &mut Stage, paths: Vec<PathBuf>, modifiers: Modifiers) {
        let _ = (stage, paths, modifiers);
    }

    /// The user wants to close the window: it closes unless this prevents it.
    fn close_requested(&mut self, stage: &mut Stage) {
        stage.exit();
    }

    /// The image that [`Stage::request_image`] requested.
    fn image(&mut self, stage: &mut Stage, frame: Frame) {
        let _ = (stage, frame);
    }

    /// [`crate::Waker::wake`] was called, once or more often.
    fn woken(&mut self, stage: &mut Stage) {
        let _ = stage;
    }
}

/// The frame callback.
type FrameCallback<'a> = Box<dyn FnMut(&mut Stage, Tick) -> AnimationState + 'a>;

/// The interface callback.
type InterfaceCallback<'a> = Box<dyn FnMut(&mut Stage, &mut egui::Ui) + 'a>;

/// An application of at most two closures.
#[derive(Default)]
pub(crate) struct Closures<'a> {
    pub(crate) frame: Option<FrameCallback<'a>>,
    pub(crate) interface: Option<InterfaceCallback<'a>>,
}

impl Handler for Closures<'_> {
    fn frame(&mut self, stage: &mut Stage, tick: Tick) -> AnimationState {
        self.frame.as_mut().map_or(AnimationState::Resting, |frame| frame(stage, tick))
    }

    fn interface(&mut self, stage: &mut Stage, ui: &mut egui::Ui) {
        if let Some(interface) = &mut self.interface {
            interface(stage, ui);
        }
    }
}
