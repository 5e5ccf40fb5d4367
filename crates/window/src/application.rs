//! `Application`: add objects and run it.

use winit::error::EventLoopError;
use winit::event_loop::EventLoop;

use crate::handler::{AnimationState, Closures, Handler, Tick};
use crate::shell::{Shell, UserEvent};
use crate::{Interaction, Stage, WindowError};

/// What to do with a recording.
type Recorded<'a> = Box<dyn FnOnce(Interaction) + 'a>;

/// A window that shows a scene. Mouse and keys move the camera and the selected object (H lists
/// them), the image is redrawn when something changes, and the program only has to provide the
/// scene.
///
/// ```no_run
/// use trigon_mesh::primitives;
/// use trigon_scene::Material;
/// use trigon_window::Application;
///
/// # fn main() -> Result<(), trigon_window::WindowError> {
/// let mut application = Application::new("A cube");
/// application.stage.scene.add_object("cube", primitives::cube(1.0), Material::default());
/// application.run()
/// # }
/// ```
pub struct Application<'a> {
    /// What the window shows.
    pub stage: Stage,
    closures: Closures<'a>,
    recorded: Option<Recorded<'a>>,
    played: Interaction,
}

impl<'a> Application<'a> {
    /// A window with an empty scene.
    #[must_use]
    pub fn new(title: impl Into<String>) -> Self {
        Self {
            stage: Stage::new(title),
            closures: Closures::default(),
            recorded: None,
            played: Interaction::default(),
        }
    }

    /// Calls this before each frame, at about 60 frames a second, for as long as it returns
    /// [`AnimationState::Running`]. It may add, remove, move and rotate anything in the scene.
    pub fn animate(&mut self, frame: impl FnMut(&mut Stage, Tick) -> AnimationState + 'a) {
        self.closures.frame = Some(Box::new(frame));
    }

    /// Adds panels and windows over the image, with [`egui`](crate::egui). Called whenever they may
    /// have changed. Its changes to the stage are drawn.
    pub fn interface(&mut self, interface: impl FnMut(&mut Stage, &mut egui::Ui) + 'a) {
        self.closures.interface = Some(Box::new(interface));
    }

    /// Passes a recording of the window's input to `done` when the window is closed.
    pub fn record(&mut self, done: impl FnOnce(Interaction) + 'a) {
        self.recorded = Some(Box::new(done));
    }

    /// Replays a recording when the window is open; mouse and keyboard are ignored until it ends.
    /// To get the same images, the window must have the same size.
    pub fn play(&mut self, interaction: Interaction) {
        self.played = interaction;
    }

    /// Opens the window and returns when it is closed.
    ///
    /// # Errors
    /// [`WindowError::NoDisplay`] if no window can be opened, [`WindowError::SecondRun`] if this
    /// process had a window before, and errors of the window system.
    ///
    /// # Panics
    /// On macOS, from any thread but the main one.
    pub fn run(mut self) -> Result<(), WindowError> {
        let mut closures = std::mem::take(&mut self.closures);
        self.run_with(&mut closures)
    }

    /// Opens the window for an application that needs more than closures, and returns when it is
    /// closed. The closures given to this application are not used.
    ///
    /// # Errors
    /// As [`Application::run`].
    ///
    /// # Panics
    /// On macOS, from any thread but the main one.
    pub fn run_with(self, handler: &mut dyn Handler) -> Result<(), WindowError> {
        let event_loop = event_loop()?;
        let mut shell = Shell::new(self.stage, handler, &event_loop.create_proxy());
        shell.play(self.played);
        if self.recorded.is_some() {
            shell.record();
        }
        let ended = event_loop.run_app(&mut shell);
        if let (Some(done), Some(recorded)) = (self.recorded, shell.take_recorded()) {
            done(recorded);
        }
        shell.into_result()?;
        ended.map_err(|error| WindowError::Disconnected { reason: error.to_string() })
    }
}

fn event_loop() -> Result<EventLoop<UserEvent>, WindowError> {
    let mut builder = EventLoop::with_user_event();
    allow_any_thread(&mut builder);
    builder.build().map_err(|error| match error {
        EventLoopError::RecreationAttempt => WindowError::SecondRun,
        other => WindowError::NoDisplay { reason: other.to_string() },
    })
}

/// On systems other than macOS a window may belong to any thread; winit would panic without this.
#[cfg(target_os = "linux")]
fn allow_any_thread(builder: &mut winit::event_loop::EventLoopBuilder<UserEvent>) {
    use winit::platform::{wayland, x11};
    wayland::EventLoopBuilderExtWayland::with_any_thread(builder, true);
    x11::EventLoopBuilderExtX11::with_any_thread(builder, true);
}

/// On systems other than macOS a window may belong to any thread; winit would panic without this.
#[cfg(target_os = "windows")]
fn allow_any_thread(builder: &mut winit::event_loop::EventLoopBuilder<UserEvent>) {
    winit::platform::windows::EventLoopBuilderExtWindows::with_any_thread(builder, true);
}

#[cfg(not(any(target_os = "linux", target_os = "windows")))]
fn allow_any_thread(_: &mut winit::event_loop::EventLoopBuilder<UserEvent>) {}
