//! The vertices of one draw after the vertex stage.

use super::{ScreenVertex, Slots, VertexProgram};
use crate::clip::Outcode;
use crate::simd::Token;
use trigon_math::Vec4;

/// Looks up a draw's vertices by the indices that the draw uses.
#[derive(Clone, Copy)]
pub(crate) struct DrawVertices<'a> {
    pub(crate) slots: Slots<'a>,
    /// The last is that of vertices that do not exist.
    pub(crate) screen_vertices: &'a [ScreenVertex],
    pub(crate) pipeline: &'a dyn VertexProgram,
    pub(crate) token: Token,
}

impl<'a> DrawVertices<'a> {
    /// The vertex of an index; one that is not snapped and invalid if there is none.
    #[inline(always)]
    pub(crate) fn get(&self, index: u32) -> &'a ScreenVertex {
        let missing =
            self.screen_vertices.len().checked_sub(1).expect("there is one place more than vertices");
        &self.screen_vertices[self.slots.of(index).min(missing)]
    }

    /// The planes beyond which a vertex lies; none for one that needs no cutting.
    pub(crate) fn outcode(&self, index: u32) -> Outcode {
        self.get(index).outcode()
    }

    /// The position of a vertex in clip space. It is not kept, because few triangles are cut: the
    /// pipeline computes it again. Pipelines must then return the same bits as in the vertex stage, or
    /// cracks would open to neighbours that are not cut.
    pub(crate) fn position(&self, index: u32) -> Vec4 {
        self.pipeline.position(self.token, index as usize)
    }
}
