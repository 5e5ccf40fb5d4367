//! Counts the pixels that show the wrong face, in exact integers.

use crate::oracle::nearness::{self, Nearness};
use trigon_classic::{Field, Scene};

/// What is wrong with an image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OrderErrors {
    /// Pixels that show anything, as they should.
    pub seen: usize,
    /// Pixels that show a face which is not there, or not the nearest (or one of the
    /// nearest) there, or the background where there is a face.
    pub misordered: usize,
}

impl OrderErrors {
    /// Of an image of a scene.
    #[must_use]
    pub fn of(scene: &Scene, shown: &Field<u32>) -> Self {
        let nearest = nearest(scene);
        let mut errors = Self::default();
        for (place, nearest) in nearest.pixels() {
            let pixel = place.map(|part| part as i32);
            let face = (shown[place] != u32::MAX).then(|| scene.face(shown[place]));
            let found = face.and_then(|face| Nearness::of(face.corners, pixel));
            let is_right = face.is_some() == nearest.is_some() && found == *nearest;
            errors.seen += usize::from(nearest.is_some());
            errors.misordered += usize::from(!is_right);
        }
        errors
    }

    /// Misordered pixels for a thousand that show anything.
    #[must_use]
    pub fn per_mille(&self) -> f64 {
        1e3 * self.misordered as f64 / self.seen as f64
    }
}

/// The nearest of all faces in each pixel.
fn nearest(scene: &Scene) -> Field<Option<Nearness>> {
    let mut nearest: Field<Option<Nearness>> = Field::new(scene.size(), None);
    for (_, face) in scene.faces() {
        for pixel in nearness::pixels(face.corners, scene.size()) {
            let best = &mut nearest[pixel.map(|part| part as usize)];
            *best = (*best).max(Nearness::of(face.corners, pixel));
        }
    }
    nearest
}
