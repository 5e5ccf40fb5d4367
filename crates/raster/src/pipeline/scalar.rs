//! Shading for pipelines that shade one fragment at a time: compiled once for
//! all of them, and not for each at every level.

use super::run::for_each_vector;
use super::traits::ScalarPipeline;
use crate::fragments::{Columns, ShadeContext, ShadeOutput, Task, finite};
use crate::simd::{F32, InlineMap, LANES, Simd, Token, at_level, prelude::*};

/// Writes the colours of all pixels.
pub(super) fn shade(
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
pub(super) fn mask(
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
