//! The window itself: winit's event loop around a [`Session`], which decides
//! everything. Events go in, pictures come out, and between them the loop
//! sleeps for as long as the session says.

use std::sync::Arc;
use std::time::{Duration, Instant};

use winit::application::ApplicationHandler;
use winit::dpi::LogicalSize;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, ControlFlow};
use winit::window::{Window, WindowId};

use crate::input::{InputEvent, translate::translate};
use crate::pacing::Wake;
use crate::present::Presenter;
use crate::session::Session;
use crate::{Handler, Stage, WindowError};

/// A window that is open. The presenter goes first when it closes.
struct Open {
    presenter: Presenter,
    window: Arc<Window>,
    title: String,
    /// When it was last asked.
    minimised: bool,
}

/// An application between its start and its end.
pub(crate) struct Shell<'a> {
    session: Session<'a>,
    open: Option<Open>,
    started: Instant,
    error: Option<WindowError>,
}

impl<'a> Shell<'a> {
    pub(crate) fn new(stage: Stage, handler: &'a mut dyn Handler) -> Self {
        Self { session: Session::new(stage, handler), open: None, started: Instant::now(), error: None }
    }

    /// What went wrong, if anything.
    pub(crate) fn into_result(self) -> Result<(), WindowError> {
        self.error.map_or(Ok(()), Err)
    }

    fn now(&self) -> Duration {
        self.started.elapsed()
    }

    fn open(&mut self, event_loop: &ActiveEventLoop) -> Result<(), WindowError> {
        let stage = self.session.stage();
        let (title, size) = (stage.title().to_owned(), stage.viewport());
        let attributes = Window::default_attributes()
            .with_title(&title)
            .with_inner_size(LogicalSize::new(size.width.max(1), size.height.max(1)));
        let refused = |error: winit::error::OsError| WindowError::Window { reason: error.to_string() };
        let window = Arc::new(event_loop.create_window(attributes).map_err(refused)?);
        let presenter = Presenter::new(event_loop, &window)?;
        let now = self.now();
        self.session.event(InputEvent::Scaled(window.scale_factor()), now);
        let size = window.inner_size();
        self.session.event(InputEvent::Resized { width: size.width, height: size.height }, now);
        self.session.start(now);
        self.open = Some(Open { presenter, window, title, minimised: false });
        Ok(())
    }

    /// Draws and shows a frame.
    fn draw(&mut self) -> Result<(), WindowError> {
        let now = self.now();
        let Some(open) = &mut self.open else { return Ok(()) };
        // Not every system tells of a window that is minimised, but each asks
        // for a frame when it is seen again.
        let minimised = open.window.is_minimized() == Some(true);
        if minimised != std::mem::replace(&mut open.minimised, minimised) {
            let event = if minimised { InputEvent::Hidden } else { InputEvent::Shown };
            self.session.event(event, now);
        }
        let Some(canvas) = self.session.draw(now, &|| self.started.elapsed()) else { return Ok(()) };
        open.presenter.present(&open.window, canvas)?;
        self.session.presented(self.started.elapsed());
        Ok(())
    }

    /// What a size or scale means for the surface.
    fn fit_surface(&mut self) -> Result<(), WindowError> {
        let Some(open) = &mut self.open else { return Ok(()) };
        let size = open.window.inner_size();
        open.presenter.resize(size.width, size.height)?;
        let now = self.started.elapsed();
        self.session.event(InputEvent::Resized { width: size.width, height: size.height }, now);
        Ok(())
    }

    fn fail(&mut self, event_loop: &ActiveEventLoop, result: Result<(), WindowError>) {
        if let Err(error) = result {
            self.error = Some(error);
            event_loop.exit();
        }
    }
}

impl ApplicationHandler<()> for Shell<'_> {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.open.is_none() {
            let result = self.open(event_loop);
            self.fail(event_loop, result);
        }
    }

    fn suspended(&mut self, _: &ActiveEventLoop) {
        self.open = None;
    }

    fn user_event(&mut self, _: &ActiveEventLoop, (): ()) {
        let now = self.now();
        self.session.woken(now);
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let now = self.now();
        if let Some(event) = translate(&event, self.session.stage().scale()) {
            self.session.event(event, now);
        }
        let result = match event {
            WindowEvent::RedrawRequested => self.draw(),
            // Not every system follows a new scale by a new size.
            WindowEvent::Resized(_) | WindowEvent::ScaleFactorChanged { .. } => self.fit_surface(),
            _ => Ok(()),
        };
        self.fail(event_loop, result);
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        let now = self.now();
        self.session.settle(now);
        if self.session.is_over() {
            event_loop.exit();
            return;
        }
        let Some(open) = &mut self.open else {
            event_loop.set_control_flow(ControlFlow::Wait);
            return;
        };
        let title = self.session.stage().title();
        if open.title != title {
            open.window.set_title(title);
            open.title = title.to_owned();
        }
        event_loop.set_control_flow(match self.session.next(now) {
            Wake::Now => {
                open.window.request_redraw();
                ControlFlow::Wait
            }
            Wake::At(time) => ControlFlow::WaitUntil(self.started + time),
            Wake::Never => ControlFlow::Wait,
        });
    }
}
