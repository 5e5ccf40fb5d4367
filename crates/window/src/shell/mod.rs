//! The window: winit's event loop around a [`Session`], which makes all decisions. The loop passes events in,
//! shows the images that come out, and sleeps as long as the session says.

#[cfg(feature = "accesskit")]
mod accessibility;
mod size;

use std::sync::Arc;
use std::time::{Duration, Instant};

use winit::application::ApplicationHandler;
use winit::dpi::{PhysicalPosition, PhysicalSize};
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoopProxy};
use winit::window::{CursorGrabMode, Fullscreen, Window, WindowId};

use crate::egui_painter::MAX_TEXTURE_SIDE;
use crate::input::{InputEvent, translate::translate};
use crate::interaction::Interaction;
use crate::pacing::Wake;
use crate::present::Presenter;
use crate::session::Session;
use crate::worker::Worker;
use crate::{Handler, Stage, WindowError};

/// User events: they wake the loop from other threads.
#[derive(Clone, Debug)]
pub(crate) enum UserEvent {
    /// [`crate::Waker::wake`].
    Application,
    /// An image is finished.
    Image,
    /// The interface requests a pass.
    Interface,
    /// A screen reader requested an action.
    #[cfg(feature = "accesskit")]
    Accessibility(egui_winit::accesskit_winit::WindowEvent),
}

/// An open window. The presenter is dropped first when it closes.
struct Open {
    presenter: Presenter,
    /// Translates between the window system and egui.
    egui: egui_winit::State,
    window: Arc<Window>,
    title: String,
    /// When it was last queried.
    minimized: bool,
    /// Whether this program requested the next frame.
    is_redraw_requested: bool,
    /// Whether the pointer is confined to it.
    keeps_pointer: bool,
    full_screen: bool,
}

/// A running application.
pub(crate) struct Shell<'a> {
    session: Session<'a>,
    #[cfg(feature = "accesskit")]
    proxy: EventLoopProxy<UserEvent>,
    open: Option<Open>,
    started: Instant,
    error: Option<WindowError>,
    /// Input that is being replayed.
    played: Interaction,
}

impl<'a> Shell<'a> {
    pub(crate) fn new(stage: Stage, handler: &'a mut dyn Handler, proxy: &EventLoopProxy<UserEvent>) -> Self {
        // Sending fails if the window is closed: then there is nobody to wake.
        let ring = |ring: UserEvent| {
            let proxy = proxy.clone();
            move || {
                let _ = proxy.send_event(ring.clone());
            }
        };
        stage.waker().connect(ring(UserEvent::Application));
        let started = Instant::now();
        let worker = Worker::of_threads(ring(UserEvent::Image), move || started.elapsed());
        let mut session = Session::new(stage, handler, worker);
        session.interface().connect(ring(UserEvent::Interface));
        Self {
            session,
            #[cfg(feature = "accesskit")]
            proxy: proxy.clone(),
            open: None,
            started,
            error: None,
            played: Interaction::default(),
        }
    }

    /// Starts recording events.
    pub(crate) fn record(&mut self) {
        self.session.record();
    }

    /// The recorded events.
    pub(crate) fn take_recorded(&mut self) -> Option<Interaction> {
        self.session.take_recorded()
    }

    /// Replays input; mouse and keyboard are ignored meanwhile.
    pub(crate) fn play(&mut self, interaction: Interaction) {
        self.played = interaction;
    }

