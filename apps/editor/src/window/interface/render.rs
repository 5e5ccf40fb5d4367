//! The window of the rendered image: what is rendered and how, the progress, and the image.

use std::sync::Arc;
use std::time::Duration;

use trigon_document::scene::quality::Preset;
use trigon_window::Stage;
use trigon_window::egui::{
    self, Button, ComboBox, Context, DragValue, Id, Image, Key, ProgressBar, TextureOptions, Ui, Vec2,
};

use super::bars::{focus_first, label};
use crate::request::ImageKind;
use crate::window::editor::Editor;
use crate::window::images::{Images, LARGEST, RenderChoices, RenderFrom, SIZES};
use crate::window::navigation;

/// In points.
const MARGIN: f32 = 120.0;
const LEAST: Vec2 = Vec2::new(420.0, 320.0);

/// How often the progress is shown again.
const INTERVAL: Duration = Duration::from_millis(100);

/// What was done in the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum RenderAction {
    Render(RenderFrom),
    Cancel,
    Save,
}

/// Shows it while it is open.
pub(super) fn show(context: &Context, editor: &mut Editor, stage: &Stage) {
    if !editor.images.is_open {
        return;
    }
    let has_camera = navigation::camera(&editor.document).is_some();
    let size = (context.content_rect().size() - Vec2::splat(MARGIN)).max(LEAST);
    let (mut is_open, mut did) = (true, None);
    let window = egui::Window::new("Rendered Image").id(Id::unique("render")).open(&mut is_open);
    let window = window.collapsible(false).default_size(size.min(Vec2::new(1000.0, 720.0)));
    let window = window.default_pos(context.content_rect().min + Vec2::new(60.0, 70.0)).constrain(true);
    window.show(context, |ui| {
        did = choices(ui, &mut editor.images, has_camera);
        ui.separator();
        did = content(ui, &mut editor.images, has_camera).or(did);
    });
    // Escape closes what lies over it first.
    let is_on_top = !editor.dialog.is_open() && !egui::Popup::is_any_open(context);
    if !is_open || (is_on_top && context.input(|input| input.key_pressed(Key::Escape))) {
        if !is_open {
            editor.images.rendering = None;
        }
        editor.images.leave();
    }
    match did {
        Some(RenderAction::Render(from)) => {
            editor.images.choices.from = from;
            editor.render(stage);
        }
        Some(RenderAction::Cancel) => drop(editor.images.leave()),
        Some(RenderAction::Save) => editor.ask_for_image(ImageKind::Render),
        None => {}
    }
}

/// What is rendered, how large and how well, and the buttons.
fn choices(ui: &mut Ui, images: &mut Images, has_camera: bool) -> Option<RenderAction> {
    let mut did = None;
    ui.horizontal_wrapped(|ui| {
        let choices = &mut images.choices;
        for (from, name) in [(RenderFrom::Camera, "Through Camera"), (RenderFrom::View, "The View")] {
            let can = has_camera || from == RenderFrom::View;
            let shown = ui.add_enabled(can, Button::selectable(choices.from == from, name));
            if shown.on_disabled_hover_text("The scene has no camera: Add, Camera").clicked() {
                choices.from = from;
            }
        }
        ui.separator();
        sizes(ui, choices);
        ui.separator();
        presets(ui, choices);
        ui.checkbox(&mut choices.is_transparent, "Transparent")
            .on_hover_text("Nothing behind the scene: PNG, WebP and EXR keep it so");
        ui.separator();
        let is_running = images.rendering.is_some();
        let can = has_camera || choices.from == RenderFrom::View;
        if ui.add_enabled(can && !is_running, Button::new("Render")).clicked() {
            did = Some(RenderAction::Render(choices.from));
        }
        let can_save = images.rendered.is_some() && !is_running;
        let save = ui.add_enabled(can_save, Button::new("Save Image…"));
        if save.on_hover_text("PNG, JPEG, WebP or OpenEXR").clicked() {
            did = Some(RenderAction::Save);
        }
    });
    did
}

fn sizes(ui: &mut Ui, choices: &mut RenderChoices) {
    for (pixels, name) in [(&mut choices.width, "width"), (&mut choices.height, "height")] {
        let field = ui.add(DragValue::new(pixels).range(1..=LARGEST).suffix(" px"));
        label(&field, &format!("{name} of the image"));
    }
    let shown = ComboBox::from_id_salt("sizes").selected_text("Size").width(0.0).show_ui(ui, |ui| {
        for (name, size) in SIZES {
            if ui.selectable_label(size == [choices.width, choices.height], name).clicked() {
                [choices.width, choices.height] = size;
            }
        }
    });
    label(&shown.response, "usual sizes");
}

fn presets(ui: &mut Ui, choices: &mut RenderChoices) {
    let shown = ComboBox::from_id_salt("preset").selected_text(name_of(choices.preset)).width(0.0);
    let shown = shown.show_ui(ui, |ui| {
        for preset in Preset::ALL {
            let row = ui.selectable_label(choices.preset == preset, name_of(preset));
            if row.on_hover_text(preset.quality().to_string()).clicked() {
                choices.preset = preset;
            }
        }
    });
    label(&shown.response, "quality of the image");
    shown.response.on_hover_text(choices.preset.quality().to_string());
}

fn name_of(preset: Preset) -> &'static str {
    match preset {
        Preset::Draft => "Draft",
        Preset::Standard => "Standard",
        Preset::High => "High",
        Preset::Reference => "Reference",
    }
}

/// The progress while an image is rendered, or else what the last one is or why there is none; and the image.
fn content(ui: &mut Ui, images: &mut Images, has_camera: bool) -> Option<RenderAction> {
    let mut did = None;
    if let Some(rendering) = &images.rendering {
        ui.horizontal(|ui| {
            let bar = ProgressBar::new(rendering.progress()).show_percentage();
            let bar = ui.add(bar.desired_width((ui.available_width() - 90.0).max(60.0)));
            label(&bar, "progress of the image");
            if ui.button("Cancel").on_hover_text("Escape").clicked() {
                did = Some(RenderAction::Cancel);
            }
        });
        ui.ctx().request_repaint_after(INTERVAL);
    } else if !images.note.is_empty() {
        ui.add(egui::Label::new(&images.note).wrap());
        if !has_camera {
            let button = ui.button("Render the View");
            focus_first(&button);
            if button.clicked() {
                did = Some(RenderAction::Render(RenderFrom::View));
            }
        }
    } else if let Some(rendered) = &images.rendered {
        ui.weak(format!("{} × {} pixels", rendered.frame.width, rendered.frame.height));
    }
    image(ui, images);
    did
}

/// The last image, as large as it fits.
fn image(ui: &mut Ui, images: &mut Images) {
    let Some(rendered) = &images.rendered else { return };
    let texture = images.texture.get_or_insert_with(|| {
        ui.ctx().load_texture("rendered", Arc::clone(&rendered.shown), TextureOptions::LINEAR)
    });
    let free = ui.available_size().max(Vec2::splat(64.0));
    let pixels = Vec2::new(rendered.frame.width as f32, rendered.frame.height as f32);
    let points = pixels / ui.ctx().pixels_per_point();
    let scale = (free.x / points.x).min(free.y / points.y).min(1.0);
    ui.add(Image::new((texture.id(), points * scale)));
}
