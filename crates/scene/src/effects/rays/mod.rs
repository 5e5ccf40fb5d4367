//! Rays among the casters of a scene: exact shadows, ambient occlusion, mirrors and glass. All but those
//! that come from the eye through glass alone ignore alpha masks: the whole triangle stops them.

mod cache;
mod enclosure;
mod occlusion;
mod optics;
mod surface_hit;

pub(crate) use cache::RayCache;
pub(crate) use occlusion::AmbientRays;
pub(crate) use optics::{Glass, Medium, Optics, left_after};
pub(crate) use surface_hit::SurfaceHit;

use crate::work::{Work, note};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use surface_hit::CasterSurfaces;
use trigon_math::{Bvh, DAffine3, DMat4, DVec3, Mat4, Ray, Vec3};
use trigon_raster::simd::{F32, InlineMap, LANES, Simd, lanes_of, prelude::*};

use crate::effects::casters::Casters;
use crate::lanes::{V3, moved, turned};
use crate::lighting::{Arriving, Lamp, LampSource, LitPoints};
use crate::scene::Scene;

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
    fn new(casters: &Casters, looks_of: Option<&Scene>) -> Self {
        let middle = casters.bounds.center().unwrap_or(DVec3::ZERO);
        let mut triangles = Vec::new();
        for caster in &casters.list {
            let to_scene = DAffine3 {
                translation: caster.shadow.placement.world.translation - middle,
                ..caster.shadow.placement.world
            };
            let [x, y, z] = &caster.geometry.columns.positions;
            let position = |vertex: u32| {
                let vertex = vertex as usize;
                let position = Vec3::new(x[vertex], y[vertex], z[vertex]);
                to_scene.transform_point3(position.as_dvec3()).as_vec3()
            };
            for (run, material) in caster.geometry.runs.iter().zip(&caster.shadow.materials) {
                if material.is_some() {
                    let run = &caster.geometry.triangles[run.triangles.clone()];
                    triangles.extend(run.iter().map(|corners| corners.map(position)));
                }
            }
        }
        let reach = (casters.bounds.size() * 0.5).max_element() as f32;
        let surfaces = looks_of.map(|scene| CasterSurfaces::new(scene, casters));
        Self { bvh: Bvh::new(&triangles), middle, reach, surfaces }
    }

    pub(crate) fn byte_count(&self) -> usize {
        self.bvh.byte_count() + self.surfaces.as_ref().map_or(0, CasterSurfaces::byte_count)
    }
}

/// The casters as the rays of a frame hit them.
#[derive(Debug, Default)]
pub(crate) struct RayScene {
    triangles: Arc<RayTriangles>,
    /// From camera space to the triangles'.
    to_scene: Mat4,
    /// And back.
    pub(super) from_scene: Mat4,
    /// Shadow, occlusion and sight rays.
    pub(super) cast: [AtomicU64; 3],
}

impl RayScene {
    fn new(triangles: Arc<RayTriangles>, camera_to_world: &DAffine3) -> Self {
        let shifted =
            DAffine3 { translation: camera_to_world.translation - triangles.middle, ..*camera_to_world };
        let [to_scene, from_scene] = [shifted, shifted.inverse()].map(|map| DMat4::from(map).as_mat4());
        Self { triangles, to_scene, from_scene, cast: Default::default() }
    }

    /// The first hit of a ray, if appearances are known. A ray with the eyes of the camera passes
    /// what these see through.
    pub(super) fn met(&self, ray: &Ray, passes_gaps: bool) -> Option<SurfaceHit> {
        /// The maximum number of gaps in a row.
        const MOST_GAPS: usize = 64;
        note(Work::SightRay);
        let surfaces = self.triangles.surfaces.as_ref()?;
        let mut start = 0.0_f32;
        for _ in 0..MOST_GAPS {
            let hit = self.triangles.bvh.nearest(ray, start..f32::INFINITY)?;
            let found = surfaces.at(&hit, ray);
            if !(found.is_gap && passes_gaps) {
                return Some(found);
            }
            start = hit.distance.next_up();
        }
        None
    }

