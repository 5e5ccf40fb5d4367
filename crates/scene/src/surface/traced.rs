//! Surfaces from which sight rays continue: mirrors and glass.

use trigon_raster::simd::{F32, Simd, prelude::*};

use super::{Surface, shown};
use crate::effects::Optics;
use crate::lanes::{V3, difference, dot, negated, product, scaled, sum};
use crate::lighting::{Brdf, LitPoints, Microfacets};

/// The start of sight rays at eight points.
#[derive(Clone, Copy)]
pub(super) struct TracedSurface<'a, S: Simd> {
    pub(super) facets: &'a Microfacets<S>,
    pub(super) optics: &'a Optics,
    /// The fraction of ambient light that arrives.
    pub(super) open: Option<F32<S>>,
    pub(super) albedo: V3<S>,
    /// The fraction of the albedo that is diffuse.
    pub(super) diffuse_share: F32<S>,
    /// The transmission factor of the texture.
    pub(super) transmission: Option<F32<S>>,
}

impl<const FLAT: bool> Surface<'_, FLAT> {
    /// The light from mirrors and glass. The diffuse colour gets a fraction of what the surface does not
    /// reflect, and glass transmits a part of that.
    pub(super) fn traced<S: Simd>(
        &self,
        simd: S,
        points: &LitPoints<S>,
        surface: &TracedSurface<'_, S>,
        active: u64,
    ) -> V3<S> {
        let TracedSurface { facets, optics, open, albedo, diffuse_share, transmission } = *surface;
        simd.vectorize(
            #[inline(always)]
            || {
                let LitPoints { normal, view, facing, .. } = *points;
                let cosine = dot(normal, view);
                let back = difference(scaled(normal, cosine * 2.0), view);
                let mirrored = self.lighting.seen(simd, points, optics, back, active);
                let brdf = Brdf::Microfacets(*facets);
                let reflected = self.reflected(simd, points, &brdf, (open, Some(mirrored)));
                let Optics::Glass { transmission: factor, ior } = *optics else {
                    return shown(&reflected, scaled(albedo, diffuse_share));
                };
                let transmission = match transmission {
                    Some(part) => part * factor,
                    None => F32::splat(simd, factor),
                };
                let matt = shown(&reflected, scaled(albedo, diffuse_share * (1.0 - transmission)));
                // Snell's law, into the denser medium: there is no total reflection.
                let ratio = 1.0 / ior;
                let bent = (1.0 - (1.0 - cosine * cosine) * (ratio * ratio)).sqrt();
                let into =
                    difference(scaled(normal, cosine * ratio - bent), scaled(view, F32::splat(simd, ratio)));
                let inside = LitPoints { facing: negated(facing), ..*points };
                let through = self.lighting.seen(simd, &inside, optics, into, active);
                let [r, g, b] = facets.fresnel(cosine);
                let left = [1.0 - r, 1.0 - g, 1.0 - b];
                let passed = product(product(through, left), scaled(albedo, diffuse_share * transmission));
                sum(matt, passed)
            },
        )
    }
}
