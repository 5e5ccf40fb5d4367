//! Interface tests drawn by this painter.

use egui_kittest::TestRenderer;

use super::{ChannelOrder, EguiPainter};

/// Draws for egui_kittest: pass it to the builder of a harness. Only the interface is drawn, over a
/// transparent background.
#[derive(Debug)]
pub struct EguiTestRenderer {
    painter: EguiPainter,
}

impl Default for EguiTestRenderer {
    fn default() -> Self {
        Self { painter: EguiPainter::new(ChannelOrder::Rgba) }
    }
}

impl TestRenderer for EguiTestRenderer {
    fn handle_delta(&mut self, delta: &mut egui::TexturesDelta) {
        self.painter.update_textures(delta);
    }

    fn render(
        &mut self,
        context: &egui::Context,
        output: &egui::FullOutput,
    ) -> Result<image::RgbaImage, String> {
        let scale = context.pixels_per_point();
        let size = context.content_rect().size() * scale;
        let (width, height) = (size.x.round() as u32, size.y.round() as u32);
        self.painter.set_primitives(context.tessellate(output.shapes.clone(), scale), scale);
        self.painter.invalidate();
        let mut pixels = vec![[0; 4]; width as usize * height as usize];
        let beneath = pixels.clone();
        self.painter.paint([width, height], &mut pixels, &beneath).map_err(|error| error.to_string())?;
        // Image files have straight alpha.
        let straight = pixels.iter().flat_map(|&[r, g, b, a]| {
            egui::Color32::from_rgba_premultiplied(r, g, b, a).to_srgba_unmultiplied()
        });
        let image = image::RgbaImage::from_raw(width, height, straight.collect());
        Ok(image.expect("four bytes for each pixel"))
    }
}
