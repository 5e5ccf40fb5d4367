//! Paints egui's triangles, repainting only what has changed.
//!
//! egui produces a list of clipped meshes for each pass. The painter compares it with the last one ([`changes`]),
//! marks the cells of the screen that differ ([`damage`]), and repaints these cells. First comes what lies beneath
//! the interface, then every triangle that touches a cell, clipped to the cells. [`trigon_raster::paint2d`]
//! guarantees that a scissor does not change anything inside it, so the result is the same as repainting
//! everything.
//!
//! As egui defines it, colours are premultiplied and multiplied and blended in gamma space,
//! windings are mixed, and clip rectangles are rounded to whole pixels. Paint callbacks are
//! ignored, because there is no graphics card to call.

mod changes;
mod damage;
mod extent;
mod gather;
#[cfg(any(test, feature = "kittest"))]
mod kittest;
mod textures;
mod unchanged;

use egui::ClippedPrimitive;
use rayon::prelude::*;
use trigon_raster::paint2d::{self, Canvas, Rect};

use damage::Damage;
use gather::{Boxes, Gathered};
#[cfg(any(test, feature = "kittest"))]
pub use kittest::EguiTestRenderer;
pub use textures::MAX_TEXTURE_SIDE;
use textures::Textures;

/// The order of the channels in the painted pixels. Alpha is last.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ChannelOrder {
    /// As in image files.
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
/// For each pass call [`update_textures`](Self::update_textures), always, then
/// [`set_primitives`](Self::set_primitives). Call [`paint`](Self::paint) whenever pixels are
/// needed.
#[derive(Debug, Default)]
pub struct EguiPainter {
    order: ChannelOrder,
    textures: Textures,
    /// The last primitives, in points, and the boxes around their triangles.
    primitives: Vec<ClippedPrimitive>,
    boxes: Vec<Boxes>,
    pixels_per_point: f32,
    damage: Damage,
    /// One for each band of the screen that is painted at a time.
    hands: Vec<Hand>,
}

/// What painting keeps.
#[derive(Debug, Default)]
struct Hand {
    painter: paint2d::Painter,
    gathered: Gathered,
}

/// Bands for each thread: some have more to paint than others.
const BANDS: usize = 4;

/// Pixels that are worth another thread.
const WORTH_SHARING: usize = 1 << 17;

impl EguiPainter {
    /// A painter without textures.
    #[must_use]
    pub fn new(order: ChannelOrder) -> Self {
        Self { order, ..Self::default() }
    }

    /// Takes new and changed textures, and drops those that were freed in the previous pass, whose
    /// primitives may still have used them. Call it for every pass, even if nothing of it is
    /// painted; leaves `delta` empty.
    pub fn update_textures(&mut self, delta: &mut egui::TexturesDelta) {
        self.textures.update(delta, self.order);
    }

    /// Takes the triangles of a pass. The next [`paint`](Self::paint) paints the differences from
    /// the last ones.
    pub fn set_primitives(&mut self, primitives: Vec<ClippedPrimitive>, pixels_per_point: f32) {
        if pixels_per_point == self.pixels_per_point {
            let before = std::mem::take(&mut self.primitives);
            changes::mark(&mut self.damage, pixels_per_point, [&before, &primitives], &self.textures);
        } else {
            self.pixels_per_point = pixels_per_point;
            self.damage.mark_all();
        }
        self.textures.forget_changes();
        self.boxes = primitives.iter().map(Boxes::of).collect();
        self.primitives = primitives;
    }

    /// The area beneath the interface has changed: everything must be repainted.
    pub fn invalidate(&mut self) {
        self.damage.mark_all();
    }

    /// Marks a rectangle to be painted again, because the image beneath the interface changed there.
    pub fn invalidate_part(&mut self, part: Rect) {
        self.damage.mark(part);
    }

    /// Whether the next [`paint`](Self::paint) has anything to do.
    #[must_use]
    pub fn is_damaged(&self) -> bool {
        !self.damage.is_empty()
    }

