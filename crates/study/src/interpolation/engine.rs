//! The engine's varyings.

use super::Wall;
use super::wall::{TRIANGLES, WallImage};
use crate::engine::{Engine, clip_position, field, target};
use trigon_math::{DVec2, Vec4};
use trigon_raster::simd::{F32, Simd, prelude::*};
use trigon_raster::{Culling, Draw, FragmentLanes, LanePipeline, Output, Pass, Target, VertexLanes};

/// Corners in clip space with their texels: texels are the colours.
struct Vertices {
    positions: [Vec4; 4],
    texels: [[f32; 2]; 4],
}

impl LanePipeline for Vertices {
    const VARYINGS: usize = 2;

    fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        let mut columns = [[0.0; 8]; 6];
        let lanes = vertices.first()..vertices.first() + vertices.count();
        for (lane, vertex) in lanes.enumerate() {
            let [x, y, z, w] = self.positions[vertex].to_array();
            let [u, v] = self.texels[vertex];
            for (column, value) in columns.iter_mut().zip([x, y, z, w, u, v]) {
                column[lane] = value;
            }
        }
        let [x, y, z, w, u, v] = columns.map(|column| F32::simd_from(simd, column));
        vertices.set(0, u);
        vertices.set(1, v);
        [x, y, z, w]
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let [u, v] = fragments.varyings(0);
        [u, v, F32::splat(simd, 0.0), F32::splat(simd, 1.0)]
    }
}

/// A wall and what it takes to draw it again and again.
pub(super) struct Drawer {
    vertices: Vertices,
    engine: Engine,
    target: Target<'static>,
}

impl Drawer {
    pub(super) fn new(wall: &Wall) -> Self {
        let position = |corner: super::wall::Corner| {
            let [x, y] = corner.place.map(|part| f64::from(part) / 256.0);
            clip_position(DVec2::new(x, y), 0.1, wall.size) * corner.distance as f32
        };
        let vertices = Vertices {
            positions: wall.corners.map(position),
            texels: wall.corners.map(|corner| corner.texel.map(|part| part as f32)),
        };
        Self { vertices, engine: Engine::default(), target: target(wall.size, &[Output::Linear]) }
    }

    pub(super) fn draw(&mut self) {
        let triangles = TRIANGLES.map(|triangle| triangle.map(|index| index as u32));
        let mut pass = Pass::new();
        pass.triangles(Draw { culling: Culling::None, ..Draw::new(&self.vertices, &triangles) });
        self.engine.rasterizer.draw(&pass, &mut self.target);
    }

    pub(super) fn image(&self) -> WallImage {
        let size = [self.target.width(), self.target.height()].map(|side| side as usize);
        field(size, self.target.linear()).map(|color| (color.w > 0.0).then_some([color.x, color.y]))
    }
}