    /// The error, if any.
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
            // Screen readers must know of it before anybody sees it.
            .with_visible(cfg!(not(feature = "accesskit")))
            .with_inner_size(size::fitting(size, size::screen(event_loop)));
        let refused = |error: winit::error::OsError| WindowError::Window { reason: error.to_string() };
        let window = Arc::new(event_loop.create_window(attributes).map_err(refused)?);
        let presenter = Presenter::new(event_loop, &window)?;
        #[cfg_attr(not(feature = "accesskit"), expect(unused_mut, reason = "only screen readers are added"))]
        let mut egui = egui_winit::State::new(
            self.session.interface().context().clone(),
            egui::ViewportId::ROOT,
            event_loop,
            Some(window.scale_factor() as f32),
            window.theme(),
            Some(MAX_TEXTURE_SIDE),
        );
        #[cfg(feature = "accesskit")]
        {
            egui.init_accesskit(event_loop, &window, self.proxy.clone());
            window.set_visible(true);
        }
        let now = self.now();
        self.session.interface().follow(egui.egui_input().system_theme);
        self.session.event(InputEvent::Scaled(window.scale_factor()), now);
        let size = window.inner_size();
        self.session.event(InputEvent::Resized { width: size.width, height: size.height }, now);
        self.session.start(now);
        self.open = Some(Open {
            presenter,
            egui,
            window,
            title,
            minimized: false,
            is_redraw_requested: false,
            keeps_pointer: false,
            full_screen: false,
        });
        Ok(())
    }

    /// Draws and shows a frame.
    fn draw(&mut self) -> Result<(), WindowError> {
        let now = self.now();
        let Some(open) = &mut self.open else { return Ok(()) };
        // Not every system reports that a window is minimized, but each requests a frame when it is
        // visible again.
        let minimized = open.window.is_minimized() == Some(true);
        if minimized != std::mem::replace(&mut open.minimized, minimized) {
            let event = if minimized { InputEvent::Hidden } else { InputEvent::Shown };
            self.session.event(event, now);
        }
        // The window system requests a redraw if the window has lost its content.
        let lost = !std::mem::take(&mut open.is_redraw_requested);
        let changed = self.session.draw(now, &|| self.started.elapsed()).is_some();
        if lost {
            open.presenter.forget();
        }
        if changed || lost {
            open.presenter.present(&open.window, self.session.canvas())?;
            self.session.presented(self.started.elapsed());
        }
        open.egui.handle_platform_output(&open.window, self.session.interface().take_output());
        Ok(())
    }

    /// The effect of a size or scale on the surface.
    fn fit_surface(&mut self) -> Result<(), WindowError> {
        let Some(open) = &mut self.open else { return Ok(()) };
        let size = open.window.inner_size();
        open.presenter.resize(size.width, size.height)?;
        let now = self.started.elapsed();
        self.session.event(InputEvent::Resized { width: size.width, height: size.height }, now);
        Ok(())
    }

    /// Passes an event to the interface. A redraw request is not passed on: it would request the
    /// next one.
    fn tell_interface(&mut self, event: &WindowEvent) {
        let Some(open) = self.open.as_mut().filter(|_| !matches!(event, WindowEvent::RedrawRequested)) else {
            return;
        };
        let now = self.started.elapsed();
        // Its response refers to the last pass; the session queries the interface itself.
        let _ = open.egui.on_window_event(&open.window, event);
        if self.session.interface().follow(open.egui.egui_input().system_theme) {
            self.session.interface_requested_redraw(now);
        }
        let played = !self.played.is_empty();
        for event in open.egui.egui_input_mut().events.drain(..).filter(|_| !played) {
            self.session.event(InputEvent::Interface(event), now);
        }
    }

    /// Replays the input that is due. The window has its own scale and visibility; it is is_redraw_requested for
    /// the recorded size.
    fn step_play(&mut self, now: Duration) -> Result<(), WindowError> {
        // With its own time: what counts is how long a key was held, not when that was noticed.
        while let Some((moment, event)) = self.played.next(now) {
            match event {
                InputEvent::Resized { width, height } => self.ask_for_size(width, height)?,
                event if event.is_by_hand() => self.session.event(event, moment),
                _ => {}
            }
        }
        Ok(())
    }

    fn ask_for_size(&mut self, width: u32, height: u32) -> Result<(), WindowError> {
        let Some(open) = &self.open else { return Ok(()) };
        match open.window.request_inner_size(PhysicalSize::new(width, height)) {
            // It has this size already, and no event will report it, as under Wayland.
            Some(_) => self.fit_surface(),
            None => Ok(()),
        }
    }

    fn fail(&mut self, event_loop: &ActiveEventLoop, result: Result<(), WindowError>) {
        if let Err(error) = result {
            self.error = Some(error);
            event_loop.exit();
        }
    }
}

impl ApplicationHandler<UserEvent> for Shell<'_> {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.open.is_none() {
            let result = self.open(event_loop);
            self.fail(event_loop, result);
        }
    }

    fn suspended(&mut self, _: &ActiveEventLoop) {
        self.open = None;
    }

    fn user_event(&mut self, _: &ActiveEventLoop, ring: UserEvent) {
        let now = self.now();
        match ring {
            UserEvent::Application => self.session.woken(now),
            UserEvent::Image => self.session.collect(now),
            UserEvent::Interface => self.session.interface_requested_redraw(now),
            #[cfg(feature = "accesskit")]
            UserEvent::Accessibility(event) => self.accessibility(event),
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let now = self.now();
        self.tell_interface(&event);
        let ours = translate(&event, self.session.stage().scale());
        if let Some(event) = ours.filter(|event| self.played.is_empty() || !event.is_by_hand()) {
            self.session.event(event, now);
        }
        let result = match event {
            WindowEvent::RedrawRequested => self.draw(),
            // Not every system sends a new size after a new scale.
            WindowEvent::Resized(_) | WindowEvent::ScaleFactorChanged { .. } => self.fit_surface(),
            _ => Ok(()),
        };
        self.fail(event_loop, result);
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        let now = self.now();
        let played = self.step_play(now);
        self.fail(event_loop, played);
        self.session.settle(now);
        if self.session.is_over() {
            event_loop.exit();
            return;
        }
        let Some(open) = &mut self.open else {
            event_loop.set_control_flow(ControlFlow::Wait);
            return;
        };
        let keeps = self.session.keeps_pointer();
        if keeps != std::mem::replace(&mut open.keeps_pointer, keeps) {
            // Not every system can; then the pointer may leave the window, as usual.
            let grab = if keeps { CursorGrabMode::Confined } else { CursorGrabMode::None };
            let _ = open.window.set_cursor_grab(grab);
        }
        if let Some(position) = self.session.take_pointer_position()
            && open.window.set_cursor_position(PhysicalPosition::new(position.x, position.y)).is_err()
        {
            self.session.pointer_stays();
        }
        let full_screen = self.session.stage().full_screen;
        if full_screen != std::mem::replace(&mut open.full_screen, full_screen) {
            open.window.set_fullscreen(full_screen.then_some(Fullscreen::Borderless(None)));
        }
        let title = self.session.stage().title();
        if open.title != title {
            open.window.set_title(title);
            open.title = title.to_owned();
        }
        let next = self.session.next(now);
        if next == Wake::Now {
            open.window.request_redraw();
            open.is_redraw_requested = true;
        }
        let later = if let Wake::At(time) = next { Some(time) } else { None };
        let due = [later, self.played.due()].into_iter().flatten().min();
        event_loop.set_control_flow(match due {
            Some(time) => ControlFlow::WaitUntil(self.started + time),
            None => ControlFlow::Wait,
        });
    }
}
