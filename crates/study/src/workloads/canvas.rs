//! The only file here that drives the rasterizer.

use super::pipelines::{BlinnPhong, Flat, Gouraud, Textured};
use super::{Scene, Shading};
use trigon_math::Vec4;
use trigon_raster::{Background, Draw, LanePipeline, Pass, Rasterizer, Stats, Target, TargetError};

/// The caller's pixels and what it takes to draw into them, kept from frame to
/// frame.
pub struct Canvas<'a> {
    rasterizer: Rasterizer,
    target: Target<'a>,
}

impl<'a> Canvas<'a> {
    /// A picture of the scene's size and samples in `pixels`: row-major from the
    /// top left, plain RGBA8, [`Scene::pixel_count`] of them.
    ///
    /// # Errors
    /// [`TargetError`] when there cannot be one.
    pub fn new(
        rasterizer: Rasterizer,
        scene: &Scene,
        pixels: &'a mut [[u8; 4]],
    ) -> Result<Self, TargetError> {
        let target =
            Target::new(scene.size.x, scene.size.y, &[])?.with_unorm8(pixels)?.with_samples(scene.samples)?;
        Ok(Self { rasterizer, target })
    }

    /// Draws one frame of a scene of the same size and samples, and tells what it
    /// took; the picture is complete when this returns.
    pub fn draw(&mut self, scene: &Scene) -> Stats {
        match &scene.shading {
            Shading::Flat => self.draw_with(&Flat(scene), scene),
            Shading::Gouraud => self.draw_with(&Gouraud(scene), scene),
            Shading::BlinnPhong => self.draw_with(&BlinnPhong(scene), scene),
            Shading::Textured(texture) => self.draw_with(&Textured { scene, texture }, scene),
        }
    }

    fn draw_with(&mut self, pipeline: &impl LanePipeline, scene: &Scene) -> Stats {
        let background = Vec4::from(Scene::BACKGROUND.map(f32::from)) / 255.0;
        let mut pass = Pass::new();
        pass.background(Background::Color(background));
        pass.triangles(Draw { culling: scene.culling, ..Draw::new(pipeline, &scene.mesh.triangles) });
        self.rasterizer.draw(&pass, &mut self.target)
    }
}
