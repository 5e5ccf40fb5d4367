//! How much of an image can be proven correct, and what the proof costs.

use crate::workloads::{Canvas, Scene, Workload};
use std::num::NonZeroUsize;
use trigon_raster::{Certainty, ExecuteSettings, Rasterizer, TargetError, Tolerance};

/// Fractions of the pixels that show any surface; their sum is 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Certified {
    /// Proven not to change.
    pub certified: f64,
    /// The visible triangle may change.
    pub visibility: f64,
    /// The visible triangle does not change, but a byte may.
    pub color: f64,
}

/// Draws a workload's image and certifies it, repeatedly, on one thread.
pub struct Prover {
    scene: Scene,
    canvas: Canvas<'static>,
}

impl Prover {
    /// An image smaller by this factor in each direction. Nothing is drawn yet.
    ///
    /// # Errors
    /// Not enough memory.
    pub fn new(workload: Workload, shrink: u32) -> Result<Self, TargetError> {
        let mut scene = workload.scene();
        scene.size /= shrink.max(1);
        let settings = ExecuteSettings { threads: Some(NonZeroUsize::MIN), ..Default::default() };
        let rasterizer = Rasterizer::new(settings).expect("no SIMD level was asked for");
        let canvas = Canvas::with_own_pixels(rasterizer, &scene)?;
        Ok(Self { scene, canvas })
    }

    /// Width and height of the image in pixels.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        self.scene.size.to_array().map(|side| side as usize)
    }

    /// Draws the image.
    pub fn draw(&mut self) {
        self.canvas.draw(&self.scene);
    }

    /// Draws the image, and certifies what can be proven of it under the usual tolerance.
    ///
    /// # Errors
    /// Not enough memory.
    pub fn prove(&mut self) -> Result<Certified, TargetError> {
        self.canvas.draw(&self.scene);
        let certificate = self.canvas.certify(&self.scene, Tolerance::default())?;
        let drawn = self.canvas.pixels().iter().zip(certificate.pixels());
        let drawn = drawn.filter(|(color, _)| **color != Scene::BACKGROUND).map(|(_, certainty)| *certainty);
        let mut counts = [0.0; 3];
        drawn.for_each(|certainty| counts[certainty as usize] += 1.0);
        let all = counts.iter().sum::<f64>().max(1.0);
        let share = |certainty: Certainty| counts[certainty as usize] / all;
        Ok(Certified {
            certified: share(Certainty::Certified),
            visibility: share(Certainty::Visibility),
            color: share(Certainty::Color),
        })
    }
}
