//! How much of an image can be proven correct, and what the proof costs.

use crate::workloads::{Canvas, Scene, Workload};
use std::num::NonZeroUsize;
use trigon_raster::{Certainty, ExecuteSettings, Rasterizer, TargetError, Tolerance};

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

/// Draws a workload's image and proves it, as often as asked for, on one thread.
pub struct Prover {
    scene: Scene,
    canvas: Canvas<'static>,
}

impl Prover {
    /// An image so many times smaller in each direction. Nothing is drawn yet.
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

    /// Draws the image, and proves under the usual tolerance what can be proven of it.
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
