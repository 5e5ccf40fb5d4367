//! Soft shadows: the fraction of the rays to a lamp with an extent that arrive (R. Cook, T. Porter and L. Carpenter,
//! "Distributed Ray Tracing", 1984).
//!
//! The rays end on a [pattern](DiscPattern) over the disc that the point sees in the lamp's place: it has the lamp's
//! radius, and its middle is where the light comes from.

use std::sync::atomic::Ordering;

use trigon_math::{Rays, Vec2};
use trigon_raster::simd::{F32, LANES, Mask, Simd, prelude::*};

use super::{DiscPattern, RayPart, RayScene, frames};
use crate::effect_settings::{MOST_RAYS, RaySampling, SoftShadows};
use crate::lanes::{difference, normalized, scaled, splat, sum, turned};
use crate::lighting::{Arriving, Lamp, LampSource, LitPoints};
use crate::work::{Work, note};

/// The rays to each lamp with an extent.
#[derive(Clone, Debug)]
pub(crate) struct LampRays {
    pattern: DiscPattern,
    pub(crate) sampling: RaySampling,
}

/// Eight points in the light of a lamp.
#[derive(Clone, Copy)]
pub(crate) struct LampStarts<'a, S: Simd> {
    pub(crate) lamp: &'a Lamp,
    pub(crate) points: &'a LitPoints<S>,
    pub(crate) arriving: &'a Arriving<S>,
    pub(crate) part: RayPart,
    /// A bit for each point in use.
    pub(crate) active: u64,
}

impl LampRays {
    pub(crate) fn new(settings: SoftShadows) -> Self {
        /// Radians. Sixteen steps are a golden angle, too, but for whole turns: the points of each pixel that shares them
        /// are spread evenly, where those at every sixteenth golden angle are not.
        const STEP: f32 = 2.598_896_2;
        let SoftShadows { rays, sampling, .. } = settings;
        Self { pattern: DiscPattern::new(rays.clamp(1, MOST_RAYS), sampling, STEP), sampling }
    }

    /// The fraction of the lamp that eight points see; 0 where no light comes from.
    pub(crate) fn lit<S: Simd>(&self, simd: S, scene: &RayScene, starts: &LampStarts<'_, S>) -> F32<S> {
        let LampStarts { lamp, points, arriving, part, active } = *starts;
        simd.vectorize(
            #[inline(always)]
            || {
                let [zero, one] = [F32::splat(simd, 0.0), F32::splat(simd, 1.0)];
                let origin = scene.origins(simd, points);
                let (middle, end) = match lamp.source {
                    LampSource::Directional(_) => {
                        (turned(&scene.turn(), arriving.towards), F32::splat(simd, f32::INFINITY))
                    }
                    LampSource::Point { position, .. } => {
                        let lamp = splat(simd, scene.to_scene.transform_point3(position));
                        (difference(lamp, origin), one)
                    }
                };
                let has_light = !arriving.share.simd_le(0.0);
                let active = active as u32 & has_light.to_bitmask() as u32;
                if active == 0 {
                    return zero;
                }
                let frames = frames(simd, normalized(middle), self.pattern.turns(points.lanes.pixels, part))
                    .map(|axis| scaled(axis, F32::splat(simd, lamp.radius)));
                let (first, step) = (part.first(points.lanes.pixels), part.step());
                let count = self.pattern.points().len() / step;
                let mut arrived = zero;
                for index in 0..count {
                    let [x, y] = self.lanes_of(simd, &first, index * step);
                    let aside = sum(scaled(frames[0], x), scaled(frames[1], y));
                    let rays = Rays { origin, direction: sum(middle, aside), start: zero, end, active };
                    let occluded = scene.triangles.bvh.occluded_rays(simd, &rays, None);
                    let lit = Mask::from_bitmask(simd, u64::from(active & !occluded));
                    arrived += lit.select(one, zero);
                }
                note(Work::SoftShadowRay);
                let cast = u64::from(active.count_ones()) * count as u64;
                scene.cast[3].fetch_add(cast, Ordering::Relaxed);
                arrived / count as f32
            },
        )
    }

    /// Points of the pattern, each counted from the first one of its lane.
    #[inline(always)]
    fn lanes_of<S: Simd>(&self, simd: S, first: &[usize; LANES], offset: usize) -> [F32<S>; 2] {
        let (mut x, mut y) = ([0.0; LANES], [0.0; LANES]);
        for (lane, first) in first.iter().enumerate() {
            Vec2 { x: x[lane], y: y[lane] } = self.pattern.points()[first + offset];
        }
        [F32::simd_from(simd, x), F32::simd_from(simd, y)]
    }
}
