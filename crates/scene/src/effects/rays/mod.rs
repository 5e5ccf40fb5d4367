//! Rays among the casters of a scene: exact shadows, ambient occlusion, mirrors and glass. All but those
//! that come from the eye through glass alone ignore alpha masks: the whole triangle stops them.
//!
//! The BVH over the casters' triangles is kept until the casters change, and refitted where they only move. A surface may
//! enclose a volume or not: a ray that enters through an open surface would never leave, so an open surface stands for a
//! plate.

mod occlusion;
mod openness_buffer;
mod optics;
mod pattern;
mod soft_shadows;
mod surface_hit;

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelExtend, ParallelIterator};
use surface_hit::CasterSurfaces;
use trigon_math::glam::Affine3;
use trigon_math::{Bvh, DAffine3, DVec3, Ray, Rays, Vec2, Vec3};
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, InlineMap, LANES, Mask, Simd, greater};

use super::casters::{Casters, ShadowSource};
use crate::lanes::{V3, difference, dot, moved, scaled, splat, sum, turned};
use crate::lighting::{Arriving, Lamp, LampSource, LitPoints};
use crate::scene::Scene;
use crate::work::{Work, note};

pub(crate) use occlusion::{AmbientRays, RayStarts};
pub(crate) use openness_buffer::{OpennessBuffer, OpennessOf, SmallImage, SmallView};
pub(crate) use optics::{Glass, Medium, Optics, left_after};
pub(crate) use pattern::{DiscPattern, GOLDEN_ANGLE, RayPart};
pub(crate) use soft_shadows::{LampRays, LampStarts};
pub(crate) use surface_hit::SurfaceHit;

/// The triangles of all casters, around the middle of their box.
#[derive(Debug, Default)]
pub(crate) struct RayTriangles {
    bvh: Bvh,
    middle: DVec3,
    /// The largest coordinate.
    reach: f32,
    /// Their appearance, if sight rays may end on them.
    surfaces: Option<CasterSurfaces>,
}

impl RayTriangles {
    /// Those of the last frame, if there are any, may have moved.
    fn new(casters: &Casters, looks_of: Option<&Scene>, last: Option<Self>) -> Self {
        let middle = casters.bounds.center().unwrap_or(DVec3::ZERO);
        let triangles = positions(casters, middle);
        let bvh = last.and_then(|last| last.bvh.refit(&triangles)).unwrap_or_else(|| Bvh::new(&triangles));
        let reach = (casters.bounds.size() * 0.5).max_element() as f32;
        let surfaces = looks_of.map(|scene| CasterSurfaces::new(scene, casters));
        Self { bvh, middle, reach, surfaces }
    }

    pub(crate) fn byte_count(&self) -> usize {
        self.bvh.byte_count() + self.surfaces.as_ref().map_or(0, CasterSurfaces::byte_count)
    }
}

/// The corners of all triangles around a point of the world.
fn positions(casters: &Casters, middle: DVec3) -> Vec<[Vec3; 3]> {
    /// Triangles per task, at least.
    const FEWEST: usize = 1 << 13;
    let mut triangles = Vec::new();
    for caster in &casters.list {
        let world = &caster.shadow.placement.world;
        let to_scene = DAffine3 { translation: world.translation - middle, ..*world };
        let [x, y, z] = &caster.geometry.columns.positions;
        let position = |vertex: u32| {
            let vertex = vertex as usize;
            let position = Vec3::new(x[vertex], y[vertex], z[vertex]);
            to_scene.transform_point3(position.as_dvec3()).as_vec3()
        };
        for (run, material) in caster.geometry.runs.iter().zip(&caster.shadow.materials) {
            if material.is_some() {
                let run = caster.geometry.triangles[run.triangles.clone()].par_iter().with_min_len(FEWEST);
                triangles.par_extend(run.map(|corners| corners.map(position)));
            }
        }
    }
    triangles
}

