//! Shades a list of pixels of one draw in full vectors: those of a large
//! triangle together, those of small ones side by side. Which way a pixel takes
//! changes nothing.

use super::mixed::{Mixed, mixed};
use super::uniform::uniform;
use super::weights::TriangleLanes;
use super::{CornerValues, FragmentLanes, Job, LaneTriangles, MAX_VARYINGS, ShadeContext, ShadeOutput, Work};
use crate::LanePipeline;
use crate::simd::{Each, F32, I32, LANES, Simd, U32, lanes_of, prelude::*};

/// From this many pixels on a triangle gets vectors of its own.
const UNIFORM: usize = 5;

/// Vectors that have been made ready.
pub(super) struct Batch<'f, S: Simd> {
    pub(super) triangle: TriangleLanes<S>,
    pub(super) triangles: LaneTriangles<'f>,
}

/// Writes the colours of all pixels.
#[inline(always)]
pub(super) fn shade<S: Simd, P: LanePipeline>(
    simd: S,
    pipeline: &P,
    context: &ShadeContext<'_>,
    (jobs, work): (&[Job], &[Work]),
    output: &mut ShadeOutput<'_>,
) {
    for_each_vector(
        simd,
        context,
        P::VARYINGS,
        (jobs, work),
        #[inline(always)]
        |fragments, work| {
            output.write(simd, finite(simd, pipeline.fragments(simd, fragments)), work);
        },
    );
}

/// Writes for each pixel whether its fragment exists.
#[inline(always)]
pub(super) fn mask<S: Simd, P: LanePipeline>(
    simd: S,
    pipeline: &P,
    context: &ShadeContext<'_>,
    (jobs, work): (&[Job], &[Work]),
    kept: &mut [u8],
) {
    for_each_vector(
        simd,
        context,
        P::VARYINGS,
        (jobs, work),
        #[inline(always)]
        |fragments, work| {
            let mask = pipeline.masks(simd, fragments).to_bitmask();
            for (lane, work) in work.iter().enumerate() {
                kept[work.output as usize] = (mask >> lane & 1) as u8;
            }
        },
    );
}

/// One colour for each triangle, asked at the first of its pixels.
#[inline(always)]
pub(super) fn shade_flat<S: Simd, P: LanePipeline>(
    simd: S,
    pipeline: &P,
    context: &ShadeContext<'_>,
    (jobs, work): (&[Job], &[Work]),
    output: &mut ShadeOutput<'_>,
) {
    let mut values = [CornerValues::ZERO; MAX_VARYINGS];
    for job in jobs {
        let batch = uniform(simd, context, job.place, &mut values[..P::VARYINGS]);
        let all = &work[job.work.clone()];
        let fragments = fragments(simd, context, &batch, &values[..P::VARYINGS], &all[..1]);
        let color = finite(simd, pipeline.fragments(simd, &fragments));
        output.fill(simd, color, all);
    }
}

/// Calls `visit` with vectors that cover all pixels, each with its own part of
/// the work.
#[inline(always)]
pub(super) fn for_each_vector<S: Simd>(
    simd: S,
    context: &ShadeContext<'_>,
    stride: usize,
    (jobs, work): (&[Job], &[Work]),
    mut visit: impl FnMut(&FragmentLanes<'_, S>, &[Work]),
) {
    let mut values = [CornerValues::ZERO; MAX_VARYINGS];
    let mut waiting = Mixed::default();
    let mut jobs = jobs.iter();
    let mut together = [Work::default(); LANES];
    loop {
        let job = if waiting.is_full() { None } else { jobs.next() };
        let (batch, work) = match job {
            Some(job) => {
                let all = &work[job.work.clone()];
                let whole = if context.is_cut(job.place) { all.len() } else { full(all.len()) };
                waiting.extend(job.place, &all[whole..]);
                if whole == 0 {
                    continue;
                }
                (uniform(simd, context, job.place, &mut values[..stride]), &all[..whole])
            }
            None if waiting.is_empty() => return,
            None => mixed(simd, context, (&mut waiting, &mut together), &mut values[..stride]),
        };
        for work in work.chunks(LANES) {
            visit(&fragments(simd, context, &batch, &values[..stride], work), work);
        }
    }
}

/// How many of a triangle's pixels are shaded in vectors of its own; the rest
/// shares one with other triangles.
#[inline(always)]
fn full(count: usize) -> usize {
    if count % LANES < UNIFORM { count - count % LANES } else { count }
}

/// The fragments of up to eight pixels.
#[inline(always)]
fn fragments<'v, S: Simd>(
    simd: S,
    context: &ShadeContext<'_>,
    batch: &'v Batch<'_, S>,
    varyings: &'v [CornerValues],
    work: &[Work],
) -> FragmentLanes<'v, S> {
    let [x, y] = points(simd, context, &batch.triangle, work);
    FragmentLanes {
        simd,
        count: work.len(),
        varyings,
        place: batch.triangle.at(simd, x, y),
        x,
        y,
        supersampling: context.frame.supersampling,
        triangles: &batch.triangles,
    }
}

/// Where up to eight pixels are shaded, in 1/256 pixel: at their centre, or if
/// their triangle does not cover it at the lowest-numbered sample that it covers.
#[inline(always)]
fn points<S: Simd>(
    simd: S,
    context: &ShadeContext<'_>,
    triangle: &TriangleLanes<S>,
    work: &[Work],
) -> [I32<S>; 2] {
    // Lanes to spare repeat the first.
    let spots = lanes_of(
        #[inline(always)]
        |lane| work.get(lane).unwrap_or(&work[0]).spot(),
    );
    let (corners, partly) = Work::corners(U32::simd_from(simd, spots), &context.area);
    let centre = corners.each(
        #[inline(always)]
        |column| column + 128,
    );
    if !partly {
        return centre;
    }
    let covered = triangle.covers(simd, centre);
    if covered.all_true() {
        return centre;
    }
    let mut points = centre;
    for offset in context.frame.grid.pattern.offsets().iter().rev() {
        let sample = [corners[0] + offset[0], corners[1] + offset[1]];
        let here = !covered & triangle.covers(simd, sample);
        points = [0, 1].each(
            #[inline(always)]
            |axis| here.select(sample[axis], points[axis]),
        );
    }
    points
}

/// A colour without anything that is not finite.
#[inline(always)]
pub(super) fn finite<S: Simd>(simd: S, color: [F32<S>; 4]) -> [F32<S>; 4] {
    let zero = F32::splat(simd, 0.0);
    // Infinity and NaN times zero are no numbers.
    color.each(
        #[inline(always)]
        |channel| (channel * zero).simd_eq(zero).select(channel, zero),
    )
}
