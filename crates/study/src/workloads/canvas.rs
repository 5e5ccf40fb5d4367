//! Draws a workload with the rasterizer. The only file here that uses it.

use super::pipelines::{BlinnPhong, Flat, Gouraud, Textured};
use super::{Scene, Shading};
use trigon_math::Vec4;
use trigon_raster::{
    Background, Certificate, Draw, LanePipeline, Output, Pass, Rasterizer, Stats, Target, TargetError,
    Tolerance,
};

/// The caller's pixels and what it takes to draw into them, kept from frame to
/// frame.
pub struct Canvas<'a> {
    rasterizer: Rasterizer,
    target: Target<'a>,
}

impl<'a> Canvas<'a> {
    /// An image of the scene's size and samples in `pixels`: row-major from the
    /// top left, plain RGBA8, [`Scene::pixel_count`] of them.
    ///
    /// # Errors
    /// [`TargetError`] when there cannot be one.
    pub fn new(
        rasterizer: Rasterizer,
        scene: &Scene,
        pixels: &'a mut [[u8; 4]],
    ) -> Result<Self, TargetError> {
        let target = Target::new(scene.size.x, scene.size.y, &[])?.with_unorm8(pixels)?;
        Self { rasterizer, target }.sampled(scene)
    }

    /// The same in memory of its own; see [`pixels`](Self::pixels).
    ///
    /// # Errors
    /// [`TargetError`] when there cannot be one.
    pub fn with_own_pixels(rasterizer: Rasterizer, scene: &Scene) -> Result<Canvas<'static>, TargetError> {
        let target = Target::new(scene.size.x, scene.size.y, &[Output::Unorm8])?;
        Canvas { rasterizer, target }.sampled(scene)
    }

    fn sampled(self, scene: &Scene) -> Result<Self, TargetError> {
        let target =
            self.target.with_samples_per_axis(scene.samples_per_axis)?.with_samples(scene.samples)?;
        Ok(Self { target, ..self })
    }

    /// The image as it was drawn last.
    #[must_use]
    pub fn pixels(&self) -> &[[u8; 4]] {
        self.target.unorm8().expect("every canvas has these pixels")
    }

    /// Draws one frame of a scene of the same size and samples, and tells what it
    /// took; the image is complete when this returns.
    pub fn draw(&mut self, scene: &Scene) -> Stats {
        let Self { rasterizer, target } = self;
        recorded(scene, |pass| rasterizer.draw(pass, target))
    }

    /// Proves which pixels of such a frame stay as they are within a tolerance.
    ///
    /// # Errors
    /// Not enough memory.
    pub fn certify(&mut self, scene: &Scene, tolerance: Tolerance) -> Result<Certificate, TargetError> {
        recorded(scene, |pass| self.rasterizer.certify(pass, &self.target, tolerance))
    }
}

/// Does something with the pass of a frame.
fn recorded<R>(scene: &Scene, then: impl FnOnce(&Pass<'_>) -> R) -> R {
    match &scene.shading {
        Shading::Flat => with(&Flat(scene), scene, then),
        Shading::Gouraud => with(&Gouraud(scene), scene, then),
        Shading::BlinnPhong => with(&BlinnPhong(scene), scene, then),
        Shading::Textured(texture) => with(&Textured { scene, texture }, scene, then),
    }
}

fn with<R>(pipeline: &impl LanePipeline, scene: &Scene, then: impl FnOnce(&Pass<'_>) -> R) -> R {
    let background = Vec4::from(Scene::BACKGROUND.map(f32::from)) / 255.0;
    let mut pass = Pass::new();
    pass.background(Background::Color(background));
    pass.triangles(Draw { culling: scene.culling, ..Draw::new(pipeline, &scene.mesh.triangles) });
    then(&pass)
}
