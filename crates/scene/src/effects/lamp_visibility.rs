//! How much of a lamp is visible from points on surfaces: by shadow maps or rays, and with soft edges if it has an extent.

use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, Simd};

use super::LightingEnvironment;
use super::rays::{LampStarts, RayPart, RayScene};
use crate::effect_settings::RaySampling;
use crate::lanes::{dot, positive};
use crate::lighting::{Arriving, Lamp, LitPoints};

impl LightingEnvironment {
    /// The unshadowed fraction of a lamp's light; `None` if all of it arrives.
    #[inline(always)]
    pub(crate) fn share<S: Simd>(
        &self,
        simd: S,
        number: usize,
        lamp: &Lamp,
        points: &LitPoints<S>,
        arriving: &Arriving<S>,
    ) -> Option<F32<S>> {
        if let Some(maps) = &self.shadow_maps {
            return maps.share(simd, number, points, arriving.towards);
        }
        let rays = self.rays.as_ref().filter(|_| self.shadow_rays)?;
        if self.lamp_rays.is_some() && lamp.radius > 0.0 {
            let part = if self.lamp_buffers.is_empty() { RayPart::All } else { RayPart::OfSquare(2) };
            let is_lit = arriving.share * dot(points.normal, arriving.towards);
            let active = points.lanes.active & is_lit.simd_gt(0.0).to_bitmask();
            return self.soft_share(simd, rays, number, &LampStarts { lamp, points, arriving, part, active });
        }
        Some(rays.lit(simd, lamp, points, arriving))
    }

    /// For each lamp, by its number, whether neighbours share the rays to it; none if no lamp's are shared.
    pub(crate) fn sharing_lamps(&self) -> Vec<bool> {
        /// The most buffers of half the image's size; rays to other lamps start at every sample.
        const MOST: usize = 16;
        if self.lamp_rays.as_ref().is_none_or(|rays| rays.sampling == RaySampling::Full) {
            return Vec::new();
        }
        let mut left = MOST;
        let lamps = self.lights.lamps.iter().map(|lamp| {
            let is_shared = lamp.radius > 0.0 && left > 0;
            left -= usize::from(is_shared);
            is_shared
        });
        lamps.collect()
    }

    /// The visible fraction of a lamp with an extent: what neighbours found together, or by rays of the points' own.
    fn soft_share<S: Simd>(
        &self,
        simd: S,
        rays: &RayScene,
        number: usize,
        starts: &LampStarts<'_, S>,
    ) -> Option<F32<S>> {
        let lamp_rays = self.lamp_rays.as_ref()?;
        let LampStarts { points, active, .. } = *starts;
        let shared = self.lamp_buffers.get(number).and_then(Option::as_ref);
        let Some(buffer) = shared.filter(|_| points.lanes.is_direct) else {
            return Some(lamp_rays.lit(simd, rays, starts));
        };
        simd.vectorize(
            #[inline(always)]
            || {
                let (found, is_known) = buffer.at(simd, points, points.lanes.pixels);
                // Below 0 the buffer is too coarse for an edge.
                let is_known = is_known & found.simd_ge(0.0);
                let unknown = active & !is_known.to_bitmask();
                if unknown == 0 {
                    return Some(found);
                }
                let own = lamp_rays.lit(simd, rays, &LampStarts { active: unknown, ..*starts });
                Some(is_known.select(found, own))
            },
        )
    }

    /// The fraction of a lamp that points see by a part of the rays, and less than 0 where it does not shine; `None` if
    /// there are no such rays.
    #[inline(always)]
    pub(crate) fn lamp_by_rays<S: Simd>(
        &self,
        simd: S,
        number: usize,
        points: &LitPoints<S>,
        part: RayPart,
    ) -> Option<F32<S>> {
        let (lamp_rays, rays) = (self.lamp_rays.as_ref()?, self.rays.as_ref()?);
        let lamp = self.lights.lamps.get(number)?;
        let arriving = lamp.arriving(simd, points.position);
        let light = arriving.share * positive(dot(points.facing, arriving.towards));
        let has_light = light.simd_gt(0.0);
        let active = points.lanes.active & has_light.to_bitmask();
        let starts = LampStarts { lamp, points, arriving: &arriving, part, active };
        let lit = lamp_rays.lit(simd, rays, &starts);
        Some(has_light.select(lit, F32::splat(simd, -1.0)))
    }
}
