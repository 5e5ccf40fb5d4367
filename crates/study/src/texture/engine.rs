//! The floor drawn by the engine: two triangles, and one texture look-up per pixel.

use super::{Ground, TextureFilter};
use crate::engine::{Engine, clip_position, field, positions, target};
use trigon_classic::Field;
use trigon_math::{DVec2, Vec4};
use trigon_raster::simd::{F32, Simd, prelude::*};
use trigon_raster::{
    Culling, Draw, FragmentLanes, LanePipeline, Output, Pass, Sampler, Target, Texture, VertexLanes,
};

/// The corners of the floor on the image, with their texture coordinates.
struct Floor {
    positions: Vec<Vec4>,
    coordinates: [[f32; 8]; 2],
}

impl Floor {
    fn new(ground: &Ground) -> Self {
        let size = ground.size();
        let [width, height] = size.map(|side| side as f64);
        let corners = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
        let position = |corner: [f64; 2]| {
            clip_position(DVec2::from(corner), 0.01, size) * ground.distance(corner) as f32
        };
        let mut coordinates = [[0.0; 8]; 2];
        for (lane, corner) in corners.into_iter().enumerate() {
            let [u, v] = ground.coordinates(corner);
            [coordinates[0][lane], coordinates[1][lane]] = [u as f32, v as f32];
        }
        Self { positions: corners.map(position).to_vec(), coordinates }
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        // Four vertices are one vector.
        for (axis, coordinates) in self.coordinates.into_iter().enumerate() {
            vertices.set(axis, F32::simd_from(simd, coordinates));
        }
        positions(simd, vertices, &self.positions)
    }
}

/// The floor with its texture.
struct Textured<'a> {
    floor: &'a Floor,
    texture: &'a Texture,
    sampler: Sampler,
}

impl LanePipeline for Textured<'_> {
    const VARYINGS: usize = 2;

    fn vertex_count(&self) -> usize {
        self.floor.positions.len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        self.floor.vertices(simd, vertices)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let [[ux, uy], [vx, vy]] = [fragments.gradient(0), fragments.gradient(1)];
        self.texture.sample_lanes(simd, fragments.varyings(0), [ux, vx], [uy, vy], &self.sampler)
    }
}

/// The floor with its coordinates as colours: all but the look-up.
struct Plain<'a>(&'a Floor);

impl LanePipeline for Plain<'_> {
    const VARYINGS: usize = 2;

    fn vertex_count(&self) -> usize {
        self.0.positions.len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        self.0.vertices(simd, vertices)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let [u, v] = fragments.varyings(0);
        [u, v, F32::splat(simd, 0.0), F32::splat(simd, 1.0)]
    }
}

/// A floor and what it takes to draw it again and again.
pub struct Drawer<'a> {
    ground: &'a Ground,
    floor: Floor,
    engine: Engine,
    target: Target<'static>,
}

impl<'a> Drawer<'a> {
    /// Nothing is drawn yet.
    #[must_use]
    pub fn new(ground: &'a Ground) -> Self {
        let target = target(ground.size(), &[Output::Linear]);
        Self { ground, floor: Floor::new(ground), engine: Engine::default(), target }
    }

    /// Draws the floor through a filter.
    pub fn draw(&mut self, filter: TextureFilter) {
        let Self { ground, floor, engine, target } = self;
        let textured = Textured { floor, texture: ground.texture(), sampler: filter.sampler() };
        draw(&textured, engine, target);
    }

    /// Draws the floor without its texture.
    pub fn draw_plain(&mut self) {
        let Self { floor, engine, target, .. } = self;
        draw(&Plain(floor), engine, target);
    }

    /// The light of each pixel as it was drawn last.
    #[must_use]
    pub fn light(&self) -> Field<f64> {
        field(self.ground.size(), self.target.linear()).map(|color| color.x.into())
    }
}

fn draw(pipeline: &impl LanePipeline, engine: &mut Engine, target: &mut Target<'_>) {
    let mut pass = Pass::new();
    pass.triangles(Draw { culling: Culling::None, ..Draw::new(pipeline, &[[0, 1, 2], [0, 2, 3]]) });
    engine.rasterizer.draw(&pass, target);
}