    /// The glass of a slot of a node, with what is beneath it.
    pub(crate) fn glass(&self, node: u32, slot: u32) -> Option<Glass> {
        self.triangles.surfaces.as_ref()?.glass(node, slot)
    }

    /// The number of rays cast to lamps, into the surroundings, and along the line of sight.
    pub(crate) fn cast(&self) -> [u64; 3] {
        self.cast.each_ref().map(|cast| cast.load(Ordering::Relaxed))
    }

    pub(crate) fn byte_count(&self) -> usize {
        self.triangles.byte_count()
    }

    /// 1 where a lamp's light arrives, otherwise 0.
    pub(crate) fn lit<S: Simd>(
        &self,
        simd: S,
        lamp: &Lamp,
        points: &LitPoints<S>,
        arriving: &Arriving<S>,
    ) -> F32<S> {
        let origins = self.origins(simd, points);
        let [x, y, z] = self.turned_rows(simd, arriving.towards);
        let wanted: [f32; LANES] = arriving.share.into();
        let reach: [f32; LANES] = match lamp.source {
            LampSource::Directional(_) => [f32::INFINITY; LANES],
            LampSource::Point { position, .. } => {
                let lamp = self.to_scene.transform_point3(position);
                lanes_of(|lane| (lamp - origins[lane]).length())
            }
        };
        let mut cast = 0;
        let lit = lanes_of(|lane| {
            let direction = Vec3::new(x[lane], y[lane], z[lane]);
            if wanted[lane] <= 0.0 || direction == Vec3::ZERO {
                return 0.0;
            }
            cast += 1;
            note(Work::ShadowRay);
            let ray = Ray { origin: origins[lane], direction };
            if self.triangles.bvh.occluded(&ray, 0.0..reach[lane]) { 0.0 } else { 1.0 }
        });
        self.cast[0].fetch_add(cast, Ordering::Relaxed);
        F32::simd_from(simd, lit)
    }

    /// From camera directions to the triangles'.
    pub(super) fn turn(&self) -> trigon_math::Mat3 {
        trigon_math::Mat3::from_mat4(self.to_scene)
    }

    /// Camera directions as the triangles have them.
    pub(super) fn turned_rows<S: Simd>(&self, simd: S, directions: V3<S>) -> [[f32; LANES]; 3] {
        simd.vectorize(
            #[inline(always)]
            || rows(turned(&self.turn(), directions)),
        )
    }

    /// The start of rays: off the surface by the possible rounding error.
    pub(super) fn origins<S: Simd>(&self, simd: S, points: &LitPoints<S>) -> [Vec3; LANES] {
        let [x, y, z] = simd.vectorize(
            #[inline(always)]
            || rows(moved(&self.to_scene, points.position)),
        );
        let [nx, ny, nz] = self.turned_rows(simd, points.facing);
        lanes_of(|lane| {
            let side = Vec3::new(nx[lane], ny[lane], nz[lane]);
            self.off(Vec3::new(x[lane], y[lane], z[lane]), side)
        })
    }

    /// A point next to a surface, on the side to which a unit vector points.
    pub(super) fn off(&self, at: Vec3, side: Vec3) -> Vec3 {
        /// In units in the last place of the largest coordinate.
        const OFF: f32 = 64.0 * f32::EPSILON;
        let largest = at.abs().max_element();
        let largest = if largest > self.triangles.reach { largest } else { self.triangles.reach };
        at + side * (largest * OFF)
    }
}

#[inline(always)]
pub(crate) fn rows<S: Simd>(vector: V3<S>) -> [[f32; LANES]; 3] {
    vector.each(
        #[inline(always)]
        |axis| axis.into(),
    )
}
