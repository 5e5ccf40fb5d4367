//! A texture times light at the vertices.

use trigon_raster::simd::{F32, Simd, greater, prelude::*};
use trigon_raster::{FragmentLanes, LanePipeline, Texture, VertexLanes};

use super::surface::{Columns, look_up};
use crate::image::{AMBIENT, LIGHT};

pub(super) struct Textured<'a> {
    pub(super) columns: &'a Columns,
    pub(super) base: &'a Texture,
}

impl LanePipeline for Textured<'_> {
    const VARYINGS: usize = 3;

    fn vertex_count(&self) -> usize {
        self.columns.positions[0].len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        self.columns.set_uv(simd, vertices, 0);
        // The cosine to the lamp, which shines along the knot's own z-axis.
        let facing = vertices.load(simd, &self.columns.normals[2]);
        vertices.set(2, greater(facing, F32::splat(simd, 0.0)) * LIGHT + AMBIENT);
        self.columns.clip(simd, vertices)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let [r, g, b, _] = look_up(simd, fragments, self.base);
        let light = fragments.varying(2);
        [r * light, g * light, b * light, F32::splat(simd, 1.0)]
    }
}
