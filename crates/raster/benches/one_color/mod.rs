//! What several benches draw: vertices in one colour, at places from numbers that are the same every time.

use trigon_math::Vec4;
use trigon_raster::simd::{F32, Simd, prelude::*};
use trigon_raster::{FragmentLanes, LanePipeline, VertexLanes};

/// Width and height of the image.
pub(crate) const SIZE: [usize; 2] = [1920, 1080];

/// A vertex in pixels.
#[derive(Clone, Copy)]
pub(crate) struct Vertex {
    pub(crate) place: [f32; 2],
    pub(crate) depth: f32,
}

/// Vertices in one colour.
pub(crate) struct OneColor([Vec<f32>; 4]);

impl OneColor {
    pub(crate) fn new(vertices: &[Vertex]) -> Self {
        let axis = |axis: usize, sign: f32| {
            let side = SIZE[axis] as f32 / 2.0;
            vertices.iter().map(|vertex| sign * (vertex.place[axis] / side - 1.0)).collect()
        };
        let depths = vertices.iter().map(|vertex| vertex.depth).collect();
        Self([axis(0, 1.0), axis(1, -1.0), depths, vec![1.0; vertices.len()]])
    }
}

impl LanePipeline for OneColor {
    const VARYINGS: usize = 0;
    const FLAT: bool = true;

    fn vertex_count(&self) -> usize {
        self.0[0].len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        let [x, y, z, w] = &self.0;
        [vertices.load(simd, x), vertices.load(simd, y), vertices.load(simd, z), vertices.load(simd, w)]
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, _: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        Vec4::new(0.2, 0.5, 0.7, 1.0).to_array().map(|value| F32::splat(simd, value))
    }
}

/// Numbers that look random, within 0 and 1: Knuth's generator, kept because published times are of what it places.
pub(crate) fn numbers() -> impl FnMut() -> f32 {
    let mut seed = 12_345_u64;
    move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 40) as f32 / (1 << 24) as f32
    }
}
