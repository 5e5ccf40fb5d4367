//! The ready application: add objects, run.

use winit::error::EventLoopError;
use winit::event_loop::EventLoop;

use crate::handler::{Animated, Animation, Handler, Tick};
use crate::shell::Shell;
use crate::{Stage, WindowError};

/// A closure that is called for each frame.
type Animate<'a> = Box<dyn FnMut(&mut Stage, Tick) -> Animation + 'a>;

/// A window on a scene. Mouse and keys turn the camera and the selected object
/// (H shows which), the picture is drawn when something has changed, and the
/// program only has to say what is in the scene.
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
    animate: Option<Animate<'a>>,
}

impl<'a> Application<'a> {
    /// A window with an empty scene.
    #[must_use]
    pub fn new(title: impl Into<String>) -> Self {
        Self { stage: Stage::new(title), animate: None }
    }

    /// Calls this before each frame, at about 60 frames a second, for as long
    /// as it answers [`Animation::Running`]. It may add, remove, move and turn
    /// whatever is in the scene.
    pub fn animate(&mut self, frame: impl FnMut(&mut Stage, Tick) -> Animation + 'a) {
        self.animate = Some(Box::new(frame));
    }

    /// Opens the window and returns when it is closed.
    ///
    /// # Errors
    /// [`WindowError::NoDisplay`] where no window can be opened,
    /// [`WindowError::SecondRun`] if this process had a window before, and what
    /// the window system may refuse.
    ///
    /// # Panics
    /// On macOS, from any thread but the main one.
    pub fn run(mut self) -> Result<(), WindowError> {
        match self.animate.take() {
            Some(frame) => self.run_with(&mut Animated(frame)),
            None => self.run_with(&mut NoHandler),
        }
    }

    /// Opens the window for an application that does more than animate, and
    /// returns when it is closed. A closure given to [`Application::animate`]
    /// is not used.
    ///
    /// # Errors
    /// As [`Application::run`].
    ///
    /// # Panics
    /// On macOS, from any thread but the main one.
    pub fn run_with(self, handler: &mut dyn Handler) -> Result<(), WindowError> {
        let event_loop = event_loop()?;
        let proxy = event_loop.create_proxy();
        self.stage.waker().connect(move || {
            // Fails when the window is closed: then there is nobody to wake.
            let _ = proxy.send_event(());
        });
        let mut shell = Shell::new(self.stage, handler);
        let ended = event_loop.run_app(&mut shell);
        shell.into_result()?;
        ended.map_err(|error| WindowError::Disconnected { reason: error.to_string() })
    }
}

/// Nothing but the window's own keys.
struct NoHandler;

impl Handler for NoHandler {}

fn event_loop() -> Result<EventLoop<()>, WindowError> {
    let mut builder = EventLoop::with_user_event();
    allow_any_thread(&mut builder);
    builder.build().map_err(|error| match error {
        EventLoopError::RecreationAttempt => WindowError::SecondRun,
        other => WindowError::NoDisplay { reason: other.to_string() },
    })
}

/// Elsewhere than on macOS a window may belong to any thread; winit would
/// panic without this.
#[cfg(target_os = "linux")]
fn allow_any_thread(builder: &mut winit::event_loop::EventLoopBuilder<()>) {
    use winit::platform::{wayland, x11};
    wayland::EventLoopBuilderExtWayland::with_any_thread(builder, true);
    x11::EventLoopBuilderExtX11::with_any_thread(builder, true);
}

/// Elsewhere than on macOS a window may belong to any thread; winit would
/// panic without this.
#[cfg(target_os = "windows")]
fn allow_any_thread(builder: &mut winit::event_loop::EventLoopBuilder<()>) {
    winit::platform::windows::EventLoopBuilderExtWindows::with_any_thread(builder, true);
}

#[cfg(not(any(target_os = "linux", target_os = "windows")))]
fn allow_any_thread(_: &mut winit::event_loop::EventLoopBuilder<()>) {}
