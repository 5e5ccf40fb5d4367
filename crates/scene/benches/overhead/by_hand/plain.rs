//! One colour.

use trigon_raster::simd::{F32, InlineMap, Simd, prelude::*};
use trigon_raster::{FragmentLanes, LanePipeline, VertexLanes};

use super::surface::Columns;
use crate::image::COLOR;

pub(super) struct Plain<'a>(pub(super) &'a Columns);

impl LanePipeline for Plain<'_> {
    const VARYINGS: usize = 0;
    const FLAT: bool = true;

    fn vertex_count(&self) -> usize {
        self.0.positions[0].len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        self.0.clip(simd, vertices)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, _: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        COLOR.extend(1.0).to_array().each(
            #[inline(always)]
            |channel| F32::splat(simd, channel),
        )
    }
}
