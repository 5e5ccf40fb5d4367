//! The loop over the vertices of a draw: runs the pipeline, eight vertices at a time, and snaps the results to the
//! sub-pixel grid.

use super::traits::{LanePipeline, ScalarPipeline};
use crate::MAX_VARYINGS;
use crate::simd::{F32, InlineMap, LANES, Simd, Token, at_level, prelude::*};
use crate::vertex::{ScreenVertex, Slots, VertexDestination, VertexLanes, VertexProgram, to_screen};
use crate::viewport::Viewport;
use std::ops::Range;
use trigon_math::Vec4;

/// The distance in f32 from one vertex's varyings to the next one's: see [`VertexProgram::stride`].
const fn stride(varyings: usize) -> usize {
    if varyings < 3 { varyings } else { varyings.next_multiple_of(2) }
}

impl<P: LanePipeline> VertexProgram for P {
    fn vertex_count(&self) -> usize {
        P::vertex_count(self)
    }

    fn stride(&self) -> usize {
        let varyings = P::varyings(self);
        assert!(varyings <= MAX_VARYINGS, "a pipeline has at most {MAX_VARYINGS} varyings, not {varyings}");
        stride(varyings)
    }

    fn varyings(&self) -> usize {
        P::varyings(self)
    }

    fn run_vertices(
        &self,
        token: Token,
        used: Slots<'_>,
        slots: Range<usize>,
        viewport: Viewport,
        out: VertexDestination<'_>,
    ) {
        let run = VertexRun { used, slots, viewport, out };
        // The other branch is not compiled.
        if P::SCALAR {
            let pipeline = self.as_scalar().expect("a scalar pipeline");
            run_scalar(token, pipeline, stride(P::VARYINGS), run);
        } else {
            at_level!(token, simd => run_lanes(simd, self, run));
        }
    }

    fn position(&self, token: Token, vertex: u32) -> Vec4 {
        let mut varyings = [0.0; MAX_VARYINGS];
        if P::SCALAR {
            let pipeline = self.as_scalar().expect("a scalar pipeline");
            return Vec4::from_array(pipeline.run_vertex(vertex as usize, &mut varyings));
        }
        // By the code of the vertex stage, so that it is compiled once.
        let (mut position, mut snapped) = (Vec4::ZERO, [ScreenVertex::default()]);
        let varyings = &mut varyings[..self.stride()];
        let out = VertexDestination { vertices: &mut snapped, varyings, position: Some(&mut position) };
        self.run_vertices(token, Slots::of_vertex(vertex), 0..1, Viewport { width: 1, height: 1 }, out);
        position
    }
}

/// Some of the vertices that a draw uses.
struct VertexRun<'r> {
    used: Slots<'r>,
    slots: Range<usize>,
    viewport: Viewport,
    out: VertexDestination<'r>,
}

/// Computes screen vertices and varyings.
#[inline(always)]
fn run_lanes<S: Simd, P: LanePipeline>(simd: S, pipeline: &P, run: VertexRun<'_>) {
    let VertexRun { used, slots, viewport, out } = run;
    let VertexDestination { vertices, mut varyings, mut position } = out;
    let (guard, stride) = (viewport.guard(), stride(pipeline.varyings()));
    // Listed vertices do not lie side by side.
    let together = if used.are_consecutive() { LANES } else { 1 };
    for (group, vertices) in vertices.chunks_mut(together).enumerate() {
        let first = used.index(slots.start + group * together);
        let (rows, rest) = std::mem::take(&mut varyings).split_at_mut(vertices.len() * stride);
        varyings = rest;
        let mut lanes = VertexLanes::new(first, vertices.len(), rows, stride);
        let clip = pipeline.vertices(simd, &mut lanes);
        if let Some(position) = position.take() {
            let [x, y, z, w] = clip;
            *position = Vec4::new(x[0], y[0], z[0], w[0]);
        }
        to_screen(simd, clip, viewport, guard, vertices);
    }
}

/// As [`run_lanes`], one vertex after the other; compiled once for all pipelines.
fn run_scalar(token: Token, pipeline: &dyn ScalarPipeline, stride: usize, run: VertexRun<'_>) {
    let VertexRun { used, slots, viewport, out } = run;
    let VertexDestination { vertices, mut varyings, .. } = out;
    let guard = viewport.guard();
    for (group, vertices) in vertices.chunks_mut(LANES).enumerate() {
        let mut columns = [[0.0; LANES]; 4];
        for lane in 0..vertices.len() {
            let (row, rest) = std::mem::take(&mut varyings).split_at_mut(stride);
            varyings = rest;
            let position = pipeline.run_vertex(used.index(slots.start + group * LANES + lane), row);
            for (column, value) in columns.iter_mut().zip(position) {
                column[lane] = value;
            }
        }
        at_level!(token, simd => {
            to_screen(simd, columns.each(#[inline(always)] |column| F32::simd_from(simd, column)), viewport, guard, vertices);
        });
    }
}