/// The casters as the rays of a frame hit them.
#[derive(Debug, Default)]
pub(crate) struct RayScene {
    triangles: Arc<RayTriangles>,
    /// From camera space to the triangles'.
    to_scene: Affine3,
    /// And back.
    pub(super) from_scene: Affine3,
    /// Shadow, occlusion, sight and soft shadow rays.
    pub(super) cast: [AtomicU64; 4],
}

impl RayScene {
    fn new(triangles: Arc<RayTriangles>, camera_to_world: &DAffine3) -> Self {
        let shifted =
            DAffine3 { translation: camera_to_world.translation - triangles.middle, ..*camera_to_world };
        let [to_scene, from_scene] = [shifted, shifted.inverse()].map(|map| map.as_affine3());
        Self { triangles, to_scene, from_scene, cast: Default::default() }
    }

    /// The first hits of eight rays, if appearances are known. A ray with the eyes of the camera passes what these see
    /// through. Both sets have a bit for each ray.
    pub(super) fn met<S: Simd>(
        &self,
        simd: S,
        rays: &[Ray; LANES],
        mut active: u32,
        passes_gaps: u32,
    ) -> [Option<SurfaceHit>; LANES] {
        /// The maximum number of gaps in a row.
        const MOST_GAPS: usize = 64;
        let mut met = [None; LANES];
        note(Work::SightRay);
        let Some(surfaces) = &self.triangles.surfaces else { return met };
        let mut start = [0.0; LANES];
        for _ in 0..MOST_GAPS {
            if active == 0 {
                break;
            }
            let in_lanes = in_lanes(simd, rays, start, active);
            let hits = self.triangles.bvh.nearest_rays(simd, &in_lanes, &mut |_, _| true);
            let cast = active;
            for lane in (0..LANES).filter(|lane| cast >> lane & 1 != 0) {
                let found = hits[lane].map(|hit| surfaces.at(&hit, &rays[lane]));
                if let Some(found) = found
                    && found.is_gap
                    && passes_gaps >> lane & 1 != 0
                {
                    start[lane] = found.distance.next_up();
                } else {
                    met[lane] = found;
                    active &= !(1 << lane);
                }
            }
        }
        met
    }

    /// The glass of a slot of a node, with what is beneath it.
    pub(crate) fn glass(&self, node: u32, slot: u32) -> Option<Glass> {
        self.triangles.surfaces.as_ref()?.glass(node, slot)
    }

    /// The number of rays cast to lamps without an extent, into the surroundings, along the line of sight, and to lamps
    /// with an extent.
    pub(crate) fn cast(&self) -> [u64; 4] {
        self.cast.each_ref().map(|cast| cast.load(Ordering::Relaxed))
    }

    pub(crate) fn byte_count(&self) -> usize {
        self.triangles.byte_count()
    }

    /// 1 where a lamp's light arrives, otherwise 0.
    #[inline(always)]
    pub(crate) fn lit<S: Simd>(
        &self,
        simd: S,
        lamp: &Lamp,
        points: &LitPoints<S>,
        arriving: &Arriving<S>,
    ) -> F32<S> {
        let zero = F32::splat(simd, 0.0);
        let (origin, direction) = (self.origins(simd, points), turned(&self.turn(), arriving.towards));
        let reach = match lamp.source {
            LampSource::Directional(_) => F32::splat(simd, f32::INFINITY),
            LampSource::Point { position, .. } => {
                let lamp = difference(splat(simd, self.to_scene.transform_point3(position)), origin);
                dot(lamp, lamp).sqrt()
            }
        };
        let is_turned = !(direction[0].simd_eq(0.0) & direction[1].simd_eq(0.0) & direction[2].simd_eq(0.0));
        let requested = !arriving.share.simd_le(0.0) & is_turned;
        let active = requested.to_bitmask() as u32;
        if active != 0 {
            note(Work::ShadowRay);
        }
        self.cast[0].fetch_add(active.count_ones().into(), Ordering::Relaxed);
        let rays = Rays { origin, direction, start: zero, end: reach, active };
        let occluded = self.triangles.bvh.occluded_rays(simd, &rays, None);
        let lit = Mask::from_bitmask(simd, u64::from(active & !occluded));
        lit.select(F32::splat(simd, 1.0), zero)
    }

