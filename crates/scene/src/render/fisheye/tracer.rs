//! Finds the surfaces that rays from the eye meet. A BVH in f32 says which triangle is hit; everything else about the hit
//! is computed in f64 from that triangle and the ray of the lens.

use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

use trigon_camera::{FisheyeLens, FisheyeRay};
use trigon_math::{DAffine3, DVec3, Ray, RayHit, Vec3};
use trigon_raster::{
    BlendMode, Culling, Pass, PointScratch, PointShader, Rasterizer, ShadedDraw, SurfacePoint,
};

use super::EyeTriangles;
use super::picture::SampleGrid;
use crate::geometry::Geometry;
use crate::outputs::{Beam, Facet};
use crate::prepare::PreparedScene;
use crate::render::record::Record;

/// Rays among the draws of one image.
pub(in crate::render) struct Tracer<'p> {
    prepared: &'p PreparedScene<'p>,
    pub(super) lens: FisheyeLens,
    pub(super) grid: SampleGrid,
    pub(super) shader: PointShader<'p>,
    triangles: &'p EyeTriangles,
    /// By their nodes and triangles.
    runs: Vec<DrawnRun<'p>>,
    shaded: AtomicU64,
}

/// Triangles of a node that are drawn together.
pub(super) struct DrawnRun<'p> {
    /// In the pass.
    pub(super) draw: usize,
    pub(super) node: u32,
    pub(super) geometry: &'p Geometry,
    /// Of the geometry.
    pub(super) triangles: Range<u32>,
    pub(super) blend_mode: BlendMode,
    culling: Culling,
    to_camera: DAffine3,
}

/// A sample of the image, and its ray.
pub(super) struct EyeSample {
    /// Where its colour goes.
    pub(super) slot: usize,
    /// Its column and row in the finer grid.
    pub(super) sample: [u32; 2],
    pub(super) ray: FisheyeRay,
}

/// A surface that a sample shows.
pub(super) struct EyeFragment {
    /// Of the sample in its list.
    pub(super) index: usize,
    pub(super) run: usize,
    pub(super) point: SurfacePoint,
}

/// A sample whose ray goes on behind the hit that it had last.
struct PendingRay {
    index: usize,
    after: Option<RayHit>,
}

impl<'p> DrawnRun<'p> {
    /// `None` for a node without a shape.
    fn new(
        prepared: &'p PreparedScene<'p>,
        draw: usize,
        shaded: ShadedDraw<'p>,
        record: &'p (dyn Record + 'p),
    ) -> Option<Self> {
        let ShadedDraw { object: node, culling, blend_mode, .. } = shaded;
        let source = record.source();
        let shape = prepared.shapes.get(node as usize)?;
        Some(Self {
            draw,
            node,
            geometry: source.geometry,
            triangles: source.triangles.start as u32..source.triangles.end as u32,
            blend_mode,
            culling,
            to_camera: prepared.eye.to_camera(&shape.world),
        })
    }
}

