//! The z-buffer (E. Catmull, "A subdivision algorithm for computer display of curved surfaces", 1974): each
//! pixel stores the nearest depth so far, here in `f32`. Faces come in any order.

use super::Field;
use super::{Drawing, Scene, Surface};

/// An image with its depths, kept from frame to frame.
pub(super) struct Buffers {
    drawing: Drawing,
    depths: Field<f32>,
}

impl Buffers {
    pub(super) fn new(scene: &Scene) -> Self {
        Self { drawing: Drawing::empty(scene.size()), depths: Field::new(scene.size(), f32::NEG_INFINITY) }
    }

    pub(super) fn draw(&mut self, scene: &Scene) -> &Drawing {
        let Self { drawing, depths } = self;
        drawing.clear();
        depths.clear(f32::NEG_INFINITY);
        for (number, face) in scene.faces() {
            let Some(surface) = Surface::new(face) else { continue };
            drawing.tests += surface.each_pixel(scene.limits(), |pixel, depth| {
                let index = pixel.map(|part| part as usize);
                let depth = depth as f32;
                if depth > depths[index] {
                    depths[index] = depth;
                    drawing.faces[index] = number;
                }
            });
        }
        drawing
    }
}
