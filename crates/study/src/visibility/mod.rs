//! Which face is visible in each pixel? The algorithms that source D discusses (row D5), two that it leaves out, and
//! the renderer.
//!
//! The algorithms are those of [`trigon_classic`]; here are the cases that tell them apart, and what is wrong in
//! their images.

mod cases;

use trigon_classic::{DEPTH_LIMIT, Drawing, Field, Method, NotConvex, STEPS_PER_PIXEL, Scene};
use trigon_math::{DVec2, Vec4};
use trigon_raster::Output;

use super::engine::{Corners, Engine, clip_position, target};
use super::oracle::depth;
use super::oracle::depth::Nearness;

pub use cases::{VisibilityCase, balls, sheets};

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
            Self::Engine => Ok(draw(scene)),
        }
    }

    /// What draws a scene again and again, with memory, trees and what else is the same for any
    /// ray kept; a scene that is refused takes no time.
    #[must_use]
    pub fn repeated(self, scene: &Scene) -> Box<dyn FnMut() + '_> {
        match self {
            Self::Classic(method) => method.repeated(scene),
            Self::Engine => Box::new(repeated(scene)),
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

fn draw(scene: &Scene) -> Drawing {
    let shape = Corners::new(clip_corners(scene));
    Drawing { faces: Engine::default().visible(&shape, scene.size()), tests: 0 }
}

/// Draws again and again, into the same target.
fn repeated(scene: &Scene) -> impl FnMut() + use<> {
    let (mut engine, mut target) = (Engine::default(), target(scene.size(), &[Output::Triangle]));
    let shape = Corners::new(clip_corners(scene));
    move || engine.draw(&shape, &mut target)
}

/// The corners of all faces, three for each, as the engine takes them.
pub(crate) fn clip_corners(scene: &Scene) -> Vec<Vec4> {
    let position = |[x, y, z]: [i32; 3]| {
        let point = DVec2::new(x.into(), y.into()) / f64::from(STEPS_PER_PIXEL);
        clip_position(point, f64::from(z) / f64::from(DEPTH_LIMIT), scene.size())
    };
    scene.faces().flat_map(|(_, face)| face.corners.map(position)).collect()
}

/// What is wrong with an image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OrderErrors {
    /// Pixels that show anything, as they should.
    pub visible: usize,
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
        for (position, nearest) in nearest.pixels() {
            let pixel = position.map(|part| part as i32);
            let face = (shown[position] != u32::MAX).then(|| scene.face(shown[position]));
            let found = face.and_then(|face| Nearness::of(face.corners, pixel));
            let is_right = face.is_some() == nearest.is_some() && found == *nearest;
            errors.visible += usize::from(nearest.is_some());
            errors.misordered += usize::from(!is_right);
        }
        errors
    }

    /// Misordered pixels for a thousand that show anything.
    #[must_use]
    pub fn per_mille(&self) -> f64 {
        1e3 * self.misordered as f64 / self.visible as f64
    }
}

/// The nearest of all faces in each pixel.
fn nearest(scene: &Scene) -> Field<Option<Nearness>> {
    let mut nearest: Field<Option<Nearness>> = Field::new(scene.size(), None);
    for (_, face) in scene.faces() {
        for pixel in depth::pixels(face.corners, scene.size()) {
            let best = &mut nearest[pixel.map(|part| part as usize)];
            *best = (*best).max(Nearness::of(face.corners, pixel));
        }
    }
    nearest
}

#[cfg(test)]
mod tests;
