//! The interface over the image: an egui context, the window's own widgets, and the painter that turns them
//! into pixels. It is independent of the window system: events and times go in, triangles come out.

mod corners;
mod drop_target;
mod legend;
mod menu;
mod outline;
mod sheet;
mod theme;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use egui::{Context, Event, LayerId, Order, Pos2, Ui};
use trigon_camera::{Camera, Viewport};
use trigon_math::DVec2;

use crate::egui_painter::{ChannelOrder, EguiPainter, MAX_TEXTURE_SIDE};
use crate::keymap::Binding;
use crate::stage::Stage;

/// The time and size of a pass.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Moment {
    pub(crate) now: Duration,
    pub(crate) viewport: Viewport,
    /// Physical pixels per logical one.
    pub(crate) scale: f64,
}

/// The interface of one window.
pub(crate) struct Interface {
    context: Context,
    pub(crate) painter: EguiPainter,
    events: Vec<Event>,
    focused: bool,
    /// Whether the system has light or dark windows, if it says.
    system_theme: Option<egui::Theme>,
    /// The area that no panel covers, in points.
    free: egui::Rect,
    /// When it needs to change by itself.
    due: Option<Duration>,
    /// Output for the window system: pointer shapes, copied text, links.
    output: egui::PlatformOutput,
    /// Whether a pass is in progress: then requesting another one wakes nobody.
    in_pass: Arc<AtomicBool>,
}

impl Interface {
    pub(crate) fn new() -> Self {
        let context = Context::default();
        theme::set_colors(&context);
        Self {
            context,
            painter: EguiPainter::new(ChannelOrder::Bgra),
            events: Vec::new(),
            focused: true,
            system_theme: None,
            free: egui::Rect::EVERYTHING,
            due: None,
            output: egui::PlatformOutput::default(),
            in_pass: Arc::default(),
        }
    }

    /// Follows the system. Tells whether that is another theme than before.
    pub(crate) fn follow(&mut self, system_theme: Option<egui::Theme>) -> bool {
        std::mem::replace(&mut self.system_theme, system_theme) != system_theme
    }

    pub(crate) fn context(&self) -> &Context {
        &self.context
    }

    /// From now on `ring` is called when another thread requests a pass.
    pub(crate) fn connect(&self, ring: impl Fn() + Send + Sync + 'static) {
        let in_pass = Arc::clone(&self.in_pass);
        self.context.set_request_repaint_callback(move |_| {
            if !in_pass.load(Ordering::Relaxed) {
                ring();
            }
        });
    }

    /// An event for the next pass.
    pub(crate) fn event(&mut self, event: Event) {
        if let Event::WindowFocused(focused) = event {
            self.focused = focused;
        }
        self.events.push(event);
    }

    /// Whether a position in physical pixels is on a panel or a window of the interface, or one of
    /// them is being dragged.
    pub(crate) fn wants_pointer(&self, at: DVec2) -> bool {
        let at = at / f64::from(self.context.pixels_per_point());
        let at = Pos2::new(at.x as f32, at.y as f32);
        let covered = match self.context.layer_id_at(at) {
            Some(LayerId { order: Order::Background, .. }) | None => !self.free.contains(at),
            Some(_) => true,
        };
        covered || self.context.egui_is_using_pointer()
    }

    /// Whether a widget has the keyboard, or a menu is open, which Escape closes.
    pub(crate) fn wants_keyboard(&self) -> bool {
        self.context.egui_wants_keyboard_input() || egui::Popup::is_any_open(&self.context)
    }

