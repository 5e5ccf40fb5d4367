//! Fragments are stored and sorted in each pixel (L. Carpenter, "The A-buffer, an antialiased hidden surface
//! method", SIGGRAPH 1984, without its masks).

use super::{SHOWS, Way, lights};
use trigon_classic::{Field, Scene, Surface};

/// The fragments of all pixels, in lists that keep their memory.
pub(super) struct Fragments {
    /// The depth and the face of each.
    lists: Field<Vec<(f64, u32)>>,
    lights: Vec<f64>,
    image: Field<f64>,
}

impl Fragments {
    pub(super) fn new(scene: &Scene) -> Self {
        Self {
            lists: Field::new(scene.size(), Vec::new()),
            lights: lights(scene),
            image: Field::new(scene.size(), 0.0),
        }
    }
}

impl Way for Fragments {
    fn draw(&mut self, scene: &Scene) {
        self.lists.values_mut().iter_mut().for_each(Vec::clear);
        for (number, face) in scene.faces() {
            let Some(surface) = Surface::new(face) else { continue };
            surface.each_pixel(scene.limits(), |pixel, depth| {
                self.lists[pixel.map(|part| part as usize)].push((depth, number));
            });
        }
        let lists = self.lists.values_mut().iter_mut();
        for (list, pixel) in lists.zip(self.image.values_mut()) {
            list.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
            *pixel = list.iter().fold(0.0, |below, &(_, number)| {
                below * SHOWS + self.lights[number as usize] * (1.0 - SHOWS)
            });
        }
    }

    fn image(&self) -> Field<f64> {
        self.image.clone()
    }
}
