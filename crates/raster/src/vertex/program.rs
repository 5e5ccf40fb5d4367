//! The vertex half of a draw's pipeline, without its type.

use super::{ScreenVertex, Slots};
use crate::simd::Token;
use crate::viewport::Viewport;
use std::ops::Range;
use trigon_math::Vec4;

/// Where the vertex stage writes vertices, and their varyings side by side.
pub(crate) struct VertexDestination<'o> {
    pub(crate) vertices: &'o mut [ScreenVertex],
    pub(crate) varyings: &'o mut [f32],
}

/// What the stages before shading need of a pipeline. The type is erased once per draw.
pub(crate) trait VertexProgram: Sync {
    fn vertex_count(&self) -> usize;

    /// The distance in f32 from one vertex's varyings to the next one's: a multiple of 2, so that
    /// two are copied at a time; one if there is one.
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
        out: VertexDestination<'_>,
    );

    /// The clip-space position of a vertex.
    fn position(&self, token: Token, vertex: usize) -> Vec4;
}