    /// Gives the keyboard to the first widget.
    pub(crate) fn take_keyboard(&mut self) {
        let (key, modifiers) = (egui::Key::Tab, egui::Modifiers::NONE);
        self.events.push(Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers });
    }

    /// Gives the keyboard to the search of the list of keys, which is shown from the next pass on.
    pub(crate) fn search_keys(&self) {
        self.context.memory_mut(|memory| memory.request_focus(sheet::search_id()));
    }

    /// Whether that search has the keyboard.
    pub(crate) fn searches_keys(&self) -> bool {
        self.context.memory(|memory| memory.has_focus(sheet::search_id()))
    }

    /// Takes the keyboard from it.
    pub(crate) fn end_search(&self) {
        self.context.memory_mut(|memory| memory.surrender_focus(sheet::search_id()));
    }

    /// When it needs to change by itself; `None` for never.
    pub(crate) fn due(&self) -> Option<Duration> {
        self.due
    }

    /// The output for the window system since the last call.
    pub(crate) fn take_output(&mut self) -> egui::PlatformOutput {
        std::mem::take(&mut self.output)
    }

    /// Runs a pass. `application` adds its own widgets, more than once if egui lays out again.
    /// Returns the command selected in the list of keys.
    pub(crate) fn run(
        &mut self,
        moment: Moment,
        stage: &mut Stage,
        shown_by: Option<&Camera>,
        application: &mut dyn FnMut(&mut Stage, &mut Ui),
    ) -> Option<Binding> {
        self.context.set_zoom_factor(stage.text_scale.clamp(0.5, 4.0));
        theme::choose(&self.context, stage.theme);
        let input = self.input(moment);
        let (mut chosen, mut free) = (None, egui::Rect::EVERYTHING);
        self.in_pass.store(true, Ordering::Relaxed);
        let mut output = self.context.run_ui(input, |ui| {
            application(stage, ui);
            free = ui.available_rect_before_wrap();
            name_view(ui.ctx(), free, stage);
            let bounds = stage.selection_bounds().filter(|_| stage.shows_scene());
            if let (Some(camera), Some(bounds)) = (shown_by, bounds) {
                outline::show(ui, camera, stage.image_area(), &bounds);
            }
            let left = corners::show(ui.ctx(), free, stage, moment.now);
            legend::show(ui.ctx(), left, stage);
            chosen = sheet::show(ui.ctx(), free, stage);
            chosen = menu::show(ui.ctx(), stage).or(chosen.take());
            drop_target::show(ui.ctx(), stage);
        });
        self.in_pass.store(false, Ordering::Relaxed);
        self.free = free;
        self.output.append(output.platform_output);
        self.painter.update_textures(&mut output.textures_delta);
        let root = output.viewport_output.get(&egui::ViewportId::ROOT);
        // The distant future counts as never.
        self.due = root.and_then(|root| moment.now.checked_add(root.repaint_delay));
        self.due = self.due.filter(|due| *due < Duration::from_secs(u64::MAX / 2));
        let primitives = self.context.tessellate(output.shapes, output.pixels_per_point);
        self.painter.set_primitives(primitives, output.pixels_per_point);
        chosen
    }

    fn input(&mut self, Moment { now, viewport, scale }: Moment) -> egui::RawInput {
        let points = scale as f32 * self.context.zoom_factor();
        let size = egui::vec2(viewport.width as f32, viewport.height as f32) / points;
        let mut input = egui::RawInput {
            screen_rect: Some(egui::Rect::from_min_size(Pos2::ZERO, size)),
            max_texture_side: Some(MAX_TEXTURE_SIDE),
            time: Some(now.as_secs_f64()),
            focused: self.focused,
            system_theme: self.system_theme,
            events: std::mem::take(&mut self.events),
            ..egui::RawInput::default()
        };
        input.viewports.entry(egui::ViewportId::ROOT).or_default().native_pixels_per_point =
            Some(scale as f32);
        input
    }
}

/// Describes window and image for screen readers, if one is active.
fn name_view(context: &Context, free: egui::Rect, stage: &Stage) {
    context.accesskit_node_builder(egui::accesskit_root_id(), |window| window.set_label(stage.title()));
    context.accesskit_node_builder(egui::Id::unique("view"), |node| {
        let selected = stage.selection.and_then(|id| stage.scene.node(id));
        let selected = selected.map(|node| format!("; selected: {}", node.name)).unwrap_or_default();
        let [x0, y0, x1, y1] = [free.min.x, free.min.y, free.max.x, free.max.y].map(f64::from);
        node.set_role(egui::Role::Image);
        node.set_label(format!("3D view: {}{selected}", stage.title()));
        node.set_bounds(egui::accesskit::Rect { x0, y0, x1, y1 });
    });
}