impl<'p> Tracer<'p> {
    /// For the draws of a pass, which are all recorded in it in this order.
    pub(in crate::render) fn new(
        prepared: &'p PreparedScene<'p>,
        pass: &'p Pass<'p>,
        draws: &'p [Box<dyn Record + 'p>],
        triangles: &'p EyeTriangles,
        rasterizer: &Rasterizer,
    ) -> Self {
        let grid = SampleGrid::new(prepared.settings);
        let shader = rasterizer.point_shader(pass, grid.axis);
        let lens = prepared.lens.expect("the scene is prepared for a lens");
        let recorded = shader.draws().zip(draws).enumerate();
        let mut runs: Vec<DrawnRun<'p>> = recorded
            .filter_map(|(draw, (shaded, record))| DrawnRun::new(prepared, draw, shaded?, &**record))
            .collect();
        runs.sort_by_key(|run| (run.node, run.triangles.start));
        Self { prepared, lens, grid, shader, triangles, runs, shaded: AtomicU64::new(0) }
    }

    /// Adds to the number of surfaces that were shaded.
    pub(super) fn count(&self, shaded: usize) {
        self.shaded.fetch_add(shaded as u64, Ordering::Relaxed);
    }

    /// How many surfaces were shaded.
    pub(in crate::render) fn shaded_count(&self) -> u64 {
        self.shaded.load(Ordering::Relaxed)
    }

    pub(super) fn run(&self, number: usize) -> &DrawnRun<'p> {
        &self.runs[number]
    }

    /// The surfaces that samples show: of each sample front to back, up to the first that hides all behind it.
    pub(super) fn fragments(&self, samples: &[EyeSample], scratch: &mut PointScratch) -> Vec<EyeFragment> {
        let mut fragments = Vec::with_capacity(samples.len());
        let mut pending: Vec<PendingRay> =
            (0..samples.len()).map(|index| PendingRay { index, after: None }).collect();
        while !pending.is_empty() {
            let hits: Vec<(PendingRay, EyeFragment)> =
                pending.iter().filter_map(|ray| self.next(&samples[ray.index], ray)).collect();
            let exists = self.existing(&hits, scratch);
            pending.clear();
            for ((behind, fragment), exists) in hits.into_iter().zip(exists) {
                let hides = self.runs[fragment.run].blend_mode != BlendMode::Translucent;
                if exists {
                    fragments.push(fragment);
                }
                if !(exists && hides) {
                    pending.push(behind);
                }
            }
        }
        fragments
    }

    /// The next surface that a sample's ray meets, and the ray behind it.
    fn next(&self, sample: &EyeSample, ray: &PendingRay) -> Option<(PendingRay, EyeFragment)> {
        let camera = self.prepared.camera;
        let origin = (camera.position - self.triangles.middle).as_vec3();
        let direction: Vec3 = (camera.orientation * sample.ray.direction).as_vec3();
        let start = ray.after.map_or(0.0, |last| last.distance);
        let counts = |hit: &RayHit| {
            // Several triangles may be at one distance.
            let order = |hit: &RayHit| (hit.distance, hit.triangle);
            let is_behind = ray.after.is_none_or(|last| order(hit) > order(&last));
            is_behind && self.drawn(hit.triangle).is_some_and(|(run, triangle)| self.shows(run, triangle))
        };
        let hit = self.triangles.bvh.nearest_of(&Ray { origin, direction }, start..f32::INFINITY, counts)?;
        let (number, triangle) = self.drawn(hit.triangle)?;
        let (index, after) = (ray.index, Some(hit));
        let point = self.point(number, triangle, sample);
        Some((PendingRay { index, after }, EyeFragment { index, run: number, point }))
    }

    /// The run that draws a triangle, if any does, and the triangle's number in the geometry.
    fn drawn(&self, triangle: u32) -> Option<(usize, u32)> {
        let [node, triangle] = self.triangles.owner(triangle);
        let after = self.runs.partition_point(|run| (run.node, run.triangles.start) <= (node, triangle));
        let number = after.checked_sub(1)?;
        let run = &self.runs[number];
        (run.node == node && run.triangles.contains(&triangle)).then_some((number, triangle))
    }

    /// Whether the side that the eye sees of a triangle is drawn.
    fn shows(&self, run: usize, triangle: u32) -> bool {
        match self.runs[run].culling {
            Culling::None => true,
            Culling::Back => !self.facet(run, triangle).is_clockwise(),
            Culling::Front => self.facet(run, triangle).is_clockwise(),
        }
    }

    fn facet(&self, run: usize, triangle: u32) -> Facet {
        let DrawnRun { geometry, to_camera, .. } = &self.runs[run];
        let [x, y, z] = &geometry.columns.positions;
        let corner = |vertex: u32| {
            let at = vertex as usize;
            to_camera.transform_point3(DVec3::new(x[at].into(), y[at].into(), z[at].into()))
        };
        Facet::new(geometry.triangles[triangle as usize].map(corner), Beam::Central)
    }

    fn point(&self, run: usize, triangle: u32, sample: &EyeSample) -> SurfacePoint {
        let (facet, FisheyeRay { direction, steps }) = (self.facet(run, triangle), &sample.ray);
        let weights = facet.weights(*direction);
        let slopes = steps.map(|step| {
            let slope = facet.slope(*direction, weights, step / f64::from(self.grid.axis)).as_vec3();
            [slope.y, slope.z]
        });
        SurfacePoint {
            triangle: triangle - self.runs[run].triangles.start,
            front_facing: !facet.is_clockwise(),
            weights: weights.as_vec3().to_array(),
            slopes,
            sample: sample.sample,
        }
    }

    /// Which hits are no holes of masks.
    fn existing(&self, hits: &[(PendingRay, EyeFragment)], scratch: &mut PointScratch) -> Vec<bool> {
        let mut exists = vec![true; hits.len()];
        let draw = |&hit: &usize| self.runs[hits[hit].1.run].draw;
        let is_masked = |&hit: &usize| {
            matches!(self.runs[hits[hit].1.run].blend_mode, BlendMode::Masked | BlendMode::MaskedPerSample)
        };
        let mut masked: Vec<usize> = (0..hits.len()).filter(is_masked).collect();
        masked.sort_by_key(draw);
        let (mut points, mut passed) = (Vec::new(), Vec::new());
        for same in masked.chunk_by(|one, next| draw(one) == draw(next)) {
            points.clear();
            points.extend(same.iter().map(|&hit| hits[hit].1.point));
            passed.clear();
            passed.resize(same.len(), false);
            self.shader.mask(draw(&same[0]), &points, scratch, &mut passed);
            for (&hit, &passed) in same.iter().zip(&passed) {
                exists[hit] = passed;
            }
        }
        exists
    }
}
