//! Fragments are kept and sorted in each pixel (L. Carpenter, "The A-buffer, an
//! antialiased hidden surface method", SIGGRAPH 1984, without its masks).

use super::{SHOWS, light};
use crate::field::Field;
use crate::visibility::{Scene, Surface};

pub(super) fn draw(scene: &Scene) -> Field<f64> {
    let mut fragments: Field<Vec<(f64, u32)>> = Field::new(scene.size(), Vec::new());
    for (number, face) in scene.faces() {
        let Some(surface) = Surface::new(face) else { continue };
        surface.each_pixel(scene.limits(), |pixel| {
            fragments[pixel.map(|part| part as usize)].push((surface.depth(pixel), number));
        });
    }
    fragments.map(|fragments| {
        let mut fragments = fragments.clone();
        fragments.sort_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
        fragments.iter().fold(0.0, |below, (_, number)| below * SHOWS + light(*number) * (1.0 - SHOWS))
    })
}
