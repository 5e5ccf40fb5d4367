//! The engine with several samples per pixel.

use super::Star;
use crate::engine::{Corners, Engine, clip_position, field, target};
use crate::oracle::STEPS;
use trigon_classic::Field;
use trigon_math::DVec2;
use trigon_raster::{Output, Target};

/// A star, with what is kept to draw it repeatedly.
pub(super) struct Drawer {
    engine: Engine,
    target: Target<'static>,
    shape: Corners,
}

impl Drawer {
    pub(super) fn new(star: &Star, samples: u32, samples_per_axis: u32) -> Self {
        let size = [star.side; 2];
        let corners = star.triangles.as_flattened().iter();
        let position =
            |&[x, y]: &[i32; 2]| clip_position(DVec2::new(x.into(), y.into()) / f64::from(STEPS), 0.5, size);
        let shape = Corners::new(corners.map(position).collect());
        let target = target(size, &[Output::Linear]).with_samples(samples).expect("a standard number");
        let target = target.with_samples_per_axis(samples_per_axis).expect("up to four are possible");
        Self { engine: Engine::default(), target, shape }
    }

    pub(super) fn draw(&mut self) {
        self.engine.draw(&self.shape, &mut self.target);
    }

    /// The covered fraction of each pixel.
    pub(super) fn shares(&self) -> Field<f64> {
        let size = [self.target.width(), self.target.height()].map(|side| side as usize);
        field(size, self.target.linear()).map(|color| f64::from(color.x))
    }
}
