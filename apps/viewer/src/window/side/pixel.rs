//! Why a pixel of the window's image looks as it does.

use trigon_math::DVec2;
use trigon_scene::Renderer;
use trigon_window::{Stage, egui};

use crate::pixel::{self, ExplainedPixel};

/// A pixel with its explanation.
#[derive(Default)]
pub(super) struct PixelPanel {
    explained: Option<Result<ExplainedPixel, String>>,
}

impl PixelPanel {
    pub(super) fn forget(&mut self) {
        self.explained = None;
    }

    /// Explains the pixel at a point of the window, in physical pixels.
    pub(super) fn explain(&mut self, stage: &Stage, at: Option<DVec2>) {
        if !stage.shows_scene() {
            self.explained =
                Some(Err("Press B until this model alone is shown; then click a pixel.".to_owned()));
            return;
        }
        let size = stage.viewport().size();
        let at = at.filter(|at| at.cmpge(DVec2::ZERO).all() && at.cmplt(size).all());
        self.explained = at.map(|at| {
            let mut renderer = Renderer::new(stage.image_settings());
            pixel::explained(&mut renderer, &stage.scene, &stage.camera(), [at.x as u32, at.y as u32])
                .map_err(|failure| failure.to_string())
        });
    }

    pub(super) fn show(&self, ui: &mut egui::Ui, stage: &Stage) {
        let wrapped = |ui: &mut egui::Ui, text: &str| ui.add(egui::Label::new(text).wrap());
        match &self.explained {
            None => drop(wrapped(ui, "Click a pixel of the image.")),
            Some(Err(why)) => drop(wrapped(ui, why)),
            Some(Ok(explained)) => {
                let lines = explained.lines(&stage.scene);
                egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                    for line in lines {
                        let text = egui::RichText::new(line.text.as_str());
                        let text = if line.is_heading { text.strong() } else { text };
                        ui.horizontal_top(|ui| {
                            ui.add_space(f32::from(line.indent) * 8.0);
                            ui.add(egui::Label::new(text).wrap());
                        });
                    }
                });
            }
        }
    }
}
