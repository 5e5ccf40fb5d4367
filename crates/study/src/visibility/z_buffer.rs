//! The z-buffer (E. Catmull, "A subdivision algorithm for computer display of curved
//! surfaces", 1974): each pixel keeps the nearest depth so far, here in `f32`. Faces come
//! in any order.

use super::{Drawing, Scene, Surface};
use crate::field::Field;

pub(super) fn draw(scene: &Scene) -> Drawing {
    let mut drawing = Drawing::empty(scene.size());
    let mut depths = Field::new(scene.size(), f32::NEG_INFINITY);
    for (number, face) in scene.faces() {
        let Some(surface) = Surface::new(face) else { continue };
        drawing.tests += surface.each_pixel(scene.limits(), |pixel| {
            let place = pixel.map(|part| part as usize);
            let depth = surface.depth(pixel) as f32;
            if depth > depths[place] {
                depths[place] = depth;
                drawing.faces[place] = number;
            }
        });
    }
    drawing
}
