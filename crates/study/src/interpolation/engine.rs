//! The renderer's varyings.

use super::wall::TRIANGLES;
use super::{Texel, Wall};
use crate::engine::{Engine, clip_position, field, target};
use crate::field::Field;
use trigon_math::{DVec2, Vec4};
use trigon_raster::{Culling, Draw, Fragment, Output, Pass, Pipeline, VertexOutput};

impl Pipeline for Wall {
    type Varyings = Texel;

    fn vertex_count(&self) -> usize {
        self.corners.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<Texel> {
        let corner = self.corners[index];
        let [x, y] = corner.place.map(|part| part as f64 / 256.0);
        let position = clip_position(DVec2::new(x, y), 0.1, self.size) * corner.distance as f32;
        VertexOutput { position, varyings: corner.texel.map(|part| part as f32) }
    }

    fn fragment(&self, fragment: &Fragment<Texel>) -> Vec4 {
        let [u, v] = fragment.varyings;
        Vec4::new(u, v, 0.0, 1.0)
    }
}

pub(super) fn draw(wall: &Wall) -> Field<Option<Texel>> {
    let triangles = TRIANGLES.map(|triangle| triangle.map(|index| index as u32));
    let mut target = target(wall.size, &[Output::Linear]);
    let mut pass = Pass::new();
    pass.triangles(Draw { culling: Culling::None, ..Draw::new(wall, &triangles) });
    Engine::default().rasterizer.draw(&pass, &mut target);
    field(wall.size, target.linear()).map(|color| (color.w > 0.0).then_some([color.x, color.y]))
}
