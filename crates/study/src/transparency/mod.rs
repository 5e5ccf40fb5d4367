//! In which order are translucent faces laid over each other? By faces as they come, by
//! bodies, by faces, and by fragments in each pixel.

mod engine;
mod faces;
mod fragments;

#[cfg(test)]
mod tests;

use crate::field::Field;
use crate::metric::Difference;
use crate::random::Random;
use crate::visibility::Scene;

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
    pub fn draw(self, scene: &Scene) -> Field<f64> {
        match self {
            Self::Unsorted => faces::draw(scene, |_| 0),
            Self::ByBody => faces::draw(scene, faces::depth_of_body(scene)),
            Self::ByFace => faces::draw(scene, faces::depth_of_face(scene)),
            Self::ByFragment => fragments::draw(scene),
            Self::Engine => engine::draw(scene),
        }
    }

    /// How far that is from fragments in the right order.
    pub fn error(self, scene: &Scene) -> Difference {
        let (drawn, right) = (self.draw(scene), Self::ByFragment.draw(scene));
        let pairs =
            right.pixels().filter(|(_, light)| **light > 0.0).map(|(place, &light)| [drawn[place], light]);
        Difference::of(pairs)
    }
}

/// How much of what is behind a face shows.
const SHOWS: f64 = 0.5;

/// The light of a face, a number of its own for each.
fn light(face: u32) -> f64 {
    Random::new(face.into()).between(0.1, 1.0)
}
