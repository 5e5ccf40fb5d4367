//! Faces laid over each other one after the other (T. Porter and T. Duff, "Compositing
//! digital images", SIGGRAPH 1984), the farthest first.

use super::{SHOWS, light};
use crate::field::Field;
use crate::visibility::{Scene, Surface};

/// In ascending order of a key; equal ones as they come.
pub(super) fn draw(scene: &Scene, key: impl Fn(u32) -> i64) -> Field<f64> {
    let mut order: Vec<u32> = scene.faces().map(|(number, _)| number).collect();
    order.sort_by_key(|&number| key(number));
    let mut picture = Field::new(scene.size(), 0.0);
    for number in order {
        let Some(surface) = Surface::new(scene.face(number)) else { continue };
        let light = light(number) * (1.0 - SHOWS);
        surface.each_pixel(scene.limits(), |pixel| {
            let below = &mut picture[pixel.map(|part| part as usize)];
            *below = *below * SHOWS + light;
        });
    }
    picture
}

/// Three times the depth of a face's middle.
pub(super) fn depth_of_face(scene: &Scene) -> impl Fn(u32) -> i64 {
    |number| scene.face(number).corners.iter().map(|corner| i64::from(corner[2])).sum()
}

/// The depth of the middle of a face's body.
pub(super) fn depth_of_body(scene: &Scene) -> impl Fn(u32) -> i64 {
    |number| {
        let corners = &scene.bodies()[scene.face(number).body].corners;
        corners.iter().map(|corner| i64::from(corner[2])).sum::<i64>() / corners.len() as i64
    }
}
