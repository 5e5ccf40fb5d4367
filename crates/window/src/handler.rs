//! What an application adds to a window: everything here has a default that
//! does nothing.

use std::path::PathBuf;
use std::time::Duration;

use trigon_math::DVec2;
use trigon_scene::Frame;

use crate::Stage;
use crate::input::{Hands, Input, Modifiers, Taken};

/// The moment of a frame.
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
pub enum Animation {
    /// Go on, at about 60 frames a second.
    Running,
    /// Nothing moves by itself any more. [`Stage::animate`] starts it again.
    Resting,
}

/// The application's part. All methods are called on the window's thread, and
/// may change whatever is on the stage: it is drawn again after each of them.
pub trait Handler {
    /// The window has opened. [`Stage::reset_view`] follows, so what is added to
    /// the scene here is in the picture.
    fn start(&mut self, stage: &mut Stage) {
        let _ = stage;
    }

    /// A frame is about to be drawn. Called once in the beginning, and then for
    /// as long as the answer is [`Animation::Running`].
    fn frame(&mut self, stage: &mut Stage, tick: Tick) -> Animation {
        let _ = (stage, tick);
        Animation::Resting
    }

    /// Something was done by hand that no widget took: the application may take it before the
    /// camera, the keymap and clicks do. While [`Stage::input_owner`] is the application, widgets are
    /// not asked before.
    fn input(&mut self, stage: &mut Stage, input: &Input, hands: Hands) -> Taken {
        let _ = (stage, input, hands);
        Taken::No
    }

    /// The window put its pointer to the other side, as [`Stage::wraps_pointer`] asks for: in physical pixels. That
    /// was no movement.
    fn pointer_jumped(&mut self, stage: &mut Stage, to: DVec2) {
        let _ = (stage, to);
    }

    /// A key was pressed that is bound to [`crate::Action::Command`] under this name.
    fn command(&mut self, stage: &mut Stage, name: &str) {
        let _ = (stage, name);
    }

    /// Adds panels and windows of the application's own; the picture lies behind them.
    /// Called whenever the interface may have changed, more than once where it has to
    /// be laid out again. Where no widget is, mouse and keys go to camera and objects.
    fn interface(&mut self, stage: &mut Stage, ui: &mut egui::Ui) {
        let _ = (stage, ui);
    }

    /// Files or folders were dropped onto the window, all of one drop together.
    fn dropped(&mut self, stage: &mut Stage, paths: Vec<PathBuf>, modifiers: Modifiers) {
        let _ = (stage, paths, modifiers);
    }

    /// Somebody wants to close the window: unless this says otherwise, it is closed.
    fn close_requested(&mut self, stage: &mut Stage) {
        stage.exit();
    }

    /// A picture that [`Stage::request_picture`] asked for.
    fn picture(&mut self, stage: &mut Stage, frame: Frame) {
        let _ = (stage, frame);
    }

    /// [`crate::Waker::wake`] was called, once or more often.
    fn woken(&mut self, stage: &mut Stage) {
        let _ = stage;
    }
}

/// What is called for each frame.
type Frames<'a> = Box<dyn FnMut(&mut Stage, Tick) -> Animation + 'a>;

/// What adds widgets.
type Interface<'a> = Box<dyn FnMut(&mut Stage, &mut egui::Ui) + 'a>;

/// An application of at most two closures.
#[derive(Default)]
pub(crate) struct Closures<'a> {
    pub(crate) frame: Option<Frames<'a>>,
    pub(crate) interface: Option<Interface<'a>>,
}

impl Handler for Closures<'_> {
    fn frame(&mut self, stage: &mut Stage, tick: Tick) -> Animation {
        self.frame.as_mut().map_or(Animation::Resting, |frame| frame(stage, tick))
    }

    fn interface(&mut self, stage: &mut Stage, ui: &mut egui::Ui) {
        if let Some(interface) = &mut self.interface {
            interface(stage, ui);
        }
    }
}
