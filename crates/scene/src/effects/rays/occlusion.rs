//! Ambient occlusion: the fraction of cosine-weighted rays that leave the surroundings of a point
//! (H. Landis, "Production-Ready Global Illumination", 2002).
//!
//! The directions are a spiral over the disc below the hemisphere, which gives the cosine weights.
//! [Full sampling](RaySampling::Full) casts all of them at every point, rotated about the normal by one of 16
//! angles. Otherwise points cast a part of them each, and neighbours complete each other. The pixel's position in a
//! square of four by four selects the angle or the part: neighbours differ, and the image is reproducible.

use crate::work::{Work, note};
use std::sync::atomic::Ordering;

use trigon_math::{Hemispheres, Rays, Vec2, Vec3, elementary};
use trigon_raster::simd::{F32, InlineMap, LANES, Mask, Simd, inlined, prelude::*};

use super::{RayScene, columns, rows};
use crate::effect_settings::{AmbientOcclusion, RaySampling};
use crate::lanes::{V3, scaled, sum, turned};
use crate::lighting::LitPoints;

/// Sines and cosines of the turns.
const TURNS: usize = 16;

/// The rays of each pixel.
#[derive(Clone, Debug)]
pub(crate) struct AmbientRays {
    /// Unit vectors around +Z.
    directions: Vec<Vec3>,
    turns: [Vec2; TURNS],
    distance: f32,
    pub(crate) sampling: RaySampling,
}

/// Which of the rays start at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RayPart {
    /// All, turned.
    All,
    /// Those of one in so many pixels, in a square of pixels: 2 or 4 is the square's side.
    OfSquare(usize),
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
        /// The golden angle, in radians.
        const STEP: f32 = 2.399_963_2;
        let requested = settings.rays.clamp(1, AmbientOcclusion::MOST_RAYS);
        let count = match settings.sampling {
            RaySampling::Full => requested,
            // Each pixel of a square gets as many.
            RaySampling::Shared => requested.next_multiple_of(TURNS as u32),
        };
        let direction = |i: u32| {
            let square = (i as f32 + 0.5) / count as f32;
            let (radius, angle) = (square.sqrt(), i as f32 * STEP);
            let flat = Vec2::new(elementary::cos_f32(angle), elementary::sin_f32(angle)) * radius;
            flat.extend((1.0 - square).sqrt())
        };
        let turn = |i: usize| {
            // Bit-reversed: neighbours differ most.
            let angle = ((i as u8).reverse_bits() >> 4) as f32 / TURNS as f32 * std::f32::consts::TAU;
            Vec2::new(elementary::cos_f32(angle), elementary::sin_f32(angle))
        };
        Self {
            directions: (0..count).map(direction).collect(),
            turns: std::array::from_fn(turn),
            distance: settings.distance,
            sampling: settings.sampling,
        }
    }

    /// The fraction of rays that leave the surroundings of eight points.
    pub(crate) fn open<S: Simd>(&self, simd: S, scene: &RayScene, starts: &RayStarts<'_, S>) -> F32<S> {
        let RayStarts { points, pixels, part, active } = *starts;
        simd.vectorize(
            #[inline(always)]
            || {
                let normal = turned(&scene.turn(), points.facing);
                let is_turned = !(normal[0].simd_eq(0.0) & normal[1].simd_eq(0.0) & normal[2].simd_eq(0.0));
                let active = is_turned.to_bitmask() as u32 & active as u32;
                let origin = scene.origins(simd, points);
                let surroundings = Hemispheres { origin, normal, distance: self.distance, active };
                let surroundings = scene.triangles.bvh.surroundings(simd, &surroundings);
                let [zero, one] = [F32::splat(simd, 0.0), F32::splat(simd, 1.0)];
                if active == 0 || surroundings.is_empty() {
                    return one;
                }
                let frames = self.frames(simd, normal, pixels, part);
                let first = first_of(pixels, part);
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

    /// Two unit vectors along eight surfaces, turned as the positions of the pixels say if all rays are cast.
    #[inline(always)]
    fn frames<S: Simd>(&self, simd: S, normal: V3<S>, pixels: [F32<S>; 2], part: RayPart) -> [V3<S>; 2] {
        let [nx, ny, nz] = rows(normal);
        let numbers = numbers_in_square(pixels, 4);
        let (mut right, mut up) = ([Vec3::ZERO; LANES], [Vec3::ZERO; LANES]);
        for lane in 0..LANES {
            let (tangent, bitangent) = Vec3::new(nx[lane], ny[lane], nz[lane]).any_orthonormal_pair();
            let turn = match part {
                RayPart::All => self.turns[numbers[lane]],
                RayPart::OfSquare(_) => Vec2::X,
            };
            right[lane] = tangent * turn.x + bitangent * turn.y;
            up[lane] = bitangent * turn.x - tangent * turn.y;
        }
        [columns(simd, &right), columns(simd, &up)]
    }
}

impl RayPart {
    /// One in so many rays is cast.
    fn step(self) -> usize {
        match self {
            Self::All => 1,
            Self::OfSquare(side) => side * side,
        }
    }
}

/// The number of the first ray of each pixel.
#[inline(always)]
fn first_of<S: Simd>(pixels: [F32<S>; 2], part: RayPart) -> [usize; LANES] {
    match part {
        RayPart::All => [0; LANES],
        RayPart::OfSquare(side) => {
            let bits = (side * side).trailing_zeros();
            numbers_in_square(pixels, side).each(
                #[inline(always)]
                // Bit-reversed, as turns are.
                |number| usize::from((number as u8).reverse_bits() >> (8 - bits)),
            )
        }
    }
}

/// Where pixels lie in a square of pixels, row by row.
#[inline(always)]
fn numbers_in_square<S: Simd>([x, y]: [F32<S>; 2], side: usize) -> [usize; LANES] {
    let [x, y]: [[f32; LANES]; 2] = [x.into(), y.into()];
    let number = inlined(
        #[inline(always)]
        |lane: usize| (y[lane] as usize % side) * side + x[lane] as usize % side,
    );
    let mut numbers = [0; LANES];
    for (lane, own) in numbers.iter_mut().enumerate() {
        *own = number(lane);
    }
    numbers
}
