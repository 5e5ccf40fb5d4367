//! In which order are translucent faces blended? In submission order, sorted by body, sorted by face, and
//! sorted by fragment in each pixel.

mod engine;
mod faces;
mod fragments;

#[cfg(test)]
mod tests;

use crate::metric::Difference;
use crate::oracle::nearness::{self, Nearness};
use engine::Drawer;
use faces::Faces;
use fragments::Fragments;
use std::cmp::Reverse;
use trigon_classic::{Field, Scene};
use trigon_math::SplitMix64;

/// A way to order what is translucent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Transparency {
    /// As faces come.
    Unsorted,
    /// Bodies by the depth of their middle.
    ByBody,
    /// Faces by the depth of their middle.
    ByFace,
    /// Fragments, in each pixel.
    ByFragment,
    /// The renderer.
    Engine,
}

impl Transparency {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Unsorted, Self::ByBody, Self::ByFace, Self::ByFragment, Self::Engine];

    /// The name in tables and plots.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Unsorted => "unsorted",
            Self::ByBody => "sorted by body",
            Self::ByFace => "sorted by face",
            Self::ByFragment => "sorted in each pixel",
            Self::Engine => "engine",
        }
    }

    /// The light of each pixel before black, every face letting half of it through.
    #[must_use]
    pub fn draw(self, scene: &Scene) -> Field<f64> {
        let mut way = self.way(scene);
        way.draw(scene);
        way.image()
    }

    /// What draws a scene again and again, with all memory kept.
    #[must_use]
    pub fn repeated(self, scene: &Scene) -> Box<dyn FnMut() + '_> {
        let mut way = self.way(scene);
        Box::new(move || way.draw(scene))
    }

    fn way(self, scene: &Scene) -> Box<dyn Way> {
        match self {
            Self::Unsorted => Box::new(Faces::new(scene, |_, _| 0)),
            Self::ByBody => Box::new(Faces::new(scene, faces::depth_of_body)),
            Self::ByFace => Box::new(Faces::new(scene, faces::depth_of_face)),
            Self::ByFragment => Box::new(Fragments::new(scene)),
            Self::Engine => Box::new(Drawer::new(scene)),
        }
    }

    /// How far that is from [`exact`].
    #[must_use]
    pub fn error(self, scene: &Scene, exact: &Field<f64>) -> Difference {
        let drawn = self.draw(scene);
        let pairs = exact.pixels().filter(|(_, light)| **light > 0.0);
        Difference::of(pairs.map(|(place, &light)| [drawn[place], light]))
    }
}

/// A way to order faces, with the memory that it draws in.
trait Way {
    fn draw(&mut self, scene: &Scene);

    /// What was drawn last.
    fn image(&self) -> Field<f64>;
}

/// The light of each pixel with all faces in the order of their [`Nearness`], of equal ones the
/// later first.
#[must_use]
pub fn exact(scene: &Scene) -> Field<f64> {
    let mut layers: Field<Vec<(Nearness, Reverse<u32>)>> = Field::new(scene.size(), Vec::new());
    for (number, face) in scene.faces() {
        for pixel in nearness::pixels(face.corners, scene.size()) {
            let nearness = Nearness::of(face.corners, pixel);
            layers[pixel.map(|part| part as usize)]
                .extend(nearness.map(|nearness| (nearness, Reverse(number))));
        }
    }
    layers.values_mut().iter_mut().for_each(|layers| layers.sort());
    layers.map(|layers| layers.iter().fold(0.0, |below, (_, Reverse(face))| (below + light(*face)) / 2.0))
}

/// How much of what is behind a face shows.
const SHOWS: f64 = 0.5;

/// The light of a face, a number of its own for each.
fn light(face: u32) -> f64 {
    SplitMix64::new(face.into()).between(0.1, 1.0)
}

/// The lights of all faces of a scene.
fn lights(scene: &Scene) -> Vec<f64> {
    scene.faces().map(|(number, _)| light(number)).collect()
}
