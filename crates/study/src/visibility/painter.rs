//! The painter's algorithm (M. E. Newell, R. G. Newell and T. L. Sancha, "A solution to
//! the hidden surface problem", ACM Annual Conference 1972) without its cutting of faces:
//! they are sorted by the depth of their middle, and painted one over the other. Faces
//! that cross each other, or overlap in a ring, have no right order.

use super::{Drawing, Scene, Surface};

pub(super) fn draw(scene: &Scene) -> Drawing {
    let mut drawing = Drawing::empty(scene.size());
    let mut order: Vec<(i64, u32)> = scene
        .faces()
        .map(|(number, face)| (face.corners.iter().map(|corner| i64::from(corner[2])).sum(), number))
        .collect();
    order.sort_by(|a, b| {
        drawing.tests += 1;
        a.cmp(b)
    });
    for (_, number) in order {
        let Some(surface) = Surface::new(scene.face(number)) else { continue };
        surface.each_pixel(scene.limits(), |[x, y]| drawing.faces[[x as usize, y as usize]] = number);
    }
    drawing
}
