//! The engine's method: one lasting thread pool, whose threads take tiles of the image in turn.

use super::Corner;
use crate::engine::{Corners, Engine, clip_position, field, target};
use std::num::NonZeroUsize;
use trigon_classic::Field;
use trigon_math::DVec2;
use trigon_raster::{Output, Target};

/// An image that is drawn by several threads again and again.
pub struct Shared {
    engine: Engine,
    target: Target<'static>,
    shape: Corners,
}

impl Shared {
    /// Faces, with a number of threads; 0 counts as 1.
    #[must_use]
    pub fn new(faces: &[[Corner; 3]], size: [usize; 2], threads: usize) -> Self {
        let position = |&[x, y, distance]: &Corner| {
            // The source's pixels have their centres at whole numbers.
            clip_position(DVec2::new(x, y) + 0.5, 0.5, size) * distance as f32
        };
        let shape = Corners::new(faces.as_flattened().iter().map(position).collect());
        let threads = NonZeroUsize::new(threads).unwrap_or(NonZeroUsize::MIN);
        let outputs = [Output::Srgb8, Output::Depth, Output::Triangle, Output::Object];
        Self { engine: Engine::with_threads(threads), target: target(size, &outputs), shape }
    }

    /// Draws the image.
    pub fn draw(&mut self) {
        self.engine.draw(&self.shape, &mut self.target);
    }

    /// The number of the face in each pixel, `u32::MAX` for none.
    #[must_use]
    pub fn faces(&self) -> Field<u32> {
        let size = [self.target.width(), self.target.height()].map(|side| side as usize);
        field(size, self.target.triangles())
    }
}
