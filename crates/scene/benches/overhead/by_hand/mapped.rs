//! A texture, a normal map, Lambert's light in each pixel, and a shadow map.

use trigon_raster::simd::{F32, InlineMap, Simd, prelude::*};
use trigon_raster::{FragmentLanes, LanePipeline, Texture, VertexLanes};

use super::shadow::{Receivers, ShadowMap};
use super::surface::{NormalMapped, look_up};
use crate::image::{AMBIENT, LIGHT};
use crate::lanes::{cross, dot, normalized, positive, splat};

pub(super) struct Mapped<'a> {
    pub(super) surface: NormalMapped<'a>,
    pub(super) base: &'a Texture,
    pub(super) shadow: &'a ShadowMap,
}

impl LanePipeline for Mapped<'_> {
    const VARYINGS: usize = NormalMapped::VARYINGS;

    fn vertex_count(&self) -> usize {
        self.surface.columns.positions[0].len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        self.surface.vertices(simd, vertices)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let [r, g, b, _] = look_up(simd, fragments, self.base);
        let [facing, normal] = self.surface.normals(simd, fragments);
        let towards = splat(simd, self.surface.columns.towards);
        let mut light = positive(dot(normal, towards));
        if light.simd_gt(0.0).any_true() {
            let at = NormalMapped::POSITION;
            let [x, y, z] = [at, at + 1, at + 2].each(
                #[inline(always)]
                |varying| fragments.gradient(varying),
            );
            let plane = cross(normalized([x[0], y[0], z[0]]), normalized([x[1], y[1], z[1]]));
            let receivers = Receivers { position: fragments.varyings(at), facing, plane, towards };
            light *= self.shadow.share(simd, &receivers);
        }
        let light = light * LIGHT + AMBIENT;
        [r * light, g * light, b * light, F32::splat(simd, 1.0)]
    }
}
