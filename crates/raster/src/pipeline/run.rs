//! The loop over the fragments of one draw, in full vectors: a vector's pixels may show different triangles.
//!
//! The weights of the next eight pixels are computed before the current eight are shaded: the longest chain of
//! dependent instructions begins with them (`docs/performance-notebook.md`, "Dependency stalls in shading").
//!
//! Pipelines of different types lie side by side: the type is erased once per draw ([`AnyPipeline`]). A virtual call
//! restores it, once for all pixels of a draw in a tile. Shading for pipelines that shade one fragment at a time is
//! compiled once for all of them, and not for each at every level.

use super::traits::ScalarPipeline;
use crate::LanePipeline;
use crate::fragments::{
    Barycentrics, Columns, FragmentBatch, FragmentLanes, Records, ShadeContext, ShadeOutput, ShadePoint,
    SpecialColumns, Spots, Task, TriangleLanes, finite,
};
use crate::simd::{F32, I32, InlineMap, LANES, Simd, Token, U32, at_level, prelude::*};
use crate::vertex::VertexProgram;

/// Writes the colours of all pixels.
#[inline(always)]
pub(super) fn shade<S: Simd, P: LanePipeline>(
    simd: S,
    pipeline: &P,
    context: &ShadeContext<'_>,
    task: &Task<'_>,
    columns: &mut [Columns; 2],
    output: &mut ShadeOutput<'_>,
) {
    for_each_vector(
        simd,
        context,
        task,
        columns,
        #[inline(always)]
        |fragments, _| output.write(fragments, finite(simd, pipeline.fragments(simd, fragments))),
    );
}

/// Writes for each fragment of a list whether it exists.
#[inline(always)]
pub(super) fn mask<S: Simd, P: LanePipeline>(
    simd: S,
    pipeline: &P,
    context: &ShadeContext<'_>,
    task: &Task<'_>,
    columns: &mut [Columns; 2],
    passed: &mut [u8],
) {
    for_each_vector(
        simd,
        context,
        task,
        columns,
        #[inline(always)]
        |fragments, vector| {
            let mask = pipeline.masks(simd, fragments).to_bitmask();
            for (lane, &output) in vector.outputs().iter().enumerate() {
                passed[output as usize] = (mask >> lane & 1) as u8;
            }
        },
    );
}

/// Calls `visit` with vectors that cover all pixels.
#[inline(always)]
fn for_each_vector<S: Simd>(
    simd: S,
    context: &ShadeContext<'_>,
    task: &Task<'_>,
    columns: &mut [Columns; 2],
    mut visit: impl FnMut(&FragmentLanes<'_, S>, &FragmentBatch<'_, S>),
) {
    let [mut next, mut now] = columns.each_mut();
    next.reset();
    now.reset();
    let count = task.vectors();
    for number in 0..count + 1 {
        if number < count {
            // A separate function, so that it is compiled once for all pipelines.
            simd.vectorize(
                #[inline(always)]
                || prepare(simd, context, task, &mut *next, number),
            );
        }
        if number > 0 {
            let vector = task.vector(simd, number - 1);
            visit(&fragments(simd, context, task.records, now, &vector), &vector);
        }
        std::mem::swap(&mut next, &mut now);
    }
}

/// Loads a vector's triangles, and the positions of its pixels in them.
#[inline(always)]
fn prepare<S: Simd>(
    simd: S,
    context: &ShadeContext<'_>,
    task: &Task<'_>,
    columns: &mut Columns,
    number: usize,
) {
    if let Some(points) = task.points {
        return columns.load_points(context, &points[number * LANES..]);
    }
    let vector = task.vector(simd, number);
    columns.load(simd, context, task.records, &vector);
    let point = points(simd, context, columns, vector.spots);
    columns.placed = TriangleLanes::load(simd, columns).weigh(simd, point);
}

/// The fragments of a vector.
#[inline(always)]
fn fragments<'v, S: Simd>(
    simd: S,
    context: &'v ShadeContext<'v>,
    records: &'v Records,
    columns: &'v Columns,
    vector: &'v FragmentBatch<'_, S>,
) -> FragmentLanes<'v, S> {
    let barycentrics = match columns.special().and_then(SpecialColumns::slopes) {
        None => TriangleLanes::load(simd, columns).at(simd, &columns.placed),
        Some(slopes) => Barycentrics::of_weights(simd, &columns.placed, slopes),
    };
    FragmentLanes {
        simd,
        varyings: columns.varyings(records.shape().varyings),
        columns,
        barycentrics,
        point: columns.placed.point(simd),
        vector,
        records,
        context,
    }
}

/// Where up to eight pixels are shaded, in 1/256 pixel from the tile's corner: at a
/// given sample, or else at their centre, or at the lowest-numbered sample that their
/// triangle covers if it does not cover the centre.
#[inline(always)]
fn points<S: Simd>(simd: S, context: &ShadeContext<'_>, columns: &Columns, spots: U32<S>) -> [I32<S>; 2] {
    let (corners, elsewhere) = ShadePoint::corners(spots);
    let Some(spots) = elsewhere else {
        return corners.each(
            #[inline(always)]
            |column| column + 128,
        );
    };
    // A separate function that borrows nothing from this one: borrowed values would have to live in memory,
    // even where pixels have one sample.
    let [x, y] = simd.vectorize(
        #[inline(always)]
        move || sample_points(simd, context, &TriangleLanes::load(simd, columns), corners, &spots),
    );
    [x, y]
}