    /// From camera directions to the triangles'.
    pub(super) fn turn(&self) -> trigon_math::Mat3 {
        self.to_scene.matrix3
    }

    /// The start of rays: off the surface by the possible rounding error.
    #[inline(always)]
    pub(super) fn origins<S: Simd>(&self, simd: S, points: &LitPoints<S>) -> V3<S> {
        let at = moved(&self.to_scene, points.position);
        let side = turned(&self.turn(), points.facing);
        let largest = greater(greater(at[0].abs(), at[1].abs()), at[2].abs());
        let reach = F32::splat(simd, self.triangles.reach);
        sum(at, scaled(side, greater(largest, reach) * OFF))
    }

    /// A point next to a surface, on the side to which a unit vector points.
    pub(super) fn off(&self, at: Vec3, side: Vec3) -> Vec3 {
        let largest = at.abs().max_element();
        let largest = if largest > self.triangles.reach { largest } else { self.triangles.reach };
        at + side * (largest * OFF)
    }
}

/// How far rays start off a surface, in units in the last place of the largest coordinate.
const OFF: f32 = 64.0 * f32::EPSILON;

/// Rays from where they start on, component by component.
fn in_lanes<S: Simd>(simd: S, rays: &[Ray; LANES], start: [f32; LANES], active: u32) -> Rays<S> {
    simd.vectorize(
        #[inline(always)]
        || {
            let (mut origins, mut directions) = ([Vec3::ZERO; LANES], [Vec3::ZERO; LANES]);
            for (lane, ray) in rays.iter().enumerate() {
                (origins[lane], directions[lane]) = (ray.origin, ray.direction);
            }
            Rays {
                origin: columns(simd, &origins),
                direction: columns(simd, &directions),
                start: F32::simd_from(simd, start),
                end: F32::splat(simd, f32::INFINITY),
                active,
            }
        },
    )
}

/// Eight vectors, component by component.
#[inline(always)]
pub(super) fn columns<S: Simd>(simd: S, vectors: &[Vec3; LANES]) -> V3<S> {
    let [mut x, mut y, mut z] = [[0.0; LANES]; 3];
    for (lane, vector) in vectors.iter().enumerate() {
        (x[lane], y[lane], z[lane]) = (vector.x, vector.y, vector.z);
    }
    [F32::simd_from(simd, x), F32::simd_from(simd, y), F32::simd_from(simd, z)]
}

/// Two unit vectors perpendicular to each of eight, turned about them.
#[inline(always)]
fn frames<S: Simd>(simd: S, normal: V3<S>, turns: [Vec2; LANES]) -> [V3<S>; 2] {
    let [nx, ny, nz] = rows(normal);
    let (mut right, mut up) = ([Vec3::ZERO; LANES], [Vec3::ZERO; LANES]);
    for (lane, turn) in turns.into_iter().enumerate() {
        let (tangent, bitangent) = Vec3::new(nx[lane], ny[lane], nz[lane]).any_orthonormal_pair();
        right[lane] = tangent * turn.x + bitangent * turn.y;
        up[lane] = bitangent * turn.x - tangent * turn.y;
    }
    [columns(simd, &right), columns(simd, &up)]
}

#[inline(always)]
pub(crate) fn rows<S: Simd>(vector: V3<S>) -> [[f32; LANES]; 3] {
    vector.each(
        #[inline(always)]
        |axis| axis.into(),
    )
}

