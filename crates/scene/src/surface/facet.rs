//! Flat faces: one colour per triangle, lit once.

use trigon_math::Vec3;
use trigon_raster::FragmentLanes;
use trigon_raster::simd::{F32, InlineMap, LANES, Simd, prelude::*};

use super::{Coverage, Illumination, Surface, shown};
use crate::lanes::{V3, cross, difference, dot, negated, normalized, scaled, select, splat, sum};
use crate::lighting::LitPoints;
use crate::work::{Work, note};

impl<const FLAT: bool> Surface<'_, FLAT> {
    /// One colour for each triangle.
    #[inline(always)]
    pub(super) fn facet_color<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let base = splat(simd, self.params.material.base_color.truncate());
        let lit = match self.illumination {
            Illumination::OnFacets => self.lit_facets(simd, fragments, base),
            Illumination::None
            | Illumination::AtVertices
            | Illumination::InPixels
            | Illumination::Value(_) => base,
        };
        let emissive = self.params.material.emissive;
        if emissive != Vec3::ZERO {
            note(Work::Emission);
        }
        let [r, g, b] = sum(lit, splat(simd, emissive));
        match self.params.coverage {
            Coverage::Opaque => [r, g, b, F32::splat(simd, 1.0)],
            Coverage::Translucent => {
                note(Work::Blend);
                let alpha = F32::splat(simd, self.params.material.base_color.w.clamp(0.0, 1.0));
                [r * alpha, g * alpha, b * alpha, alpha]
            }
        }
    }

    /// A colour lit at the centre of its triangle.
    pub(super) fn lit_facets<S: Simd>(
        &self,
        simd: S,
        fragments: &FragmentLanes<'_, S>,
        albedo: V3<S>,
    ) -> V3<S> {
        simd.vectorize(
            #[inline(always)]
            || {
                let points = self.facets(simd, fragments.primitives());
                shown(&self.lit_plainly(simd, &points), albedo)
            },
        )
    }

    /// The centres of triangles, and the sides from which they are seen.
    #[inline(always)]
    pub(super) fn facets<S: Simd>(&self, simd: S, primitives: [u32; LANES]) -> LitPoints<S> {
        let [a, b, c] = [0, 1, 2].each(
            #[inline(always)]
            |corner| self.placement.camera(simd, self.corners(simd, primitives, corner)),
        );
        let position = scaled(sum(sum(a, b), c), F32::splat(simd, 1.0 / 3.0));
        let normal = normalized(cross(difference(b, a), difference(c, a)));
        let view = self.view(simd, position);
        // The visible side is the one that faces the eye, whatever the winding.
        let faces_eye = dot(normal, view).simd_ge(0.0);
        let normal = select(faces_eye, normal, negated(normal));
        LitPoints { position, normal, facing: normal, plane: normal, view }
    }

    /// The positions of one corner of eight triangles, in the mesh's space.
    #[inline(always)]
    fn corners<S: Simd>(&self, simd: S, primitives: [u32; LANES], corner: usize) -> V3<S> {
        let vertices = primitives.each(
            #[inline(always)]
            |primitive| self.triangles[primitive as usize][corner] as usize,
        );
        self.columns.positions.each_ref().each(
            #[inline(always)]
            |column| {
                let values = vertices.each(
                    #[inline(always)]
                    |vertex| column[vertex],
                );
                F32::simd_from(simd, values)
            },
        )
    }
}
