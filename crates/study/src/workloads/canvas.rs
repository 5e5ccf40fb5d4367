//! The only file here that drives the rasterizer.

use super::pipelines::{BlinnPhong, Flat, Gouraud, Textured};
use super::{Scene, Shading};
use trigon_math::Vec4;
use trigon_raster::{Background, Draw, ExecuteSettings, Output, Pass, Pipeline, Target, TargetError};

/// A picture and what it takes to draw into it, kept from frame to frame.
pub struct Canvas {
    settings: ExecuteSettings,
    target: Target,
    pixels: Vec<[u8; 4]>,
}

impl Canvas {
    /// A picture of the scene's size and samples.
    ///
    /// # Errors
    /// [`TargetError`] when there cannot be one.
    pub fn new(scene: &Scene, settings: ExecuteSettings) -> Result<Self, TargetError> {
        let target = Target::new(scene.size.x, scene.size.y, &[Output::Linear])?
            .with_samples_per_axis(scene.samples.isqrt())?;
        let pixels = vec![[0; 4]; scene.size.element_product() as usize];
        Ok(Self { settings, target, pixels })
    }

    /// Draws one frame of a scene of the same size and samples; the picture is
    /// complete when this returns.
    pub fn draw(&mut self, scene: &Scene) {
        match &scene.shading {
            Shading::Flat => self.execute(scene, &Flat(scene)),
            Shading::Gouraud => self.execute(scene, &Gouraud(scene)),
            Shading::BlinnPhong => self.execute(scene, &BlinnPhong(scene)),
            Shading::Textured(texture) => self.execute(scene, &Textured { scene, texture }),
        }
    }

    fn execute(&mut self, scene: &Scene, pipeline: &impl Pipeline) {
        let background = Vec4::from(Scene::BACKGROUND.map(f32::from)) / 255.0;
        let mut pass = Pass::new();
        pass.background(Background::Color(background));
        pass.triangles(Draw { culling: scene.culling, ..Draw::new(pipeline, &scene.mesh.triangles) });
        pass.execute(&mut self.target, &self.settings);
        let linear = self.target.linear().expect("it was asked for");
        for (pixel, color) in self.pixels.iter_mut().zip(linear) {
            *pixel = color.to_array().map(|channel| (channel.clamp(0.0, 1.0) * 255.0 + 0.5) as u8);
        }
    }

    /// The picture: row-major from the top left, plain RGBA8.
    pub fn pixels(&self) -> &[[u8; 4]] {
        &self.pixels
    }
}
