//! Paints egui's triangles, and of them only what has changed.
//!
//! egui hands over a list of clipped meshes for each pass. The painter compares it
//! with the last one ([`changes`]), marks the cells of the screen that differ
//! ([`damage`]), and paints these anew: first what lies beneath the interface, then
//! every triangle that touches them, clipped to them. [`trigon_raster::paint2d`]
//! promises that a scissor changes nothing of what is inside it, so the result is
//! the same as if all had been painted.
//!
//! As egui defines it, colours are premultiplied and multiplied and blended in
//! gamma space, windings are mixed, and clip rectangles are rounded to whole
//! pixels. Paint callbacks are left out: there is no graphics card to call.

mod changes;
mod damage;
mod gather;
#[cfg(any(test, feature = "kittest"))]
mod kittest;
mod textures;

use egui::ClippedPrimitive;
use trigon_raster::paint2d::{self, Canvas, Rect};

use damage::Damage;
use gather::Gathered;
#[cfg(any(test, feature = "kittest"))]
pub use kittest::EguiTestRenderer;
pub use textures::MAX_TEXTURE_SIDE;
use textures::Textures;

/// The order of the channels in the pixels that are painted on. Alpha is last.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ChannelOrder {
    /// As in picture files.
    #[default]
    Rgba,
    /// As windows have it in memory.
    Bgra,
}

impl ChannelOrder {
    /// From red, green, blue, alpha to this order.
    #[must_use]
    pub fn arrange(self, [r, g, b, a]: [u8; 4]) -> [u8; 4] {
        match self {
            Self::Rgba => [r, g, b, a],
            Self::Bgra => [b, g, r, a],
        }
    }
}

/// Paints the passes of one egui context on pixels of one size.
///
/// For each pass: [`update_textures`](Self::update_textures), always, then
/// [`set_primitives`](Self::set_primitives). Whenever pixels are wanted:
/// [`paint`](Self::paint).
#[derive(Debug, Default)]
pub struct EguiPainter {
    painter: paint2d::Painter,
    order: ChannelOrder,
    textures: Textures,
    /// What was last set, in points.
    primitives: Vec<ClippedPrimitive>,
    pixels_per_point: f32,
    damage: Damage,
    gathered: Gathered,
}

impl EguiPainter {
    /// A painter that knows no texture yet.
    #[must_use]
    pub fn new(order: ChannelOrder) -> Self {
        Self { order, ..Self::default() }
    }

    /// Takes over new and changed textures, and gives up those that were freed in
    /// the pass before: the primitives of that one may still have used them. To be
    /// called for every pass, also if nothing of it is painted; leaves `delta` empty.
    pub fn update_textures(&mut self, delta: &mut egui::TexturesDelta) {
        self.textures.update(delta, self.order);
    }

    /// Takes over the triangles of a pass. What differs from the last ones is
    /// painted by the next [`paint`](Self::paint).
    pub fn set_primitives(&mut self, primitives: Vec<ClippedPrimitive>, pixels_per_point: f32) {
        if pixels_per_point == self.pixels_per_point {
            let before = std::mem::take(&mut self.primitives);
            changes::mark(&mut self.damage, pixels_per_point, [&before, &primitives], &self.textures);
        } else {
            self.pixels_per_point = pixels_per_point;
            self.damage.mark_all();
        }
        self.textures.forget_changes();
        self.primitives = primitives;
    }

    /// What lies beneath the interface has changed: all is to be painted again.
    pub fn invalidate(&mut self) {
        self.damage.mark_all();
    }

    /// What lies beneath the interface has changed within a rectangle, which is to be painted again.
    pub fn invalidate_part(&mut self, part: Rect) {
        self.damage.mark(part);
    }

    /// Whether the next [`paint`](Self::paint) has something to do.
    #[must_use]
    pub fn is_damaged(&self) -> bool {
        !self.damage.is_empty()
    }

    /// Brings pixels up to date: rows from the top, `size` is width and height.
    /// They hold what was last painted, or anything after
    /// [`invalidate`](Self::invalidate) and at the first time; another size than the
    /// last one invalidates. `beneath` is what lies under the interface.
    ///
    /// Returns the rectangles that were painted; they do not overlap.
    ///
    /// # Errors
    /// If a side is 0 or too large, or the pixels are not as many as they should be.
    pub fn paint(
        &mut self,
        size: [u32; 2],
        pixels: &mut [[u8; 4]],
        beneath: &[[u8; 4]],
    ) -> Result<Vec<Rect>, paint2d::SizeError> {
        let [width, height] = size;
        if beneath.len() != pixels.len() {
            return Err(paint2d::SizeError { width, height, pixels: beneath.len() });
        }
        Canvas::new(width, height, pixels)?;
        let bounds = Rect::new([0, 0], size.map(|side| side as i32));
        let dirty = self.damage.take(bounds);
        for &rect in &dirty {
            restore(rect, width as usize, pixels, beneath);
        }
        let mut canvas = Canvas::new(width, height, pixels)?;
        for &rect in &dirty {
            self.paint_inside(&mut canvas, rect);
        }
        Ok(dirty)
    }

    /// Paints all primitives inside a rectangle of the canvas.
    fn paint_inside(&mut self, canvas: &mut Canvas<'_>, rect: Rect) {
        for primitive in &self.primitives {
            let egui::epaint::Primitive::Mesh(mesh) = &primitive.primitive else { continue };
            let Some(image) = self.textures.image(mesh.texture_id) else { continue };
            let scissor = gather::to_pixels(primitive.clip_rect, self.pixels_per_point).intersection(rect);
            if scissor.is_empty() {
                continue;
            }
            self.gathered.gather(mesh, scissor, self.pixels_per_point, self.order);
            self.painter.paint(canvas, &[self.gathered.mesh(scissor, image)]);
        }
    }
}

/// Copies a rectangle of what lies beneath.
fn restore(rect: Rect, width: usize, pixels: &mut [[u8; 4]], beneath: &[[u8; 4]]) {
    let [left, right] = [rect.min[0] as usize, rect.max[0] as usize];
    for y in rect.min[1] as usize..rect.max[1] as usize {
        let row = y * width + left..y * width + right;
        pixels[row.clone()].copy_from_slice(&beneath[row]);
    }
}

#[cfg(test)]
mod tests;
