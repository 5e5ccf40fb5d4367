//! Shading for pipelines that shade one fragment at a time: compiled once for
//! all of them, and not for each at every level.

use super::run::{finite, for_each_vector};
use super::{Job, ShadeContext, ShadeOutput, Work};
use crate::pipeline::ScalarPipeline;
use crate::simd::{Each, F32, LANES, Simd, Token, at_level, prelude::*};

/// A pipeline and the number of its varyings.
type Pipeline<'p> = (&'p dyn ScalarPipeline, usize);

/// Writes the colours of all pixels.
pub(super) fn shade(
    token: Token,
    pipeline: Pipeline<'_>,
    context: &ShadeContext<'_>,
    list: (&[Job], &[Work]),
    output: &mut ShadeOutput<'_>,
) {
    at_level!(token, simd => shade_lanes(simd, pipeline, context, list, output));
}

#[inline(always)]
fn shade_lanes<S: Simd>(
    simd: S,
    (pipeline, stride): Pipeline<'_>,
    context: &ShadeContext<'_>,
    list: (&[Job], &[Work]),
    output: &mut ShadeOutput<'_>,
) {
    for_each_vector(
        simd,
        context,
        stride,
        list,
        #[inline(always)]
        |fragments, work| {
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
            output.write(simd, finite(simd, color), work);
        },
    );
}

/// Writes for each pixel whether its fragment exists.
pub(super) fn mask(
    token: Token,
    (pipeline, stride): Pipeline<'_>,
    context: &ShadeContext<'_>,
    list: (&[Job], &[Work]),
    kept: &mut [u8],
) {
    at_level!(token, simd => for_each_vector(simd, context, stride, list, #[inline(always)] |fragments, work| {
        fragments.for_each(|lane, fragment| {
            kept[work[lane].output as usize] = u8::from(pipeline.run_mask(&fragment));
        });
    }));
}
