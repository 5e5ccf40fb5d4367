//! The painter's algorithm (M. E. Newell, R. G. Newell and T. L. Sancha, "A solution to the hidden surface
//! problem", ACM Annual Conference 1972) without splitting faces. Faces are sorted by the depth of their centres
//! and painted in that order. For faces that intersect, or overlap in a cycle, no order is correct.

use super::{Drawing, Scene, Surface};

/// An image and the order of faces, in memory that is kept from frame to frame.
pub(super) struct Painter {
    drawing: Drawing,
    order: Vec<(i64, u32)>,
}

impl Painter {
    pub(super) fn new(scene: &Scene) -> Self {
        Self { drawing: Drawing::empty(scene.size()), order: Vec::new() }
    }

    pub(super) fn draw(&mut self, scene: &Scene) -> &Drawing {
        let Self { drawing, order } = self;
        drawing.clear();
        order.clear();
        let depth = |corners: [super::Corner; 3]| corners.iter().map(|corner| i64::from(corner[2])).sum();
        order.extend(scene.faces().map(|(number, face)| (depth(face.corners), number)));
        order.sort_by(|a, b| {
            drawing.tests += 1;
            a.cmp(b)
        });
        for &(_, number) in &*order {
            let Some(surface) = Surface::new(scene.face(number)) else { continue };
            surface.each_pixel(scene.limits(), |[x, y], _| drawing.faces[[x as usize, y as usize]] = number);
        }
        drawing
    }
}