/// The same where some pixels may be shaded elsewhere than at their centres.
#[inline(always)]
fn sample_points<S: Simd>(
    simd: S,
    context: &ShadeContext<'_>,
    triangle: &TriangleLanes<'_, S>,
    corners: [I32<S>; 2],
    spots: &Spots<S>,
) -> [I32<S>; 2] {
    let Spots { partly, samples } = *spots;
    let mut points = corners.each(
        #[inline(always)]
        |column| column + 128,
    );
    let sampled = samples.simd_gt(I32::splat(simd, 0)) & !partly;
    let beside = partly & !triangle.covers(simd, points);
    let mut pending = sampled | beside;
    for (index, offset) in context.pattern.offsets().iter().enumerate() {
        if !pending.any_true() {
            break;
        }
        let sample = [corners[0] + offset[0], corners[1] + offset[1]];
        let mut here = pending & samples.simd_eq(I32::splat(simd, index as i32 + 1));
        // Most often all pixels see their triangles at their first samples.
        if (pending & !here).any_true() {
            here |= pending & beside & triangle.covers(simd, sample);
        }
        points = [0, 1].each(
            #[inline(always)]
            |axis| here.select(sample[axis], points[axis]),
        );
        pending &= !here;
    }
    points
}

/// Writes the colours of all pixels.
pub(super) fn shade_scalar(
    token: Token,
    pipeline: &dyn ScalarPipeline,
    context: &ShadeContext<'_>,
    task: &Task<'_>,
    columns: &mut [Columns; 2],
    output: &mut ShadeOutput<'_>,
) {
    at_level!(token, simd => shade_lanes(simd, pipeline, context, task, columns, output));
}

#[inline(always)]
fn shade_lanes<S: Simd>(
    simd: S,
    pipeline: &dyn ScalarPipeline,
    context: &ShadeContext<'_>,
    task: &Task<'_>,
    columns: &mut [Columns; 2],
    output: &mut ShadeOutput<'_>,
) {
    for_each_vector(
        simd,
        context,
        task,
        columns,
        #[inline(always)]
        |fragments, _| {
            let mut colors = [[0.0; LANES]; 4];
            fragments.for_each(|lane, fragment| {
                for (column, value) in colors.iter_mut().zip(pipeline.run_fragment(&fragment)) {
                    column[lane] = value;
                }
            });
            let color = colors.each(
                #[inline(always)]
                |column| F32::simd_from(simd, column),
            );
            output.write(fragments, finite(simd, color));
        },
    );
}

/// Writes for each fragment of a list whether it exists.
pub(super) fn mask_scalar(
    token: Token,
    pipeline: &dyn ScalarPipeline,
    context: &ShadeContext<'_>,
    task: &Task<'_>,
    columns: &mut [Columns; 2],
    passed: &mut [u8],
) {
    at_level!(token, simd => for_each_vector(simd, context, task, columns, #[inline(always)] |fragments, vector| {
        fragments.for_each(|lane, fragment| {
            passed[vector.outputs()[lane] as usize] = u8::from(pipeline.run_mask(&fragment));
        });
    }));
}

/// A pipeline without its type.
pub(crate) trait AnyPipeline: VertexProgram {
    /// Whether it reads the whole fragment, depth and 1/w included.
    fn reads_all(&self) -> bool;

    /// Whether a triangle has the same colour all over.
    fn is_flat(&self) -> bool;

    /// Shades pixels of the draw; of a flat one, one of each triangle.
    fn shade(
        &self,
        token: Token,
        context: &ShadeContext<'_>,
        task: &Task<'_>,
        columns: &mut [Columns; 2],
        output: &mut ShadeOutput<'_>,
    );

    /// Evaluates the masks of a list of fragments: 1 or 0 for each, at its output's index.
    fn mask(
        &self,
        token: Token,
        context: &ShadeContext<'_>,
        task: &Task<'_>,
        columns: &mut [Columns; 2],
        passed: &mut [u8],
    );
}

impl<P: LanePipeline> AnyPipeline for P {
    fn reads_all(&self) -> bool {
        P::SCALAR
    }

    fn is_flat(&self) -> bool {
        P::FLAT
    }

    fn shade(
        &self,
        token: Token,
        context: &ShadeContext<'_>,
        task: &Task<'_>,
        columns: &mut [Columns; 2],
        output: &mut ShadeOutput<'_>,
    ) {
        if P::SCALAR {
            let pipeline = self.as_scalar().expect("a scalar pipeline");
            shade_scalar(token, pipeline, context, task, columns, output);
        } else {
            at_level!(token, simd => shade(simd, self, context, task, columns, output));
        }
    }

    fn mask(
        &self,
        token: Token,
        context: &ShadeContext<'_>,
        task: &Task<'_>,
        columns: &mut [Columns; 2],
        passed: &mut [u8],
    ) {
        if P::SCALAR {
            let pipeline = self.as_scalar().expect("a scalar pipeline");
            mask_scalar(token, pipeline, context, task, columns, passed);
        } else if P::MASKED {
            at_level!(token, simd => mask(simd, self, context, task, columns, passed));
        } else {
            passed.fill(1);
        }
    }
}
