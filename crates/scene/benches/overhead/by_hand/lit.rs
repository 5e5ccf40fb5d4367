//! One colour, and Lambert's light in each pixel.

use trigon_raster::simd::{F32, Simd, prelude::*};
use trigon_raster::{FragmentLanes, LanePipeline, VertexLanes};

use super::surface::Columns;
use crate::image::{AMBIENT, COLOR, LIGHT};
use crate::lanes::{dot, normalized, positive, splat};

pub(super) struct Lit<'a>(pub(super) &'a Columns);

impl LanePipeline for Lit<'_> {
    const VARYINGS: usize = 3;

    fn vertex_count(&self) -> usize {
        self.0.positions[0].len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        self.0.set_normal(simd, vertices, 0);
        self.0.clip(simd, vertices)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let normal = normalized(fragments.varyings(0));
        let light = positive(dot(normal, splat(simd, self.0.towards))) * LIGHT + AMBIENT;
        [light * COLOR.x, light * COLOR.y, light * COLOR.z, F32::splat(simd, 1.0)]
    }
}
