//! The renderer's translucent surfaces, which it sorts in each sample.

use super::{SHOWS, light};
use crate::engine::{Engine, field, target};
use crate::field::Field;
use crate::visibility::{Scene, clip_corners};
use trigon_math::Vec4;
use trigon_raster::{Culling, Draw, Fragment, Output, Pass, Pipeline, Surface, VertexOutput};

/// Faces with corners of their own.
struct Faces {
    corners: Vec<Vec4>,
}

impl Pipeline for Faces {
    type Varyings = ();

    fn vertex_count(&self) -> usize {
        self.corners.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        VertexOutput { position: self.corners[index], varyings: () }
    }

    fn fragment(&self, fragment: &Fragment<()>) -> Vec4 {
        let alpha = (1.0 - SHOWS) as f32;
        (Vec4::splat(light(fragment.triangle) as f32) * alpha).with_w(alpha)
    }
}

pub(super) fn draw(scene: &Scene) -> Field<f64> {
    let faces = Faces { corners: clip_corners(scene) };
    let triangles: Vec<[u32; 3]> =
        (0..scene.face_count() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let mut target = target(scene.size(), &[Output::Linear]);
    let mut pass = Pass::new();
    let surface = Surface::Translucent;
    pass.triangles(Draw { surface, culling: Culling::None, ..Draw::new(&faces, &triangles) });
    Engine::default().rasterizer.draw(&pass, &mut target);
    field(scene.size(), target.linear()).map(|color| color.x.into())
}
