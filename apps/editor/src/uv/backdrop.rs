//! What lies behind the coordinates: the image of the material, or a checker, in and around the square of the image.

use trigon_document::Document;
use trigon_document::scene::{Scene, Texture, TextureId};
use trigon_window::egui::{
    Color32, ColorImage, Context, Painter, Rect, Stroke, StrokeKind, TextureHandle, TextureOptions, pos2,
};

use super::canvas::UvCanvas;

/// What is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Backdrop {
    /// The image of the base color, or the checker where the material has none.
    #[default]
    Image,
    Checker,
    Nothing,
}

/// An image on the screen.
#[derive(Default)]
pub(super) struct ShownImage(Option<(TextureId, [u32; 2], TextureHandle)>);

/// The longest side of an image on the screen, in pixels: larger ones are thinned out.
const LARGEST: u32 = 1024;

/// Squares of the checker along a side.
const SQUARES: usize = 8;

const DARK: Color32 = Color32::from_gray(62);
const LIGHT: Color32 = Color32::from_gray(86);

/// The image of the base colour of the active object's first material that has one.
fn texture(document: &Document) -> Option<(TextureId, &Texture)> {
    let scene: &Scene = document.nodes();
    let node = scene.node(document.selection().active?)?;
    let bound = node.materials.iter().find_map(|&id| scene.materials.get(id)?.base_color_texture)?;
    Some((bound.texture, &scene.textures.get(bound.texture)?.texture))
}

impl ShownImage {
    /// Draws the backdrop.
    pub(super) fn draw(
        &mut self,
        painter: &Painter,
        canvas: &UvCanvas,
        document: &Document,
        backdrop: Backdrop,
    ) {
        let image = canvas.image();
        let found = texture(document).filter(|_| backdrop == Backdrop::Image);
        match found {
            Some((id, texture)) => {
                let handle = self.handle(painter.ctx(), id, texture);
                let all = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
                painter.image(handle.id(), image, all, Color32::WHITE);
            }
            None if backdrop != Backdrop::Nothing => draw_checker(painter, image),
            None => {}
        }
        painter.rect_stroke(image, 0.0, Stroke::new(1.0, Color32::from_gray(150)), StrokeKind::Outside);
    }

    fn handle(&mut self, context: &Context, id: TextureId, texture: &Texture) -> &TextureHandle {
        let size = [texture.width(), texture.height()];
        let known = self.0.take().filter(|(of, known, _)| (*of, *known) == (id, size));
        let shown = known.unwrap_or_else(|| {
            (id, size, context.load_texture("uv image", thinned(texture), TextureOptions::LINEAR))
        });
        &self.0.insert(shown).2
    }
}

/// Every so many texels of each row and column.
fn thinned(texture: &Texture) -> ColorImage {
    let [width, height] = [texture.width(), texture.height()];
    let step = width.max(height).div_ceil(LARGEST).max(1);
    let sides = [width, height].map(|side| side.div_ceil(step) as usize);
    let texels = texture.texels().zip(0u64..).filter(|(_, index)| {
        let (x, y) = (index % u64::from(width), index / u64::from(width));
        x % u64::from(step) == 0 && y % u64::from(step) == 0
    });
    let bytes: Vec<u8> = texels.flat_map(|(texel, _)| texel).collect();
    ColorImage::from_rgba_unmultiplied(sides, &bytes)
}

fn draw_checker(painter: &Painter, image: Rect) {
    painter.rect_filled(image, 0.0, DARK);
    let side = image.size() / SQUARES as f32;
    for (x, y) in (0..SQUARES).flat_map(|y| (0..SQUARES).map(move |x| (x, y))) {
        if (x + y) % 2 == 0 {
            let min = image.min + side * trigon_window::egui::vec2(x as f32, y as f32);
            painter.rect_filled(Rect::from_min_size(min, side), 0.0, LIGHT);
        }
    }
}

#[cfg(test)]
mod tests {
    use trigon_document::scene::TextureFormat;

    use super::*;

    #[test]
    fn large_images_are_thinned_out() {
        let texels = (0..3000u32).map(|x| [(x / 12) as u8, 0, 0, 255]).collect();
        let wide = Texture::new(3000, 1, texels, TextureFormat::Srgb).expect("a row");
        let image = thinned(&wide);
        assert_eq!(image.size, [1000, 1], "every third");
        assert_eq!(image.pixels[4].r(), 1, "texel 12");
    }
}
