//! Ambient occlusion: the fraction of cosine-weighted rays that leave the surroundings of a point
//! (H. Landis, "Production-Ready Global Illumination", 2002).
//!
//! The directions end on a [pattern](DiscPattern) over the disc below the hemisphere, which gives the cosine weights.

use std::sync::atomic::Ordering;

use trigon_math::{Hemispheres, Rays, Vec3};
use trigon_raster::simd::{F32, LANES, Mask, Simd, prelude::*};

use super::{DiscPattern, GOLDEN_ANGLE, RayPart, RayScene, columns, frames};
use crate::effect_settings::{AmbientOcclusion, MOST_RAYS, RaySampling};
use crate::lanes::{V3, scaled, sum, turned};
use crate::lighting::LitPoints;
use crate::work::{Work, note};

/// The rays of each pixel.
#[derive(Clone, Debug)]
pub(crate) struct AmbientRays {
    pattern: DiscPattern,
    /// Unit vectors around +Z, above the pattern's points.
    directions: Vec<Vec3>,
    distance: f32,
    pub(crate) sampling: RaySampling,
}

/// Eight points from which rays start.
#[derive(Clone, Copy)]
pub(crate) struct RayStarts<'a, S: Simd> {
    pub(crate) points: &'a LitPoints<S>,
    /// Where they lie in the image, in pixels.
    pub(crate) pixels: [F32<S>; 2],
    pub(crate) part: RayPart,
    /// A bit for each point in use.
    pub(crate) active: u64,
}

impl AmbientRays {
    pub(crate) fn new(settings: AmbientOcclusion) -> Self {
        let AmbientOcclusion { rays, distance, sampling } = settings;
        let pattern = DiscPattern::new(rays.clamp(1, MOST_RAYS), sampling, GOLDEN_ANGLE);
        let raised = pattern
            .points()
            .iter()
            .enumerate()
            .map(|(i, flat)| flat.extend((1.0 - pattern.square(i)).sqrt()));
        Self { directions: raised.collect(), pattern, distance, sampling }
    }

    /// The fraction of rays that leave the surroundings of eight points.
    pub(crate) fn open<S: Simd>(&self, simd: S, scene: &RayScene, starts: &RayStarts<'_, S>) -> F32<S> {
        let RayStarts { points, pixels, part, active } = *starts;
        simd.vectorize(
            #[inline(always)]
            || {
                let normal = turned(&scene.turn(), points.facing);
                let is_turned = !(normal[0].simd_eq(0.0) & normal[1].simd_eq(0.0) & normal[2].simd_eq(0.0));
                let [zero, one] = [F32::splat(simd, 0.0), F32::splat(simd, 1.0)];
                let active = is_turned.to_bitmask() as u32 & active as u32;
                if active == 0 {
                    return one;
                }
                let origin = scene.origins(simd, points);
                let surroundings = Hemispheres { origin, normal, distance: self.distance, active };
                let surroundings = scene.triangles.bvh.surroundings(simd, &surroundings);
                if surroundings.is_empty() {
                    return one;
                }
                let frames = frames(simd, normal, self.pattern.turns(pixels, part));
                let first = part.first(pixels);
                let step = part.step();
                let count = self.directions.len() / step;
                let (start, end) = (zero, F32::splat(simd, self.distance));
                let mut open = zero;
                for index in 0..count {
                    let [x, y, z] = self.lanes_of(simd, &first, index * step);
                    let flat = sum(scaled(frames[0], x), scaled(frames[1], y));
                    let direction = sum(flat, scaled(normal, z));
                    let rays = Rays { origin, direction, start, end, active };
                    let occluded = scene.triangles.bvh.occluded_rays(simd, &rays, Some(&surroundings));
                    open += Mask::from_bitmask(simd, u64::from(occluded)).select(zero, one);
                }
                note(Work::OcclusionRay);
                let cast = u64::from(active.count_ones()) * count as u64;
                scene.cast[1].fetch_add(cast, Ordering::Relaxed);
                open / count as f32
            },
        )
    }

    /// Directions around +Z, each counted from the first one of its lane.
    #[inline(always)]
    fn lanes_of<S: Simd>(&self, simd: S, first: &[usize; LANES], offset: usize) -> V3<S> {
        let mut directions = [Vec3::ZERO; LANES];
        for (direction, first) in directions.iter_mut().zip(first) {
            *direction = self.directions[first + offset];
        }
        columns(simd, &directions)
    }
}
