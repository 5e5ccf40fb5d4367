//! Which face is visible in each pixel? The algorithms that source D discusses (row D5), two that it leaves out, and
//! the renderer.
//!
//! The algorithms are those of [`trigon_classic`]; here are the cases that tell them apart, and what is wrong in
//! their images.

mod cases;
mod engine;
mod errors;

#[cfg(test)]
mod tests;

pub use cases::{Case, balls, sheets};
pub use errors::OrderErrors;

pub(crate) use engine::clip_corners;

use trigon_classic::{Drawing, Method, NotConvex, Scene};

/// A way to find the nearest face of each pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Visibility {
    /// One of the classical algorithms.
    Classic(Method),
    /// The renderer.
    Engine,
}

impl Visibility {
    /// All of them: the classical ones in the order of [`Method::ALL`], then the renderer.
    pub const ALL: [Self; 7] = {
        let mut all = [Self::Engine; 7];
        let mut index = 0;
        while index < Method::ALL.len() {
            all[index] = Self::Classic(Method::ALL[index]);
            index += 1;
        }
        all
    };

    /// The name in tables and plots.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Classic(method) => method.name(),
            Self::Engine => "engine",
        }
    }

    /// What is counted as a test; empty where nothing is.
    #[must_use]
    pub fn test(self) -> &'static str {
        match self {
            Self::Classic(method) => method.test(),
            Self::Engine => "",
        }
    }

    /// Draws a scene.
    ///
    /// # Errors
    /// Roberts' algorithm refuses bodies that are not convex.
    pub fn draw(self, scene: &Scene) -> Result<Drawing, NotConvex> {
        match self {
            Self::Classic(method) => method.draw(scene),
            Self::Engine => Ok(engine::draw(scene)),
        }
    }

    /// What draws a scene again and again, with memory, trees and what else is the same for any
    /// ray kept; a scene that is refused takes no time.
    #[must_use]
    pub fn repeated(self, scene: &Scene) -> Box<dyn FnMut() + '_> {
        match self {
            Self::Classic(method) => method.repeated(scene),
            Self::Engine => Box::new(engine::repeated(scene)),
        }
    }

    /// What draws a scene again and again with nothing kept.
    #[must_use]
    pub fn repeated_anew(self, scene: &Scene) -> Box<dyn FnMut() + '_> {
        Box::new(move || drop(self.draw(scene)))
    }

    /// Whether [`repeated`](Self::repeated) keeps anything.
    #[must_use]
    pub fn keeps_state(self) -> bool {
        match self {
            Self::Classic(method) => method.keeps_state(),
            Self::Engine => true,
        }
    }
}
