//! The vertex half of a draw's pipeline, without its type.

use super::{ScreenVertex, Slots};
use crate::simd::Token;
use crate::viewport::Viewport;
use std::ops::Range;
use trigon_math::Vec4;

/// What the stages before shading ask of a pipeline. The type is forgotten once per draw.
pub(crate) trait VertexProgram: Sync {
    fn vertex_count(&self) -> usize;

    /// From how many f32 on the next vertex's varyings start: whole fours, so that
    /// they are copied by four; fewer where there are fewer.
    fn stride(&self) -> usize;

    /// How many f32 are interpolated.
    fn varyings(&self) -> usize;

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
}