/// The BVH of the last frame.
#[derive(Debug, Default)]
pub(crate) struct RayCache {
    cached: Option<(Vec<ShadowSource>, Arc<RayTriangles>)>,
}

impl RayCache {
    /// With materials, if sight rays may end on the casters.
    pub(crate) fn scene(
        &mut self,
        casters: &Casters,
        looks_of: Option<&Scene>,
        camera_to_world: &DAffine3,
    ) -> RayScene {
        let fits = |(cached, triangles): &(Vec<ShadowSource>, Arc<RayTriangles>)| {
            casters.shadow_sources().eq(cached) && triangles.surfaces.is_some() == looks_of.is_some()
        };
        let cached = match self.cached.take() {
            Some(cached) if fits(&cached) => cached,
            other => {
                let last = other.and_then(|(_, triangles)| Arc::into_inner(triangles));
                let sources = casters.shadow_sources().cloned().collect();
                (sources, Arc::new(RayTriangles::new(casters, looks_of, last)))
            }
        };
        let (_, triangles) = self.cached.insert(cached);
        RayScene::new(Arc::clone(triangles), camera_to_world)
    }
}

/// Whether triangles enclose a volume: each of their edges is passed as often in one direction as in
/// the other. Vertices at the same position are the same.
fn encloses([x, y, z]: &[Vec<f32>; 3], triangles: impl Iterator<Item = [u32; 3]>) -> bool {
    // +0, so that both zeros are the same.
    let position_bits = |vertex: u32| [x, y, z].map(|column| (column[vertex as usize] + 0.0).to_bits());
    let mut ordered: Vec<u32> = (0..x.len() as u32).collect();
    ordered.sort_unstable_by_key(|&vertex| position_bits(vertex));
    let mut welded = vec![0_u32; ordered.len()];
    for pair in ordered.windows(2) {
        let is_new = position_bits(pair[0]) != position_bits(pair[1]);
        welded[pair[1] as usize] = welded[pair[0] as usize] + u32::from(is_new);
    }
    let mut edges: Vec<([u32; 2], bool)> = Vec::new();
    for corners in triangles {
        let [a, b, c] = corners.map(|vertex| welded[vertex as usize]);
        let sides = [[a, b], [b, c], [c, a]].into_iter().filter(|[from, to]| from != to);
        edges.extend(sides.map(|[from, to]| ([from.min(to), from.max(to)], from < to)));
    }
    edges.sort_unstable();
    let is_balanced = |edge: &[([u32; 2], bool)]| {
        2 * edge.iter().filter(|(_, is_forward)| *is_forward).count() == edge.len()
    };
    !edges.is_empty() && edges.chunk_by(|one, next| one.0 == next.0).all(is_balanced)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The corners of a tetrahedron, each three times as at creases, the last ones with a zero of
    /// the other sign.
    fn positions() -> [Vec<f32>; 3] {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let column = |axis: usize| -> Vec<f32> {
            let of = |zero: f32| corners.map(|corner: [f32; 3]| if corner[axis] == 0.0 { zero } else { 1.0 });
            [of(0.0), of(0.0), of(-0.0)].concat()
        };
        [column(0), column(1), column(2)]
    }

    #[test]
    fn closed_surfaces_enclose_and_open_ones_do_not() {
        let faces = [[0, 2, 1], [4, 5, 7], [8, 11, 10], [1, 6, 11]];
        let encloses = |faces: &[[u32; 3]]| encloses(&positions(), faces.iter().copied());
        assert!(encloses(&faces), "a tetrahedron");
        assert!(!encloses(&faces[..3]), "one that lacks a face");
        let turned = [faces[0], faces[1], faces[2], [11, 6, 1]];
        assert!(!encloses(&turned), "one with a face that looks inwards");
        assert!(encloses(&[&faces[..], &[[0, 4, 8]]].concat()), "a triangle without area is no edge");
        assert!(!encloses(&[]), "nothing");
    }
}
