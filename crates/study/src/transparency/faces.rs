//! Whole faces blended one after the other, the farthest first (T. Porter and T. Duff, "Compositing digital
//! images", SIGGRAPH 1984).

use super::{SHOWS, Way, lights};
use trigon_classic::{Field, Scene, Surface};

/// What faces are sorted by, in ascending order.
type Key = fn(&Scene, u32) -> i64;

/// Faces in the order of a key; equal ones as they come.
pub(super) struct Faces {
    key: Key,
    order: Vec<u32>,
    lights: Vec<f64>,
    image: Field<f64>,
}

impl Faces {
    pub(super) fn new(scene: &Scene, key: Key) -> Self {
        Self { key, order: Vec::new(), lights: lights(scene), image: Field::new(scene.size(), 0.0) }
    }
}

impl Way for Faces {
    fn draw(&mut self, scene: &Scene) {
        let Self { key, order, lights, image } = self;
        order.clear();
        order.extend(scene.faces().map(|(number, _)| number));
        order.sort_by_key(|&number| key(scene, number));
        image.clear(0.0);
        for &number in &*order {
            let Some(surface) = Surface::new(scene.face(number)) else { continue };
            let light = lights[number as usize] * (1.0 - SHOWS);
            surface.each_pixel(scene.limits(), |pixel, _| {
                let below = &mut image[pixel.map(|part| part as usize)];
                *below = *below * SHOWS + light;
            });
        }
    }

    fn image(&self) -> Field<f64> {
        self.image.clone()
    }
}

/// Three times the depth of a face's middle.
pub(super) fn depth_of_face(scene: &Scene, number: u32) -> i64 {
    scene.face(number).corners.iter().map(|corner| i64::from(corner[2])).sum()
}

/// The depth of the middle of a face's body.
pub(super) fn depth_of_body(scene: &Scene, number: u32) -> i64 {
    let corners = &scene.bodies()[scene.face(number).body].corners;
    corners.iter().map(|corner| i64::from(corner[2])).sum::<i64>() / corners.len() as i64
}
