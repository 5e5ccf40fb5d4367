//! The window itself: winit's event loop around a [`Session`], which decides
//! everything. Events go in, pictures come out, and between them the loop
//! sleeps for as long as the session says.

#[cfg(feature = "accesskit")]
mod accessibility;

use std::sync::Arc;
use std::time::{Duration, Instant};

use winit::application::ApplicationHandler;
use winit::dpi::{LogicalSize, PhysicalPosition, PhysicalSize};
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

/// What wakes the loop from other threads.
#[derive(Clone, Debug)]
pub(crate) enum Ring {
    /// [`crate::Waker::wake`].
    Application,
    /// A picture is finished.
    Picture,
    /// The interface wants a pass.
    Interface,
    /// Whoever reads the screen aloud wants something.
    #[cfg(feature = "accesskit")]
    Accessibility(egui_winit::accesskit_winit::WindowEvent),
}

/// A window that is open. The presenter goes first when it closes.
struct Open {
    presenter: Presenter,
    /// From the window system to egui and back.
    egui: egui_winit::State,
    window: Arc<Window>,
    title: String,
    /// When it was last asked.
    minimised: bool,
    /// Whether the next frame was asked for by this program.
    asked: bool,
    /// Whether the pointer is to stay in it.
    keeps_pointer: bool,
    full_screen: bool,
}

/// An application between its start and its end.
pub(crate) struct Shell<'a> {
    session: Session<'a>,
    #[cfg(feature = "accesskit")]
    proxy: EventLoopProxy<Ring>,
    open: Option<Open>,
    started: Instant,
    error: Option<WindowError>,
    /// What is done in place of hands.
    played: Interaction,
}

impl<'a> Shell<'a> {
    pub(crate) fn new(stage: Stage, handler: &'a mut dyn Handler, proxy: &EventLoopProxy<Ring>) -> Self {
        // Sending fails when the window is closed: then there is nobody to wake.
        let ring = |ring: Ring| {
            let proxy = proxy.clone();
            move || {
                let _ = proxy.send_event(ring.clone());
            }
        };
        stage.waker().connect(ring(Ring::Application));
        let started = Instant::now();
        let worker = Worker::of_threads(ring(Ring::Picture), move || started.elapsed());
        let mut session = Session::new(stage, handler, worker);
        session.interface().connect(ring(Ring::Interface));
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

    /// Remembers what comes in.
    pub(crate) fn record(&mut self) {
        self.session.record();
    }

    /// What has come in.
    pub(crate) fn take_recorded(&mut self) -> Option<Interaction> {
        self.session.take_recorded()
    }

    /// Does this in place of hands, which are not listened to meanwhile.
    pub(crate) fn play(&mut self, interaction: Interaction) {
        self.played = interaction;
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
            // Screen readers have to know of it before anybody sees it.
            .with_visible(cfg!(not(feature = "accesskit")))
            .with_inner_size(LogicalSize::new(size.width.max(1), size.height.max(1)));
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
        self.session.event(InputEvent::Scaled(window.scale_factor()), now);
        let size = window.inner_size();
        self.session.event(InputEvent::Resized { width: size.width, height: size.height }, now);
        self.session.start(now);
        self.open = Some(Open {
            presenter,
            egui,
            window,
            title,
            minimised: false,
            asked: false,
            keeps_pointer: false,
            full_screen: false,
        });
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
        // The window system asks where the window has lost what it showed.
        let lost = !std::mem::take(&mut open.asked);
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

    /// What a size or scale means for the surface.
    fn fit_surface(&mut self) -> Result<(), WindowError> {
        let Some(open) = &mut self.open else { return Ok(()) };
        let size = open.window.inner_size();
        open.presenter.resize(size.width, size.height)?;
        let now = self.started.elapsed();
        self.session.event(InputEvent::Resized { width: size.width, height: size.height }, now);
        Ok(())
    }

    /// Hands an event to the interface. A request to draw is none: it would ask for the
    /// next one.
    fn tell_interface(&mut self, event: &WindowEvent) {
        let Some(open) = self.open.as_mut().filter(|_| !matches!(event, WindowEvent::RedrawRequested)) else {
            return;
        };
        let now = self.started.elapsed();
        // What it answers is about the last pass; the session asks the interface itself.
        let _ = open.egui.on_window_event(&open.window, event);
        let played = !self.played.is_empty();
        for event in open.egui.egui_input_mut().events.drain(..).filter(|_| !played) {
            self.session.event(InputEvent::Interface(event), now);
        }
    }

    /// Does what is due of what is played. The window has its own scale and is seen or
    /// not; it is asked for the size.
    fn step_play(&mut self, now: Duration) -> Result<(), WindowError> {
        // With its own moment: how long a key was held counts, not when that was found out.
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
            // It has it already, and no event will tell, as under Wayland.
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

impl ApplicationHandler<Ring> for Shell<'_> {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.open.is_none() {
            let result = self.open(event_loop);
            self.fail(event_loop, result);
        }
    }

    fn suspended(&mut self, _: &ActiveEventLoop) {
        self.open = None;
    }

    fn user_event(&mut self, _: &ActiveEventLoop, ring: Ring) {
        let now = self.now();
        match ring {
            Ring::Application => self.session.woken(now),
            Ring::Picture => self.session.collect(now),
            Ring::Interface => self.session.interface_asked(now),
            #[cfg(feature = "accesskit")]
            Ring::Accessibility(event) => self.accessibility(event),
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
            // Not every system follows a new scale by a new size.
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
            // Not every system can; then the pointer may leave the window, as always.
            let grab = if keeps { CursorGrabMode::Confined } else { CursorGrabMode::None };
            let _ = open.window.set_cursor_grab(grab);
        }
        if let Some(place) = self.session.take_pointer_place()
            && open.window.set_cursor_position(PhysicalPosition::new(place.x, place.y)).is_err()
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
            open.asked = true;
        }
        let later = if let Wake::At(time) = next { Some(time) } else { None };
        let due = [later, self.played.due()].into_iter().flatten().min();
        event_loop.set_control_flow(match due {
            Some(time) => ControlFlow::WaitUntil(self.started + time),
            None => ControlFlow::Wait,
        });
    }
}
