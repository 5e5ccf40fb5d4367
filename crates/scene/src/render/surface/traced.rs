//! Surfaces from which rays of sight go on: mirrors and glass.

use trigon_raster::simd::{F32, Simd, prelude::*};

use super::{Surface, shown};
use crate::effects::Optics;
use crate::render::lanes::{V3, difference, dot, negated, product, scaled, sum};
use crate::render::lighting::{Answer, LitPoints, Microfacets};

impl<const FLAT: bool> Surface<'_, FLAT> {
    /// What mirrors and glass show. Of what the surface does not reflect its diffuse
    /// colour has a share, and of that, glass lets a part pass.
    pub(super) fn traced<S: Simd>(
        &self,
        simd: S,
        points: &LitPoints<S>,
        (facets, optics, open): (&Microfacets<S>, &Optics, Option<F32<S>>),
        (albedo, share, passing): (V3<S>, F32<S>, Option<F32<S>>),
        active: u64,
    ) -> V3<S> {
        simd.vectorize(
            #[inline(always)]
            || {
                let LitPoints { normal, view, facing, .. } = *points;
                let cosine = dot(normal, view);
                let back = difference(scaled(normal, cosine * 2.0), view);
                let mirrored = self.scenery.seen(simd, points, optics, back, active);
                let answer = Answer::Microfacets(*facets);
                let reflected = self.reflected(simd, points, &answer, (open, Some(mirrored)));
                let Optics::Glass { transmission, ior } = *optics else {
                    return shown(&reflected, scaled(albedo, share));
                };
                let transmission = passing.map_or(F32::splat(simd, transmission), |part| part * transmission);
                let matt = shown(&reflected, scaled(albedo, share * (1.0 - transmission)));
                // Snell's law, into what is denser: no light is reflected as a whole.
                let ratio = 1.0 / ior;
                let bent = (1.0 - (1.0 - cosine * cosine) * (ratio * ratio)).sqrt();
                let into =
                    difference(scaled(normal, cosine * ratio - bent), scaled(view, F32::splat(simd, ratio)));
                let inside = LitPoints { facing: negated(facing), ..*points };
                let through = self.scenery.seen(simd, &inside, optics, into, active);
                let [r, g, b] = facets.fresnel(cosine);
                let left = [1.0 - r, 1.0 - g, 1.0 - b];
                let passed = product(product(through, left), scaled(albedo, share * transmission));
                sum(matt, passed)
            },
        )
    }
}
