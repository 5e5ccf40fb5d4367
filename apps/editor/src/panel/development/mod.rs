//! The tab *Development*: how the frame was made: stages, tiles, overdraw, buffers, effects with
//! their reasons, single pixels, accuracy.
//!
//! Stage statistics need a separate frame, which is drawn on request.

mod buffer;
mod report;
#[cfg(test)]
mod tests;

use trigon_window::egui::{self, CollapsingHeader, Sense, TextureHandle, TextureOptions, Ui};
use trigon_window::scene::camera::Camera;
use trigon_window::scene::{EffectPlan, Frame, Outputs, RenderSettings, Renderer, Scene, Stats};
use trigon_window::{FrameReport, QualityReport, Stage};

use super::row::choice;
use crate::request::Request;
use buffer::Buffer;

/// What is drawn in the window, and what that took.
pub(crate) struct DrawnView<'v> {
    pub(crate) scene: &'v Scene,
    pub(crate) camera: Camera,
    /// With the size of the window.
    pub(crate) settings: RenderSettings,
    pub(crate) report: FrameReport,
    pub(crate) quality: Option<QualityReport>,
    /// How the image at rest is compared and refined.
    pub(crate) comparison: trigon_window::Comparison,
    pub(crate) refinement: trigon_window::Refinement,
}

impl<'v> DrawnView<'v> {
    /// Of a window.
    pub(crate) fn of(stage: &'v Stage) -> Self {
        let viewport = stage.viewport();
        let (width, height) = (viewport.width.max(1), viewport.height.max(1));
        Self {
            scene: &stage.scene,
            camera: stage.camera(),
            settings: RenderSettings { width, height, ..stage.settings.clone() },
            report: stage.report(),
            quality: stage.quality_report(),
            comparison: stage.comparison,
            refinement: stage.refinement,
        }
    }
}

/// The state of the tab: the requested image.
#[derive(Default)]
pub(crate) struct DevelopmentState {
    inspected: Option<Inspected>,
    /// Why there is none.
    failure: Option<String>,
    buffer: Buffer,
}

/// An image with everything that is known of it.
struct Inspected {
    frame: Frame,
    stats: Stats,
    /// How many samples of a pixel are shaded.
    shades: u64,
    plan: Option<EffectPlan>,
    /// The buffer as an image, and which buffer it is; made again when another one is chosen.
    image: Option<(Buffer, TextureHandle)>,
    pixel: Option<[u32; 2]>,
}

/// Shows it.
pub(crate) fn development(
    ui: &mut Ui,
    view: &DrawnView<'_>,
    state: &mut DevelopmentState,
    requests: &mut Vec<Request>,
) {
    section(ui, "Last frame", |ui| report::frame(ui, view));
    section(ui, "Accuracy", |ui| report::accuracy(ui, view, requests));
    let hover = "Draws the view once more, with all buffers and counts. The window waits for it.";
    if ui.add(egui::Button::new("Inspect the image").wrap()).on_hover_text(hover).clicked() {
        inspect(view, state);
    }
    if let Some(failure) = &state.failure {
        ui.add(egui::Label::new(failure).wrap());
    }
    let Some(inspected) = &mut state.inspected else { return };
    section(ui, "Stages", |ui| report::stages(ui, &inspected.stats, &inspected.frame, inspected.shades));
    section(ui, "Buffers", |ui| buffers(ui, view, inspected, &mut state.buffer));
    if let Some(plan) = &inspected.plan {
        section(ui, "Effects", |ui| report::effects(ui, plan));
    }
}

fn section(ui: &mut Ui, title: &str, contents: impl FnOnce(&mut Ui)) {
    CollapsingHeader::new(title).default_open(true).show_unindented(ui, contents);
}

fn inspect(view: &DrawnView<'_>, state: &mut DevelopmentState) {
    let mut renderer = Renderer::new(RenderSettings { outputs: Outputs::ALL, ..view.settings.clone() });
    let shades = u64::from(view.settings.samples_per_axis).pow(2);
    (state.inspected, state.failure) = match renderer.render(view.scene, &view.camera) {
        Ok(frame) => {
            let (stats, plan) = (*renderer.stats(), renderer.plan().cloned());
            (Some(Inspected { frame, stats, shades, plan, image: None, pixel: None }), None)
        }
        Err(error) => (None, Some(error.to_string())),
    };
}

/// A buffer as an image, and the pixel that was clicked there.
fn buffers(ui: &mut Ui, view: &DrawnView<'_>, inspected: &mut Inspected, chosen: &mut Buffer) {
    choice(ui, "Buffer", "What the image shows.", chosen, &Buffer::ALL.map(|one| (one, one.name(), "")));
    let side = ui.available_width().max(16.0);
    let known = inspected.image.take().filter(|(of, _)| of == chosen);
    let (_, texture) = inspected.image.insert(known.unwrap_or_else(|| {
        let image = chosen.image(&inspected.frame, side.round() as u32);
        (*chosen, ui.ctx().load_texture("buffer", image, TextureOptions::NEAREST))
    }));
    let size = texture.size_vec2();
    let image = egui::Image::from_texture((texture.id(), size)).sense(Sense::click());
    let response = ui.add(image.alt_text("Buffer image")).on_hover_text("Click a pixel to explain it");
    if let Some(at) = response.interact_pointer_pos().filter(|_| response.clicked()) {
        let share = (at - response.rect.min) / response.rect.size();
        let (width, height) = (inspected.frame.width, inspected.frame.height);
        let pixel = |share: f32, size: u32| ((share * size as f32) as u32).min(size - 1);
        inspected.pixel = Some([pixel(share.x, width), pixel(share.y, height)]);
    }
    match inspected.pixel {
        Some(at) => report::explain(ui, view.scene, &inspected.frame, at),
        None => drop(ui.add(egui::Label::new("Click a pixel of the image to explain it.").wrap())),
    }
}