    /// Brings pixels up to date: rows from the top, `size` is width and height. The pixels must contain what
    /// was last painted, or anything after [`invalidate`](Self::invalidate) and at the first call; a
    /// different size invalidates. `beneath` is what lies under the interface.
    ///
    /// Returns the repainted rectangles, which do not overlap.
    ///
    /// # Errors
    /// A side is 0 or too large, or the number of pixels does not match.
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
        let dirty = self.damage.take(Rect::new([0, 0], size.map(|side| side as i32)));
        let area = |rect: &Rect| [0, 1].map(|axis| rect.max[axis].abs_diff(rect.min[axis]) as usize);
        let area: usize = dirty.iter().map(area).map(|[width, height]| width * height).sum();
        let most = BANDS * rayon::current_num_threads();
        let count = (area * BANDS / WORTH_SHARING).clamp(1, most);
        let rows = height.div_ceil(count as u32);
        let mut hands = std::mem::take(&mut self.hands);
        hands.resize_with(hands.len().max(count), Hand::default);
        let piece = width as usize * rows as usize;
        let bands = pixels.par_chunks_mut(piece).zip(beneath.par_chunks(piece)).zip(&mut hands).enumerate();
        bands.try_for_each(|(number, ((pixels, beneath), hand))| {
            let top = number as u32 * rows;
            let rows = top..height.min(top + rows);
            self.paint_band(Band { width, rows, pixels, beneath }, &dirty, hand)
        })?;
        self.hands = hands;
        Ok(dirty)
    }

    /// Brings rows of an image up to date inside rectangles.
    fn paint_band(&self, band: Band<'_>, dirty: &[Rect], hand: &mut Hand) -> Result<(), paint2d::SizeError> {
        let Band { width, rows, pixels, beneath } = band;
        let top = rows.start as i32;
        let bounds = Rect::new([0, top], [width as i32, rows.end as i32]);
        let within = || dirty.iter().map(|rect| rect.intersection(bounds)).filter(|rect| !rect.is_empty());
        for Rect { min: [left, upper], max: [right, lower] } in within() {
            let rows = Rect::new([left, upper - top], [right, lower - top]);
            restore(rows, width as usize, pixels, beneath);
        }
        let mut canvas = Canvas::of_rows(width, rows, pixels)?;
        within().for_each(|rect| self.paint_inside(&mut canvas, rect, hand));
        Ok(())
    }

    /// Paints all primitives inside a rectangle of the canvas.
    fn paint_inside(&self, canvas: &mut Canvas<'_>, rect: Rect, Hand { painter, gathered }: &mut Hand) {
        for (primitive, boxes) in self.primitives.iter().zip(&self.boxes) {
            let egui::epaint::Primitive::Mesh(mesh) = &primitive.primitive else { continue };
            let Some(image) = self.textures.image(mesh.texture_id) else { continue };
            let scissor = gather::to_pixels(primitive.clip_rect, self.pixels_per_point).intersection(rect);
            if scissor.is_empty() {
                continue;
            }
            gathered.gather(mesh, boxes, scissor, self.pixels_per_point, self.order);
            painter.paint(canvas, &[gathered.mesh(scissor, image)]);
        }
    }
}

/// Rows of an image that one thread paints.
struct Band<'p> {
    /// Of the image.
    width: u32,
    /// Their numbers in the image.
    rows: std::ops::Range<u32>,
    pixels: &'p mut [[u8; 4]],
    beneath: &'p [[u8; 4]],
}

/// Copies a rectangle from beneath the interface.
fn restore(rect: Rect, width: usize, pixels: &mut [[u8; 4]], beneath: &[[u8; 4]]) {
    let [left, right] = [rect.min[0] as usize, rect.max[0] as usize];
    for y in rect.min[1] as usize..rect.max[1] as usize {
        let row = y * width + left..y * width + right;
        pixels[row.clone()].copy_from_slice(&beneath[row]);
    }
}

#[cfg(test)]
mod tests;
