//! Which share of a picture is proven, and what proving it takes.

use crate::workloads::{Canvas, Scene, Workload};
use trigon_raster::{Certainty, Rasterizer, TargetError, Tolerance};

/// Shares of the pixels that show anything, together 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Certified {
    /// Proven to stay as they are.
    pub certified: f64,
    /// May come to see something else.
    pub visibility: f64,
    /// See the same, but a byte may change.
    pub color: f64,
}

/// Draws a workload's picture and proves it, as often as asked for.
pub struct Prover {
    scene: Scene,
    pixels: Vec<[u8; 4]>,
}

impl Prover {
    /// A picture so many times smaller in each direction. Nothing is drawn yet.
    pub fn new(workload: Workload, shrink: u32) -> Self {
        let mut scene = workload.scene();
        scene.size /= shrink.max(1);
        let pixels = vec![[0; 4]; scene.pixel_count()];
        Self { scene, pixels }
    }

    /// Draws the picture.
    ///
    /// # Errors
    /// Not enough memory.
    pub fn draw(&mut self) -> Result<(), TargetError> {
        Canvas::new(Rasterizer::default(), &self.scene, &mut self.pixels)?.draw(&self.scene);
        Ok(())
    }

    /// Draws the picture, and proves under the usual tolerance what can be proven of it.
    ///
    /// # Errors
    /// Not enough memory.
    pub fn prove(&mut self) -> Result<Certified, TargetError> {
        let mut canvas = Canvas::new(Rasterizer::default(), &self.scene, &mut self.pixels)?;
        canvas.draw(&self.scene);
        let certificate = canvas.certify(&self.scene, Tolerance::default())?;
        let drawn = self.pixels.iter().zip(certificate.pixels());
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
