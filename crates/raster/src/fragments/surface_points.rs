//! Points of triangles that something other than the rasterizer found visible, such as rays, as the input of a pipeline's
//! shading function. Their weights are given: nothing of them follows from where triangles are on the screen.

use super::barycentrics::Barycentrics;
use super::columns::Columns;
use super::context::ShadeContext;
use super::fragment_lanes::FragmentLanes;
use super::layout::flag;
use super::records::{Records, Tag};
use super::task::FragmentBatch;
use crate::simd::{F32, I32, InlineMap, LANES, Row, Simd, lanes_of, prelude::*};

/// A point of a triangle that is to be shaded.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint {
    /// The number of the triangle in its draw.
    pub triangle: u32,
    /// Whether its corners wind counter-clockwise as the eye sees them.
    pub front_facing: bool,
    /// The barycentric weights of its corners.
    pub weights: [f32; 3],
    /// The derivatives of the weights of corners 1 and 2, to the right and downwards, per sample of the finer grid; that
    /// of corner 0 makes their sum 0.
    pub slopes: [[f32; 2]; 2],
    /// The column and row of the sample in the finer grid of supersampling, both below 65536.
    pub sample: [u32; 2],
}

/// Memory for eight points at a time, to be reused.
pub struct PointScratch {
    records: Records,
    columns: Columns,
    /// The varyings at corner 0 of all lanes, then at corners 1 and 2.
    varyings: Vec<Row>,
    points: Vec<SurfacePoint>,
}

impl Default for PointScratch {
    fn default() -> Self {
        let (records, columns) = (Records::default(), Columns::new());
        Self { records, columns, varyings: Vec::new(), points: Vec::new() }
    }
}

impl PointScratch {
    /// Loads up to eight points; lanes to spare repeat the first.
    pub(crate) fn load(&mut self, context: &ShadeContext<'_>, points: &[SurfacePoint]) {
        let points = lanes_of(|lane| *points.get(lane).unwrap_or(&points[0]));
        let flags = |point: &SurfacePoint| if point.front_facing { 0 } else { flag::BACK };
        self.records
            .set_tags(points.each_ref().map(|point| Tag { primitive: point.triangle, flags: flags(point) }));
        let count = context.varying_count;
        self.varyings.clear();
        self.varyings.resize(3 * count, [0; LANES]);
        for (lane, point) in points.iter().enumerate() {
            let corners = context.geometry().corners(point.triangle);
            for (rows, corner) in self.varyings.chunks_exact_mut(count.max(1)).zip(corners) {
                for (row, value) in rows.iter_mut().zip(context.varyings.of(corner)) {
                    row[lane] = value.to_bits().cast_signed();
                }
            }
        }
        self.points.clear();
        self.points.extend(points);
    }

    /// The points that were loaded.
    #[inline(always)]
    pub(crate) fn lanes<'v, S: Simd>(
        &'v self,
        simd: S,
        context: &'v ShadeContext<'v>,
        batch: &'v FragmentBatch<'v, S>,
    ) -> FragmentLanes<'v, S> {
        let points: &[SurfacePoint; LANES] = self.points.first_chunk().expect("eight were loaded");
        let column = |of: &dyn Fn(&SurfacePoint) -> f32| F32::simd_from(simd, points.each_ref().map(of));
        let weights = [0, 1, 2].map(|corner| column(&|point| point.weights[corner]));
        let slopes = [0, 1].map(|corner| [0, 1].map(|axis| column(&|point| point.slopes[axis][corner])));
        let middle = |axis: usize| points.each_ref().map(|point| (point.sample[axis] as i32) * 256 + 128);
        let (first, others) = self.varyings.split_at(context.varying_count);
        let (second, third) = others.split_at(context.varying_count);
        FragmentLanes {
            simd,
            varyings: [first, second, third],
            columns: &self.columns,
            barycentrics: Barycentrics::of_weights(simd, weights, slopes),
            point: [0, 1].each(
                #[inline(always)]
                |axis| I32::simd_from(simd, middle(axis)),
            ),
            vector: batch,
            records: &self.records,
            context,
        }
    }
}
