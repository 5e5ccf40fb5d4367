//! Pipelines of different types side by side: the type is forgotten once per
//! draw and remembered once per run of a draw's pixels in a tile.

use super::columns::Columns;
use super::task::Task;
use super::{MAX_VARYINGS, ShadeContext, ShadeOutput, run, scalar};
use crate::LanePipeline;
use crate::simd::{Token, at_level};
use crate::vertex::{self, ScreenVertex, Slots};
use crate::viewport::Viewport;
use std::ops::Range;
use trigon_math::Vec4;

/// A pipeline without its type.
pub(crate) trait AnyPipeline: Sync {
    fn vertex_count(&self) -> usize;

    /// From how many f32 on the next vertex's varyings start: whole fours, so that
    /// they are copied by four; fewer where there are fewer.
    fn stride(&self) -> usize;

    /// How many f32 are interpolated.
    fn varyings(&self) -> usize;

    /// Whether fragments are asked for everything that there is to know.
    fn asks_all(&self) -> bool;

    /// Whether a triangle has the same colour all over.
    fn is_flat(&self) -> bool;

    /// Runs the vertex stage over some of the `used` vertices.
    fn run_vertices(
        &self,
        token: Token,
        used: Slots<'_>,
        slots: Range<usize>,
        viewport: Viewport,
        out: (&mut [ScreenVertex], &mut [f32]),
    );

    /// The clip-space position of a vertex.
    fn position(&self, token: Token, vertex: usize) -> Vec4;

    /// Shades pixels of the draw; of a flat one, one of each triangle.
    fn shade(
        &self,
        token: Token,
        context: &ShadeContext<'_>,
        list: (&Task<'_>, &mut [Columns; 2]),
        output: &mut ShadeOutput<'_>,
    );

    /// Asks whether the fragments of a list exist: 1 or 0 for each, at its output's
    /// place.
    fn mask(
        &self,
        token: Token,
        context: &ShadeContext<'_>,
        list: (&Task<'_>, &mut [Columns; 2]),
        kept: &mut [u8],
    );
}

impl<P: LanePipeline> AnyPipeline for P {
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

    fn asks_all(&self) -> bool {
        P::SCALAR
    }

    fn is_flat(&self) -> bool {
        P::FLAT
    }

    fn run_vertices(
        &self,
        token: Token,
        used: Slots<'_>,
        slots: Range<usize>,
        viewport: Viewport,
        out: (&mut [ScreenVertex], &mut [f32]),
    ) {
        // The other branch is not compiled.
        if P::SCALAR {
            let pipeline = self.as_scalar().expect("a scalar pipeline");
            vertex::run_scalar(token, (pipeline, stride(P::VARYINGS)), (used, slots), viewport, out);
        } else {
            at_level!(token, simd => vertex::run(simd, self, (used, slots), viewport, out));
        }
    }

    fn position(&self, token: Token, vertex: usize) -> Vec4 {
        let mut varyings = [0.0; MAX_VARYINGS];
        if P::SCALAR {
            let pipeline = self.as_scalar().expect("a scalar pipeline");
            Vec4::from_array(pipeline.run_vertex(vertex, &mut varyings))
        } else {
            at_level!(token, simd => vertex::position(simd, self, vertex, &mut varyings[..P::varyings(self)]))
        }
    }

    fn shade(
        &self,
        token: Token,
        context: &ShadeContext<'_>,
        list: (&Task<'_>, &mut [Columns; 2]),
        output: &mut ShadeOutput<'_>,
    ) {
        if P::SCALAR {
            let pipeline = self.as_scalar().expect("a scalar pipeline");
            scalar::shade(token, pipeline, context, list, output);
        } else {
            at_level!(token, simd => run::shade(simd, self, context, list, output));
        }
    }

    fn mask(
        &self,
        token: Token,
        context: &ShadeContext<'_>,
        list: (&Task<'_>, &mut [Columns; 2]),
        kept: &mut [u8],
    ) {
        if P::SCALAR {
            let pipeline = self.as_scalar().expect("a scalar pipeline");
            scalar::mask(token, pipeline, context, list, kept);
        } else if P::MASKED {
            at_level!(token, simd => run::mask(simd, self, context, list, kept));
        } else {
            kept.fill(1);
        }
    }
}

/// See [`AnyPipeline::stride`].
pub(crate) const fn stride(varyings: usize) -> usize {
    if varyings < 3 { varyings } else { varyings.next_multiple_of(4) }
}
